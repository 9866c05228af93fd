"""Effects are an open set: one that is written here alone runs through every level that can bear it."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest

from fem_check import Friction, Gravity, Material, Membrane, Scene, cycle_speed, simulate
from fem_check.shell.effects.effect import Effect
from fem_check.shell.kinematics.point_state import PointState
from linear_theory import Sheet, SineWave, crawl_speed
from linear_theory.common.pairs import identity
from linear_theory.common.shown import Value

MATERIAL = Material(0.03, 0.5)
STRETCHING = Membrane(MATERIAL)
WEAK = (Gravity(3e-7), Friction(1.0, 2e-2))
"""A slip speed that a step resolves with the few points along this mesh, which all slip alike here."""


@dataclass(frozen=True)
class Foundation(Value, Effect):
    """Springs that hold every point across the sheet at its place, stiffness k per undeformed area."""

    stiffness: float
    entries: ClassVar[tuple[int, ...]] = (0,)
    stored_as: ClassVar[str] = "elastic"

    def _away(self, state: PointState) -> np.ndarray:
        away = state.position - state.region.reference[0, :, state._points]
        away[1:] = 0
        return away

    def energy(self, state: PointState) -> np.ndarray:
        return self.stiffness / 2 * state.measure * (self._away(state) ** 2).sum(0)

    def gradient(self, state: PointState) -> np.ndarray:
        return (self.stiffness * state.measure * self._away(state))[None]

    def hessian(self, state: PointState) -> np.ndarray:
        across = np.zeros_like(identity(state.components))
        across[0] = 1
        return (self.stiffness * state.measure * across)[None, None]


def scene(*effects: Effect, alpha: float = 0.1) -> Scene:
    return Scene(Sheet(), SineWave(), alpha, effects=(STRETCHING, *effects), cells=(2, 4))


def test_springs_that_forbid_to_widen_change_the_speed_in_cycle_and_stepper_alike() -> None:
    held = (Foundation(1e3 * MATERIAL.stretching),)
    free, stiff = (cycle_speed(scene(*held[:n], *WEAK), rtol=1e-2) for n in (0, 1))
    few, many = (simulate(scene(*held, *WEAK), periods=1, steps=n) for n in (32, 64))
    stepped = (4 * many.speed.mean - few.speed.mean) / 3  # steps are of second order
    assert abs(stiff.mean - free.mean) > 0.1 * abs(free.mean)
    assert stiff.mean == pytest.approx(stepped, rel=1e-2)
    assert np.isnan(stiff.model_error)  # it is not the sheet that nothing but growth deforms


def test_its_energy_is_in_the_balance() -> None:
    run = simulate(scene(Foundation(MATERIAL.stretching), *WEAK), periods=1, steps=32)
    without = simulate(scene(*WEAK), periods=1, steps=32)
    assert run.power.elastic[-1] != without.power.elastic[-1]
    assert abs(run.power.residual[-1]) < 1e-2 * abs(run.power.elastic).max()


def test_a_theory_that_does_not_know_it_refuses() -> None:
    with pytest.raises(ValueError, match="cannot represent Foundation"):
        crawl_speed(scene(Foundation(1.0)))


def test_it_is_part_of_the_key() -> None:
    assert scene(Foundation(1.0)).key() != scene(Foundation(2.0)).key()
    assert scene(Foundation(1.0)) == scene(Foundation(1.0))
