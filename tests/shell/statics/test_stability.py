"""Whether an equilibrium is a minimum: by the sign of the lowest curvature, beyond its error."""

from dataclasses import dataclass

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.kinematics.rest_state import grown_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.material import Material
from fem_check.shell.statics.equilibrium import Equilibrium
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Load, Potential
from fem_check.shell.statics.saddle import saddle
from fem_check.shell.statics.stability import LowestMode, lowest_mode
from linear_theory.growth.growth import Growth
from tests.shell.shell_cases import at, koiter, shell

Array = NDArray[np.float64]

FREE = [("bfs", 0.03, 3), ("bfs", 0.01, 2), ("argyris", 0.03, 2), ("bfs", 0.1, 2)]
"""Element, thickness and cells across of sheets that nothing holds."""


def column(share: float, slenderness: float = 1e3) -> Equilibrium:
    """A clamped column, straight, under a share of Euler's load pi^2 B/(4 L^2), nu = 0."""
    sheet, material = shell("bfs", (0, 1, 16), (0, 0.1, 1)), Material(1 / slenderness, 0.0)
    pressing = DeadLoad((-share * np.pi**2 / 4 * material.bending, 0.0, 0.0))
    loads = (Load(sheet.edge(at(0, 1)), pressing),)
    potential = Potential(sheet, koiter(material), grown_state(sheet.interior), loads=loads)
    return Minimiser(Supports(sheet).clamp(at(0, 0))).minimise(potential, sheet.zeros())


@pytest.mark.parametrize("slenderness", [1e3, 1e2])
def test_a_long_column_buckles_at_the_load_of_euler(slenderness: float) -> None:
    """The lowest curvature is 1e-10 of the diagonal at a load 1e-5 beyond; it shortens by (h/L)^2."""
    near = 1e-5 if slenderness == 1e3 else 1e-3
    below, above = (column(1 + sign * near, slenderness) for sign in (-1, 1))
    assert not below.buckled
    assert np.isnan([below.negative_curvature, below.curvature_error]).all()
    assert above.buckled
    assert 0 < above.curvature_error < 1e-3 * abs(above.negative_curvature)
    farther = column(1 + 3 * near, slenderness)  # the curvature falls in proportion to the load
    assert farther.negative_curvature == pytest.approx(3 * above.negative_curvature, rel=0.1)


@dataclass(frozen=True)
class FreeSheet:
    """A sheet in space that nothing holds, with a smooth random growth and natural curvature."""

    element: str
    thickness: float
    cells: int
    seed: int

    def equilibrium(self) -> tuple[Minimiser, Potential, Equilibrium]:
        rng = np.random.default_rng(self.seed)
        sheet = shell(self.element, (-0.25, 0.25, self.cells), (-0.5, 0.5, 2 * self.cells))
        x, y = sheet.interior.parameters.reshape(2, -1)
        a, b, c, phase, bend = rng.uniform(-1, 1, 5)
        grown = a * np.sin(3 * x + phase) + b * np.cos(2 * y + phase) + c * x * y
        rest = grown_state(
            sheet.interior, grown, Growth(0.1 * self.thickness**2, curvature_coupling=bend)
        )
        potential = Potential(sheet, koiter(Material(self.thickness, 0.3)), rest)
        minimiser = Minimiser(Supports(sheet))
        return minimiser, potential, minimiser.minimise(potential, sheet.zeros())


def lowest_of(minimiser: Minimiser, potential: Potential, state: Array) -> LowestMode | None:
    """Lowest eigenvalue of the Hessian at a state, with the error by rounding alone."""
    here = minimiser.factorised(potential, state, 0.0, convex=False)
    matrix = here.values, here.factor, here.shift, here.scale
    return lowest_mode(minimiser.sparsity, *matrix) if here.shift > 0 else None


def turned(minimiser: Minimiser, state: Array, rotation: Array) -> Array:
    """The state of the sheet after a rotation about the origin."""
    sheet = minimiser.supports.discretisation

    def rigid(x: Array, y: Array) -> Array:
        out = np.zeros((6, 3, x.size))
        gradient = (rotation - np.eye(3))[:, :2]
        out[0], out[1], out[2] = gradient @ np.stack([x, y]), gradient[:, :1], gradient[:, 1:]
        return out

    return (state.reshape(-1, 3) @ rotation.T).ravel() + sheet.interpolate(rigid)


@pytest.mark.parametrize("case", range(len(FREE)))
def test_a_rigid_motion_is_no_buckling(case: int) -> None:
    """Its curvature is 0: to rounding, at the equilibrium, in any orientation of the sheet."""
    minimiser, potential, found = FreeSheet(*FREE[case], seed=case).equilibrium()
    assert not found.buckled
    for rotation in (np.eye(3), Rotation.random(random_state=case).as_matrix()):
        state = turned(minimiser, found.state, rotation)
        assert potential.energy_and_gradient(state)[0] == pytest.approx(found.energy, rel=1e-6)
        lowest = lowest_of(minimiser, potential, state)
        if lowest is not None:  # else rounding happened to make all of them positive
            value, error = lowest.curvature
            assert abs(value) <= error < 1e-13
        assert not minimiser.minimise(potential, state).buckled


@pytest.mark.parametrize("distance", [1e-9, 1e-6])
def test_an_error_of_the_state_is_none_of_its_curvature(distance: float) -> None:
    """Forces that are left over make a rotation of a free sheet look unstable."""
    unstable = []
    for case in range(len(FREE)):
        minimiser, potential, found = FreeSheet(*FREE[case], seed=case).equilibrium()
        units = np.repeat(minimiser.supports.discretisation.units, 3)
        off = np.random.default_rng(case).standard_normal(found.state.size) / units
        off *= distance / minimiser.rms(off)
        lowest = lowest_of(minimiser, potential, found.state + off)
        unstable.append(lowest is not None and lowest.is_negative)
        assert saddle(minimiser, potential, found.state + off, distance).mode is None
    assert sum(unstable) >= 2
