"""The order of the vertices of elements, on which neighbours must agree for continuous functions.

A function of an edge runs along it, from one of its ends to the other. Where two elements take it in
opposite directions, functions of odd degree jump across the edge, and the sheet is torn there.
"""

from dataclasses import replace
from typing import Any

import numpy as np
import skfem
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

Flags = NDArray[np.bool_]
Indices = NDArray[np.int64]


def oriented(mesh: Any) -> Any:
    """The same triangles or quadrilaterals, every edge of which runs in one direction.

    In a triangle edges run from the lower to the higher vertex, once its vertices are sorted. In a
    quadrilateral opposite edges run in parallel, which meshes in the plane always admit (R. Agelek, M.
    Anderson, W. Bangerth, W. L. Barth, ACM Trans. Math. Softw. 44:5, 2017).

    >>> import numpy as np
    >>> from fem_check.mesh.orientation import oriented
    >>> from skfem import MeshTri
    >>> corners = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    >>> print(*oriented(MeshTri(corners, np.array([[2], [0], [1]]), sort_t=False)).t[:, 0])
    0 1 2
    """
    if isinstance(mesh, skfem.MeshTri):
        return mesh if np.all(np.diff(mesh.t, axis=0) > 0) else replace(mesh, sort_t=True)
    if _agree(mesh):
        return mesh
    turns = (np.arange(4)[:, None] + _sources(mesh)) % 4
    return replace(mesh, t=np.take_along_axis(mesh.t, turns, axis=0))


def _agree(mesh: Any) -> bool:
    """Whether quadrilaterals already do, whose edges run from vertex 0 to 1, 1 to 2, 3 to 2, 0 to 3."""
    ahead, edges = mesh.t[[1, 2, 2, 3]] > mesh.t[[0, 1, 3, 0]], mesh.t2f.ravel()
    upwards = np.bincount(edges, ahead.ravel())
    return bool(np.all((upwards == 0) | (upwards == np.bincount(edges))))


def _sources(mesh: Any) -> Indices:
    """Which vertex of each quadrilateral both its edges run away from."""
    ahead = np.roll(mesh.t, -1, axis=0) > mesh.t  # around the element, from lower to higher vertices
    forward = ahead == _kept(mesh, ahead)[mesh.t2f]
    leaves = forward & ~np.roll(forward, 1, axis=0)
    return np.asarray(np.argmax(leaves, axis=0))


def _kept(mesh: Any, ahead: Flags) -> Flags:
    """Which edges run from their lower to their higher vertex, such that opposite ones are parallel.

    An edge and its reverse are two nodes of a graph, joined with those of the opposite edges that run
    in parallel: of the two parts that a chain of edges falls into either is a choice.
    """
    count = mesh.facets.shape[1]
    here, there = mesh.t2f[:2].ravel(), mesh.t2f[2:].ravel()
    against = (ahead[:2] == ahead[2:]).ravel()  # around the element opposite edges are antiparallel
    rows = np.concatenate([here, here + count])
    columns = np.concatenate([there + count * against, there + count * ~against])
    graph = coo_array((np.ones(len(rows)), (rows, columns)), (2 * count, 2 * count))
    part = connected_components(graph, directed=False)[1]
    return np.asarray(part[:count] < part[count:])
