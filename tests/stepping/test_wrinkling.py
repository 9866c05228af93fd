"""Motions in the plane that go on where a real sheet wrinkles at its edge say so."""

import numpy as np
import pytest

from fem_check import (
    Friction,
    Gravity,
    Material,
    Membrane,
    Scene,
    Trajectory,
    cycle_speed,
    simulate,
    solve,
)
from fem_check.shell.statics.ellipticity import edge_limit
from fem_check.shell.statics.equilibrium import UnstableError
from linear_theory import Sheet, SineWave

EFFECTS = (Membrane(Material(0.03, 0.5)), Gravity(3e-6), Friction(1.0, slip_speed=0.05))


def scene(alpha: float) -> Scene:
    return Scene(Sheet(), SineWave(), alpha, effects=EFFECTS, cells=(2, 4))


def edge_stretches(motion: Trajectory) -> np.ndarray:
    """Smallest length of the sides over their grown length at each kept time, by chords of 1/1000."""
    y = np.linspace(-0.5, 0.5, 1001)
    middle = (y[1:] + y[:-1]) / 2
    found = []
    for t in motion.stored_times:
        grown = motion.scene.alpha * motion.amplitude(t) * np.sin(2 * np.pi * (middle - t))
        sides = (motion.positions(t, np.stack([np.full_like(y, x), y])) for x in (-0.25, 0.25))
        chords = [np.hypot(*np.diff(side, axis=1)) / np.diff(y) for side in sides]
        found.append((np.array(chords) / np.exp(grown)).min())
    return np.array(found)


def test_motions_beyond_stability_are_found_where_the_edge_is_too_short() -> None:
    motion = simulate(scene(0.5), periods=1, steps=24)
    stretch = edge_stretches(motion)
    clear = abs(stretch - edge_limit(0.5)) > 2e-3  # quadrature points are not the shortest places
    np.testing.assert_array_equal(motion.wrinkled[clear], (stretch < edge_limit(0.5))[clear])
    assert motion.wrinkled.any()
    assert not motion.wrinkled[0]
    assert "compressed beyond material stability" in motion.speed.model


def test_the_cycle_refuses_and_steps_are_never_converged() -> None:
    with pytest.raises(UnstableError, match="beyond material stability"):
        cycle_speed(scene(0.5), rtol=0.1)
    found = solve(scene(0.5), "stepped", rtol=None, periods=1, steps=24)
    assert "compressed beyond material stability" in found.caution
    assert not found.converged


def test_a_sheet_that_is_stable_or_bends_does_not() -> None:
    assert not simulate(scene(0.4), periods=1, steps=24).wrinkled.any()
