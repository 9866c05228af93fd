"""Checks of a mesh of triangles or quadrilaterals before anything is solved on it.

A mesh with gaps, overlaps or folds would silently give the result of another sheet. Every function that
accepts a mesh checks it here. All tolerances are relative to the mesh or to an element, so that the
unit of length does not matter.
"""

from typing import Any

import numpy as np
import shapely
import skfem
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.int64]

FLAT = 1e-12
"""Sine of an angle of an element below which its area counts as zero."""

SEAM = 1e-4
"""Smallest distance of a boundary vertex to another boundary edge, relative to the shortest edge at the
vertex. Rounding to single precision is smaller, and so narrow a slit is not a real one."""

AREA = 1e-9
"""Relative difference between the total area of the elements and the area within the boundary."""

SHORTER = 0.1
"""Fraction of the length by which a mesh may be shorter than its sheet, as polygons of curved outlines
are by a few per cent. Wrong units, or a sheet along the other axis, deviate more."""

BEYOND = 1e-6
"""Fraction of the length by which a mesh may extend beyond its sheet: single-precision roundoff."""

SHOWN = 5
"""Largest number of elements or vertices named in a message."""


def check_mesh(mesh: Any, name: str = "mesh") -> None:
    """Raise ValueError for a mesh that is not a single, connected, conforming sheet.

    Refused are elements with curved sides and degenerate, inverted, duplicate or overlapping elements;
    vertices that are not finite, belong to no element or lie on another edge without being connected
    to it (unmerged seams, hanging nodes); parts connected by single vertices or not at all. name: of
    the argument, for the message.
    """
    if not isinstance(mesh, skfem.Mesh) or mesh.elem not in (skfem.ElementTriP1, skfem.ElementQuad1):
        raise ValueError(
            f"{name} = {type(mesh).__name__}: must be triangles or quadrilaterals in the plane with "
            "straight sides, a skfem.MeshTri or MeshQuad"
        )
    if not np.all(np.isfinite(mesh.p)):
        bad = np.flatnonzero(~np.isfinite(mesh.p).all(0))
        raise ValueError(f"{name}.p must be finite, is not at vertices {_shown(bad)}")
    _check_elements(mesh, name)
    _check_facets(mesh, name)
    edges = mesh.facets[:, mesh.boundary_facets()]
    _check_seams(mesh, edges, name)
    _check_one_piece(mesh, edges, name)
    _check_overlap(mesh, edges, name)


def check_fits(mesh: Any, sheet: Sheet, name: str = "mesh") -> None:
    """Raise ValueError for a mesh that is not in the coordinates of its sheet.

    It must lie within the rectangle of the sheet, where growth is checked in advance, and have the same
    length, since the wave is defined relative to the length of the sheet.
    """
    low, high = mesh.p.min(1), mesh.p.max(1)
    half = np.array([sheet.width, sheet.length]) / 2
    beyond = np.maximum(high, -low) - half
    if beyond.max() <= BEYOND * sheet.length and (high - low)[1] >= (1 - SHORTER) * sheet.length:
        return
    (width, length), (x, y) = high - low, (low + high) / 2
    raise ValueError(
        f"{name}: is {width:.6g} by {length:.6g} about x = {x:.6g}, y = {y:.6g}; must lie within the "
        f"sheet, {sheet.width:.6g} by {sheet.length:.6g} about 0, 0, and as long (to {SHORTER:.0%}): "
        "convert it to the unit of the sheet, move it to 0, 0, or give the Sheet its length and width"
    )


def _check_elements(mesh: Any, name: str) -> None:
    """Every vertex belongs to an element, and no element is degenerate, folded or non-convex."""
    unused = np.setdiff1d(np.arange(mesh.p.shape[1]), mesh.t)
    if unused.size:
        raise ValueError(
            f"{name}: {unused.size} vertices belong to no element: {_shown(unused)}; remove them with "
            "mesh.remove_unused_nodes()"
        )
    corners = mesh.p[:, mesh.t]
    ahead = np.roll(corners, -1, axis=1) - corners
    behind = np.roll(corners, 1, axis=1) - corners
    turn = ahead[0] * behind[1] - ahead[1] * behind[0]
    sides = np.sqrt((ahead**2).sum(0))
    smallest = FLAT * sides * np.roll(sides, 1, axis=0)
    bad = (np.abs(turn) <= smallest).any(0) | ((turn < 0).any(0) & (turn > 0).any(0))
    _refuse(bad, "inverted or have no area; move or remove their vertices", name)


def _check_facets(mesh: Any, name: str) -> None:
    """An edge belongs to at most two elements, which lie on opposite sides of it."""
    _, first, times = np.unique(np.sort(mesh.t, axis=0), axis=1, return_index=True, return_counts=True)
    doubled = np.zeros(mesh.t.shape[1], bool)
    doubled[first[times > 1]] = True
    _refuse(doubled, "duplicates; remove one of each pair", name)
    shared = np.bincount(mesh.t2f.ravel(), minlength=mesh.facets.shape[1])
    _refuse((shared[mesh.t2f] > 2).any(0), "at an edge shared by more than two", name)
    inner = np.flatnonzero(mesh.f2t[1] >= 0)
    start, end = mesh.p[:, mesh.facets[:, inner]].transpose(1, 0, 2)
    centre, edge = mesh.p[:, mesh.t].mean(1), end - start
    sides = [centre[:, mesh.f2t[k, inner]] - start for k in (0, 1)]
    one, other = (edge[0] * side[1] - edge[1] * side[0] for side in sides)
    folded = np.zeros(mesh.t.shape[1], bool)
    folded[mesh.f2t[0, inner[one * other >= 0]]] = True
    _refuse(folded, "inverted (they overlap a neighbour)", name)


def _check_seams(mesh: Any, edges: Indices, name: str) -> None:
    """No boundary vertex lies on a boundary edge of which it is not an end."""
    points = _local(mesh)
    lengths = np.sqrt(((points[edges[0]] - points[edges[1]]) ** 2).sum(1))
    reach = np.full(len(points), np.inf)
    np.minimum.at(reach, edges, np.broadcast_to(lengths, edges.shape))
    vertices = np.unique(edges)
    tree = shapely.STRtree(shapely.linestrings(points[edges.T]))
    near, edge = tree.query(
        shapely.points(points[vertices]), predicate="dwithin", distance=SEAM * reach[vertices]
    )
    vertex, (start, end) = vertices[near], edges[:, edge]
    foreign = np.flatnonzero((vertex != start) & (vertex != end))
    if not foreign.size:
        return
    i, a, b = (int(v[foreign[0]]) for v in (vertex, start, end))
    count = np.unique(vertex[foreign]).size
    x, y = mesh.p[:, i]
    gap = np.linalg.norm(points[[a, b]] - points[i], axis=1)
    if gap.min() <= SEAM * reach[i]:
        twin = (a, b)[int(gap.argmin())]
        words = f"first {i} and {twin} at x = {x:.6g}, y = {y:.6g}: merge these coincident vertices"
    else:
        words = (
            f"first {i} at x = {x:.6g}, y = {y:.6g} on the edge from {a} to {b}: split that edge there"
        )
    raise ValueError(f"{name}: {count} vertices lie on edges to which they are not connected, {words}")


def _check_one_piece(mesh: Any, edges: Indices, name: str) -> None:
    """All elements are connected by edges, and the boundary passes every vertex at most once."""
    count, inner = mesh.t.shape[1], mesh.f2t[:, mesh.f2t[1] >= 0]
    graph = coo_array((np.ones(inner.shape[1]), (inner[0], inner[1])), shape=(count, count))
    pieces, piece = connected_components(graph, directed=False)
    passed = np.bincount(edges.ravel(), minlength=mesh.p.shape[1])
    hinges = np.flatnonzero(passed > 2)
    if hinges.size:
        raise ValueError(
            f"{name}: parts are connected only by single vertices (hinges): {_shown(hinges)}; connect "
            "them by an edge or separate them"
        )
    if pieces > 1:
        other = int(np.flatnonzero(piece != piece[0])[0])
        raise ValueError(
            f"{name}: has {pieces} separate pieces, must be one; elements 0 and {other} are in two"
        )


def _check_overlap(mesh: Any, edges: Indices, name: str) -> None:
    """The boundary does not cross itself and encloses the area of the elements."""
    points = _local(mesh)
    boundary = shapely.linestrings(points[edges.T])
    first, second = shapely.STRtree(boundary).query(boundary, predicate="crosses")
    if first.size:
        a, b = edges[:, first[0]], edges[:, second[0]]
        raise ValueError(
            f"{name}: elements overlap: the boundary crosses itself, first at the edges between "
            f"vertices {a[0]}, {a[1]} and {b[0]}, {b[1]}"
        )
    x, y = points[mesh.t].transpose(2, 0, 1)
    x_after, y_after = np.roll(x, -1, axis=0), np.roll(y, -1, axis=0)
    area = float((abs((x * y_after - x_after * y).sum(0)) / 2).sum())
    enclosed = float(shapely.build_area(shapely.multilinestrings(list(boundary))).area)
    if abs(area - enclosed) > AREA * area:
        raise ValueError(
            f"{name}: elements overlap: their total area is {area / enclosed:.9g} times the area "
            "enclosed by the boundary"
        )


def _local(mesh: Any) -> Array:
    """Vertices (n, 2) relative to one of them, in units of the mesh size, to avoid cancellation."""
    return np.asarray((mesh.p - mesh.p[:, :1]).T / np.ptp(mesh.p, axis=1).max())


def _refuse(bad: Flags, what: str, name: str) -> None:
    if bad.any():
        numbers = _shown(np.flatnonzero(bad))
        raise ValueError(f"{name}: {bad.sum()} of {bad.size} elements are {what}: {numbers}")


def _shown(numbers: Indices) -> str:
    more = ", ..." if numbers.size > SHOWN else ""
    return ", ".join(str(int(number)) for number in numbers[:SHOWN]) + more
