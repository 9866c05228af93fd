"""Strain that acts back on an excitable wave: exact limits, a literal rod, resumed runs, refusals."""

import json
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from fem_check import (
    Friction,
    Gravity,
    Material,
    Membrane,
    StrainFeedback,
    Trajectory,
    cycle_speed,
    predict,
    simulate,
    speeds,
)
from fem_check.excitable import Excitation, FitzHughNagumo, RationalStart, UniformStart
from fem_check.shell.stepping.stepper import amplitude
from linear_theory import Scene, Sheet, crawl_speed, line_balance
from tests.excitable.reference_feedback import Rod
from tests.stepping.test_shell_snapshot import interrupted, same

Array = NDArray[np.float64]

SHEET = Sheet(length=1.0, width=0.5)
ROD = Sheet(length=1.0, width=0.04, poisson=0.0, thickness=0.03)
WEAK = (Membrane(Material(0.03, 0.5)), Gravity(1e-7, "material"), Friction(1.0, 1e-3))
SOFT = (Membrane(Material(0.03, 0.0)), Gravity(1e-2, "material"), Friction(1.0, 0.02))


@cache
def wave(
    coefficient: float | None, length: float, start: object = None, sheet: Sheet = SHEET
) -> Excitation:
    feedback = None if coefficient is None else StrainFeedback(coefficient)
    start = RationalStart() if start is None else start
    equation = FitzHughNagumo(-0.1, 1e-4, 0.05, length, start, feedback=feedback)  # type: ignore
    return equation.on(sheet, until=100.0, rtol=1e-2)


def uniform(coefficient: float | None, alpha: float = 0.2) -> Scene:
    found = wave(coefficient, 0.2, UniformStart(0.3))
    return Scene(SHEET, found, alpha, effects=WEAK, cells=(1, 2))


@pytest.fixture(scope="module")
def swelling() -> list[Trajectory]:
    """A sheet that grows the same everywhere, with 48 and 96 steps a period."""
    return [simulate(uniform(-0.3), periods=1, steps=steps) for steps in (48, 96)]


def exact(alpha: float, coefficient: float, ramp: float, times: Array) -> Array:
    """tr ε = 2 alpha c: the kinetics with another linear coefficient."""

    def rates(t: float, u: Array) -> list[float]:
        c, w = u
        shift = 2 * alpha * amplitude(t, ramp) * coefficient
        return [c * (1 - c) * (c + 0.1) + shift * c - w, 0.05 * (c - 1e-4 * w)]

    options = {"t_eval": times, "rtol": 1e-10, "atol": 1e-12}
    return np.asarray(solve_ivp(rates, (0, times[-1]), [0.3, 0.0], **options).y[0])


def errors(found: Trajectory, coefficient: float, alpha: float) -> Array:
    times = found.stored_times
    c = [float(found.model.growth(float(t), 0.1, 0.2)) for t in times]
    return abs(c - exact(alpha, coefficient, found.start, times))


def test_uniform_growth_shifts_the_linear_coefficient_and_the_order_is_two(
    swelling: list[Trajectory],
) -> None:
    coarse, fine = (errors(found, -0.3, 0.2).max() for found in swelling)
    assert fine < 4e-3
    assert np.log2(coarse / fine) > 1.7
    assert fine <= swelling[1].growth_error < 0.1


def test_a_rod_that_friction_compresses_against_a_literal_one() -> None:
    """Friction changes c by 0.01 here, twenty times the difference allowed."""
    scene = Scene(ROD, wave(0.15, 0.05, sheet=ROD), 0.2, effects=SOFT, cells=(1, 4))
    found = simulate(scene, periods=1, steps=96)
    numbers = (-0.1, 1e-4, 0.05, 0.05, 0.15)
    rod = Rod(numbers, 0.2, 0.03, 1e-2, 0.02, found.amplitude, 40)
    end = float(found.times[-1])
    s, c, centre = rod.end(end)
    apart = abs(found.model.growth(end, 0 * s, s - 0.5) - c).max()
    assert apart < 8e-4 < 0.01 * np.ptp(c)
    assert apart <= found.growth_error
    assert found.centre[1, -1] == pytest.approx(centre, rel=0.05)
    assert not found.speed.converged


def test_no_feedback_has_the_same_bits() -> None:
    without, zero = (simulate(uniform(f), periods=1, steps=48) for f in (None, 0.0))
    same(without, zero)


def test_weak_feedback_is_close_to_none() -> None:
    alone = uniform(None)
    found = simulate(uniform(1e-9), periods=1, steps=48)
    t = float(found.times[-1])
    assert float(found.model.growth(t, 0.1, 0.2)) == pytest.approx(
        float(alone.drive.value(0.1, 0.2, t)), abs=2e-4
    )


@pytest.mark.parametrize("options", [{"steps": 48, "keep_every": 3}, {"rtol": 0.3}])
def test_an_interrupted_run_ends_with_the_same_bits(tmp_path: Path, options: dict[str, float]) -> None:
    scene = Scene(ROD, wave(0.15, 0.2, sheet=ROD), 0.2, effects=SOFT, cells=(1, 2))
    options = {"periods": 1, **options, "snapshot_every": 7}
    whole = simulate(scene, **options)  # type: ignore[arg-type]
    resumed = interrupted(scene, tmp_path / "cut.npz", 17, **options)
    assert resumed.resumed_at > 0
    same(whole, resumed)
    for t in (whole.stored_times[3], whole.times[-1], 0.37 * whole.times[-1]):
        c = [
            one.model.growth(float(t), np.zeros(3), np.array([-0.4, 0.0, 0.3]))
            for one in (whole, resumed)
        ]
        assert np.array_equal(*c)


def test_levels_that_take_the_wave_as_given_refuse_it() -> None:
    scene = uniform(-0.3)
    planar = Scene(SHEET, scene.wave, 0.2)
    for level, asked in (
        (lambda: cycle_speed(scene), scene),
        (lambda: speeds(planar), planar),
        (lambda: predict(planar), planar),
    ):
        with pytest.raises(ValueError, match=r"cannot represent .*the strain acts back on"):
            level()
        assert asked.drive.has_state
    for call in (
        lambda: crawl_speed(SHEET, scene.wave, alpha=0.1),
        lambda: line_balance(scene.wave, 0.1, length=1.0),
        lambda: scene.wave.value(0.0, 0.0, 1.0),  # type: ignore[attr-defined]
        lambda: scene.wave.periodic().period,  # type: ignore[attr-defined]
        lambda: scene.drive.value(0.0, 0.0, 1.0),
    ):
        with pytest.raises(ValueError, match="strain acts back on"):
            call()
    assert "acts back" in repr(scene.wave)


def test_bad_input_is_refused() -> None:
    with pytest.raises(ValueError, match="coefficient contains nan"):
        StrainFeedback(float("nan"))
    with pytest.raises(ValueError, match="feedback = 3"):
        FitzHughNagumo(0.1, 0.1, 0.1, 0.1, feedback=3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"steps = 48: must be >= \d+, else the feedback"):
        simulate(uniform(-30.0), periods=1, steps=48)
    with pytest.raises(ValueError, match=r"until = 100: must be (>=|longer)"):
        simulate(uniform(-0.3), periods=9, steps=48)


def test_a_scene_with_feedback_is_data() -> None:
    scene = uniform(-0.3)
    again = Scene.from_dict(json.loads(json.dumps(scene.to_dict())))
    assert (again, again.key()) == (scene, scene.key())
    assert again != uniform(-0.2)
