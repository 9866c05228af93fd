"""A periodic wave on the elements of any outline: harmonics in time at the nodes."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.excitable.space import Space
from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.wave.measured.basis import Basis

Array = NDArray[np.float64]


class NodalWave(Shown):
    """c = sum over k of coefficients (2 harmonics + 1, nodes) times 1, cos, sin, cos 2, sin 2, ..."""

    def __init__(self, space: Space, basis: Basis, coefficients: Array) -> None:
        self.space, self.basis, self.coefficients = space, basis, coefficients

    def _contents(self) -> Mapping[str, Any]:
        return {"nodes": self.space.size, "harmonics": self.basis.harmonics, "period": self.period}

    @property
    def period(self) -> float:
        """Units of time."""
        return self.basis.period

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """c; x, y, t broadcast. The body is known: `length` has no effect."""
        return self._sum(x, y, self.basis.times(validation.real_array("t", t)))

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """dc/dt likewise."""
        return self._sum(x, y, self.basis.time_rates(validation.real_array("t", t)))

    def _sum(self, x: ArrayLike, y: ArrayLike, times: Array) -> Array:
        nodes, shares = self.space.weights(validation.real_array("x", x), validation.real_array("y", y))
        places = np.einsum("n...,kn...->...k", shares, self.coefficients[:, nodes])
        return np.asarray(np.einsum("...k,...k->...", places, times))
