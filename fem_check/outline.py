"""The outline of a sheet that need not be a rectangle."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from skfem import MeshTri

from fem_check import meshing, polygons
from linear_theory import validation
from linear_theory.sheet import Sheet

Array = NDArray[np.float64]

MOST_TRIANGLES = 1_000_000


@dataclass(frozen=True, eq=False)
class Outline:
    """A polygon with polygonal holes, in the coordinates of the sheet.

    corners: (n, 2), n >= 3, in units of length, either way round; holes: such arrays, within the
    outline and apart from each other. A wave on it has its origin at y = 0 and as its length the
    extent of the outline along y: centre the outline on the origin to compare it with a `Sheet`.

    Raises ValueError for corners that are not finite, not (n, 2), enclose no area, or cross.

    >>> from fem_check import Outline
    >>> arrow = Outline([[-0.25, -0.5], [0.25, -0.5], [0.25, 0.0], [0.0, 0.5], [-0.25, 0.0]])
    >>> print(f"{arrow.length} L long, {arrow.width} L wide, area {arrow.area} L^2")
    1.0 L long, 0.5 L wide, area 0.375 L^2
    """

    corners: Array
    holes: tuple[Array, ...] = ()

    def __init__(self, corners: ArrayLike, holes: Sequence[ArrayLike] = ()) -> None:
        object.__setattr__(self, "corners", _loop("corners", corners))
        checked = tuple(_loop(f"holes[{i}]", hole) for i, hole in enumerate(holes))
        object.__setattr__(self, "holes", checked)
        _check_apart(self.loops)

    @classmethod
    def rectangle(cls, sheet: Sheet) -> "Outline":
        """The outline of a rectangular sheet."""
        return cls.trapezoid(sheet.width, sheet.width, sheet.length)

    @classmethod
    def trapezoid(cls, rear: float, front: float, length: float) -> "Outline":
        """Mirror symmetric in x, `rear` wide at y = -length/2 and `front` wide at y = length/2."""
        names = ("rear", "front", "length")
        a, b, c = (
            validation.positive(n, v) / 2 for n, v in zip(names, (rear, front, length), strict=True)
        )
        return cls([[-a, -c], [a, -c], [b, c], [-b, c]])

    @property
    def loops(self) -> tuple[Array, ...]:
        """Outline and holes."""
        return (self.corners, *self.holes)

    @property
    def length(self) -> float:
        """Extent along y."""
        return float(np.ptp(self.corners[:, 1]))

    @property
    def width(self) -> float:
        """Extent along x."""
        return float(np.ptp(self.corners[:, 0]))

    @property
    def area(self) -> float:
        """Without the holes."""
        return polygons.signed_area(self.corners) - sum(map(polygons.signed_area, self.holes))

    @property
    def largest_angle(self) -> float:
        """Of the material at any corner, radians; the larger, the more singular are the strains."""
        turns = [polygons.turns(self.corners), *(-polygons.turns(hole) for hole in self.holes)]
        return float(np.pi - min(turn.min() for turn in turns))

    def mesh(self, size: float) -> MeshTri:
        """Triangles with sides of about `size`; exact in outline and area.

        Raises ValueError for a size that is not positive, too large to follow the outline or so small
        that there would be more than MOST_TRIANGLES.
        """
        size = validation.positive("size", size)
        smallest = float(np.sqrt(4 * self.area / MOST_TRIANGLES))  # four triangles in a square cell
        if size < smallest:
            raise ValueError(f"size = {size:g}: must be >= {smallest:g} for this outline")
        if len(self.corners) == 4 and self.largest_angle <= np.pi and not self.holes:
            return meshing.quadrilateral_mesh(self.corners, size)
        return meshing.polygon_mesh(self.loops, size)


def _loop(name: str, corners: ArrayLike) -> Array:
    """The polygon, checked and turned anticlockwise."""
    loop = validation.real_array(name, corners)
    if loop.ndim != 2 or loop.shape[1] != 2 or len(loop) < 3:
        raise ValueError(f"{name} has shape {loop.shape}: must be (n, 2) with n >= 3")
    if np.any(np.all(loop == np.roll(loop, -1, axis=0), axis=1)):
        raise ValueError(f"{name} repeats a corner: neighbours must differ")
    area = polygons.signed_area(loop)
    if abs(area) <= 1e-12 * np.ptp(loop, axis=0).max() ** 2:
        raise ValueError(f"{name} encloses the area {abs(area):g}: must be > 0")
    loop = np.array(loop if area > 0 else loop[::-1])
    loop.setflags(write=False)
    return loop


def _check_apart(loops: Sequence[Array]) -> None:
    """Raise ValueError unless no sides cross and every hole lies within the outline alone."""
    crossing = polygons.first_crossing(loops)
    if crossing is not None:
        raise ValueError(f"corners, holes: sides {crossing} cross, must not meet")
    for i, hole in enumerate(loops[1:]):
        others = [loop for loop in loops[1:] if loop is not hole]
        if not polygons.inside(loops[:1], hole[:1])[0] or any(
            polygons.inside([other], hole[:1])[0] for other in others
        ):
            raise ValueError(f"holes[{i}]: must lie within corners and outside the other holes")
