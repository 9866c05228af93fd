"""Strain that acts back on a wave of a sheet that bends on its ground: limits, symmetry, power, resumed
runs."""

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from fem_check import StrainFeedback, Trajectory, simulate
from fem_check.excitable import Excitation, FitzHughNagumo, RationalStart
from linear_theory import Scene, Sheet
from tests.shell.shell_scenes import lying
from tests.stepping.test_shell_snapshot import interrupted, same

Array = NDArray[np.float64]

SHEET = Sheet()
STEPS = 96


@cache
def wave(coefficient: float | None, origin: float = -0.5) -> Excitation:
    """The numbers of nu = -0.1 with longer waves, for which few elements will do."""
    feedback = None if coefficient is None else StrainFeedback(coefficient)
    equation = FitzHughNagumo(-0.1, 1e-4, 0.05, 0.1, RationalStart(origin), feedback=feedback)
    return equation.on(SHEET, until=100.0, rtol=1e-2)


def scene(coefficient: float | None, origin: float = -0.5) -> Scene:
    return lying(0.15, 0.5, slip=5e-3, cells=(1, 3)).but(wave=wave(coefficient, origin))


@cache
def stepped(coefficient: float | None, origin: float = -0.5, steps: int = STEPS) -> Trajectory:
    return simulate(scene(coefficient, origin), periods=1, steps=steps)


def growth(found: Trajectory) -> Array:
    """c at some places at the end."""
    x, y = np.meshgrid([-0.2, 0.0, 0.2], np.linspace(-0.45, 0.45, 7))
    return np.asarray(found.model.growth(float(found.times[-1]), x, y))


def test_the_strain_of_a_bending_sheet_acts_back() -> None:
    """Here it turns the sheet back; errors of c and of the speed cover twice as many steps."""
    alone, found, finer = stepped(None), stepped(0.1), stepped(0.1, steps=2 * STEPS)
    assert np.ptp(alone.positions(float(alone.times[-1]))[2]) > 1e-3  # it does bend
    assert abs(growth(found) - growth(alone)).max() > 0.02
    assert abs(found.speed.mean - alone.speed.mean) > found.speed.error + alone.speed.error
    assert abs(growth(found) - growth(finer)).max() <= found.growth_error
    assert abs(found.speed.mean - finer.speed.mean) <= found.speed.error


def test_what_feedback_does_vanishes_with_its_coefficient() -> None:
    """Linearly: a tenth of it does a tenth as much, and none has the same bits as no feedback."""
    same(stepped(None), stepped(0.0))
    strong, weak = (stepped(f) for f in (1e-2, 1e-3))
    for what in (growth, lambda found: found.centre[1:]):
        full, part = (what(found) - what(stepped(0.0)) for found in (strong, weak))
        assert abs(10 * part - full).max() < 0.1 * abs(full).max()


def test_a_symmetric_start_stays_symmetric_and_crawls_nowhere() -> None:
    found = stepped(0.1, origin=0.0)
    c = growth(found)
    assert c == pytest.approx(c[::-1], abs=1e-6)
    assert c == pytest.approx(c[:, ::-1], abs=1e-6)
    assert abs(found.centre[:2]).max() < 1e-6
    assert np.ptp(found.centre[2]) > 1e-5  # but it rises and falls


def test_the_balance_of_power_closes() -> None:
    """What growth does goes into energies and friction, up to an error of second order in the step."""
    coarse, fine = (stepped(0.1, steps=steps).power for steps in (STEPS, 2 * STEPS))
    assert abs(fine.residual).max() < 0.04 * fine.growth[-1]
    assert coarse.residual[-1] / fine.residual[-1] == pytest.approx(4, rel=0.1)


def test_an_interrupted_run_ends_with_the_same_bits(tmp_path: Path) -> None:
    options = {"periods": 1, "steps": STEPS, "snapshot_every": 7}
    same(stepped(0.1), interrupted(scene(0.1), tmp_path / "cut.npz", 17, **options))
