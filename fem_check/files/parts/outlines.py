"""The body of a scene file: its box, and the mesh of an outline that is no rectangle."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.files.bodies import HoleTable, OutlineTable
from fem_check.files.parts.ways import way_of
from fem_check.files.system import System
from fem_check.files.tables import SheetTable
from fem_check.mesh.elements import default_cells
from fem_check.mesh.outline import Outline
from linear_theory.common.extras import optional
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]

ROUND, ROUND_HOLE = 96, 12
"""Corners of the polygons that stand for an ellipse, whose area is 0.07 % too small, and for a round
hole, which keeps its area and needs no fine triangles."""

AREA = float(np.sqrt(2 * np.pi / (ROUND_HOLE * np.sin(2 * np.pi / ROUND_HOLE))))
"""By how much the corners of a round hole lie outside of the ellipse that it stands for."""

WAYS = ("shape", "corners", "mesh", "vertices")
"""To say an outline."""

SHAPES = {"trapezoid": ("rear", "front")}
"""Keys of their own of outlines."""

HOLES = {
    "circle": ("diameter",),
    "ellipse": ("length", "width"),
    "rectangle": ("length", "width"),
    "polygon": ("corners",),
}
"""Keys of holes by their shape."""


def sheet_of(table: SheetTable, outline: OutlineTable | None, system: System) -> Sheet:
    """The sheet, or the box around its outline; what is not given is in proportion as in the paper."""
    paper, length = Sheet(), system.number(table.length, 1.0)
    width = paper.width * length
    if outline is not None and outline.rear is not None and outline.front is not None:
        width = max(system.number(outline.rear), system.number(outline.front))
    return Sheet(
        length,
        system.number(table.width, width),
        table.poisson,
        system.number(table.thickness, paper.thickness * length),
    )


def mesh_of(
    table: OutlineTable, system: System, sheet: Sheet, drive: Drive, planar: bool, folder: Path
) -> Any:
    """The scikit-fem mesh of an outline. Raises ValueError for keys that do not go together."""
    way_of(table, WAYS)
    if table.mesh is not None or table.vertices is not None:
        for name in ("holes", "size"):
            if getattr(table, name):
                raise ValueError(f"{name}: must be left out, a mesh has its own")
        return _given_mesh(table, system, folder)
    corners = _corners(table, system, sheet)
    holes = [_hole(hole, i, system, table.unit) for i, hole in enumerate(table.holes)]
    across, along = default_cells(drive, planar)
    size = min(sheet.length / along, sheet.width / across)
    return Outline(corners, holes).mesh(system.number(table.size, size))


def _corners(table: OutlineTable, system: System, sheet: Sheet) -> Any:
    if table.corners is not None:
        return system.factor(table.unit) * np.array(table.corners)
    for shape, keys in SHAPES.items():
        for key in keys:
            if (getattr(table, key) is None) == (table.shape == shape):
                must = "given for" if table.shape == shape else "left out but for"
                raise ValueError(f"{key}: must be {must} shape = {shape!r}")
    if table.shape == "trapezoid":
        rear, front = system.number(table.rear), system.number(table.front)
        return Outline.trapezoid(rear, front, sheet.length).corners
    if table.shape == "ellipse":
        return _ellipse(sheet.width, sheet.length, ROUND)
    return Outline.rectangle(sheet).corners


def _hole(table: HoleTable, number: int, system: System, unit: str | None) -> Array:
    """The polygon of a hole."""
    for key in ("diameter", "length", "width", "corners"):
        if (getattr(table, key) is None) == (key in HOLES[table.shape]):
            must = "given" if key in HOLES[table.shape] else "left out"
            raise ValueError(f"holes[{number}].{key}: must be {must} for shape = {table.shape!r}")
    centre = np.array([system.number(table.x), system.number(table.y)])
    if table.corners is not None:
        return np.asarray(centre + system.factor(unit) * np.array(table.corners))
    if table.shape == "circle":
        diameter = system.number(table.diameter)
        return np.asarray(centre + AREA * _ellipse(diameter, diameter, ROUND_HOLE))
    width, length = system.number(table.width), system.number(table.length)
    if table.shape == "ellipse":
        return np.asarray(centre + AREA * _ellipse(width, length, ROUND_HOLE))
    return np.asarray(centre + Outline.trapezoid(width, width, length).corners)


def _ellipse(width: float, length: float, corners: int) -> Array:
    """A polygon in it whose corners lie on the ellipse, as long and wide as that, (corners, 2)."""
    angle = 2 * np.pi / corners * np.arange(corners)
    return np.stack([width / 2 * np.cos(angle), length / 2 * np.sin(angle)], axis=1)


def _given_mesh(table: OutlineTable, system: System, folder: Path) -> Any:
    """From the file itself, or from another one."""
    factor = system.factor(table.unit)
    if table.mesh is not None:
        points, cells = _from_meshio(folder / table.mesh, table.mesh)
        return _mesh(factor * points, cells)
    if table.elements is None:
        raise ValueError("elements: must be given with vertices")
    if len({len(element) for element in table.elements}) != 1:
        raise ValueError("elements: must be all triangles or all quadrilaterals")
    cells = np.array(table.elements)
    count = len(table.vertices or ())
    if cells.min() < 0 or cells.max() >= count:
        raise ValueError(f"elements: must be numbers of vertices, from 0 to {count - 1}")
    return _mesh(factor * np.array(table.vertices), cells)


def _mesh(points: Array, cells: Any) -> Any:
    """Points (n, 2) and cells (m, 3 or 4), without the points that no cell has."""
    import skfem

    used, numbers = np.unique(cells, return_inverse=True)
    kind = skfem.MeshTri if cells.shape[1] == 3 else skfem.MeshQuad
    vertices = np.ascontiguousarray(points[used].T, dtype=float)
    return kind(vertices, np.ascontiguousarray(numbers.reshape(cells.shape).T))


def _from_meshio(path: Path, name: str) -> tuple[Array, Any]:
    """Points (n, 2) and the cells of the one kind of cells that it has, (m, 3 or 4)."""
    try:
        meshio: Any = optional("meshio", "paraview", f"mesh = {name!r}")
    except ModuleNotFoundError as missing:
        raise ValueError(str(missing)) from None
    if not path.is_file():
        raise ValueError(f"mesh = {name!r}: there is no such file")
    try:
        found = meshio.read(path)
    except (Exception, SystemExit) as problem:  # its readers fail in many ways, one of them by exit
        raise ValueError(f"mesh = {name!r}: meshio cannot read it: {problem}") from None
    kinds = [kind for kind in ("triangle", "quad") if kind in found.cells_dict]
    if len(kinds) != 1:
        has = ", ".join(found.cells_dict) or "none"
        raise ValueError(f"mesh = {name!r}: must have triangles or quadrilaterals alone, has {has}")
    return _flat(np.asarray(found.points, float), name), found.cells_dict[kinds[0]]


def _flat(points: Array, name: str) -> Array:
    """The first two coordinates of points in the plane z = 0."""
    if points.shape[1] == 3 and np.any(points[:, 2] != 0):
        raise ValueError(f"mesh = {name!r}: must lie in the plane z = 0")
    return points[:, :2]
