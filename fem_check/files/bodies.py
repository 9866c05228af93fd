"""Tables of shapes: the outline of the sheet with its holes, and the height of the ground."""

from typing import Annotated, Literal

from pydantic import Field

from fem_check.files.fields import Corners, Length, Size, Table, UnitName

Triple = Annotated[list[int], Field(min_length=3, max_length=4)]


class HoleTable(Table):
    """A hole in the sheet: a circle, an ellipse, a rectangle, or a polygon."""

    shape: Literal["circle", "ellipse", "rectangle", "polygon"] = "circle"
    """What it is."""
    x: Length | None = None
    """Place of its centre across, from the middle of the sheet."""
    y: Length | None = None
    """Place of its centre along."""
    diameter: Size | None = None
    """Of a circle."""
    length: Size | None = None
    """Of an ellipse or a rectangle, along y."""
    width: Size | None = None
    """Of an ellipse or a rectangle, along x."""
    corners: Corners | None = None
    """Of a polygon, [[x, y], ...], in `unit` of the outline, from the middle of the sheet."""


class OutlineTable(Table):
    """The outline of a sheet that is no rectangle, in the coordinates of the sheet.

    One of shape, corners, mesh, and vertices with elements.
    """

    shape: Literal["rectangle", "trapezoid", "ellipse"] | None = None
    """As long and wide as the sheet; a trapezoid is `rear` wide behind and `front` wide in front."""
    rear: Size | None = None
    """Of a trapezoid, width at y = -length/2."""
    front: Size | None = None
    """Of a trapezoid, width at y = length/2."""
    corners: Corners | None = None
    """Of any polygon, [[x, y], ...], in `unit`."""
    mesh: str | None = None
    """A file with triangles or quadrilaterals, any that meshio reads, from the folder of the scene."""
    vertices: list[Annotated[list[float], Field(min_length=2, max_length=2)]] | None = None
    """Of a mesh, [[x, y], ...], in `unit`."""
    elements: list[Triple] | None = None
    """Of a mesh: the numbers of the vertices of each triangle or quadrilateral, from 0."""
    unit: UnitName | None = None
    """Unit of corners, vertices and the mesh in a file, e.g. "mm"; none beside plain numbers."""
    holes: list[HoleTable] = Field(default_factory=list)
    """Each with its shape and place."""
    size: Size | None = None
    """Of the triangles; chosen for the wave unless given."""


class TerrainTable(Table):
    """Height of the ground from the middle of the sheet on: eq. 13, expression, map or heights."""

    amplitude: Length | None = None
    """A of eq. 13, z = A sin(2 pi x/wavelength_x) sin(2 pi y/wavelength_y)."""
    wavelength_x: Size | None = None
    """Of eq. 13, across."""
    wavelength_y: Size | None = None
    """Of eq. 13, along."""
    expression: str | None = None
    """Height by x and y, e.g. "0.5*cos(2*pi*y/10)", all in the file's unit of length."""
    map: str | None = None
    """A file with heights on a grid, .npy, .csv or an image: its rows lie along y, the first at +y."""
    heights: list[list[float]] | None = None
    """The same in the file itself, in its unit of length."""
    width: Size | None = None
    """Of a map, along x, between its outer columns."""
    length: Size | None = None
    """Of a map, along y, between its outer rows."""
    height: Size | None = None
    """Of an image: how high white is above black; of an array, what the number 1 stands for."""
    smoothing: Length | None = None
    """Of a map: how far the ground may pass from its heights, root mean square. Unless given, nothing
    for numbers, and the rounding to grey values for an image."""
