"""The elements of a scene: how many, of which mesh and kind, given or as its wave needs them."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import skfem

from fem_check.mesh.checks import check_fits, check_mesh
from fem_check.mesh.shown import MeshShown
from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Drive

PLANAR_CELLS, SHELL_CELLS = 2, 6
"""Elements across the width by default, of degree 5 in the plane and of BFS in space; along the
sheet as many as make them about square, and at least twice as many to a wavelength. With 2 x 4 the
distances between points of the 2 : 1 sheet at alpha = 0.25 are right to 7e-5 of the length."""

PLANAR_DEGREE = 5

LONGEST, MOST_CELLS = 256, 100_000
"""Elements to a wavelength by default, at most: in a strip narrower than a hundredth of the wave they
are longer than wide, as growth is. And elements of a sheet, whose factor then fits in memory."""

CALL = re.compile(r"(Element\w+)\((\d*)\)")
"""An element as its data says it."""


@dataclass(frozen=True, eq=False)
class Elements(Value):
    """What a scene says of its elements: cells, mesh and element as in `Scene`; None where nothing."""

    cells: tuple[int, int] | None = None
    mesh: Any = None
    element: Any = None

    def on(self, sheet: Sheet) -> "Elements":
        """Checked, with cells as two plain integers. Raises ValueError for what a sheet cannot have."""
        if self.mesh is not None:
            hint = "outline.mesh(size) makes one of an Outline"
            check_mesh(validation.instance("mesh", self.mesh, skfem.Mesh, hint))
            check_fits(self.mesh, sheet)
        if self.element is not None:
            validation.instance("element", self.element, skfem.Element)
        if self.cells is None:
            return self
        if self.mesh is not None:
            shown = validation.shown(self.cells)
            raise ValueError(f"cells = {shown}: must be None where a mesh is given")
        return Elements(_two_integers(self.cells), None, self.element)

    def identified_by(self) -> object:
        """What its content key is made of; an element fills up with tables, its call does not."""
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
    """cells, mesh and element of a scene, those that are there, as `Scene.to_dict` writes them.

    Raises ValueError for what is no mesh and no element.
    """
    cells, mesh, element = (data.get(name) for name in ("cells", "mesh", "element"))
    found = {} if cells is None else {"cells": tuple(cells)}
    if mesh is not None:
        vertices, elements = np.array(mesh["vertices"], float).T, np.array(mesh["elements"]).T
        kind = skfem.MeshTri if len(elements) == 3 else skfem.MeshQuad
        found["mesh"] = kind(np.ascontiguousarray(vertices), np.ascontiguousarray(elements))
    if element is not None:
        called = CALL.fullmatch(str(element))
        if called is None or not hasattr(skfem, called[1]):
            raise ValueError(f"element = {element!r}: must be the name of one of scikit-fem, with ()")
        found["element"] = getattr(skfem, called[1])(*map(int, filter(None, [called[2]])))
    return found


def default_cells(drive: Drive, planar: bool) -> tuple[int, int]:
    """Elements across and along: about square, and several to a wavelength, up to LONGEST each.

    Raises ValueError where that would be too many elements.
    """
    across = PLANAR_CELLS if planar else SHELL_CELLS
    sheet, waves = drive.sheet, drive.waves_along
    square = min(across * sheet.length / sheet.width, LONGEST * waves)
    return _two_integers((across, max(round(square), 2 * across * waves)))


def grid(sheet: Sheet, cells: tuple[int, int]) -> Any:
    """A skfem.MeshQuad of equal rectangles, so many across and along."""
    lines = [
        np.linspace(-size / 2, size / 2, count + 1)
        for size, count in zip((sheet.width, sheet.length), cells, strict=True)
    ]
    return skfem.MeshQuad.init_tensor(*lines)


def default_element(mesh: Any, planar: bool) -> Any:
    """Degree 4 or 5 in the plane, in space BFS on rectangles and Argyris on triangles."""
    quadrilaterals = mesh.t.shape[0] == 4
    if planar:
        return skfem.ElementQuadP(PLANAR_DEGREE) if quadrilaterals else skfem.ElementTriP4()
    return skfem.ElementQuadBFS() if quadrilaterals else skfem.ElementTriArgyris()


def _call(element: Any) -> str | None:
    """How an element of scikit-fem is made."""
    if element is None:
        return None
    degree = getattr(element, "p", "") if isinstance(element, skfem.ElementQuadP) else ""
    return f"{type(element).__name__}({degree})"


def _two_integers(cells: Any) -> tuple[int, int]:
    """Elements across and along, from any sequence of two."""
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
            f"cells = {across, along}: {across * along} elements are too many to be solved, must be "
            f"<= {MOST_CELLS}"
        )
    return across, along
