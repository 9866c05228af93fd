"""Small deflections and vibrations of plates."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.linalg import eigsh

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.region import Entries
from fem_check.shell.kinematics.rest_state import grown_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.material import Material
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Potential
from figures.validation.problems.sheets import at, displacement, koiter, linear_response, shell
from linear_theory.common.pairs import identity
from linear_theory.common.shown import Value

Array = NDArray[np.float64]


def clamped_plate(element: str, n: int) -> float:
    """Centre deflection w D/(q L^4) of a clamped square plate; a quarter of it on n x n cells."""
    sheet = shell(element, (0, 0.5, n), (0, 0.5, n))
    supports = (
        Supports(sheet)
        .clamp(at(0, 0.5))
        .clamp(at(1, 0.5))
        .symmetric(at(0, 0), 0)
        .symmetric(at(1, 0), 1)
    )
    material = Material(0.01, 0.3)
    state = linear_response(sheet, supports, material, DeadLoad((0.0, 0.0, 1.0)))
    return displacement(sheet, state, (0, 0))[2] * material.bending


def rectangular_plate(n: int, aspect: float, clamped: bool, poisson: float = 0.3) -> tuple[float]:
    """Centre deflection w D/(q a^4) under a uniform load q, sides a and `aspect` a; n x n cells on a
    quarter of it, whose edges are simply supported or clamped."""
    sheet = shell("bfs", (0, 0.5, n), (0, aspect / 2, n))
    supports = Supports(sheet).symmetric(at(0, 0), 0).symmetric(at(1, 0), 1)
    for axis, end in ((0, 0.5), (1, aspect / 2)):
        supports = supports.clamp(at(axis, end)) if clamped else supports.pin(at(axis, end))
    material = Material(0.01, poisson)
    state = linear_response(sheet, supports, material, DeadLoad((0.0, 0.0, 1.0)))
    return (float(displacement(sheet, state, (0, 0))[2] * material.bending),)


@dataclass(frozen=True)
class _Mass(Value, Effect):
    """|x|^2/2 per undeformed area, whose Hessian is the mass matrix of unit density."""

    entries: ClassVar[Entries] = (0,)
    stored_as: ClassVar[None] = None

    def energy(self, state: PointState) -> Array:
        """See Effect."""
        return np.asarray(state.measure * (state.position**2).sum(0) / 2)

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        return np.asarray(state.measure * state.position)[None]

    def hessian(self, state: PointState) -> Array:
        """See Effect."""
        return np.asarray(state.measure * identity(state.components))[None, None]


def frequencies(sheet: Discretisation, supports: Supports, material: Material, count: int) -> Array:
    """Lowest angular frequencies of transverse vibrations at unit mass per area, (count,), with zeros.

    Points do not move in the plane, nor is there rotational inertia.
    """
    supports.held[:, :2] = True
    minimiser, rest = Minimiser(supports), grown_state(sheet.interior)

    def matrix(effects: tuple[Effect, ...]) -> Any:
        potential = Potential(sheet, effects, rest)
        values = minimiser.sparsity.assemble(potential.hessian_blocks(sheet.zeros()))
        return minimiser.sparsity.matrix(values).tocsc()

    stiffness, mass = matrix(koiter(material)), matrix((_Mass(),))
    # A shift below zero, so that rigid motions do not make the shifted matrix singular
    start = np.random.default_rng(0).standard_normal(stiffness.shape[0])
    found, _ = eigsh(stiffness, count, mass, sigma=-10 * material.bending, v0=start)
    return np.sqrt(np.maximum(np.sort(found), 0))


NAFEMS: Mapping[str, float] = {"side": 10.0, "h": 0.05, "young": 200e9, "poisson": 0.3, "rho": 8000.0}
"""Square plates of FV12 (free) and FV16 (cantilever), SI units."""


def nafems_plate(n: int, cantilever: bool, count: int) -> tuple[float, ...]:
    """Frequencies of the square plate on n x n cells, Hz; those of rigid motions are left out."""
    half, h = NAFEMS["side"] / 2, NAFEMS["h"]
    sheet = shell("bfs", (-half, half, n), (-half, half, n))
    supports = Supports(sheet)
    rigid = 0 if cantilever else 3
    if cantilever:
        supports.clamp(at(0, -half))
    # Young's modulus 1 in the matrices: of frequencies only its root is a factor
    found = frequencies(sheet, supports, Material(h, NAFEMS["poisson"]), rigid + count)[rigid:]
    scale = np.sqrt(NAFEMS["young"] / (NAFEMS["rho"] * h)) / (2 * np.pi)
    return tuple((found * scale).tolist())
