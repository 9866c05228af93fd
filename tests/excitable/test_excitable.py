"""Excitable waves against exact fronts, published pulses, limit cycles and far finer solutions."""

import json

import numpy as np
import pytest
from numpy.typing import NDArray

from fem_check import Outline
from fem_check.excitable import (
    PRESETS,
    Adaptive,
    BumpStart,
    CrossedStart,
    Euler,
    Excitation,
    FitzHughNagumo,
    Pacing,
    RationalStart,
    UniformStart,
    excitable_preset,
    speeds,
    wave_train,
)
from fem_check.excitable.methods import is_stiff
from fem_check.excitable.record import Record
from fem_check.excitable.solution import difference
from fem_check.excitable.space import Space
from fem_check.excitable.system import System
from figures.validation.excitable import arrival_speed
from linear_theory import NotConvergedError, Scene, Sheet, crawl_speed, line_balance
from linear_theory.wave.sampled import drive
from tests.excitable import reference_excitable as reference

Array = NDArray[np.float64]

SHEET = Sheet()
HOLED = Outline(
    [[-0.25, -0.5], [0.3, -0.5], [0.2, 0.5], [-0.25, 0.4]], [[[-0.1, -0.1], [0.1, -0.1], [0, 0.1]]]
)


def solved(equation: FitzHughNagumo, body: object, until: float, size: float, share: float) -> Record:
    """On elements of one size, with the tolerance of the steps."""
    return Excitation(equation, body, until, 1e-3)._solved(size, Adaptive(share))  # type: ignore[arg-type]


def test_a_front_without_recovery_has_the_exact_speed() -> None:
    for threshold, length in ((0.1, 0.02), (0.25, 0.015)):
        equation = FitzHughNagumo(threshold, 0.0, 0.0, length, BumpStart(1.0, 0.1))
        exact = (1 - 2 * threshold) * length / np.sqrt(2)
        record = solved(equation, SHEET, 0.9 / exact, length / 2, 1e-3)
        assert arrival_speed(record, 0.0, 0.33, 0.5) == pytest.approx(exact, rel=2e-5)


@pytest.mark.parametrize(
    ("numbers", "published"),
    [((0.1, 1.0, 0.01), 0.4349184), ((0.139, 2.54, 0.008), 0.3998512)],
)
def test_single_pulses_have_the_published_speed(
    numbers: tuple[float, float, float], published: float
) -> None:
    """Against an independent Newton solution on a ring, too; error of fourth order in the element."""
    threshold, decay, rate = numbers
    assert reference.pulse_speed(threshold, decay, rate) == pytest.approx(published, abs=1e-7)
    equation = FitzHughNagumo(threshold, decay, rate, 1.0, BumpStart(1.0, 8.0))
    body = Sheet(length=200.0, width=100.0)
    coarse, fine = (
        arrival_speed(solved(equation, body, 420.0, size, 1e-3), 0, 60, 0.4) for size in (1.25, 1.0)
    )
    order_four = 1.25**4
    assert fine == pytest.approx(published, rel=1e-4)
    assert (order_four * fine - coarse) / (order_four - 1) == pytest.approx(published, rel=2e-5)


def test_published_wave_train() -> None:
    """Against an independent Newton solution, too, from another start."""
    y = np.arange(128) / 128
    numbers = (-0.1, 1e-4, 0.05, 0.02)
    c, speed = reference.train(numbers, 1.0, 0.15 + 0.6 * np.cos(2 * np.pi * y), 0.025)
    assert speed == pytest.approx(0.02517, abs=5e-6)
    assert 1 / speed == pytest.approx(39.73, abs=5e-3)
    found = wave_train(excitable_preset("nu = -0.1"))
    assert found.speed == pytest.approx(speed, rel=1e-8)
    assert abs(found.speed - speed) <= found.speed_error + 1e-9 * speed
    assert found.period == pytest.approx(39.73, rel=1e-4)
    crest = np.fft.rfft(c)[1]  # the same phase: harmonic 1 of both has its crest at y = 0
    own = found.wave.cosine[0] - 1j * found.wave.sine[0]
    shift = (np.angle(own) - np.angle(crest)) / (2 * np.pi)
    assert found.wave.value(0.0, y - shift, 0.0) == pytest.approx(c, abs=1e-6)


def test_a_train_is_a_wave_that_every_level_takes() -> None:
    """Two wavelengths on a length of two are that of one; viscous speed from the stretch alone."""
    train = wave_train(excitable_preset("nu = -0.1"), length=2.0, count=2)
    one = wave_train(excitable_preset("nu = -0.1"))
    assert train.speed == pytest.approx(one.speed, rel=1e-8)
    found = line_balance(one.wave, 0.1, length=1.0, friction="viscous", growth_law="exp", rtol=1e-6)
    stretch = np.exp(0.1 * one.wave.value(0.0, np.arange(512) / 512, 0.0))
    assert found.mean == pytest.approx(np.var(stretch) / np.mean(stretch) / one.period, rel=1e-5)


def test_trains_have_a_shortest_wavelength() -> None:
    """2 pi gamma/(-nu)^(1/2), the weakly nonlinear limit: 1.26 for the printed numbers."""
    with pytest.raises(NotConvergedError, match=r"beyond a wavelength of 1\.2[5-8] times"):
        wave_train(excitable_preset("printed"))
    with pytest.raises(NotConvergedError, match="come to rest"):
        wave_train(excitable_preset("pulse train").but(pacing=None))
    with pytest.raises(ValueError, match="must have pacing = None"):
        wave_train(excitable_preset("pulse train"))


def test_the_printed_numbers_end_in_a_uniform_limit_cycle() -> None:
    """Weakly nonlinear amplitude 2 (-nu/3)^(1/2), period 29.48, and the decay of phase differences."""
    numbers = (-0.01, 1e-4, 0.05, 0.02)
    orbit = excitable_preset("printed").on(SHEET, 240.0, 1e-2).periodic()
    period, low, high = reference.limit_cycle(numbers)
    assert orbit.uniform
    assert orbit.attracts
    assert orbit.period == pytest.approx(period, rel=1e-6)
    assert orbit.period == pytest.approx(29.48, abs=5e-3)
    found = orbit.samples[0]
    assert (found.min(), found.max()) == (pytest.approx(low, abs=2e-4), pytest.approx(high, abs=2e-4))
    assert (high - low) / 2 == pytest.approx(2 * np.sqrt(0.01 / 3), rel=0.06)
    assert orbit.multiplier == pytest.approx(reference.multipliers(numbers, [1])[0], rel=0.02)


def test_weakly_nonlinear_amplitude_in_the_limit() -> None:
    ratios = []
    for threshold in (-0.02, -0.005):
        _, low, high = reference.limit_cycle((threshold, 1e-4, 0.05, 0.02))
        ratios.append((high - low) / 2 / (2 * np.sqrt(-threshold / 3)))
    assert abs(ratios[1] - 1) < 0.4 * abs(ratios[0] - 1)
    assert ratios[1] == pytest.approx(1, abs=0.03)


def test_at_nu_minus_005_the_uniform_oscillation_is_unstable() -> None:
    growth = reference.multipliers((-0.05, 1e-4, 0.05, 0.02), [1, 2, 3])
    assert growth[0] > 1.01
    assert growth[1] > 1.02
    assert growth[2] < 1
    assert max(reference.multipliers((-0.1, 1e-4, 0.05, 0.02), [1, 2, 3])) < 1


def test_a_symmetric_start_stays_symmetric() -> None:
    equation = excitable_preset("nu = -0.1").but(start=RationalStart(origin=0.0))
    record = solved(equation, SHEET, 90.0, 0.04, 1e-2)
    y = np.linspace(0, 0.5, 30)
    t = np.linspace(0, 90, 50)[:, None]
    assert record.value(0 * y, y, t) == pytest.approx(record.value(0 * y, -y, t), abs=1e-7)


@pytest.mark.parametrize("body", [Outline.rectangle(SHEET), HOLED], ids=["rectangle", "holes"])
def test_edges_let_nothing_through(body: Outline) -> None:
    """Without reaction the mean of c is conserved, and a uniform c stays as it is."""
    space = Space.on(body, 0.08, True)
    assert space.mass.sum() == pytest.approx(body.area, rel=1e-12)
    assert space.mass.min() > 0
    assert abs(space.laplacian @ np.ones(space.size)).max() < 1e-9
    assert abs(space.mass @ (space.laplacian @ np.random.default_rng(1).normal(size=space.size))) < 1e-9


def test_triangles_and_rectangles_agree_with_the_line() -> None:
    equation = excitable_preset("nu = -0.1")
    line = solved(equation, SHEET, 60.0, 0.02, 1e-3)
    crossed = equation.but(start=_Crossless())
    for equal, body in ((equation, Outline.rectangle(SHEET)), (crossed, SHEET)):
        first, second = (
            difference(line, solved(equal, body, 60.0, size, 1e-3)).max() for size in (0.06, 0.04)
        )
        assert second < 0.4 * first
        assert second < 4e-3


class _Crossless(RationalStart):
    """A start that depends on y alone, but does not say so."""

    depends_on_x = True


@pytest.mark.parametrize(
    ("body", "start", "order"),
    [
        (SHEET, RationalStart(), 3.0),
        (SHEET, CrossedStart(0.3, 0.1, 0.25), 2.6),
        (HOLED, RationalStart(), 2.5),
    ],
    ids=["line", "rectangle", "triangles"],
)
def test_order_in_space(body: object, start: object, order: float) -> None:
    equation = FitzHughNagumo(-0.05, 0.1, 0.1, 0.1, start)  # type: ignore[arg-type]
    sizes = (0.16, 0.08, 0.04) if body is HOLED else (0.125, 0.0625, 0.03125)
    *coarse, fine = (solved(equation, body, 5.0, size, 1e-4) for size in sizes)
    first, second = (rms_difference(fine, one) for one in coarse)
    assert np.log2(first / second) > order


def rms_difference(one: Record, other: Record) -> float:
    """At the end, at points of the inside."""
    x, y = np.random.default_rng(3).uniform((-0.18, 0.15), (0.18, 0.35), (300, 2)).T
    end = float(one.times[-1])
    return float(np.sqrt(np.mean((one.value(x, y, end) - other.value(x, y, end)) ** 2)))


def test_euler_is_of_first_order_and_refuses_unstable_steps() -> None:
    equation = FitzHughNagumo(-0.05, 0.1, 0.1, 0.1)
    exact = solved(equation, SHEET, 10.0, 0.125, 1e-4)
    errors = []
    for step in (0.04, 0.02):
        found = Excitation(equation, SHEET, 10.0)._solved(0.125, Euler(step))
        errors.append(difference(exact, found).max())
    assert errors[0] / errors[1] == pytest.approx(2, rel=0.05)
    with pytest.raises(ValueError, match="step = 5: must be <"):
        _ = Excitation(equation, SHEET, 10.0, method=Euler(5.0))._pair


def random_equations(count: int) -> list[FitzHughNagumo]:
    random = np.random.default_rng(11)
    found = []
    for k in range(count):
        threshold, decay = random.uniform(-0.15, 0.2), random.uniform(0, 1)
        rate, length = 10 ** random.uniform(-2, -0.7), 10 ** random.uniform(-1.4, -0.8)
        start = (
            RationalStart(random.uniform(-0.6, 0.2), random.uniform(0.3, 1)) if k % 2 else BumpStart()
        )
        pacing = Pacing(20.0, random.uniform(0.1, 0.4), 6.0, 0.2) if k % 3 == 0 else None
        found.append(FitzHughNagumo(threshold, decay, rate, length, start, pacing))
    return found


@pytest.mark.parametrize(("rtol", "count"), [(1e-2, 10), (1e-3, 4)])
def test_the_error_is_honest(rtol: float, count: int) -> None:
    """True error, at random places and times, against the estimate; and that meets its tolerance."""
    random = np.random.default_rng(5)
    y, t = random.uniform(-0.5, 0.5, 200), random.uniform(0, 40, 200)
    for equation in random_equations(count):
        wave = Excitation(equation, SHEET, 40.0, rtol)
        size = np.diff(np.sort(wave._fine.space.mesh.p[0])).max()
        exact = Excitation(equation, SHEET, 40.0, rtol)._solved(size / 3, Adaptive(1e-3))
        apart = abs(wave.value(0.0, y, t) - exact.value(0.0, y, t))
        allowed = np.interp(t, wave.times, wave.error) + 1e-9
        assert np.all(apart <= allowed), equation
        assert wave.converged
        settled = t > 1  # where the start has a slope at an edge, dc/dt is infinite there at t = 0
        rate = abs(wave.rate(0.0, y, t) - exact.rate(0.0, y, t))[settled].max()
        assert rate <= 2 * wave.error[-1] + 1e-9


def test_against_a_literal_solution() -> None:
    """Second-order differences on 400 cells by another integrator."""
    from scipy.integrate import solve_ivp

    equation = excitable_preset("nu = -0.1")
    wave = equation.on(SHEET, 50.0, 1e-3)
    n = 400
    y = (np.arange(n) + 0.5) / n
    start = np.zeros(2 * n)  # c and w in turn, so that the Jacobian is banded
    start[::2] = y**2 / (1 + y**2)

    def rates(_: float, u: Array) -> Array:
        c, w = u[::2], u[1::2]
        wide = np.concatenate([c[:1], c, c[-1:]])
        second = (wide[2:] - 2 * c + wide[:-2]) * n**2
        found = np.empty_like(u)
        found[::2] = 4e-4 * second + c * (1 - c) * (c + 0.1) - w
        found[1::2] = 0.05 * (c - 1e-4 * w)
        return found

    end = solve_ivp(rates, (0, 50), start, "LSODA", rtol=1e-8, atol=1e-9, lband=2, uband=2).y[::2, -1]
    assert wave.value(0.0, y - 0.5, 50.0) == pytest.approx(end, abs=1e-3)


def test_what_the_presets_say_of_themselves() -> None:
    """Periods, ranges and phase lags of the sentences."""
    cycles = excitable_preset("nu = -0.1").on(SHEET, 200.0, 3e-2).cycles
    assert cycles.period[-1] == pytest.approx(43, abs=0.5)
    assert (cycles.low[1], cycles.high[1]) == (
        pytest.approx(-0.48, abs=0.01),
        pytest.approx(0.77, abs=0.01),
    )
    assert np.all((cycles.lag > 0.3) & (cycles.lag < 0.65))
    still = excitable_preset("pulse train").but(pacing=None).on(SHEET, 200.0)
    assert still.cycles.count == 0
    assert "no cycle" in repr(still) or still.cycles.in_words(False, 1.0).startswith("no cycle")
    assert all(str(one).startswith(f"{name}: ") for name, one in PRESETS.items())


def test_no_stimulus_is_missed_by_long_steps() -> None:
    """Of a body at rest, by an implicit scheme whose error estimate sees nothing before it begins."""
    paced = FitzHughNagumo(0.1, 0.5, 0.02, 0.1, UniformStart(), Pacing(400.0, 1.0, duration=4.0))
    system = System(paced, SHEET, Space.on(SHEET, 0.01, False))
    assert is_stiff(system)
    times = np.linspace(0, 110, 111)
    c = Adaptive().states(system, times, system.first, 1e-2)[:, : system.space.size]
    assert c.max() > 0.5


def test_a_wave_that_does_not_repeat_is_refused_with_a_remedy() -> None:
    wave = excitable_preset("nu = -0.1").on(SHEET, 200.0, 5e-2)
    with pytest.raises(ValueError, match=r"not periodic.*take `speeds`"):
        crawl_speed(SHEET, wave, alpha=0.1)
    with pytest.raises(ValueError, match="was solved on a body of length 1"):
        drive(wave, Sheet(length=2.0))
    with pytest.raises(ValueError, match="t = 201: must be in 0 to 200"):
        wave.value(0.0, 0.0, 201.0)
    with pytest.raises(ValueError, match="k = 9: must be one of the 3 cycles"):
        wave.cycle(9)


def test_bad_input_is_refused() -> None:
    equation = excitable_preset("printed")
    for call, words in (
        (lambda: equation.but(recovery_rate=-1.0), "recovery_rate = -1: must be >= 0"),
        (lambda: equation.but(diffusion_length=0.0), "diffusion_length = 0: must be > 0"),
        (lambda: equation.but(start=3), "start = 3: must be a Start"),
        (lambda: equation.on(3, 1.0), "body = 3: must be a Sheet or an Outline"),
        (lambda: equation.on(SHEET, -1.0), "until = -1: must be > 0"),
        (lambda: equation.on(SHEET, 1.0, 0.0), r"rtol = 0: must be in \[1e-08, 1\)"),
        (lambda: Pacing(10.0, duration=8.0), "duration = 8: must be at most half"),
        (lambda: excitable_preset("nu"), "name = 'nu': must be"),
    ):
        with pytest.raises(ValueError, match=words):
            call()


def test_growth_without_bound_is_an_error() -> None:
    wild = FitzHughNagumo(0.1, 0.0, 0.0, 0.1, UniformStart(), Pacing(5.0, -1e9, 2.0))
    with pytest.raises(NotConvergedError, match="could not be followed beyond t = "):
        _ = wild.on(SHEET, 10.0, 1e-2, Euler(0.1))._pair


@pytest.mark.parametrize(
    "wave",
    [
        excitable_preset("nu = -0.1").on(SHEET, 60.0, 1e-2),
        excitable_preset("nu = -0.1").on(SHEET, 60.0, 1e-2, Euler(0.01)),
        excitable_preset("pulse train").on(SHEET, 450.0, 1e-2).periodic(),
        excitable_preset("nu = -0.1").but(start=CrossedStart()).on(HOLED, 60.0, 0.1),
    ],
)
def test_waves_are_data(wave: Excitation) -> None:
    from linear_theory.scene.data import part_of

    again = part_of(json.loads(json.dumps(wave.to_dict())), "wave")
    assert again == wave
    assert again.to_dict() == wave.to_dict()
    assert again != excitable_preset("printed").on(SHEET, 60.0, 1e-2)


def test_a_scene_with_an_excitable_wave_is_data() -> None:
    scene = Scene(SHEET, excitable_preset("nu = -0.1").on(SHEET, 60.0, 1e-2), alpha=0.1)
    again = Scene.from_dict(json.loads(json.dumps(scene.to_dict())))
    assert again == scene
    assert again.key() == scene.key()


def test_turbulence_parts_twins_and_makes_cores_and_a_spiral_does_neither() -> None:
    """On far cruder differences of their own; both begin as one spiral."""
    growth, cores = reference.twins(_numbers("turbulent"), 80, 1000.0)
    assert cores[5] == 1
    assert 0.005 < growth < 0.02
    assert min(cores[35:]) >= 1
    assert max(cores[35:]) >= 4
    growth, cores = reference.twins(_numbers("spiral"), 40, 600.0)
    assert growth < 0.003
    assert max(cores) <= 1


def _numbers(name: str) -> reference.Numbers:
    e = excitable_preset(name)
    return e.threshold, e.recovery_decay, e.recovery_rate, e.diffusion_length


def test_turbulence_is_known_until_it_is_not() -> None:
    """c and its error at first, while one spiral turns, against finer elements."""
    square = Sheet(length=1.0, width=1.0)
    wave = excitable_preset("turbulent").on(square, 30.0, 0.2)
    assert wave.converged
    finer = Excitation(wave.equation, square, 30.0)._solved(0.015, Adaptive(1e-2))
    x, y = np.random.default_rng(2).uniform(-0.5, 0.5, (2, 200))
    for t in (10.0, 30.0):
        apart = abs(wave.value(x, y, t) - finer.value(x, y, t)).max()
        assert apart <= np.interp(t, wave.times, wave.error)


def test_the_spiral_winds_and_drives_a_wide_sheet() -> None:
    """The phase of (c, dc/dt) turns once around the centre of a square sheet; seven turns on, too."""
    square = Sheet(length=1.0, width=1.0)
    wave = excitable_preset("spiral").on(square, 300.0, 5e-2)
    angle = np.linspace(0, 2 * np.pi, 200)
    for t, radii in ((165.0, (0.1, 0.3)), (299.0, (0.2, 0.45))):
        for radius in radii:
            place = radius * np.cos(angle), radius * np.sin(angle), t
            phase = np.unwrap(np.arctan2(5 * wave.rate(*place), wave.value(*place) - 0.1))
            assert abs(phase[-1] - phase[0]) == pytest.approx(2 * np.pi, abs=1e-6)
    assert wave.cycles.period == pytest.approx(42, abs=1.5)
    assert not wave.repeats
    found = speeds(Scene(square, wave, alpha=0.1), [-1], rtol=0.1)
    assert 0 < abs(found.mean[0]) < 0.1 * 0.1 / wave.period
