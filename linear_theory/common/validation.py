"""Input checks: every message names the argument, its value and the allowed range."""

import math
import operator
import reprlib
import sys
from collections.abc import Collection
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

SMALLEST_RTOL = 1e-13
"""Smallest relative tolerance that can be verified in double precision."""

LARGEST_INTEGER = 2**53
"""Up to which all integers are exact floats."""

MOST_WAVES = 10**9
"""Waves on a sheet, so that wave numbers of all harmonics are integers of 64 bits."""

DIMENSIONLESS = ("", "dimensionless", "1")
"""Names of the dimensionless unit in unit libraries."""

T = TypeVar("T")


def shown(value: object) -> str:
    """The repr of `value` on one line, shortened, for a message."""
    if isinstance(value, type):
        return f"the class {value.__name__}"
    try:
        text = " ".join((repr if isinstance(value, str) else reprlib.repr)(value).split())
    except ValueError:  # Python writes no integers of more than 4300 digits
        return (
            "an integer too long to be shown" if isinstance(value, int) else "numbers too long to show"
        )
    return text if len(text) <= 100 else f"{text[:97]}..."


def instance(name: str, value: object, kind: type[T], hint: str = "") -> T:
    """`value`, which must be an instance of `kind`; hint: a remedy, for the message."""
    if not isinstance(value, kind):
        article = "an" if kind.__name__[0] in "AEIOU" else "a"
        made = ", made with its arguments" if value is kind else ""
        more = f"; {hint}" if hint else ""
        wanted = f"must be {article} {kind.__name__}{made}{more}"
        raise ValueError(f"{name} = {shown(value)}: {wanted}")
    return value


def real_array(name: str, value: ArrayLike) -> NDArray[np.float64]:
    """`value` as an array of finite floats.

    Complex numbers, objects, text and NaN are refused, and so are masked elements and units, which a
    plain conversion to an array would drop. pandas tables and series are converted to their values.
    """
    array = _plain(name, value)
    if array.dtype.kind not in "iuf":
        raise ValueError(f"{name} = {shown(value)}: must be real numbers, not dtype {array.dtype}")
    array = array.astype(float, copy=False)
    if not np.all(np.isfinite(array)):
        bad = array[~np.isfinite(array)].flat[0]
        raise ValueError(f"{name} contains {bad}: must be finite")
    return array


def _plain(name: str, value: Any) -> NDArray[Any]:
    """`value` as an array of any type; refused if that would drop a mask or a unit."""
    if type(value) is np.ndarray:
        return value
    value = _without_wrapping(name, value)
    try:
        array = np.asarray(value)
        words = any(isinstance(part, str) for part in array.flat) if array.dtype == object else True
        if not words and hasattr(value, "to_numpy"):  # a pandas column with missing values
            array = np.asarray(value.to_numpy(dtype=float))
    except (ValueError, TypeError) as error:
        raise ValueError(f"{name} = {shown(value)}: must be real numbers ({error})") from None
    return array


def _without_wrapping(name: str, value: Any) -> Any:
    """`value` without an empty mask and without a dimensionless unit."""
    if isinstance(value, list | tuple):
        return [_without_wrapping(name, part) for part in value]
    if isinstance(value, np.ma.MaskedArray):
        masked = int(np.ma.getmaskarray(value).sum())
        if masked:
            raise ValueError(
                f"{name} has {masked} masked elements: must have none; leave them out with "
                ".compressed() or replace them with .filled(number)"
            )
        return value.data
    unit = getattr(value, "units", None) if hasattr(value, "units") else getattr(value, "unit", None)
    if unit is None or callable(unit):
        return value
    if str(unit) not in DIMENSIONLESS:
        raise ValueError(
            f"{name} = {shown(value)}: has the unit {unit}, must be plain numbers; convert to the "
            "units of length and time that all arguments share, and pass the magnitude"
        )
    return getattr(value, "magnitude", value)


def real(name: str, value: object) -> float:
    """`value` as one finite float."""
    if type(value) is float and math.isfinite(value):
        return value  # as nearly always: the way through an array takes 5 us
    array = None if isinstance(value, bool | str) else real_array(name, value)  # type: ignore[arg-type]
    if array is None or array.ndim != 0:
        raise ValueError(f"{name} = {shown(value)}: must be a single real number")
    return float(array)


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
    """`value` as an integer, at least `minimum`, exact as a float; 2.0 is refused, numpy's are not."""
    try:
        if isinstance(value, bool):
            raise TypeError
        number = operator.index(value)  # type: ignore[arg-type]
    except TypeError:
        raise ValueError(f"{name} = {shown(value)}: must be an integer") from None
    if minimum is not None and number < minimum:
        raise ValueError(f"{name} = {shown(number)}: must be >= {minimum}")
    if abs(number) > LARGEST_INTEGER:
        raise ValueError(f"{name} = {shown(number)}: must be at most {LARGEST_INTEGER} in size")
    return number


def wave_count(value: object) -> int:
    """A number of waves on the sheet: an integer up to MOST_WAVES, not 0 (negative runs towards -y)."""
    number = integer("count", value)
    if number == 0:
        raise ValueError("count = 0: must be a non-zero integer")
    if abs(number) > MOST_WAVES:
        raise ValueError(f"count = {number}: must be from -{MOST_WAVES} to {MOST_WAVES}")
    return number


def tolerance(value: object) -> float:
    """A relative tolerance within reach of double precision."""
    number = real("rtol", value)
    if not SMALLEST_RTOL <= number < 1:
        raise ValueError(f"rtol = {number:g}: must be in [{SMALLEST_RTOL:g}, 1)")
    return number


def absolute_tolerance(atol: object, rtol: float, alpha: float, unit: float) -> float:
    """The absolute tolerance of a speed, > 0: as given, or 1e-3 rtol alpha^2 L/T.

    unit: L/T. Speeds are at least of order alpha^2 L/T, so that an alpha for which this is not finite
    is refused here.
    """
    size = alpha * alpha * unit
    if not math.isfinite(size):
        raise ValueError(f"alpha = {alpha:g}: alpha^2 L/T must be finite")
    if atol is not None:
        return positive("atol", atol)
    return max(1e-3 * rtol * size, sys.float_info.min)


def choice(name: str, value: object, allowed: Collection[str]) -> str:
    """`value`, which must be one of the allowed names."""
    if not isinstance(value, str) or value not in allowed:
        raise ValueError(
            f"{name} = {shown(value)}: must be one of {', '.join(repr(str(a)) for a in allowed)}"
        )
    return value


def flag(name: str, value: object) -> bool:
    """`value`, which must be True or False, numpy's included; text such as "no" is neither."""
    if not isinstance(value, bool | np.bool_):
        raise ValueError(f"{name} = {shown(value)}: must be True or False")
    return bool(value)


def label(name: str, value: object) -> str:
    """`value`, which must be non-empty text."""
    if not isinstance(value, str) or not value:
        raise ValueError(f"{name} = {shown(value)}: must be non-empty text")
    return value
