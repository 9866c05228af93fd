"""The families of terms of the Airy series (eq. 15): wave numbers, and what depends on them alone.

Growth even in y calls for the families A and C, growth odd in y for B and D. A and B run along x, C and
D along y, and the two of one direction have as many terms, so that they are one `Family` here: wherever
a first axis of 2 stands, it is the symmetry of growth in y, 0 even and 1 odd.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.deformation.airy.special import one_plus_x_over_sinh
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]


class Modes(NamedTuple):
    """Some terms of a family, each (2, n).

    numbers: m and m, or r and s; wavenumbers: alpha_m and alpha_m, or gamma_r and delta_s, 1/length;
    diagonal: 1 + tau 2kH/sinh(2kH).
    """

    numbers: Array
    wavenumbers: Array
    diagonal: Array


@dataclass(frozen=True)
class Family:
    """The terms along one side of the sheet: A and B, or C and D.

    count: number of terms kept; side: length of the sheet in the trigonometric direction; half: half
    its length H in the hyperbolic one. For each symmetry, (2, 1): step, 1 for the numbers 1, 2, 3, ...,
    2 for 1, 3, 5, ...; parity tau, +1 for cosh, -1 for sinh; tail, beyond `count` barred amplitudes are
    tail * K/number.
    """

    count: int
    side: float
    half: float
    step: Array
    parity: Array
    tail: Array

    @property
    def spacing(self) -> float:
        """Distance of neighbouring wave numbers, 1/length."""
        return 2 * np.pi / self.side

    @cached_property
    def first(self) -> Array:
        """Wave number of number 1, (2, 1), 1/length."""
        return self.spacing / self.step

    @cached_property
    def modes(self) -> Modes:
        """The terms kept, then as many beyond, where a truncation shows its error."""
        numbers = 1 + self.step * np.arange(2 * self.count)
        k = self.first * numbers
        return Modes(numbers, k, one_plus_x_over_sinh(2 * self.half * k, self.parity))

    @cached_property
    def kept(self) -> Modes:
        """Those that are solved for."""
        return Modes(*(values[:, : self.count] for values in self.modes))

    @cached_property
    def beyond(self) -> Modes:
        """Those that follow."""
        return Modes(*(values[:, self.count :] for values in self.modes))

    @cached_property
    def slope(self) -> Array:
        """tanh^tau(kH) of the terms kept, (2, count)."""
        t = np.tanh(self.half * self.kept.wavenumbers)
        return np.where(self.parity > 0, t, 1 / t)

    @property
    def signs(self) -> Array:
        """Barred amplitudes are these times the printed ones, (2, count)."""
        return np.where(self.step == 2, 1.0, -1.0) * (-1.0) ** np.arange(self.count)


def _both(even: float, odd: float) -> Array:
    return np.array([[even], [odd]], float)


# step, parity, tail
_ALONG_X = _both(1, 1), _both(1, -1), _both(1, 1)
_ALONG_Y = _both(1, 2), _both(1, 1), _both(-1, -2)


def families(sheet: Sheet, modes: tuple[int, int]) -> tuple[Family, Family]:
    """The families along x (A, B) and along y (C, D), with so many terms."""
    return (
        Family(modes[0], sheet.width, sheet.length / 2, *_ALONG_X),
        Family(modes[1], sheet.length, sheet.width / 2, *_ALONG_Y),
    )
