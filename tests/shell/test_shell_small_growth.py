"""The cycle of shapes at growth so small that its speed, of order alpha^2, is near roundoff."""

import numpy as np
import pytest
import skfem

from fem_check.shell.cycle import speed as speed_module
from fem_check.shell.cycle.balance import STATIC_NOISE, CycleBalance
from fem_check.shell.cycle.shapes import Shapes, _Solver, cycle_of_shapes
from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.material import Material
from linear_theory import Sheet, SineWave
from linear_theory.scene.scene import Scene

LIMIT = 1.5332
"""V/alpha^2 on these 4 x 8 elements, the same to four digits for alpha from 1e-3 to 1e-5."""


def small(alpha: float, period: float = 1.0) -> Scene:
    """The paper's sheet, stretching in the plane."""
    effects = (Membrane(Material(0.03, 0.5)),)
    element = skfem.ElementQuadBFS()
    return Scene(Sheet(), SineWave(1, period), alpha, effects=effects, cells=(4, 8), element=element)


@pytest.fixture
def work(monkeypatch: pytest.MonkeyPatch) -> dict[str, int]:
    """Counts the times that are balanced and the phases that are asked for."""
    done = {"times": 0, "phases": 0}
    balance, shapes = CycleBalance._balance, speed_module.cycle_of_shapes

    def counted_balance(self: CycleBalance, times: np.ndarray) -> object:
        done["times"] += times.size
        return balance(self, times)

    def counted_shapes(scene: Scene, count: int, known: Shapes | None) -> Shapes:
        done["phases"] = max(done["phases"], count)
        return shapes(scene, count, known)

    monkeypatch.setattr(CycleBalance, "_balance", counted_balance)
    monkeypatch.setattr(speed_module, "cycle_of_shapes", counted_shapes)
    return done


@pytest.mark.parametrize("alpha", [1e-9, 1e-8])
def test_no_work_is_spent_on_noise(alpha: float, work: dict[str, int]) -> None:
    """It took 4418 times and 128 phases; no more is spent than where the tolerance is met."""
    found = cycle_speed(small(alpha), rtol=1e-2)
    assert not found.converged
    assert abs(found.mean - LIMIT * alpha**2) <= found.error
    spent = dict(work)
    work.update(times=0, phases=0)
    assert cycle_speed(small(1e-3), rtol=1e-2).converged
    assert spent["times"] <= work["times"]
    assert spent["phases"] == work["phases"] == speed_module.FIRST_PHASES


@pytest.mark.parametrize("alpha", [1e-7, 3e-7, 4e-7, 1e-6])
def test_errors_are_honest_down_to_the_noise(alpha: float) -> None:
    found = cycle_speed(small(alpha), rtol=1e-2)
    assert abs(found.mean / alpha**2 - LIMIT) <= found.error / alpha**2 + 1e-4  # digits of LIMIT
    assert found.error >= STATIC_NOISE
    assert found.converged == (found.error <= 1e-2 * found.mean) == (alpha > 2e-7)


def test_noise_is_in_the_units_of_the_wave() -> None:
    slow, fast = (cycle_speed(small(1e-8, period), rtol=1e-2) for period in (1.0, 1e-3))
    assert fast.error == pytest.approx(1e3 * slow.error, rel=0.5)  # but for what noise adds to it


@pytest.mark.parametrize("alpha", [1e-9, 3e-7, 1e-5, 1e-3])
def test_shapes_are_right_to_a_share_of_alpha_squared(alpha: float) -> None:
    """One more of Newton's corrections changes them by no more than that, or roundoff.

    The energy of small strains does not show whether the last step went downhill.
    """
    shapes = cycle_of_shapes(small(alpha), 4)
    solver = _Solver(shapes.model)
    for t, state in zip(shapes.times, shapes.states, strict=True):
        again = solver.shape(float(t), state, state).state
        # 1e-13: unknowns are slopes too, and twists, which differ from values by 1/h^2 = 64
        assert np.abs(again - state).max() <= 1e-4 * alpha**2 + 1e-13
