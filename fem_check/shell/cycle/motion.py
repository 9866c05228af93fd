"""The motion of a cycle of shapes at Gauss points, in the form read by the friction balance."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from fem_check.mesh.location import quadrilateral_points
from fem_check.shell.cycle.frame import BodyFrame
from fem_check.shell.cycle.shapes import Shapes, time_factors
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.places import ROUNDOFF
from fem_check.shell.kinematics.region import Region
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.friction.contact import Contact
from linear_theory.friction.load import Load
from linear_theory.friction.maps import FrictionMap
from linear_theory.motion.cells import gauss
from linear_theory.motion.motion import Motion
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]


class UnresolvedError(SheetcrawlError, ArithmeticError):
    """Too few shapes: in between, the interpolated sheet is inverted or loses contact."""


def is_mirrored(scene: Scene, mesh: Any, axis: int = 0) -> bool:
    """Whether, by symmetry of mesh and wave, one half of the sheet mirrors the motion of the other.

    mesh: of scikit-fem. axis: 0 for mirror symmetry in x, at every time; 1 for symmetry in y with time
    reversed. Only in the plane, for waves that are known to be mirrored; a sheet in space may buckle to
    one side.
    """
    mirror = np.where(np.arange(2) == axis, -1.0, 1.0)[:, None]
    return (
        scene.planar
        and scene.drive.mirrored
        and all(_same_points(p, mirror * p) for p in (mesh.p, _centres(mesh)))
    )


def depth_of(shapes: Shapes, contact: Contact) -> float:
    """Of the points on which friction acts, below the mid-surface, units of length."""
    return shapes.scene.sheet.thickness / 2 if contact.friction.on_lower_face else 0.0


@dataclass(frozen=True, eq=False)
class CycleMotion:
    """Velocities and loads of shapes on the cells of their mesh.

    load: see `Contact`; order: Gauss points per cell and direction; mirrored: whether the motion is
    mirror symmetric; map: of the coefficient of friction, by which the load is multiplied; depth: of
    the points on which friction acts, below the mid-surface. A rectangle is one cell, a triangle three.
    """

    shapes: Shapes
    load: Load
    order: int
    mirrored: bool
    map: FrictionMap | None = field(default=None, kw_only=True)
    depth: float = field(default=0.0, kw_only=True)

    def at(self, times: Array) -> Motion:
        """Motion at times (T,), with velocities in length per time and the load as `area`.

        position: (2, T, cells, n, n), of the deformed sheet. area: (T, cells, n, n), the normal load,
        which the balance multiplies by 1 + alpha e with e = dilation = 0.
        Positions and velocities are in the frame of the body, see `BodyFrame`.
        Raises UnresolvedError if the load is negative somewhere or zero everywhere.
        """
        times = np.asarray(times, float)
        values, slopes = time_factors(times, self.shapes.scene.period, self._highest)
        position = np.tensordot(values, self._places, 1).swapaxes(0, 1)
        velocity = np.tensordot(slopes, self._plane, 1).swapaxes(0, 1)
        load = self._load(times, values, position)
        _check_load(load, times)
        if self.map is not None:
            x, y = self.region.reference[0, :2]
            load = load * self.map.values(x, y, times[:, None])
        if self.depth:
            normal, turning = self._normal(values, slopes)
            position, velocity = position - self.depth * normal, velocity - self.depth * turning[:2]
        place, velocity = self._frame.seen(times, position[:2], velocity)
        shape = (times.size, -1, self.order, self.order)
        nothing = np.zeros(load.size).reshape(shape)
        return Motion(
            position=place.reshape(2, *shape),
            area=load.reshape(shape),
            velocity=velocity.reshape(2, *shape),
            dilation=nothing,
            growth=nothing,
            mirrored=self.mirrored,
        )

    @cached_property
    def weight(self) -> float:
        """Normal load of the undeformed sheet on these cells, in the unit of the loads."""
        area = self.region.measure.reshape(-1, self.order, self.order)
        weights = gauss(self.order).weights
        unit = self.shapes.model.find(Gravity).weight if self.load is Load.GROUND else 1.0
        return float(unit * (area @ weights @ weights).sum())

    @cached_property
    def region(self) -> Region:
        """The Gauss points; their weights are the Jacobians of the cells, without Gauss weights."""
        sheet = self.shapes.discretisation
        elements = np.arange(sheet.mesh.nelements)
        across = sheet.mesh.p[0, sheet.mesh.t]
        none = ROUNDOFF * np.ptp(across)
        if self.mirrored and not np.any((across.min(0) < -none) & (across.max(0) > none)):
            elements = elements[across.mean(0) > 0]  # no element crosses x = 0: one half suffices
        points, jacobian = cell_points(sheet, self.order)
        mapping = sheet.mesh._mapping()
        density = np.abs(mapping.detDF(points, tind=elements)) * jacobian
        return Region(
            sheet.mesh,
            sheet.element,
            elements,
            mapping.F(points, tind=elements),
            np.array(density),
            sheet.interior.dofs[elements],
            sheet.surface,
            sheet.components,
        )

    @property
    def _highest(self) -> int:
        return len(self.shapes.states) // 2

    @cached_property
    def _jets(self) -> Array:
        """Harmonics of x, x_1, x_2 at the points, (2K + 1, 3, components, points)."""
        entries = (0, 1, 2)
        jets = np.stack([self.region.displacement(u, entries) for u in self.shapes.harmonics])
        jets[0] += self.region.reference[list(entries)]
        return jets

    # Contiguous parts of these: tensordot would copy a slice for every batch of times.

    @cached_property
    def _places(self) -> Array:
        return np.ascontiguousarray(self._jets[:, 0])

    @cached_property
    def _plane(self) -> Array:
        return np.ascontiguousarray(self._jets[:, 0, :2])

    @cached_property
    def _tangents(self) -> Array:
        return np.ascontiguousarray(self._jets[:, 1:])

    def _normal(self, values: Array, slopes: Array) -> tuple[Array, Array]:
        """Unit normal and its rate, (3, T, points), from the factors of the harmonics (T, 2K + 1)."""
        tangents, rates = (np.tensordot(f, self._tangents, 1) for f in (values, slopes))
        (first, second), (first_rate, second_rate) = (
            t.transpose(1, 2, 0, 3) for t in (tangents, rates)
        )
        director = np.cross(first, second, axis=0)
        size = np.linalg.norm(director, axis=0)
        normal = director / size
        turning = np.cross(first_rate, second, axis=0) + np.cross(first, second_rate, axis=0)
        along = (turning * normal).sum(0)
        return normal, (turning - along * normal) / size

    @cached_property
    def _frame(self) -> BodyFrame:
        return BodyFrame.of(self.shapes)

    def _load(self, times: Array, values: Array, position: Array) -> Array:
        """Normal load for unit weight per area, times the Jacobian of the cells, (T, points)."""
        region = self.region
        if self.load is Load.MATERIAL:
            return np.broadcast_to(region.measure, (times.size, region.size))
        if self.load is Load.CURRENT:
            first, second = np.tensordot(values, self._tangents, 1).swapaxes(0, 1)
            return np.asarray(region.weights.ravel() * _area(first, second))
        if self.load is Load.GROWN:
            return self._grown_area(times)
        return self._reaction(times, position)

    def _grown_area(self, times: Array) -> Array:
        model, (x, y) = self.shapes.model, self.region.reference[0, :2]
        growth = np.stack([model.growth(float(t), x, y) for t in times])
        return model.scene.growth.metric(growth) * self.region.measure

    def _reaction(self, times: Array, position: Array) -> Array:
        """Static pressure of the ground times its reference area."""
        ground = self.shapes.model.find(Ground)
        area = self._grown_area(times) if ground.load is Load.GROWN else self.region.measure
        return np.asarray(ground.stiffness * np.minimum(position[2], 0) ** 2 * area)


def _check_load(load: Array, times: Array) -> None:
    wrong = (load.min(axis=1) < 0) | (load.max(axis=1) <= 0)
    if wrong.any():
        raise UnresolvedError(
            f"the interpolated shape bears no load, or a negative one, at {times[wrong]}"
        )


def cell_points(sheet: Discretisation, order: int) -> tuple[Array, Array]:
    """Gauss points of the cells of an element, (2, n) local coordinates, and Jacobians (n,)."""
    if sheet.mesh.refdom.nnodes == 3:
        points, jacobian = quadrilateral_points(order)
        return points.reshape(2, -1), jacobian.ravel()
    nodes = (gauss_legendre(order)[0] + 1) / 2
    return np.stack(np.meshgrid(nodes, nodes, indexing="ij")).reshape(2, -1), np.full(order**2, 0.25)


def _area(first: Array, second: Array) -> Array:
    """|a_1 x a_2| of vectors (T, components, points)."""
    if first.shape[1] == 2:
        return _cross(first.swapaxes(0, 1), second.swapaxes(0, 1))
    return np.asarray(np.linalg.norm(np.cross(first, second, axis=1), axis=1))


def _cross(u: Array, v: Array) -> Array:
    return np.asarray(u[0] * v[1] - u[1] * v[0])


def _centres(mesh: Any) -> Array:
    return np.asarray(mesh.p[:, mesh.t].mean(1))


def _same_points(p: Array, q: Array) -> bool:
    """Whether two sets of points (2, n) are equal up to order and roundoff."""
    return bool(cKDTree(p.T).query(q.T)[0].max() < ROUNDOFF * np.ptp(p))
