"""Elements and meshes suitable for a shell."""

from typing import Any

import numpy as np

from fem_check.shell.kinematics.shape_functions import is_global

CONFORMING = ("ElementQuadBFS", "ElementTriArgyris")
"""scikit-fem elements with continuous gradients (unlike Morley's)."""


def is_h2(element: Any) -> bool:
    """Whether second derivatives are square integrable across element edges."""
    return type(element).__name__ in CONFORMING


def require_h2(element: Any) -> None:
    """Raise ValueError for an element that cannot bend."""
    if not is_h2(element):
        name = type(element).__name__
        raise ValueError(f"element = {name}: must be H2, one of {', '.join(CONFORMING)}, to bend")


def check_element(mesh: Any, element: Any) -> None:
    """Raise ValueError if the element does not fit the mesh or its shape functions are unsuitable."""
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


def check_rectangles(mesh: Any, element: Any) -> None:
    """Raise ValueError for cells that are not axis-parallel rectangles if the element is BFS."""
    if type(element).__name__ != "ElementQuadBFS":
        return
    corners = mesh.p[:, mesh.t]
    sides = np.abs(np.roll(corners, -1, axis=1) - corners)
    bad = (sides.min(0) > 1e-9 * sides.max(0)).any(0)
    if bad.any():
        raise ValueError(
            f"mesh: {bad.sum()} of {bad.size} elements are not axis-parallel rectangles, as "
            f"ElementQuadBFS requires, first {bad.argmax()}; for other shapes use triangles"
        )
