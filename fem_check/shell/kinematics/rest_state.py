"""The stress-free reference geometry: rest metric, rest curvature, measure of area.

Tensors are covariant in the parameters, components (11, 22, 12) on the first axis.
"""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.kinematics.region import Region
from fem_check.shell.material import elastic_tensor
from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.growth.growth import Growth, Reference

Array = NDArray[np.float64]

UNGROWN = Growth(0.0)


@dataclass(frozen=True, eq=False)
class RestState(Shown):
    """abar and bbar of eq. 1 at the points of a region, of any origin.

    abar, bbar: (3, points). measure (points,): quadrature weight times the reference area of the energy
    density; grown_area (points,): quadrature weight times sqrt(det abar).
    Raises ValueError if abar is not finite and positive definite or bbar not finite.
    """

    abar: Array
    bbar: Array
    measure: Array
    grown_area: Array
    _tensors: dict[float, Array] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        for name in ("abar", "bbar", "measure", "grown_area"):
            validation.real_array(name, getattr(self, name))
        determinant = self.abar[0] * self.abar[1] - self.abar[2] ** 2
        if np.any(determinant <= 0) or np.any(self.abar[0] <= 0):
            raise ValueError(f"abar has determinant {determinant.min():g}: must be positive definite")

    def elastic_tensor(self, poisson: float) -> Array:
        """H of appendix A.2 in the grown metric, (3, 3, points), cached."""
        if poisson not in self._tensors:
            self._tensors[poisson] = elastic_tensor(self.abar, poisson)
        return self._tensors[poisson]

    def part(self, points: slice) -> "RestState":
        """The rest state of a slice of the points."""
        part = object.__new__(RestState)
        for name in ("abar", "bbar", "measure", "grown_area"):
            object.__setattr__(part, name, getattr(self, name)[..., points])
        object.__setattr__(part, "_tensors", {k: v[..., points] for k, v in self._tensors.items()})
        return part


def tensor_state(
    region: Region, abar: ArrayLike, bbar: ArrayLike, area: Reference | str = Reference.GROWN
) -> RestState:
    """Rest state with given tensors, each (3,) or (3, points); area: for the energy density.

    Raises ValueError for tensors that are not finite and metrics that are not positive definite.
    """
    metric, curvature = (
        np.broadcast_to(value.reshape(3, -1), (3, region.size))
        for value in (validation.real_array("abar", abar), validation.real_array("bbar", bbar))
    )
    determinant = metric[0] * metric[1] - metric[2] ** 2
    grown = region.weights.ravel() * np.sqrt(np.maximum(determinant, 0))
    return RestState(
        metric,
        curvature,
        grown if Reference.named("area", area) is Reference.GROWN else region.measure,
        grown,
    )


def grown_state(region: Region, c: ArrayLike = 0.0, growth: Growth = UNGROWN) -> RestState:
    """Rest state of a surface (A, B) with metric and curvature grown by a field c (eq. 4).

        abar = g(alpha c) A,    bbar = B - beta c abar    (or B - beta c A, see `Growth`)

    c: at the points, broadcast to (points,). The paper's sheet is flat, B = 0.
    Raises ValueError for c that is not finite or for which lengths would vanish.
    """
    field = np.broadcast_to(validation.real_array("growth", c), (region.size,))
    abar = growth.metric(field) * region.metric
    bent = abar if growth.curvature is Reference.GROWN else region.metric
    bbar = region.curvature - growth.curvature_coupling * field * bent
    return tensor_state(region, abar, bbar, growth.energy_area)
