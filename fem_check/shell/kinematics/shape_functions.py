"""Values and derivatives of scikit-fem's shape functions at given points.

scikit-fem expresses elements of the class `ElementGlobal` (BFS, Argyris) in monomials of the global
coordinates and inverts the matrix of the degrees of freedom of these monomials. Far from the origin,
relative to the size of an element, that matrix is nearly singular: on 32 x 64 elements second
derivatives of BFS and Argyris functions are accurate to five digits only. Here the same degrees of
freedom act on monomials centred and scaled per element, without loss of digits.
"""

from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

DERIVATIVES = ((0, 0), (1, 0), (0, 1), (2, 0), (0, 2), (1, 1))
"""Orders (d/dxi_1, d/dxi_2) of the entries of a jet: value, _1, _2, _11, _22, _12."""

COUNT = (1, 3, 6)
"""Number of entries of a jet of order 0, 1, 2."""


def is_global(element: Any) -> bool:
    """Whether scikit-fem defines the element by its global degrees of freedom."""
    return hasattr(element, "gdof") and hasattr(element, "maxdeg")


def shape_functions(mesh: Any, element: Any, elements: Integers, points: Array, order: int) -> Array:
    """Jets of all shape functions of some elements, (elements, points, entries, shapes).

    elements: (elements,) indices; points: (2, elements, points) in the parameter domain;
    order: highest derivative, 0, 1 or (elements defined globally) 2.
    """
    if is_global(element):
        return _global_shapes(mesh, element, elements, points, order)
    return _lagrange_shapes(mesh, element, elements, points, order)


def _lagrange_shapes(mesh: Any, element: Any, elements: Integers, points: Array, order: int) -> Array:
    mapping = mesh._mapping()
    local = mapping.invF(points, tind=elements)
    fields = []
    for shape in range(element.doflocs.shape[0]):
        field = element.gbasis(mapping, local, shape, tind=elements)[0]
        value = np.broadcast_to(np.asarray(field), points.shape[1:])
        fields.append(np.stack([value, *field.grad][: COUNT[order]], -1))
    return np.ascontiguousarray(np.stack(fields, -1))


def _global_shapes(mesh: Any, element: Any, elements: Integers, points: Array, order: int) -> Array:
    corners = mesh.p[:, mesh.t[:, elements]]
    centre = corners.mean(1)
    scale = np.ptp(corners, axis=1).max(0) / 2
    x, y = (points - centre[:, :, None]) / scale[:, None]
    orders = np.array(DERIVATIVES[: COUNT[order]])
    powers = _exponents(element)
    monomials = np.stack(
        [_monomials(powers, x, y, *d) / scale[:, None, None] ** sum(d) for d in orders], axis=2
    )
    matrix = _degrees_of_freedom(mesh, element, elements, powers, centre, scale)
    units = scale[:, None, None, None] ** _local_derivatives(mesh, element)
    return np.ascontiguousarray((monomials @ np.linalg.inv(matrix)[:, None]) * units)


def derivatives(element: Any) -> Integers:
    """Derivative order of each of `element.dofnames`: 0 for u, 1 for u_x and u_n, 2 for u_xy.

    0 for all degrees of freedom of an element that is not defined globally.
    """
    orders = [len(name.removeprefix("u").removeprefix("_")) for name in element.dofnames]
    return np.array(orders) if is_global(element) else np.zeros(len(orders), np.int64)


def _local_derivatives(mesh: Any, element: Any) -> Integers:
    """Derivative orders for all shape functions of an element: of the corners, then of the edges."""
    orders, corners = derivatives(element), mesh.t.shape[0]
    ends = element.nodal_dofs, element.nodal_dofs + element.facet_dofs
    return np.concatenate([np.tile(orders[: ends[0]], corners), np.tile(orders[slice(*ends)], corners)])


def _exponents(element: Any) -> Integers:
    """(monomials, 2) powers of the polynomial space of the element."""
    tensorial = getattr(element, "tensorial_basis", False)
    degree = element.maxdeg // 2 if tensorial else element.maxdeg
    pairs = product(range(degree + 1), repeat=2)
    return np.array([p for p in pairs if tensorial or sum(p) <= degree])


def _monomials(powers: Integers, x: Array, y: Array, dx: int, dy: int) -> Array:
    """d^dx/dx d^dy/dy of x^i y^j for all powers, (*x.shape, monomials)."""
    return _power(x, powers[:, 0], dx) * _power(y, powers[:, 1], dy)


def _power(x: Array, exponents: Integers, derivative: int) -> Array:
    factor = np.ones(exponents.shape)
    for k in range(derivative):
        factor = factor * (exponents - k)
    return np.asarray(factor * x[..., None] ** np.maximum(exponents - derivative, 0))


def _degrees_of_freedom(
    mesh: Any, element: Any, elements: Integers, powers: Integers, centre: Array, scale: Array
) -> Array:
    """Degree of freedom j of monomial i, (elements, j, i), through the element's own `gdof`.

    Derivatives are with respect to coordinates scaled by the element: all entries are of order 1.
    """
    edges = edge_frame(mesh, elements)
    matrix = np.empty((elements.size, len(powers), len(powers)))

    def derivative(i: int, axes: tuple[int, ...]) -> Any:
        dx, dy = axes.count(0), axes.count(1)

        def function(x: Array, y: Array) -> Array:
            values = _monomials(
                powers[i : i + 1], (x - centre[0]) / scale, (y - centre[1]) / scale, dx, dy
            )
            return np.asarray(values[:, 0])

        return function

    indices = [axes for count in range(3) for axes in product((0, 1), repeat=count)]
    for i in range(len(powers)):
        functions = {axes: derivative(i, axes) for axes in indices}
        for j in range(len(powers)):
            matrix[:, j, i] = element.gdof(functions, edges, j)
    return matrix


def edge_frame(mesh: Any, elements: Integers) -> dict[str, Array]:
    """Corners v, midpoints e and normals n of the edges, as scikit-fem passes them to `gdof`.

    A normal must be the same for both elements of an edge. As in scikit-fem it is the edge vector
    between ascending vertex numbers rotated by -90 degrees, and points outwards on the boundary, so
    that degrees of freedom have the same meaning in both codes.
    """
    vertices = mesh.t[:, elements]
    corners = mesh.p[:, vertices].transpose(1, 0, 2)
    following = np.roll(corners, -1, axis=0)
    edge = corners - following
    if mesh.t.shape[0] == 3:
        edge[2] = -edge[2]
    normal = np.stack([edge[:, 1], -edge[:, 0]], 1) / np.hypot(edge[:, 0], edge[:, 1])[:, None]
    middle = (corners + following) / 2
    outside = np.sign(((middle - corners.mean(0)) * normal).sum(1, keepdims=True))
    boundary = mesh.f2t[1][mesh.t2f[:, elements]][:, None] == -1
    return {"v": corners, "e": middle, "n": np.where(boundary, outside * normal, normal)}
