"""The elements of a scene: cells, mesh and element type, given or chosen for its wave."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import skfem
from numpy.typing import NDArray

from fem_check.mesh.checks import check_fits, check_mesh
from fem_check.mesh.shown import NAMES, MeshShown
from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Drive

PLANAR_CELLS, SHELL_CELLS = 2, 6
"""Default number of elements across the width, of degree 5 in the plane and BFS in space; along the
sheet they are about square, with at least twice as many per wavelength. With 2 x 4 elements the
distances between points of the 2 : 1 sheet at alpha = 0.25 have an error of 7e-5 of the length."""

PLANAR_DEGREE = 5

MOST_ALONG, MOST_ALONG_SHELL = 24, 256
"""Default limit of elements per wavelength, in the plane and in space: in narrow strips they are longer
than wide, like the growth field; twice as many change V of strips of 0.02 and 0.005 L by 1e-7
alpha^2."""

MOST_ACROSS = 64
"""Default limit of elements across, in the plane."""

MOST_CELLS = 100_000
"""Elements of a sheet, whose matrix factor must fit in memory."""

CALL = re.compile(r"(Element\w+)\((\d{0,2})\)")
"""Form of an element in plain data."""


@dataclass(frozen=True, eq=False)
class Elements(Value):
    """cells, mesh and element as in `Scene`, None where not specified."""

    cells: tuple[int, int] | None = None
    mesh: Any = None
    element: Any = None

    def on(self, sheet: Sheet) -> "Elements":
        """These elements, checked for a sheet, with cells as two integers. Raises ValueError."""
        if self.mesh is not None:
            hint = "use outline.mesh(size) for an Outline"
            check_mesh(validation.instance("mesh", self.mesh, skfem.Mesh, hint))
            check_fits(self.mesh, sheet)
        if self.element is not None:
            validation.instance("element", self.element, skfem.Element)
        if self.cells is None:
            return self
        if self.mesh is not None:
            shown = validation.shown(self.cells)
            raise ValueError(f"cells = {shown}: must be None if a mesh is given")
        return Elements(_two_integers(self.cells), None, self.element)

    def identified_by(self) -> object:
        """The content for its key: the call of the element, whose object caches tables."""
        mesh = self.mesh
        kind = None if mesh is None else (type(mesh).__name__, mesh.doflocs, mesh.t)
        return self.cells, kind, _call(self.element)

    def contents(self) -> Mapping[str, Any]:
        """cells, mesh and element as plain data, see `from_data`."""
        mesh = None if self.mesh is None else MeshShown(self.mesh)
        return {"cells": self.cells, "mesh": mesh, "element": _call(self.element)}

    def _contents(self) -> Mapping[str, Any]:
        return self.contents()

    def _rows(self) -> Mapping[str, Any]:
        return {name: value for name, value in self.contents().items() if value is not None}


def from_data(data: Mapping[str, Any]) -> dict[str, Any]:
    """cells, mesh and element of a scene, if present, from the data written by `Scene.to_dict`.

    Raises ValueError for invalid data of a mesh or an element.
    """
    cells, mesh, element = (data.get(name) for name in ("cells", "mesh", "element"))
    found = {} if cells is None else {"cells": cells}
    if mesh is not None:
        found["mesh"] = _mesh(mesh)
    if element is not None:
        found["element"] = _element(element)
    return found


def _mesh(data: Any) -> Any:
    """The mesh of vertices (n, 2) and elements (m, 3 or 4), indices of vertices."""
    named = isinstance(data, Mapping) and data.get("type") == MeshShown.__name__
    if not named or sorted(data) != ["elements", "type", "vertices"]:
        raise ValueError(
            f"mesh = {validation.shown(data)}: must have vertices, elements and the type "
            f"{MeshShown.__name__!r}, and no other keys"
        )
    vertices = _table("mesh.vertices", data["vertices"], (2,))
    elements = _table("mesh.elements", data["elements"], tuple(NAMES))
    wrong = (elements != np.floor(elements)) | (elements < 0) | (elements >= len(vertices))
    if wrong.any():
        raise ValueError(
            f"mesh.elements contains {elements[wrong][0]:g}: must be indices of the {len(vertices)} "
            f"vertices, 0 to {len(vertices) - 1}"
        )
    kind = skfem.MeshTri if elements.shape[1] == 3 else skfem.MeshQuad
    parts = vertices.T, elements.T.astype(int)
    return kind(*map(np.ascontiguousarray, parts))


def _table(name: str, value: Any, columns: tuple[int, ...]) -> NDArray[np.float64]:
    """Numbers in rows of one of these lengths."""
    table = validation.real_array(name, value)
    if table.ndim != 2 or not len(table) or table.shape[1] not in columns:
        wanted = " or ".join(map(str, columns))
        raise ValueError(f"{name} has shape {table.shape}: must be rows of {wanted} numbers")
    return table


def _element(call: Any) -> Any:
    """The element of scikit-fem that is constructed by this call."""
    parts = CALL.fullmatch(call) if isinstance(call, str) else None
    kind = getattr(skfem, parts[1], None) if parts else None
    refused = f"element = {validation.shown(call)}: must be a scikit-fem element with (), as text"
    if parts is None or not isinstance(kind, type) or not issubclass(kind, skfem.Element):
        raise ValueError(refused)
    try:
        return kind(*map(int, filter(None, [parts[2]])))
    except (TypeError, ValueError) as error:
        raise ValueError(f"{refused} ({error})") from None


def default_cells(drive: Drive, planar: bool) -> tuple[int, int]:
    """Elements across and along: about square, and several per wavelength, up to a limit each.

    Raises ValueError for too many elements.
    """
    least = PLANAR_CELLS if planar else SHELL_CELLS
    sheet, waves = drive.sheet, drive.waves_along
    limit = MOST_ALONG if planar else MOST_ALONG_SHELL
    square = min(least * sheet.length / sheet.width, limit * waves)
    # In a wide sheet the sides feel their edges as far as a length inwards.
    across = min(least * sheet.width / sheet.length, MOST_ACROSS) if planar else least
    return _two_integers((max(round(across), least), max(round(square), 2 * least * waves)))


def grid(sheet: Sheet, cells: tuple[int, int]) -> Any:
    """A skfem.MeshQuad of equal rectangles, `cells` across and along."""
    lines = [
        np.linspace(-size / 2, size / 2, count + 1)
        for size, count in zip((sheet.width, sheet.length), cells, strict=True)
    ]
    return skfem.MeshQuad.init_tensor(*lines)


def default_element(mesh: Any, planar: bool) -> Any:
    """In the plane elements of degree 4 or 5, in space BFS on rectangles and Argyris on triangles."""
    quadrilaterals = mesh.t.shape[0] == 4
    if planar:
        return skfem.ElementQuadP(PLANAR_DEGREE) if quadrilaterals else skfem.ElementTriP4()
    return skfem.ElementQuadBFS() if quadrilaterals else skfem.ElementTriArgyris()


def _call(element: Any) -> str | None:
    """The constructor call of a scikit-fem element, as text."""
    if element is None:
        return None
    degree = getattr(element, "p", "") if isinstance(element, skfem.ElementQuadP) else ""
    return f"{type(element).__name__}({degree})"


def _two_integers(cells: Any) -> tuple[int, int]:
    """Elements across and along, from any sequence of two integers."""
    if (
        not isinstance(cells, Sequence | np.ndarray)
        or np.shape(cells) != (2,)
        or isinstance(cells, str)
    ):
        shown = validation.shown(cells)
        raise ValueError(f"cells = {shown}: must be two integers, across and along")
    across, along = (validation.integer("cells", count, 1) for count in cells)
    if across * along > MOST_CELLS:
        raise ValueError(
            f"cells = {across, along}: makes {across * along} elements, must be <= {MOST_CELLS}"
        )
    return across, along
