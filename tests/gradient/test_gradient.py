"""The gradient of the speed: transposes, exact identities, central differences, stated errors."""

import math

import numpy as np
import pytest

from figures.measure.gradient.frozen import Frozen, difference
from figures.measure.gradient.scenes import names_of, scene_of
from figures.measure.gradient.table import worst
from linear_theory import (
    Contact,
    Coulomb,
    Directional,
    FieldWave,
    Mapped,
    Patches,
    Scene,
    Sheet,
    SineWave,
    Tanh,
    TravellingWave,
    Viscous,
    crawl_speed,
)
from linear_theory.deformation.ritz.solver import RitzSolver
from linear_theory.gradient import (
    WaveFamily,
    cost_gradient,
    elastic,
    motion_gradient,
    parameter,
    parameters,
    power_gradient,
    speed_gradient,
)
from linear_theory.gradient.leaves import gathered, local_coordinates
from linear_theory.motion.cells import graded
from linear_theory.motion.creases import cut

PULSE = TravellingWave([0.5, 0.2], [0.3, -0.1], 1, 1.0, 0.1)
TANH = Contact("current", Tanh(0.1))


def differences(scene, over, quantity, rtol, step=1e-2):
    """Central differences of a quantity of `crawl_speed`, and the errors of these."""
    values, errors = [], []
    for one in parameters(over):
        at = one.value(scene)
        ends = [
            quantity(crawl_speed(one.changed(scene, at + sign * step), rtol=rtol, method="ritz"))
            for sign in (1, -1)
        ]
        values.append((ends[0].value - ends[1].value) / (2 * step))
        errors.append((ends[0].error + ends[1].error) / (2 * step))
    return np.array(values), np.array(errors)


def test_weights_at_leaves_are_the_transpose_of_interpolation():
    """Sum of weights times interpolated values = sum of gathered weights times values."""
    random, n, cells = np.random.default_rng(1), 5, 6
    values = random.normal(size=(1, cells, n, n))
    place = np.broadcast_to(local_coordinates(n)[:, None], (2, cells, n, n))

    def rough(some, owners):  # some of the cells, along either axis
        return some[1, :, 0, 0] > 0.2, random.integers(0, 2, owners.size)

    channels = np.concatenate([np.ones_like(values), values, place])
    halved = graded(channels, np.arange(cells), rough, 4)
    curved = cut(halved, lambda some, owners: some[2] + 0.3 * some[3] - 0.2, 0, 2)
    assert curved.owners.size > halved.owners.size > cells
    for leaves in (halved, curved):
        weights = random.normal(size=(2, *leaves.values.shape[1:]))
        found = gathered(leaves, leaves.values[2:], weights, cells)
        want = (weights * leaves.values[1]).sum((1, 2, 3))
        assert np.allclose((found * values).sum((1, 2, 3)), want, rtol=1e-11)


@pytest.fixture(scope="module")
def solved():
    """A random growth, its displacement, and a random linear function of that with its z."""
    random, sheet = np.random.default_rng(2), Sheet(width=0.4, poisson=0.2)
    solver = RitzSolver(sheet, (5, 7))
    growth, load = random.normal(size=(1, 6, 8)), random.normal(size=(1, 2, 6, 8))
    return sheet, growth, load, solver.solve(growth), elastic.adjoint(solver, load, mirrored=False)


def test_the_density_of_growth_is_the_transpose_of_the_ritz_solution(solved):
    sheet, growth, load, u, z = solved
    assert (elastic.density(sheet, z) * growth).sum() == pytest.approx((load * u).sum(), rel=1e-11)


@pytest.mark.parametrize("name", ["poisson", "width"])
def test_the_change_of_the_ritz_solution_with_the_sheet(solved, name):
    sheet, growth, load, u, z = solved
    step = 1e-4

    def value(shift):
        sizes = {"width": sheet.width, "poisson": sheet.poisson}
        sizes[name] += shift * (sheet.width if name == "width" else 1.0)
        free = elastic._without_rigid_motion(load, sheet)  # what is rigid depends on the width, too
        return float((free * RitzSolver(Sheet(1.0, **sizes), (5, 7)).solve(growth)).sum())

    slope = (8 * (value(step) - value(-step)) - value(2 * step) + value(-2 * step)) / (12 * step)
    by = {"poisson": elastic.by_poisson, "width": elastic.by_width}[name]
    assert by(sheet, growth, u, z)[0] == pytest.approx(slope, rel=1e-8)


@pytest.mark.parametrize(("name", "seed"), [("viscous", 1), ("tanh", 2), ("tanh", 3)])
def test_adjoint_is_the_derivative_of_the_sums_on_a_frozen_grid(name, seed):
    """Along a random direction of all parameters, by differences of fourth order of the same sums."""
    random = np.random.default_rng(seed)
    assert difference(scene_of(name, random), random) < 1e-6


@pytest.mark.parametrize("name", ["tanh", "coulomb"])
def test_stated_errors_are_not_smaller_than_true_ones(name):
    scene = scene_of(name, np.random.default_rng(8), harmonics=2)
    assert worst(scene, names_of(scene), name).share <= 1


@pytest.mark.parametrize("law", [Viscous(), Tanh(0.1), Coulomb()], ids=str)
def test_exact_identities(law):
    """Only alpha c counts; the phase of a travelling wave does not; V(T) = V(1)/T without a slip speed.

    A shift in time by tau/2 pi adds k tau to the phase of the k-th harmonic.
    """
    scene = Scene(Sheet(), PULSE, alpha=0.2, contact=Contact("current", law))
    waves = [f"wave.{part}.{k}" for k in range(2) for part in ("cosine", "sine")]
    found = speed_gradient(scene, ["alpha", "wave.mean", "wave.period", *waves], rtol=1e-3)
    amplitudes = [parameter(name).value(scene) for name in ["wave.mean", *waves]]
    slopes = [found["wave.mean"], *(found[name] for name in waves)]
    errors = found.errors[[0, 1, 3, 4, 5, 6]] @ [0.2, *np.abs(amplitudes)]
    assert abs(0.2 * found["growth.alpha"] - np.dot(amplitudes, slopes)) <= errors
    turn = sum(
        (k + 1)
        * (amplitudes[1 + 2 * k] * slopes[2 + 2 * k] - amplitudes[2 + 2 * k] * slopes[1 + 2 * k])
        for k in range(2)
    )
    assert abs(turn) <= 2 * errors + found.speed.error
    if law.width in (0.0, math.inf):
        assert found["wave.period"] == pytest.approx(-found.speed.mean, rel=1e-9)
    assert not found.kinks


def test_a_sine_whose_speed_is_of_second_order():
    """Even harmonics break c(t + T/2) = -c(t), on which V of order alpha^2 rests; odd ones keep it."""
    scene = Scene(Sheet(poisson=0.3), SineWave(), alpha=0.2, contact=TANH)
    over = ["alpha", "sheet.width", "wave.cosine.1", "wave.sine.2", "friction.slip_speed"]
    found = speed_gradient(scene, over, rtol=1e-4)
    want, errors = differences(scene, over, lambda speed: speed.estimate, 1e-6, 2e-3)
    assert np.all(abs(found.values - want) <= found.errors + errors + 1e-4 * abs(want))
    assert found["wave.cosine.1"] > 0.05  # of order alpha: an even harmonic is worth more
    assert found.errors.max() < 1e-3


def test_a_wave_that_turns_the_sheet():
    def oblique(s):
        return FieldWave(lambda x, y, t: np.sin(2 * np.pi * (s * x + y - t)) * (1 + 0.3 * x), 1.0)

    scene = Scene(Sheet(poisson=0.3), oblique(0.2), alpha=0.2, contact=Contact("grown", Viscous()))
    over = [WaveFamily("tilt", 0.2, oblique), "alpha", "sheet.poisson", "sheet.width"]
    found = speed_gradient(scene, over, rtol=1e-3)
    want, errors = differences(scene, over, lambda speed: speed.estimate, 1e-3)
    assert np.all(abs(found.values - want) <= found.errors + 0.02 * errors)
    assert found.speed.turning is not None


class OneWidth(FieldWave):
    """A wave that is known on a sheet of width 1 alone, as one computed there."""

    def on(self, sheet, places=None):
        if sheet.width != 1.0:
            raise ValueError(f"sheet.width = {sheet.width:g}: must be 1")
        return super().on(sheet, places)


def test_a_wave_of_one_sheet_has_no_derivative_by_its_width():
    wave = OneWidth(lambda x, y, t: np.sin(2 * np.pi * (y + x - t)), 1.0)
    scene = Scene(Sheet(width=1.0), wave, alpha=0.2)
    with pytest.raises(
        ValueError, match=r"over = 'sheet.width': the wave must be known on .* any width"
    ):
        speed_gradient(scene, "sheet.width")


@pytest.mark.parametrize("load", ["current", "material"])
def test_friction_with_a_direction_and_a_map(load):
    rear = Patches([(-1, 1, -1, -0.25, 3.0)], edge=0.1)
    law = Mapped(Directional(0.6, 1.4, 1.1, form=Viscous()), rear)
    scene = Scene(Sheet(), PULSE, alpha=0.2, contact=Contact(load, law))
    over = ["friction.map.mu.0", "friction.forward", "friction.backward", "friction.heading"]
    found = speed_gradient(scene, over, rtol=1e-4)
    want, errors = differences(scene, over, lambda speed: speed.estimate, 1e-4)
    assert np.all(abs(found.values - want) <= found.errors + errors)
    assert found["friction.heading"] == pytest.approx(0.0, abs=1e-12)  # V is even in it


def test_number_of_waves():
    scene = Scene(Sheet(), PULSE, alpha=0.2, contact=Contact("current", Viscous()))
    found = speed_gradient(scene, "wave.count", rtol=1e-4)
    want, errors = differences(scene, "wave.count", lambda speed: speed.estimate, 1e-4)
    assert abs(found.values - want) <= found.errors + errors
    assert errors < 0.1 * abs(want)


def test_second_order_in_alpha():
    scene = Scene(Sheet(poisson=0.3), PULSE, alpha=0.1, contact=TANH)
    over = ["alpha", "wave.cosine.1", "sheet.width", "friction.slip_speed"]
    found = speed_gradient(scene, over, order=2, rtol=1e-3)
    for i, one in enumerate(found.parameters):
        at, step = one.value(scene), 2e-3
        ends = [
            crawl_speed(one.changed(scene, at + sign * step), rtol=1e-4, order=2) for sign in (1, -1)
        ]
        slope = (ends[0].mean - ends[1].mean) / (2 * step)
        doubt = (ends[0].error + ends[1].error) / (2 * step)
        assert abs(found.values[i] - slope) <= found.errors[i] + doubt, one.name


@pytest.mark.parametrize("wave", [SineWave(), PULSE], ids=["sine", "pulse"])
def test_power_and_cost_of_transport(wave):
    scene = Scene(Sheet(), wave, alpha=-0.2, contact=TANH)
    over = ["alpha", "sheet.width", "wave.sine.0"]
    found = motion_gradient(scene, over, rtol=1e-4)
    speeds = {  # both numbers are of the same speeds
        one.changed(scene, at).key(): crawl_speed(one.changed(scene, at), rtol=1e-5, method="ritz")
        for one in parameters(over)
        for at in (one.value(scene) + 4e-3, one.value(scene) - 4e-3)
    }
    for gradient, name in ((found.power, "power"), (found.cost, "cost_of_transport")):
        for i, one in enumerate(gradient.parameters):
            ends = [
                getattr(speeds[one.changed(scene, one.value(scene) + step).key()], name)
                for step in (4e-3, -4e-3)
            ]
            want = (ends[0].value - ends[1].value) / 8e-3
            doubt = gradient.errors[i] + (ends[0].error + ends[1].error) / 8e-3 + 2e-4 * abs(want)
            assert abs(gradient.values[i] - want) <= doubt, (name, one.name)
    assert found.speed.values == pytest.approx(speed_gradient(scene, over, rtol=1e-4).values, rel=1e-9)
    assert cost_gradient(scene, over, rtol=1e-4).values == pytest.approx(found.cost.values, rel=1e-9)
    assert power_gradient(scene, over, rtol=1e-4).names == found.power.names


@pytest.mark.parametrize(
    ("over", "words"),
    [
        ("wave.cosin.1", "nearest is 'wave.cosine.1'"),
        ("alfa", "nearest is 'growth.alpha'"),
        ("widht", "nearest is 'sheet.width'"),
        ("sheet.widht", "nearest is 'sheet.width'"),
        ("temperature", "known are growth.alpha, .* friction.map.mu.0"),
        ("wave.cosine.99999", "has 100000 waves on the sheet, must have at most 150"),
        ([], "at least one"),
        (["alpha", "growth.alpha"], "named twice"),
        ("friction.slip_speed", "must have friction with a slip speed"),
        ("friction.forward", "must have Directional friction"),
        ("friction.map.mu.0", "must have a map of Patches"),
        ("wave.amplitude.4", "use 'wave.cosine.4' and 'wave.sine.4'"),
        (3, "must be parameters or their names"),
    ],
)
def test_parameters_that_a_scene_does_not_have_are_refused_by_name(over, words):
    with pytest.raises(ValueError, match=words):
        speed_gradient(Scene(Sheet(), SineWave(), alpha=0.1), over)


def test_scenes_without_a_gradient_are_refused():
    with pytest.raises(ValueError, match="alpha = 0: must not be 0"):
        speed_gradient(Scene(Sheet(), SineWave(), alpha=0.0), "alpha")
    with pytest.raises(ValueError, match="order = 3: must be one of 1, 2"):
        speed_gradient(Scene(Sheet(), SineWave(), alpha=0.1), "alpha", order=3)
    given = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y - t)) + 0 * x, 1.0)
    with pytest.raises(ValueError, match=r"wave.sine.0.*must have a TravellingWave"):
        speed_gradient(Scene(Sheet(), given, alpha=0.1), "wave.sine.0")


def test_parameters_change_scenes():
    """Each sets what it reads."""
    law = Mapped(Directional(0.6, 1.4, form=Tanh(0.1)), Patches([(-1, 1, -1, 0, 2.0)], edge=0.1))
    scene = Scene(Sheet(), PULSE, alpha=0.2, contact=Contact("current", law))
    names = [*names_of(scene.but(contact=TANH)), "wave.amplitude.1", "wave.phase.0", "wave.period"]
    names += ["wave.count", "friction.backward", "friction.heading", "friction.map.mu.0"]
    for one in parameters(names):
        changed = one.changed(scene, one.value(scene) - 0.05)
        assert one.value(changed) == pytest.approx(one.value(scene) - 0.05), one.name
        assert one.changed(changed, one.value(scene)).key() != changed.key()


def test_a_frozen_grid_is_that_of_its_scene():
    scene = scene_of("viscous", np.random.default_rng(1))
    assert Frozen(scene).speed(scene) == pytest.approx(crawl_speed(scene).mean, rel=1e-2, abs=1e-4)


def test_places_in_lists_are_plain_digits():
    with pytest.raises(ValueError, match="is no parameter with a gradient"):
        speed_gradient(
            Scene(Sheet(), SineWave(), alpha=0.1), "wave.cosine.\N{ARABIC-INDIC DIGIT THREE}"
        )
