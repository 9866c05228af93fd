"""What a mesh and an element must be before a shell can be built on them."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.shape_functions import is_global

CONFORMING = ("ElementQuadBFS", "ElementTriArgyris")
"""scikit-fem's elements whose functions have continuous gradients (Morley's have not)."""


def is_h2(element: Any) -> bool:
    """Whether second derivatives are square integrable across element edges."""
    return type(element).__name__ in CONFORMING


def require_h2(element: Any) -> None:
    """Raise ValueError for an element that cannot bend."""
    if not is_h2(element):
        name = type(element).__name__
        raise ValueError(f"element = {name}: must be H2, one of {', '.join(CONFORMING)}, to bend")


def check_element(mesh: Any, element: Any) -> None:
    """Raise ValueError if the element does not fit the mesh or has no shape functions to use here."""
    name = type(element).__name__
    if getattr(element, "refdom", None) is not mesh.refdom:
        raise ValueError(
            f"element = {name}: must be an element of {mesh.refdom.__name__}, as the mesh is"
        )
    if is_global(element) and not is_h2(element):
        raise ValueError(
            f"element = {name}: must be conforming, one of {', '.join(CONFORMING)} or Lagrange"
        )
    if not is_global(element) and "ElementH1" not in {base.__name__ for base in type(element).__mro__}:
        raise ValueError(f"element = {name}: must be a scalar, continuous element")


def check_mesh(mesh: Any, element: Any) -> None:
    """Raise ValueError for a mesh with inverted, flat or (for BFS) oblique elements."""
    if mesh.p.shape[0] != 2 or mesh.t.shape[0] not in (3, 4):
        raise ValueError(
            f"mesh = {type(mesh).__name__}: must be triangles or quadrilaterals in the plane"
        )
    if not np.all(np.isfinite(mesh.p)):
        raise ValueError("mesh.p contains values that are not finite")
    _check_corners(mesh)
    _check_sides(mesh)
    if type(element).__name__ == "ElementQuadBFS":
        _check_rectangles(mesh)


def _check_corners(mesh: Any) -> None:
    """No element may be flat or, if it has four corners, be folded or have a reflex corner."""
    corners = mesh.p[:, mesh.t]
    ahead = np.roll(corners, -1, axis=1) - corners
    behind = np.roll(corners, 1, axis=1) - corners
    turn = ahead[0] * behind[1] - ahead[1] * behind[0]
    smallest = 1e-12 * (ahead**2).sum(0).max(0)
    bad = (np.abs(turn) <= smallest).any(0) | (turn.max(0) * turn.min(0) < 0)
    _refuse(bad, "inverted or without area")


def _check_sides(mesh: Any) -> None:
    """The two elements of an edge must lie on different sides of it."""
    inner = np.flatnonzero(mesh.f2t[1] >= 0)
    start, end = mesh.p[:, mesh.facets[:, inner]].transpose(1, 0, 2)
    centre = mesh.p[:, mesh.t].mean(1)
    edge = end - start
    sides = [centre[:, mesh.f2t[k, inner]] - start for k in (0, 1)]
    first, second = (edge[0] * side[1] - edge[1] * side[0] for side in sides)
    bad = np.zeros(mesh.t.shape[1], bool)
    bad[mesh.f2t[0, inner[first * second >= 0]]] = True
    _refuse(bad, "inverted (they overlap a neighbour)")


def _check_rectangles(mesh: Any) -> None:
    corners = mesh.p[:, mesh.t]
    sides = np.abs(np.roll(corners, -1, axis=1) - corners)
    _refuse(
        (sides.min(0) > 1e-9 * sides.max(0)).any(0), "no rectangles along the axes (ElementQuadBFS)"
    )


def _refuse(bad: NDArray[np.bool_], what: str) -> None:
    if bad.any():
        raise ValueError(f"mesh: {bad.sum()} of {bad.size} elements are {what}, first {bad.argmax()}")
