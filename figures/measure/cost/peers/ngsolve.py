"""The displacement of the sheet by NGSolve, elements of degree 4 on a uniform grid of triangles."""

from typing import Any, NamedTuple

import numpy as np
from ngsolve import (
    BilinearForm,
    CoefficientFunction,
    Grad,
    GridFunction,
    Id,
    InnerProduct,
    LinearForm,
    Sym,
    Trace,
    VectorH1,
    cos,
    div,
    dx,
    sin,
    y,
)
from ngsolve.meshes import MakeStructured2DMesh
from numpy.typing import NDArray

from figures.measure.cost.peers.peer import Peer
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]

DEGREE = 4
CELLS = (2, 4, 8, 16)


class Solution(NamedTuple):
    """The mesh and a displacement on it for each part."""

    mesh: Any
    parts: list[Any]


def solve(sheet: Sheet, parts: tuple[tuple[float, float], ...], n: int) -> Solution:
    """Displacements for growths p sin + q cos (2 pi y/L), on n elements along the sheet."""
    mesh = MakeStructured2DMesh(
        quads=False,
        nx=max(n // 2, 1),
        ny=n,
        mapping=lambda s, t: ((s - 0.5) * sheet.width, (t - 0.5) * sheet.length),
    )
    space, nu = VectorH1(mesh, order=DEGREE), sheet.poisson
    u, v = space.TnT()
    strain, virtual = Sym(Grad(u)), Sym(Grad(v))
    stress = strain / (1 + nu) + nu / (1 - nu**2) * Trace(strain) * Id(2)
    work = BilinearForm(InnerProduct(stress, virtual) * dx, symmetric=True).Assemble()
    factor = work.mat.Inverse(unpinned(space), inverse="sparsecholesky")
    found = []
    for p, q in parts:
        phase = 2 * np.pi / sheet.length * y
        growth: CoefficientFunction = p * sin(phase) + q * cos(phase)
        load = LinearForm(growth / (1 - nu) * div(v) * dx(bonus_intorder=DEGREE)).Assemble()
        field = GridFunction(space)
        field.vec.data = factor * load.vec
        found.append(field)
    return Solution(mesh, found)


def unpinned(space: Any) -> Any:
    """Unknowns that are left when rigid motions are stopped.

    The grid's first two vertices have the same y: y of both and x of one are held.
    """
    free, second = space.FreeDofs(), space.components[0].ndof
    for pinned in (0, second, second + 1):
        free.Clear(pinned)
    return free


def displacements(solution: Solution, x: Array, y: Array) -> Array:
    """(parts, 2, *x.shape)."""
    points = solution.mesh(x.ravel(), y.ravel())
    return np.stack([field(points).T.reshape(2, *x.shape) for field in solution.parts])


def peers() -> list[Peer]:
    """NGSolve at one degree."""
    return [Peer(f"NGSolve P{DEGREE}", CELLS, solve, displacements)]
