"""Input checks: every message names the argument, its value and the allowed range."""

import math
import operator
import sys
from collections.abc import Collection

import numpy as np
from numpy.typing import ArrayLike, NDArray

SMALLEST_RTOL = 1e-13
"""Relative tolerance below which double precision cannot tell success from failure."""


def real_array(name: str, value: ArrayLike) -> NDArray[np.float64]:
    """`value` as an array of finite floats; complex, object, text and NaN are refused."""
    array = np.asarray(value)
    if array.dtype.kind not in "iuf":
        raise ValueError(f"{name} = {value!r}: must be real numbers, not dtype {array.dtype}")
    array = array.astype(float, copy=False)
    if not np.all(np.isfinite(array)):
        bad = array[~np.isfinite(array)].flat[0]
        raise ValueError(f"{name} contains {bad}: must be finite")
    return array


def real(name: str, value: object) -> float:
    """`value` as one finite float."""
    if isinstance(value, bool) or np.ndim(value) != 0:  # type: ignore[arg-type]
        raise ValueError(f"{name} = {value!r}: must be a single real number")
    return float(real_array(name, value))  # type: ignore[arg-type]


def positive(name: str, value: object) -> float:
    """`value` as one finite float > 0."""
    number = real(name, value)
    if number <= 0:
        raise ValueError(f"{name} = {number:g}: must be > 0")
    return number


def poisson(value: object) -> float:
    """A Poisson ratio: in (-1, 1/2]."""
    number = real("poisson", value)
    if not -1 < number <= 0.5:
        raise ValueError(f"poisson = {number:g}: must be in (-1, 0.5]")
    return number


def integer(name: str, value: object, minimum: int | None = None) -> int:
    """`value` as an integer, at least `minimum`; 2.0 is refused, numpy integers are not."""
    try:
        if isinstance(value, bool):
            raise TypeError
        number = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise ValueError(f"{name} = {value!r}: must be an integer") from None
    if minimum is not None and number < minimum:
        raise ValueError(f"{name} = {number}: must be >= {minimum}")
    return number


def wave_count(value: object) -> int:
    """A number of waves on the sheet: any integer but 0 (negative runs towards -y)."""
    number = integer("count", value)
    if number == 0:
        raise ValueError("count = 0: must be a non-zero integer")
    return number


def tolerance(value: object) -> float:
    """A relative tolerance that double precision can reach."""
    number = real("rtol", value)
    if not SMALLEST_RTOL <= number < 1:
        raise ValueError(f"rtol = {number:g}: must be in [{SMALLEST_RTOL:g}, 1)")
    return number


def absolute_tolerance(atol: object, rtol: float, alpha: float, unit: float) -> float:
    """The absolute tolerance of a speed, > 0: the one given, or 1e-3 rtol alpha^2 L/T.

    unit: L/T. Speeds are of the size alpha^2 L/T at least, so that an alpha for which that is no
    number is refused here.
    """
    size = alpha * alpha * unit
    if not math.isfinite(size):
        raise ValueError(f"alpha = {alpha:g}: alpha^2 L/T must be finite")
    if atol is not None:
        return positive("atol", atol)
    return max(1e-3 * rtol * size, sys.float_info.min)


def choice(name: str, value: object, allowed: Collection[str]) -> str:
    """One of a few names."""
    if not isinstance(value, str) or value not in allowed:
        raise ValueError(f"{name} = {value!r}: must be one of {', '.join(map(repr, allowed))}")
    return value


def label(name: str, value: object) -> str:
    """Text by which something is known; not empty."""
    if not isinstance(value, str) or not value:
        raise ValueError(f"{name} = {value!r}: must be text, not empty")
    return value
