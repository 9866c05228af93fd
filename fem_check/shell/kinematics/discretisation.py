"""A sheet on a scikit-fem mesh: unknowns, quadrature and the regions on which effects act."""

from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Any

import numpy as np
import skfem
from numpy.typing import ArrayLike, NDArray

from fem_check.mesh.checks import check_mesh
from fem_check.mesh.location import TriangleFinder
from fem_check.mesh.orientation import oriented
from fem_check.mesh.shown import MeshShown
from fem_check.shell.kinematics import elements
from fem_check.shell.kinematics.region import Region
from fem_check.shell.kinematics.shape_functions import derivatives, edge_frame
from fem_check.shell.kinematics.surface import Flat, Surface
from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.common.units import power_of_two
from linear_theory.common.validation import shown

Array = NDArray[np.float64]
Where = Callable[[Array], NDArray[np.bool_]]

QUADRATURE = {"ElementQuadBFS": 7, "ElementTriArgyris": 8}
"""Polynomial degree integrated exactly by default: 4 x 4 points per rectangle, 16 per triangle.

For BFS, degree 5 (3 x 3 points) is as accurate and halves the work on meshes of 2 x 2 elements or more;
a single element then has three zero-energy modes besides the rigid motions."""


class Discretisation(Shown):
    """Displacement fields of a surface: `components` copies of one scalar finite element.

    mesh: skfem.MeshTri or MeshQuad of the parameter domain; the vertices of its elements are put in
    the order that neighbours agree on. element: ElementQuadBFS on rectangles,
    ElementTriArgyris on triangles, or a continuous Lagrange element for a scene that does not bend.
    surface: the undeformed surface over that domain, exact. components: 3, or 2 in the plane.
    degree: of the polynomials that quadrature integrates exactly.

    Unknowns u are displacements in space, (size,): the components of a scalar degree of freedom are
    neighbours. Raises ValueError for meshes that are not one sheet (see `check_mesh`) and for
    unsuitable elements.
    """

    def __init__(
        self,
        mesh: Any,
        element: Any,
        surface: Surface | None = None,
        components: int = 3,
        degree: int | None = None,
    ) -> None:
        check_mesh(mesh)
        elements.check_element(mesh, element)
        elements.check_rectangles(mesh, element)
        if components not in (2, 3):
            raise ValueError(f"components = {shown(components)}: must be 2 (planar) or 3")
        self.mesh, self.element = oriented(mesh), element
        self.surface = Flat() if surface is None else surface
        self.components = components
        default = QUADRATURE.get(type(element).__name__, 2 * element.maxdeg)
        self.degree = default if degree is None else validation.integer("degree", degree, 1)
        self._dofs = skfem.Dofs(self.mesh, element)
        if components == 2 and np.abs(self._full_reference()[1:, 2]).max() > 0:
            raise ValueError(
                f"surface = {shown(self.surface)}: must lie in a plane z = const for 2 components"
            )

    def _title(self) -> str:
        return f"Discretisation: {MeshShown(self.mesh)._title()}, {self.size} unknowns"

    def _contents(self) -> Mapping[str, Any]:
        mesh = {"mesh": MeshShown(self.mesh), "element": type(self.element).__name__}
        numbers = {"components": self.components, "degree": self.degree, "size": self.size}
        return {**mesh, "surface": self.surface, **numbers}

    @property
    def scalars(self) -> int:
        """Number of scalar degrees of freedom."""
        return int(self._dofs.N)

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return self.scalars * self.components

    @cached_property
    def locations(self) -> Array:
        """Locations of the scalar degrees of freedom in the parameter domain, (2, scalars)."""
        mesh, dofs = self.mesh, self._dofs
        places = np.empty((2, self.scalars))
        for numbers, points in (
            (dofs.nodal_dofs, mesh.p),
            (dofs.facet_dofs, mesh.p[:, mesh.facets].mean(1)),
            (dofs.interior_dofs, mesh.p[:, mesh.t].mean(1)),
        ):
            for row in numbers:
                places[:, row] = points
        return places

    @cached_property
    def units(self) -> Array:
        """Units of the scalar degrees of freedom relative to length, (scalars,): 1, 1/size, 1/size^2.

        For values, first and second derivatives with respect to the parameters; size: about that of the
        mesh. They make comparisons between degrees of freedom independent of the unit of length.
        """
        size = power_of_two(float(np.ptp(self.mesh.p, axis=1).max()))
        rows = [*self._dofs.nodal_dofs, *self._dofs.facet_dofs, *self._dofs.interior_dofs]
        units = np.ones(self.scalars)
        for order, row in zip(derivatives(self.element), rows, strict=True):
            units[row] = size**-order
        return units

    def zeros(self) -> Array:
        """The undeformed state, (size,)."""
        return np.zeros(self.size)

    @cached_property
    def interior(self) -> Region:
        """All quadrature points of the sheet; its measure is the undeformed area."""
        points, weights = skfem.quadrature.get_quadrature(self.mesh.refdom, self.degree)
        mapping = self.mesh._mapping()
        density = np.abs(mapping.detDF(points)) * weights
        return self._region(np.arange(self.mesh.nelements), mapping.F(points), density)

    def edge(self, where: Where) -> Region:
        """Points on the boundary edges whose midpoints satisfy `where(xi)`; measure: undeformed length.

        where: a function of the parameters (2, edges). Raises ValueError if there are none.
        """
        facets = self.facets(where)
        basis = skfem.FacetBasis(self.mesh, self.mesh.elem(), facets=facets, intorder=self.degree)
        points = np.asarray(basis.global_coordinates())
        normals = np.broadcast_to(np.asarray(basis.normals), points.shape)
        tangents = np.stack([-normals[1], normals[0]])
        return self._region(basis.tind, points, basis.dx, tangents)

    def point(self, xi: ArrayLike) -> Region:
        """The single point of parameters xi (2,), with weight 1. Raises ValueError outside the mesh."""
        place = validation.real_array("xi", xi)
        if place.shape != (2,):
            raise ValueError(f"xi has shape {place.shape}: must be (2,)")
        return self._region(self._elements_at(place[:, None]), place[:, None, None], np.ones((1, 1)))

    def points(self, xi: ArrayLike) -> Region:
        """Points of parameters xi (2, n), each with weight 1. Raises ValueError outside the mesh."""
        places = validation.real_array("xi", xi)
        if places.ndim != 2 or len(places) != 2:
            raise ValueError(f"xi has shape {places.shape}: must be (2, n)")
        found = self._elements_at(places)
        return self._region(found, places[:, :, None], np.ones((places.shape[1], 1)))

    def _elements_at(self, places: Array) -> NDArray[np.int64]:
        """Elements that contain points (2, n), (n,). Raises ValueError outside the mesh."""
        found, _ = self._triangles(*places)
        if (found < 0).any():
            worst = places[:, (found < 0).argmax()]
            raise ValueError(f"xi = {worst}: must be in the parameter domain of the mesh")
        return np.asarray(found % self.mesh.nelements, np.int64)

    @cached_property
    def _triangles(self) -> TriangleFinder:
        """Of the elements, or of all their first and then all their second halves.

        scikit-fem's own finders lose points on the boundary to rounding.
        """
        mesh = self.mesh
        if mesh.t.shape[0] == 3:
            return TriangleFinder(mesh)
        halves = np.hstack([mesh.t[[0, 1, 2]], mesh.t[[0, 2, 3]]])
        return TriangleFinder(skfem.MeshTri(mesh.p, halves))

    def facets(self, where: Where) -> NDArray[np.int64]:
        """Indices of boundary edges whose midpoints satisfy `where`. Raises ValueError if none does."""
        facets = self.mesh.facets_satisfying(where, boundaries_only=True)
        if not facets.size:
            raise ValueError("where: must be satisfied by at least one boundary edge of the mesh")
        return np.asarray(facets, np.int64)

    def dofs_on(self, where: Where) -> dict[str, NDArray[np.int64]]:
        """Scalar degrees of freedom on those edges by scikit-fem's names ("u", "u_x", ...)."""
        return self.dofs_of(self.facets(where))

    def dofs_of(self, facets: NDArray[np.int64]) -> dict[str, NDArray[np.int64]]:
        """Scalar degrees of freedom on edges of the mesh by name."""
        view = self._dofs.get_facet_dofs(facets)
        found: dict[str, list[NDArray[np.int64]]] = {}
        for kind in (view.nodal, view.facet):
            for name, numbers in kind.items():
                found.setdefault(name, []).append(numbers)
        return {name: np.concatenate(numbers) for name, numbers in found.items()}

    def dofs_values(self) -> NDArray[np.int64]:
        """Scalar degrees of freedom that are 1 for a uniform displacement of 1; the others are 0.

        These are the nodal values of Lagrange elements, and the vertex values of elements whose other
        degrees of freedom are derivatives (BFS, Argyris) or bubbles (ElementQuadP).
        """
        ones = np.zeros(self.scalars)
        ones[self._dofs.nodal_dofs[0]] = 1
        local = ones[self.interior.dofs]
        sums = np.einsum("epk,ek->ep", self.interior.shapes((0,))[:, :, 0], local)
        if not np.allclose(sums, 1, atol=1e-8):
            ones[:] = 1
        return np.flatnonzero(ones)

    def dofs_at(self, xi: ArrayLike) -> dict[str, NDArray[np.int64]]:
        """Scalar degrees of freedom of the vertex nearest to xi, by name."""
        distance = np.abs(self.mesh.p - np.reshape(xi, (2, 1))).sum(0)
        view = self._dofs.get_vertex_dofs(np.array([distance.argmin()]))
        return dict(view.nodal)

    def interpolate(self, jets: Callable[[Array, Array], Array]) -> Array:
        """Unknowns of a displacement given by its jets (6, 3, points), in the form of a Surface.

        Nodal values and derivatives are copied; degrees of freedom at edges are normal derivatives.
        Only for ElementQuadBFS and ElementTriArgyris.
        """
        entries = {"u": 0, "u_x": 1, "u_y": 2, "u_xx": 3, "u_yy": 4, "u_xy": 5}
        u = np.zeros((self.scalars, 3))
        at_vertices = jets(*self.mesh.p)
        for name, row in zip(self.element.dofnames, self._dofs.nodal_dofs, strict=False):
            u[row] = at_vertices[entries[name]].T
        if self.element.facet_dofs:
            edges = edge_frame(self.mesh, np.arange(self.mesh.nelements))
            for place, normal, facets in zip(edges["e"], edges["n"], self.mesh.t2f, strict=True):
                _, first, second, *_ = jets(*place)
                u[self._dofs.facet_dofs[0, facets]] = (normal[0] * first + normal[1] * second).T
        return np.ascontiguousarray(u[:, : self.components]).ravel()

    def _region(
        self, elements: NDArray[np.int64], points: Array, weights: Array, tangents: Array | None = None
    ) -> Region:
        dofs = self._dofs.element_dofs[:, elements].T.astype(np.int64)
        return Region(
            self.mesh,
            self.element,
            elements,
            points,
            np.array(weights),
            dofs,
            self.surface,
            self.components,
            tangents,
        )

    def _full_reference(self) -> Array:
        return self.surface(*self.mesh.p)
