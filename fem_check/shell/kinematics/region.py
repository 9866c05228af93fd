"""Quadrature points of a discretised sheet: its interior, an edge or a single point.

Points are numbered element by element, `points` = elements x points per element. Jets are arrays
(entries, components, points) of the position and its derivatives in the order
x, x_1, x_2, x_11, x_22, x_12; each caller states the entries that it reads.
"""

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.elements import require_h2
from fem_check.shell.kinematics.shape_functions import is_global, shape_functions
from fem_check.shell.kinematics.surface import Surface
from linear_theory.common.shown import Shown

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
Entries = tuple[int, ...]


class Region(Shown):
    """Points, weights, shape functions and reference geometry, computed on first use.

    elements (elements,): indices in the mesh. parameters (2, elements, points per element).
    weights (elements, points per element): of the quadrature in the parameter domain.
    dofs (elements, shapes): scalar degrees of freedom. components: 2 in the plane, 3 in space.
    tangents: for an edge, its unit tangents in the parameter domain, shape of `parameters`.
    """

    def __init__(
        self,
        mesh: Any,
        element: Any,
        elements: Integers,
        parameters: Array,
        weights: Array,
        dofs: Integers,
        surface: Surface,
        components: int,
        tangents: Array | None = None,
    ) -> None:
        self.mesh, self.element, self.surface = mesh, element, surface
        self.elements, self.parameters, self.weights, self.dofs = elements, parameters, weights, dofs
        self.components, self.tangents = components, tangents
        self._shapes: dict[Entries, Array] = {}
        self._tables: dict[Entries, Array] = {}
        self._origins: dict[Entries, Array] = {}
        self._jets: dict[int, Array] = {}

    def _title(self) -> str:
        return f"Region: {self.size} points in {len(self.elements)} elements"

    def _contents(self) -> Mapping[str, Any]:
        names = ("elements", "parameters", "weights", "dofs", "components", "surface")
        return {name: getattr(self, name) for name in names}

    @property
    def size(self) -> int:
        """Number of points."""
        return int(self.weights.size)

    @property
    def per_element(self) -> int:
        """Points per element."""
        return int(self.weights.shape[1])

    def shapes(self, entries: Entries) -> Array:
        """The given derivatives of the shape functions, (elements or 1, points, entries, shapes).

        The first axis is 1 where all elements of the mesh are translates of one another.
        Raises ValueError for second derivatives of an element that is not H2.
        """
        if entries not in self._shapes:
            order = 2 if max(entries) > 2 else 1
            if order == 2:
                require_h2(self.element)
            all_entries = self._all_shapes(order)
            self._shapes[entries] = np.ascontiguousarray(all_entries[:, :, list(entries)])
        return self._shapes[entries]

    def _all_shapes(self, order: int) -> Array:
        if order not in self._jets:
            same = slice(0, 1) if self._translates() else slice(None)
            self._jets[order] = shape_functions(
                self.mesh, self.element, self.elements[same], self.parameters[:, same], order
            )
        return self._jets[order]

    def _translates(self) -> bool:
        corners = self.mesh.p[:, self.mesh.t[:, self.elements]]
        points = self.parameters - corners[:, 0, :, None]
        corners = corners - corners[:, :1]
        alike = np.ptp(corners, axis=2).max() < 1e-12 * np.ptp(corners)
        alike = alike and np.ptp(points, axis=1).max() < 1e-12 * np.ptp(corners)
        orientable = 0 if is_global(self.element) else 1
        return bool(alike and corners.shape[1] == 4 and self.element.facet_dofs <= orientable)

    @cached_property
    def reference(self) -> Array:
        """Jet of the undeformed surface, (6, components, points)."""
        jet = self.surface(self.parameters[0], self.parameters[1])
        return np.ascontiguousarray(jet.reshape(6, 3, -1)[:, : self.components])

    @cached_property
    def metric(self) -> Array:
        """A_11, A_22, A_12 of the undeformed surface, (3, points)."""
        first, second = self.reference[1:3]
        return np.stack([(first**2).sum(0), (second**2).sum(0), (first * second).sum(0)])

    @cached_property
    def curvature(self) -> Array:
        """B_11, B_22, B_12 of the undeformed surface, (3, points); 0 in the plane."""
        if self.components == 2:
            return np.zeros((3, self.size))
        normal = np.cross(self.reference[1], self.reference[2], axis=0)
        return np.asarray((self.reference[3:] * normal / np.sqrt((normal**2).sum(0))).sum(1))

    @cached_property
    def measure(self) -> Array:
        """Weights times the undeformed area (length, along an edge; 1 for a point), (points,)."""
        weights = self.weights.ravel()
        if self.tangents is not None:
            tangent = np.einsum("ap,acp->cp", self.tangents.reshape(2, -1), self.reference[1:3])
            return np.asarray(weights * np.sqrt((tangent**2).sum(0)))
        if self.parameters.shape[1:] == (1, 1):
            return weights
        a11, a22, a12 = self.metric
        return np.asarray(weights * np.sqrt(a11 * a22 - a12**2))

    def displacement(self, u: Array, entries: Entries, part: slice = slice(None)) -> Array:
        """Derivatives of the displacement on some elements, (entries, components, points).

        u: (scalar degrees of freedom * components,), components of one degree of freedom together.
        """
        table = self.table(entries)
        local = np.take(u.reshape(-1, self.components).T, self.dofs[part], axis=1)
        if len(table) == 1:  # the same for all elements: one product for each derivative
            values = local.reshape(-1, local.shape[-1]) @ table[0].swapaxes(1, 2)
            return values.reshape(len(entries), self.components, -1)
        values = local.swapaxes(0, 1)[:, None] @ table[part].swapaxes(2, 3)
        return np.ascontiguousarray(values.transpose(1, 2, 0, 3)).reshape(*values.shape[1:3], -1)

    def integral(self, density: Array, entries: Entries, part: slice = slice(None)) -> Array:
        """Sums over the points of each element of derivatives of shape functions times a density.

        density: (entries, components, points) -> (components, elements, shapes): the transpose of
        `displacement` before the elements are added up.
        """
        table = self.table(entries)
        if len(table) == 1:
            rows = density.reshape(len(entries), -1, table.shape[2])
            summed = (rows @ table[0]).sum(0)
        else:
            columns = density.reshape(*density.shape[:2], -1, table.shape[2]).transpose(2, 0, 1, 3)
            summed = (columns @ table[part]).sum(1).swapaxes(0, 1)
        return np.asarray(summed.reshape(self.components, -1, table.shape[3]))

    def position(self, u: Array, entries: Entries, part: slice = slice(None)) -> Array:
        """Derivatives of the exact reference plus displacement, (entries, components, points)."""
        jet = self.displacement(u, entries, part)
        if entries not in self._origins:
            self._origins[entries] = self.reference[list(entries)]
        jet += self._origins[entries][..., self.points(part)]
        return jet

    def table(self, entries: Entries) -> Array:
        """`shapes` by derivative, (elements or 1, entries, points, shapes)."""
        if entries not in self._tables:
            self._tables[entries] = np.ascontiguousarray(self.shapes(entries).swapaxes(1, 2))
        return self._tables[entries]

    def points(self, part: slice) -> slice:
        """The points of a slice of elements."""
        start, stop, _ = part.indices(len(self.elements))
        return slice(start * self.per_element, stop * self.per_element)
