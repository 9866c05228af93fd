"""Supports: clamped, pinned and symmetric edges, and the anchor of a free sheet."""

from collections.abc import Collection

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.kinematics.discretisation import Discretisation, Where
from fem_check.shell.kinematics.shape_functions import is_global
from linear_theory.common.validation import shown

Array = NDArray[np.float64]

_ALL = (0, 1, 2)

NEAR = 0.25
"""Smallest lever arm of a vertex against rotation, relative to the largest distance from the anchor."""


class Supports:
    """The set of fixed unknowns, initially empty; each method adds to it and returns the object.

    Fixed unknowns keep their value at the start of a minimisation (0 in the undeformed state). Edges
    are selected by a function of their midpoints in the parameter domain and must lie along its axes,
    because the degrees of freedom there are values and derivatives along the axes.
    """

    def __init__(self, discretisation: Discretisation) -> None:
        self.discretisation = discretisation
        self.held = np.zeros((discretisation.scalars, discretisation.components), bool)

    @property
    def free(self) -> NDArray[np.bool_]:
        """Which unknowns may move, (size,)."""
        return ~self.held.ravel()

    def pin(self, where: Where, components: Collection[int] = _ALL) -> "Supports":
        """Fix the displacement of an edge, in the given components."""
        return self._hold(where, components, across=False)

    def hold_slope(self, where: Where, components: Collection[int] = _ALL) -> "Supports":
        """Fix the derivative of the displacement across an edge, in the given components."""
        if not is_global(self.discretisation.element):
            name = type(self.discretisation.element).__name__
            raise ValueError(f"element = {name}: must be BFS or Argyris to fix a slope")
        return self._hold(where, components, across=True)

    def clamp(self, where: Where) -> "Supports":
        """Fix an edge and prevent rotation of the sheet about it.

        The slope across the edge is fixed only along the normal of the undeformed surface: near a
        clamp the sheet may still be stretched and sheared, for instance by growth. (If the normal is
        oblique to the axes, all components in which it does not vanish are fixed.)
        """
        self.pin(where, range(self.discretisation.components))
        turning = self._along_normal(where)
        return self.hold_slope(where, turning) if turning else self

    def _along_normal(self, where: Where) -> tuple[int, ...]:
        """Non-zero components of the surface normal on an edge; none in the plane."""
        if self.discretisation.components == 2:
            return ()
        mesh = self.discretisation.mesh
        vertices = mesh.p[:, np.unique(mesh.facets[:, self.discretisation.facets(where)])]
        _, first, second, *_ = self.discretisation.surface(*vertices)
        size = np.abs(np.cross(first, second, axis=0)).max(axis=1)
        return tuple(int(c) for c in np.flatnonzero(size > 1e-9 * size.max()))

    def symmetric(self, where: Where, component: int) -> "Supports":
        """Keep an edge in a plane of mirror symmetry with the axis `component` as its normal."""
        others = [c for c in range(self.discretisation.components) if c != component]
        return self.pin(where, (component,)).hold_slope(where, others)

    def anchor(self, xi: ArrayLike = (0.0, 0.0), motions: str = "xyz") -> "Supports":
        """Remove the rigid motions of a free sheet without straining it, at the vertex nearest to xi.

        motions: "xyz" for all; "xy" for those in the plane z = const, for a sheet on the ground or a
        planar scene. The support is statically determinate, so that it carries no force: the vertex is
        fixed and, against rotation, a slope there (BFS, Argyris) or one component of another vertex.
        Raises ValueError if slopes are fixed and the parameter lines do not run along x and y there
        (along x suffices for "xy").
        """
        if motions not in ("xy", "xyz"):
            raise ValueError(f"motions = {shown(motions)}: must be 'xy' or 'xyz'")
        dofs = self.discretisation.dofs_at(xi)
        self.held[dofs["u"], : len(motions) if self.discretisation.components == 3 else 2] = True
        if "u_x" not in dofs:
            self.held[self._lever(xi)] = True
            return self
        self._check_frame(xi, motions)
        self.held[dofs["u_x"], 1] = True
        if motions == "xyz" and self.discretisation.components == 3:
            self.held[dofs["u_x"], 2] = self.held[dofs["u_y"], 2] = True
        return self

    def _check_frame(self, xi: ArrayLike, motions: str) -> None:
        mesh = self.discretisation.mesh
        place = mesh.p[:, np.abs(mesh.p - np.reshape(xi, (2, 1))).sum(0).argmin()]
        _, first, second, *_ = self.discretisation.surface(place[:1], place[1:])[:, :, 0]
        off = abs(first[1]) + (abs(first[2]) + abs(second[2]) if motions == "xyz" else 0.0)
        if off > 1e-9 * np.abs([first, second]).max():
            raise ValueError(
                f"xi = {place}: parameter lines of the surface must run along x (and y) there"
            )

    def _lever(self, xi: ArrayLike) -> tuple[NDArray[np.int64], int]:
        """Degree of freedom of a vertex far from the anchor, and the component that stops rotation.

        The farthest vertex on the line along x, which preserves mirror symmetry, unless it is too near;
        else the farthest of all, and the component across the longer of its distances.
        """
        mesh = self.discretisation.mesh
        position = self.discretisation.surface(*mesh.p)[0]
        origin = position[:, np.abs(mesh.p - np.reshape(xi, (2, 1))).sum(0).argmin()]
        away = np.abs(position - origin[:, None])[:2]
        distance = np.hypot(*away)
        beside = np.where(away[1] < 1e-9 * distance.max(), away[0], 0.0)
        far = int((beside if beside.max() > NEAR * distance.max() else distance).argmax())
        across = 1 if away[0, far] >= away[1, far] else 0
        return self.discretisation.dofs_at(mesh.p[:, far])["u"], across

    def _hold(self, where: Where, components: Collection[int], across: bool) -> "Supports":
        wrong = [c for c in components if c not in range(self.discretisation.components)]
        if wrong:
            raise ValueError(
                f"components = {shown(components)}: must be in 0 ... {self.held.shape[1] - 1}"
            )
        for axis, dofs in self._by_direction(where):
            for name in self._names(axis, across):
                if name in dofs:
                    self.held[np.ix_(dofs[name], np.array(list(components)))] = True
        return self

    def _names(self, along: int, across: bool) -> tuple[str, ...]:
        """Degrees of freedom that make up the value (or slope across) of an edge along an axis."""
        t, n = "xy"[along], "yx"[along]
        return (f"u_{n}", "u_xy", "u_n") if across else ("u", f"u_{t}", f"u_{t}{t}")

    def _by_direction(self, where: Where) -> list[tuple[int, dict[str, NDArray[np.int64]]]]:
        """Degrees of freedom on the edges along axis 0 and along axis 1."""
        if not is_global(self.discretisation.element):
            return [(0, self.discretisation.dofs_on(where))]
        mesh = self.discretisation.mesh
        facets = self.discretisation.facets(where)
        extent = np.abs(np.subtract(*mesh.p[:, mesh.facets[:, facets]].transpose(1, 0, 2)))
        if np.any(extent.min(0) > 1e-9 * extent.max(0)):
            raise ValueError("where: the edges must lie along the axes of the parameter domain")
        return [
            (axis, self.discretisation.dofs_of(facets[extent.argmax(0) == axis]))
            for axis in (0, 1)
            if np.any(extent.argmax(0) == axis)
        ]
