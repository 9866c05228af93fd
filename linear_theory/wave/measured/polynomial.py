"""The smooth wave of a fit: a polynomial of x and y times harmonics in time, and its drive."""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.measured.basis import Basis
from linear_theory.wave.places import Places
from linear_theory.wave.sampled import SampledDrive

Array = NDArray[np.float64]

FARTHEST = 10.0
"""Samples from the centre of the sheet, over half its size: farther ones are in another unit."""


class PolynomialWave(Shown):
    """c = sum of coefficients (*basis.shape) times the functions of a basis.

    margins: how far beyond the ranges of x and y of the basis c is still known, units of length; x does
    not count where c does not depend on it.
    """

    def __init__(self, basis: Basis, coefficients: Array, margins: Sequence[float]) -> None:
        self.basis, self.coefficients, self.margins = basis, coefficients, tuple(margins)

    def _contents(self) -> Mapping[str, Any]:
        return {"basis": self.basis, "coefficients": self.coefficients, "margins": self.margins}

    @property
    def period(self) -> float:
        """Units of time."""
        return self.basis.period

    @property
    def words(self) -> str:
        """What it is, in a few words."""
        count = self.basis.harmonics
        return f"a measured wave of {count} harmonic{'' if count == 1 else 's'} in time"

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """c; x, y, t broadcast. The coordinates are those of the sheet: `length` has no effect."""
        return self._sum(x, y, t, self.basis.times(validation.real_array("t", t)))

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """dc/dt, exact; x, y, t broadcast. `length` has no effect."""
        return self._sum(x, y, t, self.basis.time_rates(validation.real_array("t", t)))

    def on(self, sheet: Sheet, places: Places | None = None) -> "PolynomialDrive":
        """The wave on a body within that rectangle; places: of another outline, see `protocol.Wave`."""
        return PolynomialDrive(self, sheet, places)

    @property
    def depends_on_x(self) -> bool:
        """Whether x counts."""
        return self.basis.degree[0] > 0

    def check_covers(self, sheet: Sheet) -> None:
        """Raise ValueError where the sheet reaches beyond the samples, or these are in another unit."""
        sides = [("y", sheet.length, self.basis.along, self.margins[1])]
        if self.depends_on_x:
            sides.append(("x", sheet.width, self.basis.across, self.margins[0]))
        for name, size, (low, high), margin in sides:
            if low - margin > -size / 2 or high + margin < size / 2:
                raise ValueError(
                    f"wave: was measured for {name} from {low:.6g} to {high:.6g}, but the sheet "
                    f"reaches from {-size / 2:.6g} to {size / 2:.6g} (its centre is the origin); shift "
                    f"or scale {name}, or take a sheet that the samples cover"
                )
            if max(-low, high) > FARTHEST * size / 2:
                raise ValueError(
                    f"wave: was measured for {name} from {low:.6g} to {high:.6g}, more than "
                    f"{FARTHEST:g} times as far as the sheet reaches, {size / 2:.6g} from its centre: "
                    f"must be in the unit of the sheet; scale {name}, or leave out samples "
                    f"beyond the sheet"
                )

    def _sum(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, times: Array) -> Array:
        x, y = validation.real_array("x", x), validation.real_array("y", y)
        across, along = self.basis.polynomials(x if self.depends_on_x else np.zeros(()), y)
        if self.depends_on_x:
            lines = np.tensordot(across, self.coefficients, axes=(-1, 1))  # (*x.shape, times, along)
            places = np.einsum("...kj,...j->...k", lines, along)
        else:
            places = along @ self.coefficients[:, 0].T
        found = np.einsum("...k,...k->...", places, times)
        return np.array(np.broadcast_to(found, np.broadcast_shapes(x.shape, y.shape, np.shape(t))))


class PolynomialDrive(SampledDrive):
    """A fitted wave on a body; made by `on`. Its rate and its period are exact."""

    wave: PolynomialWave

    @property
    def mirrored(self) -> bool:  # type: ignore[override]
        """Whether c does not depend on x."""
        return not self.wave.depends_on_x

    @cached_property
    def depends_on_x(self) -> bool:
        """Whether c is another one off the axis x = 0."""
        return self.wave.depends_on_x

    def check_period(self) -> None:
        """Raise ValueError where the body reaches beyond the samples; c repeats in any case."""
        self.wave.check_covers(self.sheet)

    def _check_rate(self) -> None:
        """Nothing to check: it is the derivative of the series."""
