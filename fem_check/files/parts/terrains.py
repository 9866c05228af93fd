"""The ground of a scene file that is not flat: eq. 13, a formula, or heights on a grid."""

import math
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.files.bodies import TerrainTable
from fem_check.files.parts.ways import way_of
from fem_check.files.system import System
from fem_check.shell.effects.formula import parsed
from fem_check.shell.effects.height_map import HeightMap
from fem_check.shell.effects.terrain import AROUND, Terrain
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]

EQ_13 = ("amplitude", "wavelength_x", "wavelength_y")
MAP = ("width", "length", "height", "smoothing")
IMAGES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp")
GREY = 1 / math.sqrt(12)
"""Root mean square of the rounding to a grey value, in steps of them."""

WAYS = ("amplitude", "expression", "map", "heights")
"""To say a height."""


def terrain_of(table: TerrainTable, system: System, sheet: Sheet, folder: Path) -> Terrain:
    """The ground. Raises ValueError for keys that do not go together, and as `Terrain` does."""
    way = way_of(table, WAYS)
    own = {"amplitude": EQ_13[1:], "map": MAP, "heights": MAP}.get(way, ())
    for key in (*EQ_13[1:], *MAP):
        if key in table.model_fields_set and key not in own:
            raise ValueError(f"{key}: must be left out beside {way}")
    if way == "amplitude":
        return Terrain(_eq_13(table, system))
    if table.expression is not None:
        try:
            return Terrain(parsed(table.expression))
        except ValueError as problem:
            raise ValueError(f"expression = {table.expression!r}: {problem}") from None
    return Terrain(_map(table, system, sheet, folder))


def _eq_13(table: TerrainTable, system: System) -> Any:
    """A sin(2 pi x/wavelength_x) sin(2 pi y/wavelength_y), as a sympy expression."""
    import sympy

    height = sympy.Float(system.number(table.amplitude))
    for name, symbol in (("wavelength_x", "x"), ("wavelength_y", "y")):
        wavelength = getattr(table, name)
        if wavelength is None:
            raise ValueError(f"{name}: must be given with amplitude")
        height *= sympy.sin(2 * sympy.pi * sympy.Symbol(symbol) / system.number(wavelength))
    return height


def _map(table: TerrainTable, system: System, sheet: Sheet, folder: Path) -> HeightMap:
    """Heights on a grid, from this file or another one."""
    sizes = {name: _size(table, system, name) for name in ("width", "length")}
    for name, size in sizes.items():
        least = getattr(sheet, name) + 2 * AROUND * sheet.length
        if size < least:
            raise ValueError(
                f"{name} = {size:g}: must be >= {least:g}, that of the sheet and {AROUND:g} of its "
                "length to either side"
            )
    if table.map is None:
        heights, step = np.array(_rectangular(table.heights or [])), 0.0
    else:
        heights, step = _heights(folder / table.map, table.map)
    if step and table.height is None:
        raise ValueError("height: must be given for an image, how high white is above black")
    unit = system.number(table.height, 1.0)
    if not system.plain and table.map is not None and table.height is None:
        raise ValueError("height: must be given, what the number 1 stands for, such as '1 mm'")
    smoothing = system.number(table.smoothing, unit * step * GREY)
    return HeightMap(unit * heights, **sizes, smoothing=smoothing)


def _size(table: TerrainTable, system: System, name: str) -> float:
    value = getattr(table, name)
    if value is None:
        raise ValueError(f"{name}: must be given for a map, how far it reaches")
    return system.number(value)


def _rectangular(rows: list[list[float]]) -> list[list[float]]:
    if len({len(row) for row in rows}) != 1:
        raise ValueError("heights: must be rows of one length")
    return rows


def _heights(path: Path, name: str) -> tuple[Array, float]:
    """Heights (rows, columns), and the step between grey values of an image, 0 for numbers."""
    if not path.is_file():
        raise ValueError(f"map = {name!r}: there is no such file")
    try:
        if path.suffix.lower() == ".npy":
            return np.load(path, allow_pickle=False), 0.0
        if path.suffix.lower() == ".csv":
            return np.loadtxt(path, delimiter=",", ndmin=2), 0.0
        if path.suffix.lower() in IMAGES:
            return _grey(path)
    except (OSError, ValueError) as problem:
        raise ValueError(f"map = {name!r}: cannot be read: {problem}") from None
    raise ValueError(f"map = {name!r}: must end in .npy, .csv or {', '.join(IMAGES)}")


def _grey(path: Path) -> tuple[Array, float]:
    """Grey values of an image from 0, black, to 1, white."""
    from PIL import Image

    with Image.open(path) as image:
        deep = image.mode.startswith("I")  # 16 bits
        values = np.asarray(image if deep else image.convert("L"), float)
    most = 65535.0 if deep else 255.0
    return values / most, 1 / most
