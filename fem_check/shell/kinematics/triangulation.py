"""A triangulation of the middle surface whose vertices are points of the sheet.

Their places are a linear map of the unknowns, so that what is known of triangles (whether they
intersect, how far they are apart) acts on the unknowns through that map alone. The triangles are flat:
they leave the surface by their sagitta, side^2 times curvature over 8.
"""

from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fem_check.shell.kinematics.discretisation import Discretisation
from linear_theory.common import validation

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

ROUNDOFF = 1e-9
"""Distance, relative to the size of the sheet, below which two points are one vertex."""


class Triangulation:
    """Triangles between points of a sheet in space; the sides of elements have `pieces` parts.

    The two triangles of a small quadrilateral meet alternately along one and the other diagonal: with
    an even number of pieces the triangulation has the mirror symmetries of the mesh. Raises ValueError
    for pieces < 1.

    >>> from fem_check.mesh.elements import grid
    >>> from fem_check.shell.kinematics.discretisation import Discretisation
    >>> from fem_check.shell.kinematics.triangulation import Triangulation
    >>> from linear_theory import Sheet
    >>> import skfem
    >>> sheet = Discretisation(grid(Sheet(), (2, 4)), skfem.ElementQuadBFS())
    >>> surface = Triangulation(sheet, pieces=2)
    >>> print(surface.vertices(sheet.zeros()).shape, len(surface.triangles))
    (3, 45) 64
    """

    def __init__(self, discretisation: Discretisation, pieces: int) -> None:
        self.discretisation = discretisation
        self.pieces = validation.integer("pieces", pieces, 1)

    @cached_property
    def _parts(self) -> tuple[Array, Integers]:
        mesh = self.discretisation.mesh
        corners = mesh.p[:, mesh.t]
        inside = _quadrilateral if mesh.t.shape[0] == 4 else _triangle
        weights, local = inside(self.pieces)
        points = np.einsum("ik,ckt->cti", weights, corners)
        count = points.shape[1]
        triangles = (local[None] + len(weights) * np.arange(count)[:, None, None]).reshape(-1, 3)
        flat = points.reshape(2, -1)
        scale = ROUNDOFF * np.ptp(flat, axis=1).max()
        _, first, index = np.unique(
            np.round(flat / scale).astype(np.int64), axis=1, return_index=True, return_inverse=True
        )
        return flat[:, first], index.ravel()[triangles]

    @property
    def places(self) -> Array:
        """Vertices in the parameter domain, (2, n)."""
        return self._parts[0]

    @property
    def triangles(self) -> Integers:
        """Vertices of each triangle, (m, 3)."""
        return self._parts[1]

    @cached_property
    def region(self) -> Any:
        """The vertices as points of the sheet."""
        return self.discretisation.points(self.places)

    def vertices(self, u: Array) -> Array:
        """Places (3, n) of the vertices for unknowns u (size,)."""
        return np.asarray(self.region.position(u, (0,))[0])

    @cached_property
    def map(self) -> Any:
        """P of x = X + P u, a sparse matrix (3 n, size); the coordinates of a vertex are neighbours."""
        shapes, dofs = self.region.shapes((0,))[:, 0, 0], self.region.dofs
        count = len(dofs)
        rows = np.repeat(np.arange(count), dofs.shape[1])
        values = np.broadcast_to(shapes, dofs.shape).ravel()
        shape = (count, self.discretisation.scalars)
        scalar = sp.csr_array((values, (rows, dofs.ravel())), shape=shape)
        return sp.csr_array(sp.kron(scalar, sp.eye_array(3)))

    @cached_property
    def longest(self) -> float:
        """Length of the longest side of a triangle in the parameter domain."""
        corners = self.places[:, self.triangles]
        sides = corners - np.roll(corners, 1, axis=2)
        return float(np.sqrt((sides**2).sum(0)).max())


def _quadrilateral(pieces: int) -> tuple[Array, Integers]:
    """Weights (points, 4) of the corners of an element, and triangles (m, 3) between its points."""
    s = np.linspace(0, 1, pieces + 1)
    a, b = (v.ravel() for v in np.meshgrid(s, s, indexing="ij"))
    weights = np.stack([(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b], axis=1)
    number = np.arange((pieces + 1) ** 2).reshape(pieces + 1, -1)
    one, two, three, four = (
        part.ravel() for part in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:])
    )
    rising = np.add.outer(np.arange(pieces), np.arange(pieces)).ravel() % 2 == 0
    first = np.where(rising, [one, two, three], [one, two, four])
    second = np.where(rising, [one, three, four], [two, three, four])
    return weights, np.concatenate([first.T, second.T])


def _triangle(pieces: int) -> tuple[Array, Integers]:
    """The same for an element with three corners."""
    number: dict[tuple[int, int], int] = {}
    for i in range(pieces + 1):
        for j in range(pieces + 1 - i):
            number[i, j] = len(number)
    places = np.array(list(number)) / pieces
    weights = np.column_stack([1 - places.sum(1), places])
    up = [(number[i, j], number[i + 1, j], number[i, j + 1]) for i, j in number if i + j < pieces]
    down = [
        (number[i, j], number[i, j + 1], number[i - 1, j + 1])
        for i, j in number
        if i > 0 and i + j < pieces
    ]
    return weights, np.array(up + down)
