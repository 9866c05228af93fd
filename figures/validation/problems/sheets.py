"""Meshes, supports and equilibria of which the problems are made."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import skfem
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rest_state import grown_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.kinematics.surface import Flat, Surface
from fem_check.shell.material import Material
from fem_check.shell.statics.equilibrium import Equilibrium
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Load, Potential
from fem_check.shell.statics.ramp import ramp

Array = NDArray[np.float64]

ELEMENTS = {"bfs": skfem.ElementQuadBFS, "argyris": skfem.ElementTriArgyris}


def rectangle(element: str, x: tuple[float, float, int], y: tuple[float, float, int]) -> Any:
    """A uniform mesh of rectangles, or of triangles with alternating diagonals."""
    grid = [np.linspace(start, end, count + 1) for start, end, count in (x, y)]
    kind = skfem.MeshQuad if element == "bfs" else skfem.MeshTri
    return kind.init_tensor(*grid)


def shell(
    element: str,
    x: tuple[float, float, int],
    y: tuple[float, float, int],
    surface: Surface | None = None,
    degree: int | None = None,
) -> Discretisation:
    """A rectangle of parameters mapped to a surface."""
    return Discretisation(
        rectangle(element, x, y), ELEMENTS[element](), surface or Flat(), degree=degree
    )


def at(axis: int, value: float) -> Callable[[Array], NDArray[np.bool_]]:
    """Points of the parameter domain on a line."""
    return lambda xi: np.asarray(np.isclose(xi[axis], value))


def koiter(material: Material) -> tuple[Effect, Effect]:
    """Stretching and bending."""
    return Membrane(material), Bending(material)


def displacement(sheet: Discretisation, state: Array, xi: tuple[float, float]) -> Array:
    """Displacement of one point, (3,)."""
    return np.asarray(sheet.point(xi).displacement(state, (0,))[0, :, 0])


def affine(sheet: Discretisation, gradient: Array, shift: Array) -> Array:
    """Unknowns of the displacement shift + gradient (3, 2) xi."""

    def jets(x: Array, y: Array) -> Array:
        out = np.zeros((6, 3, x.size))
        out[0] = shift[:, None] + gradient @ np.stack([x, y])
        out[1], out[2] = gradient[:, :1], gradient[:, 1:]
        return out

    return sheet.interpolate(jets)


@dataclass(frozen=True)
class Path:
    """Displacements of named points at shares of the full load."""

    values: dict[float, tuple[float, ...]]
    result: Equilibrium
    elements: int


def loaded(
    sheet: Discretisation,
    supports: Supports,
    material: Material,
    loads: Callable[[float], tuple[Load, ...]],
    read: Callable[[Array], tuple[float, ...]],
    shares: tuple[float, ...] = (1.0,),
    first: float = 0.25,
) -> Path:
    """Equilibria at shares of the load, each reached from the one before."""
    rest, minimiser = grown_state(sheet.interior), Minimiser(supports)
    state, start = sheet.zeros(), 0.0
    values: dict[float, tuple[float, ...]] = {}
    result = None
    for share in shares:

        def problem(s: float, a: float = start, b: float = share) -> Potential:
            return Potential(sheet, koiter(material), rest, loads=loads(a + s * (b - a)))

        result = ramp(minimiser, problem, state, first=min(1.0, first / (share - start)))
        state, start, values[share] = result.state, share, read(result.state)
    assert result is not None
    return Path(values, result, sheet.mesh.nelements)


def linear_response(
    sheet: Discretisation, supports: Supports, material: Material, load: DeadLoad
) -> Array:
    """State per unit of a load so small that the answer is linear: one Newton step from the rest."""
    effects = (*koiter(material), load)
    return first_step(supports, Potential(sheet, effects, grown_state(sheet.interior)))


def first_step(supports: Supports, potential: Potential) -> Array:
    """Newton's first step from the undeformed sheet, which is the linear answer."""
    sheet = supports.discretisation
    minimiser = Minimiser(supports)
    factorised = minimiser.factorised(potential, sheet.zeros(), 0.0)
    assert factorised.shift == 0
    state = sheet.zeros()
    order = minimiser.sparsity.order
    state[order] = -factorised.factor.solve(potential.gradient(sheet.zeros())[order])
    return state
