"""Mirror-symmetric outlines given by a few numbers, and meshes that move with these.

The width at the height y is w(eta), eta = 2 y/L in [-1, 1]. The outline is the polygon through the
widths at equidistant heights. A mesh is the image of one fixed grid of triangles of the square,

    x = xi w(eta)/2,   y = eta L/2,

so that a point of a triangle moves smoothly with every parameter: derivatives are taken there.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from skfem import MeshTri

from fem_check.mesh.meshing import quadrilateral_mesh
from fem_check.mesh.outline import Outline
from linear_theory.common import validation
from linear_theory.common.shown import Value

Array = NDArray[np.float64]

SIDES = 8
"""Of the polygon of a curved outline, from its rear to its front."""

NARROWEST = 0.01
"""Least width over the mean width; below, the sheet is as good as cut in two."""


class Shape(Value, ABC):
    """An outline with parameters, which are the numbers among its fields.

    A shape of one's own is a frozen dataclass that inherits from this class.
    """

    length: float

    @property
    @abstractmethod
    def sides(self) -> int:
        """Of the polygon on either edge, from rear to front."""

    @abstractmethod
    def width(self, eta: Array) -> Array:
        """At 2 y/L = eta, units of length."""

    @property
    def parameters(self) -> Mapping[str, float]:
        """Names and values; entries of a list by their number from 0, as "coefficients.0"."""
        found: dict[str, float] = {}
        for field in fields(self):  # type: ignore[arg-type]  # shapes are dataclasses
            value = getattr(self, field.name)
            if isinstance(value, tuple):
                found |= {f"{field.name}.{i}": one for i, one in enumerate(value)}
            else:
                found[field.name] = value
        return found

    def changed(self, name: str, value: float) -> "Shape":
        """The shape with another value of a parameter. Raises ValueError for one that it has not."""
        validation.choice("over", name, self.parameters)
        field, dot, place = name.partition(".")
        if not dot:
            return replace(self, **{field: value})  # type: ignore[type-var]
        entries = list(getattr(self, field))
        entries[int(place)] = value
        return replace(self, **{field: tuple(entries)})  # type: ignore[type-var]

    def widths(self) -> Array:
        """At the corners of an edge, rear to front, (sides + 1,). Raises ValueError if one is too
        narrow."""
        eta = np.linspace(-1, 1, self.sides + 1)
        found = self.width(eta)
        least = NARROWEST * found.mean()
        if not found.min() > max(least, 0.0):
            worst = eta[found.argmin()] * self.length / 2
            raise ValueError(f"width = {found.min():.3g} at y = {worst:.3g}: must be > {least:.3g}")
        return found

    def outline(self) -> Outline:
        """The polygon."""
        half, y = self.widths() / 2, np.linspace(-1, 1, self.sides + 1) * self.length / 2
        right, left = np.stack([half, y], 1), np.stack([-half, y], 1)
        return Outline(np.concatenate([right, left[::-1]]))

    @property
    def area(self) -> float:
        """Of the polygon."""
        widths = self.widths()
        return float((widths[1:] + widths[:-1]).mean() / 2 * self.length)

    def mesh(self, across: int, along: int) -> MeshTri:
        """Triangles, four to each of so many cells across, an even number, and along each side."""
        even = 2 * validation.integer("across", across, 1)
        square = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
        rows = self.sides * validation.integer("along", along, 1)
        stretched = square * [even / rows, 1.0]  # cells of one size for a grid of even x rows
        grid = quadrilateral_mesh(stretched, 2 / rows)
        xi, eta = grid.p[0] * rows / even, grid.p[1]
        corners = np.linspace(-1, 1, self.sides + 1)
        x = xi * np.interp(eta, corners, self.widths()) / 2
        return MeshTri(np.stack([x, eta * self.length / 2]), grid.t)


@dataclass(frozen=True)
class Trapezoid(Shape):
    """`rear` wide at y = -length/2 and `front` wide at y = length/2.

    Raises ValueError for sizes that are not positive.

    >>> from fem_check import Trapezoid
    >>> trapezoid = Trapezoid(rear=0.6, front=0.4, length=1.0)
    >>> print(*trapezoid.parameters, f"area {trapezoid.area:.2f} L^2")
    rear front length area 0.50 L^2
    """

    rear: float
    front: float
    length: float

    def __post_init__(self) -> None:
        for name in ("rear", "front", "length"):
            object.__setattr__(self, name, validation.positive(name, getattr(self, name)))

    @property
    def sides(self) -> int:
        """See Shape."""
        return 1

    def width(self, eta: Array) -> Array:
        """See Shape."""
        return np.asarray((self.rear * (1 - eta) + self.front * (1 + eta)) / 2)


@dataclass(frozen=True)
class LegendreShape(Shape):
    """w = (W/C) (1 + sum_k a_k P_k(eta)), k = 1, 2, ..., of the area W L whatever the a_k.

    mean_width: W; length: L; coefficients: a_1, a_2, ...; P_k are Legendre's polynomials, whose mean is
    0, and C is the mean of the polygon through them, 1 but for its sides. a_1 alone is a trapezoid.
    Raises ValueError for sizes that are not positive and where the width is not.

    >>> from fem_check import LegendreShape
    >>> lens = LegendreShape(mean_width=0.5, length=1.0, coefficients=(0.0, -0.4))
    >>> print(f"area {lens.area:.6f} L^2, {lens.widths().max():.3f} L wide")
    area 0.500000 L^2, 0.604 L wide
    """

    mean_width: float
    length: float
    coefficients: tuple[float, ...]

    def __init__(self, mean_width: float, length: float, coefficients: ArrayLike) -> None:
        object.__setattr__(self, "mean_width", validation.positive("mean_width", mean_width))
        object.__setattr__(self, "length", validation.positive("length", length))
        found = validation.real_array("coefficients", coefficients)
        if found.ndim != 1 or not found.size:
            raise ValueError(f"coefficients has shape {found.shape}: must be (n,) with n >= 1")
        object.__setattr__(self, "coefficients", tuple(found.tolist()))
        self.widths()

    @property
    def sides(self) -> int:
        """See Shape."""
        return SIDES

    def width(self, eta: Array) -> Array:
        """See Shape."""
        share = np.array([1.0, *self.coefficients])
        corners = np.polynomial.legendre.legval(np.linspace(-1, 1, SIDES + 1), share)
        mean = (corners[1:] + corners[:-1]).mean() / 2
        return np.asarray(self.mean_width * np.polynomial.legendre.legval(eta, share) / mean)
