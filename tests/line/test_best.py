import numpy as np
import pytest

from figures.measure.optimise.one_arc import best_of_one_arc
from linear_theory import Directional, Tanh, TravellingWave, Viscous, line_balance
from linear_theory.line.best.dry import dry_bound, nearly_square, size_of
from linear_theory.line.best.gradient import line_gradient
from linear_theory.line.best.viscous import best_viscous, viscous_speed
from linear_theory.optimisation.certificate import certificate
from linear_theory.optimisation.problem import Ball, Evaluation, Region
from linear_theory.optimisation.search import Ascent, climb
from linear_theory.optimisation.starts import starts

LAWS = ("coulomb", "viscous", Tanh(0.004), Directional(0.5, 1.0), Directional(0.5, 1.0, form=Viscous()))


@pytest.mark.parametrize("trial", range(5))
def test_gradient_on_a_line_is_that_of_differences(trial):
    """Of speed and power, of every law, stretch, body and load on random waves: to what differences
    are worth."""
    random = np.random.default_rng(trial)
    n = int(random.integers(2, 5))
    law, growth = LAWS[trial], ("exp", "linear", "metric")[trial % 3]
    body, count = ("line", "strip")[trial % 2], int(random.choice([1, -2]))
    alpha, length = float(random.choice([0.1, -0.08])), random.uniform(0.5, 2)
    steep = np.tile(np.arange(1.0, n + 1), 2)
    at = np.array([*random.normal(size=2 * n) / steep, 0.2, alpha, random.uniform(0.5, 2)])

    def made(v):
        return TravellingWave(v[:n], v[n : 2 * n], count, v[-1], v[-3]), v[-2]

    def motion(v):
        speed = line_balance(*made(v), friction=law, growth_law=growth, body=body, length=length)
        return np.array([speed.mean, speed.power.value])

    found = line_gradient(*made(at), friction=law, growth_law=growth, body=body, length=length)
    got = np.array(
        [[*one.cosine, *one.sine, one.mean, one.alpha, one.period] for one in (found, found.power)]
    )
    steps = 1e-6 * np.eye(at.size)
    expected = np.array([(motion(at + h) - motion(at - h)) / 2e-6 for h in steps]).T
    for ours, theirs in zip(got, expected, strict=True):
        np.testing.assert_allclose(ours, theirs, atol=2e-8 * abs(theirs).max())
    assert found.kink == ""


def test_the_power_of_friction_with_a_direction_is_known_to_its_error():
    """Its force has a corner at rest, between any points of a rule: the mean over very many phases."""
    wave, law = TravellingWave([1.0, 0.4], [0.3, -0.2], mean=0.1), Directional(0.5, 1.0, form=Viscous())
    found = line_balance(wave, 0.1, friction=law)
    stretch = 1 + 0.1 * wave.value(0.0, (np.arange(400_000) + 0.5) / 400_000, np.zeros(1)).ravel()
    slip = found.mean - (stretch - stretch.mean())
    literal = float((stretch * law.dissipation(slip[None])).mean())
    assert abs(found.power.value - literal) <= found.power.error + 1e-13


def test_a_kink_is_said():
    """cos phi + a cos 2 phi turns at phi = pi at the value a - 1: for a = 1/2 the median is not there;
    of cos phi - cos 3 phi/9 + ... flattened at its median 0 it is."""
    smooth = line_gradient(TravellingWave([1.0, 0.5], [0.0, 0.0]), 0.1)
    assert smooth.kink == ""
    flat = line_gradient(TravellingWave([1.0, 0.0, 1 / 3], [0.0, 0.0, 0.0]), 1e-9)  # cos^3: c' = 0 at 0
    assert "kink" in flat.kink


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"alpha": 0.0}, "alpha = 0: must not be 0"),
        ({"length": -1.0}, "length = -1: must be > 0"),
    ],
)
def test_a_gradient_that_is_not_there_is_refused(arguments, words):
    with pytest.raises(ValueError, match=words):
        line_gradient(TravellingWave([1.0], [0.0]), **{"alpha": 0.1, **arguments})


def test_no_wave_is_better_than_the_bound_on_dry_ground():
    random = np.random.default_rng(3)
    for n in range(1, 9):
        for _ in range(60):
            cosine, sine = random.normal(size=(2, n)) / np.arange(1, n + 1) ** random.uniform(0, 2)
            angle = np.outer(np.linspace(0, 2 * np.pi, 4001)[1:], np.arange(1, n + 1))
            g = np.cos(angle) @ cosine + np.sin(angle) @ sine
            size = np.ptp(g) / 2  # of |c| with the mean that makes it smallest
            assert np.median(g) / size <= dry_bound(n) + 1e-3  # samples


@pytest.mark.parametrize("harmonics", [2, 3, 6])
def test_the_best_wave_of_one_arc_is_below_the_bound(harmonics):
    above, below = best_of_one_arc(harmonics)
    assert below <= above <= dry_bound(harmonics)
    assert above - below < 2e-3


def test_the_supremum_is_approached():
    values = [line_balance(nearly_square(n, d), 1e-7).mean / 1e-7 for n, d in ((30, 0.1), (400, 0.02))]
    assert values[0] < values[1] < 1
    assert values[1] > 0.93
    wave = nearly_square(40, 0.1)
    assert 0.9 < size_of(wave) <= 1.0001


def test_viscous_optimum_is_the_largest_eigenvalue_of_the_kernel():
    """A literal matrix of sgn(S - S') - (S - S'), and the balance of the wave itself."""
    count = 400
    place = (np.arange(count) + 0.5) / count
    kernel = np.sign(place[:, None] - place) - (place[:, None] - place)
    largest = np.sort(np.linalg.eigvals(kernel / count).imag)[::-1]
    for number in (1, 2, 3):
        assert largest[number - 1] == pytest.approx(2 / best_viscous(number).theta, rel=2e-4)
    best = best_viscous()
    found = line_balance(best.wave(0.3, 2.0, 0.5), 1e-3, friction="viscous", length=2.0, rtol=1e-4)
    assert found.second_order == pytest.approx(0.3 * best.gain * 2.0 / 0.5, rel=1e-4)
    one, other = best.wave(0.3, 2.0, 0.5), np.linspace(-1, 1, 2001)
    square = np.mean(one.value(0.0, other, np.linspace(0, 0.5, 64, endpoint=False)[:, None]) ** 2)
    assert square == pytest.approx(0.3, rel=1e-3)


def test_the_optimiser_finds_the_viscous_optimum():
    """From random growth of cells, of one mean square, at one frequency."""
    cells, square = 16, 0.5
    size = Ball("mean square", np.full(2 * cells, 0.5 / cells), square)
    box = 3.0 * np.ones(2 * cells)
    region = Region(-box, box, 0 * box, 0.5 * box, (size,))

    def objective(point):
        speed, *gradient = viscous_speed(point[:cells], point[cells:])
        return Evaluation(speed, 0.0, np.concatenate(gradient), np.zeros(2 * cells))

    exact = square / best_viscous().theta
    for start in starts(region, 3, seed=5):
        found = climb([objective], objective, region, start, Ascent(change=1e-10))
        assert found.value == pytest.approx(exact, rel=6 / cells**2)
        names = [f"cell {i}" for i in range(2 * cells)]
        assert certificate(objective, region, found.point, names).holds(1e-4)
    sine = np.cos(2 * np.pi * (np.arange(cells) + 0.5) / cells - np.array([[0.0], [np.pi / 2]])).ravel()
    proof = certificate(objective, region, sine, names)
    assert not proof.holds(0.1)  # the sine of one wave is not the best in a finite body
    assert proof.value == pytest.approx(exact / best_viscous().gain, rel=6 / cells**2)


def test_gradient_of_the_viscous_speed():
    random = np.random.default_rng(0)
    a, b, da, db = random.normal(size=(4, 50))
    _, by_a, by_b = viscous_speed(a, b)
    change = (viscous_speed(a + da, b + db)[0] - viscous_speed(a - da, b - db)[0]) / 2  # bilinear
    assert change == pytest.approx(by_a @ da + by_b @ db, rel=1e-12)
