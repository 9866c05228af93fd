"""Triangle meshes of quadrilaterals and of polygons with holes.

Convex quadrilaterals get a grid of cells cut into four by their diagonals, with the symmetries of the
outline. Other polygons are meshed by Netgen.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from skfem import MeshTri

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

GRADING = 0.3
"""Growth rate of the triangle size with the distance from a short side."""


def quadrilateral_mesh(corners: Array, size: float) -> MeshTri:
    """Mesh of a convex quadrilateral (4, 2), anticlockwise, with triangle sides up to `size`."""
    sides = np.linalg.norm(np.roll(corners, -1, axis=0) - corners, axis=1)
    n = max(1, int(np.ceil(max(sides[0], sides[2]) / size - 1e-9)))
    m = max(1, int(np.ceil(max(sides[1], sides[3]) / size - 1e-9)))
    nodes = _bilinear(corners, np.linspace(0, 1, n + 1), np.linspace(0, 1, m + 1))
    centres = _bilinear(corners, (np.arange(n) + 0.5) / n, (np.arange(m) + 0.5) / m)
    number = np.arange((n + 1) * (m + 1)).reshape(n + 1, m + 1)
    a, b, c, d = (part.ravel() for part in _corners_of_cells(number))
    e = number.size + np.arange(n * m)
    triangles = np.concatenate([[a, b, e], [b, c, e], [c, d, e], [d, a, e]], axis=1)
    return MeshTri(np.concatenate([nodes, centres], axis=1), triangles)


def polygon_mesh(loops: Sequence[Array], size: float) -> MeshTri:
    """Mesh of a polygon with holes, reproducible from run to run.

    loops: outline (n, 2), anticlockwise, and holes, clockwise; size: approximate size of the triangles.
    Raises ValueError if Netgen finds no mesh, RuntimeError if it is not installed.
    """
    geometry, mesh_error = _netgen()
    # Netgen has absolute length tolerances: it gets coordinates of order 1 about the centre
    middle = (loops[0].min(axis=0) + loops[0].max(axis=0)) / 2
    unit = 2.0 ** np.floor(np.log2(np.ptp(loops[0], axis=0).max()))
    outline = geometry()
    for loop in loops:
        points = [outline.AppendPoint(*point) for point in ((loop - middle) / unit).tolist()]
        for start, end in zip(points, [*points[1:], points[0]], strict=True):
            outline.Append(["line", start, end], leftdomain=1, rightdomain=0)
    try:
        found = outline.GenerateMesh(maxh=float(size / unit), grading=GRADING)
    except mesh_error as error:
        raise ValueError(
            f"size = {size:g}: Netgen cannot mesh this outline ({error}); blunt sharp corners and fill "
            "narrow gaps, try another size, or pass a mesh made elsewhere as a skfem.MeshTri"
        ) from None
    points = np.array([vertex.p[:2] for vertex in found.Points()]) * unit + middle
    corners = np.concatenate(loops)
    points[: len(corners)] = corners  # exactly as given, without roundoff
    triangles = np.array([[v.nr - 1 for v in triangle.vertices] for triangle in found.Elements2D()])
    return MeshTri(np.ascontiguousarray(points.T), np.ascontiguousarray(triangles.T))


def _netgen() -> tuple[Any, Any]:
    """Netgen's class of outlines and its exception; imported here, since it is rarely needed."""
    try:
        from netgen.geom2d import SplineGeometry
        from netgen.meshing import NgException
    except ImportError as error:
        raise RuntimeError(
            "outlines other than convex quadrilaterals are meshed by Netgen, which cannot be loaded "
            f"({error}): pip install netgen-mesher, or pass a mesh made elsewhere as a skfem.MeshTri"
        ) from None
    return SplineGeometry, NgException


def _bilinear(corners: Array, s: Array, t: Array) -> Array:
    """(2, len(s) * len(t)) points of the map of the unit square, t fastest."""
    s, t = (v.ravel() for v in np.meshgrid(s, t, indexing="ij"))
    weights = np.stack([(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t])
    return np.asarray(corners.T @ weights)


def _corners_of_cells(number: Indices) -> tuple[Indices, Indices, Indices, Indices]:
    return number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
