"""The outline of a sheet: a polygon with holes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import ArrayLike, NDArray
from skfem import MeshTri

from fem_check.mesh import meshing
from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]

MOST_TRIANGLES = 1_000_000

TRIANGLES_PER_SIDE = 40
"""Bound of the number of triangles per boundary side in the transition to larger triangles inside;
measured for 1700 random outlines: 22."""

NARROWEST = 2e-4
"""Smallest distance of corners to each other and to other sides that can be meshed, relative to the
extent of the outline. Below 1e-4 Netgen sometimes did not terminate or found no mesh; a part so narrow
is no thin sheet anyway, as the thickness is about 1e-2."""

SAME = 1e-12
"""Distance below which two corners coincide, relative to the extent of the outline."""

SMALLEST, LARGEST = 1e-70, 1e70
"""Extents of an outline or a hole whose fourth powers, second moments of area, are floats."""


@dataclass(frozen=True, eq=False)
class Outline(Shown):
    """A polygon with polygonal holes, in the coordinates of the sheet.

    corners: (n, 2), n >= 3, in units of length, clockwise or anticlockwise; holes: such arrays, within
    the outline and disjoint. A corner equal to the next one (the last may repeat the first) is dropped.
    A wave on it has its origin at y = 0 and the extent of the outline along y as its length: centre the
    outline on the origin to compare it with a `Sheet`.

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
        if not isinstance(holes, Sequence | np.ndarray):
            raise ValueError(f"holes = {validation.shown(holes)}: must be a list of arrays (n, 2)")
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

    @classmethod
    def from_data(cls, corners: Any, holes: Any = (), **_: Any) -> "Outline":
        """The outline of what `to_dict` has written; its size follows from the corners."""
        return cls(corners, holes)

    def _title(self) -> str:
        return f"Outline: {len(self.corners)} corners, {len(self.holes)} holes"

    def _rows(self) -> Mapping[str, Any]:
        return {name: v for name, v in self._contents().items() if name != "holes" or self.holes}

    def _contents(self) -> Mapping[str, Any]:
        size = {"length": self.length, "width": self.width, "area": self.area}
        return {**size, "corners": self.corners, "holes": self.holes}

    @property
    def loops(self) -> tuple[Array, ...]:
        """Outline and holes, all anticlockwise."""
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
        """Area without the holes."""
        return _area(self.corners) - sum(map(_area, self.holes))

    @property
    def largest_angle(self) -> float:
        """Largest interior angle of the material, radians; it determines the corner singularities."""
        turns = [_turns(self.corners), *(-_turns(hole) for hole in self.holes)]
        return float(np.pi - min(turn.min() for turn in turns))

    def mesh(self, size: float) -> MeshTri:
        """Mesh of triangles of about `size`, smaller near short sides; exact in outline and area.

        Raises ValueError for a size that is not positive or so small that there could be more than
        MOST_TRIANGLES, and for outlines that are too narrow somewhere to be meshed.
        """
        size = validation.positive("size", size)
        self._check_count(size)
        if self._is_gridded:
            return meshing.quadrilateral_mesh(self.corners, size)
        self._check_narrow()
        return meshing.polygon_mesh([self.corners, *(hole[::-1] for hole in self.holes)], size)

    @property
    def _is_gridded(self) -> bool:
        """Whether the outline is a convex quadrilateral, which gets a grid of cells."""
        return len(self.corners) == 4 and not self.holes and self.largest_angle <= np.pi

    def _check_count(self, size: float) -> None:
        """Raise ValueError if a/size^2 + b/size + c, the bound of the triangle count, is too large."""
        a, b, c = self._count()
        if c >= MOST_TRIANGLES:
            most = MOST_TRIANGLES // TRIANGLES_PER_SIDE
            raise ValueError(f"corners, holes: must have fewer than {most} corners to be meshed")
        half = b / 2 / (MOST_TRIANGLES - c)
        smallest = half + float(np.sqrt(half**2 + a / (MOST_TRIANGLES - c)))
        if size < smallest:
            raise ValueError(f"size = {size:g}: must be >= {smallest:g} for this outline")

    def _count(self) -> tuple[float, float, int]:
        """a, b, c of the bound a/size^2 + b/size + c of the number of triangles."""
        sides = np.concatenate([_sides(loop) for loop in self.loops])
        if self._is_gridded:  # 4 (first/size + 1) (second/size + 1)
            first, second = np.maximum(sides[:2], sides[2:]).tolist()
            return 4 * first * second, 4 * (first + second), 4
        return 4 * self.area, TRIANGLES_PER_SIDE * float(sides.sum()), TRIANGLES_PER_SIDE * sides.size

    def _check_narrow(self) -> None:
        """Raise ValueError if corners are too close to each other or to other sides."""
        polygon = shapely.Polygon(*_local(self.loops))
        clearance = float(shapely.minimum_clearance(polygon))
        least = NARROWEST * max(self.length, self.width)
        if clearance < least:
            x, y = self.corners[0] + shapely.minimum_clearance_line(polygon).coords[0]
            raise ValueError(
                f"corners, holes: {clearance:.3g} apart at x = {x:.6g}, y = {y:.6g}; must be >= "
                f"{least:.3g} ({NARROWEST:g} of the extent) to be meshed: merge close corners, blunt "
                "sharp ones and fill narrow gaps"
            )


def _local(loops: Sequence[Array]) -> tuple[Array, list[Array]]:
    """Outline and holes relative to the first corner, to avoid cancellation far from the origin."""
    outline, *holes = (loop - loops[0][0] for loop in loops)
    return outline, holes


def _area(loop: Array) -> float:
    return float(shapely.Polygon(loop - loop[0]).area)


def _sides(loop: Array) -> Array:
    """Lengths of the sides, from each corner to the next."""
    return np.asarray(np.linalg.norm(np.roll(loop, -1, axis=0) - loop, axis=1))


def _turns(loop: Array) -> Array:
    """Change of direction from each side to the next, radians, positive to the left."""
    side = np.roll(loop, -1, axis=0) - loop
    after = np.roll(side, -1, axis=0)
    cross = side[:, 0] * after[:, 1] - side[:, 1] * after[:, 0]
    return np.asarray(np.arctan2(cross, np.sum(side * after, axis=1)))


def _loop(name: str, corners: ArrayLike) -> Array:
    """The polygon without repeated corners, checked and oriented anticlockwise."""
    loop = validation.real_array(name, corners)
    if loop.ndim != 2 or loop.shape[1] != 2 or len(loop) < 3:
        raise ValueError(f"{name} has shape {loop.shape}: must be (n, 2) with n >= 3")
    with np.errstate(over="ignore"):
        extent = float(np.ptp(loop, axis=0).max())
    if extent and not SMALLEST <= extent <= LARGEST:
        raise ValueError(
            f"{name} has the extent {extent:g}: must be {SMALLEST:g} to {LARGEST:g}, so that areas and "
            "moments are numbers; take another unit of length"
        )
    roundoff = SAME * extent + 4 * np.finfo(float).eps * float(np.abs(loop).max())
    while len(loop) and (same := _sides(loop) <= roundoff).any():
        loop = loop[~same]
    area = _area(loop) if len(loop) >= 3 else 0.0
    if area <= extent * roundoff:
        raise ValueError(f"{name} encloses the area {area:g}: must be > 0")
    anticlockwise = shapely.LinearRing(loop - loop[0]).is_ccw
    loop = np.array(loop if anticlockwise else loop[::-1])
    loop.setflags(write=False)
    return loop


def _check_apart(loops: Sequence[Array]) -> None:
    """Raise ValueError if sides cross or touch, or a hole is not within the outline only."""
    origin, (outline, holes) = loops[0][0], _local(loops)
    rings = [shapely.LinearRing(loop) for loop in (outline, *holes)]
    for i, ring in enumerate(rings):
        name = f"holes[{i - 1}]" if i else "corners"
        if not ring.is_simple:
            place = _self_crossing(ring) + origin
            raise ValueError(f"{name}: sides {_shown(place)} cross or touch, must not meet")
        for j, other in enumerate(rings[:i]):
            if ring.intersects(other):
                place = np.array(ring.intersection(other).point_on_surface().coords[0]) + origin
                names = f"{name} and {f'holes[{j - 1}]' if j else 'corners'}"
                raise ValueError(f"{names}: sides {_shown(place)} cross or touch, must not meet")
    polygons = [shapely.Polygon(ring) for ring in rings]
    for i, hole in enumerate(polygons[1:]):
        others = polygons[1 : i + 1] + polygons[i + 2 :]
        if not polygons[0].contains(hole) or any(other.contains(hole) for other in others):
            raise ValueError(f"holes[{i}]: must lie within corners and outside the other holes")


def _shown(place: Array) -> str:
    return "at x = {:.6g}, y = {:.6g}".format(*place)


def _self_crossing(ring: shapely.LinearRing) -> Array:
    """A point where a ring intersects itself."""
    ends = np.array(ring.coords)
    sides = shapely.linestrings(np.stack([ends[:-1], ends[1:]], axis=1))
    first, second = shapely.STRtree(sides).query(sides, predicate="intersects")
    apart = abs(first - second)
    met = shapely.intersection(sides[first], sides[second])
    # neighbours share a corner, or one folds back on the other
    turned = (shapely.length(met) > 0) & (apart > 0)
    wrong = met[turned | ((apart > 1) & (apart < len(sides) - 1))]
    return np.array(shapely.point_on_surface(wrong[0]).coords[0])
