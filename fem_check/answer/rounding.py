"""Numbers with errors, rounded for people; the error is always rounded up."""

import math
from decimal import ROUND_CEILING, ROUND_HALF_EVEN, Decimal
from typing import NamedTuple

FINEST = 1e-7
"""Smallest error shown, relative to the value: nobody reads more digits."""

PLAIN = 1e-4, 1e6
"""Range of magnitudes in which numbers are written without a power of ten."""

MINUS = "\N{MINUS SIGN}"


class Shown(NamedTuple):
    """A value and its error as text; error is empty where the value is exact."""

    value: str
    error: str

    def with_unit(self, unit: str) -> str:
        """Value, error and unit; the unit may be empty."""
        text = f"{self.value} ± {self.error}" if self.error else self.value
        power = ""
        if "e" in self.value:
            number, power = self.value.split("e")
            text = f"({number} ± {self.error.split('e')[0]})e{power}"
        return f"{text} {unit}".strip()


def measured(value: float, error: float) -> Shown:
    """A value with its error, which is rounded up to one digit, or two where the first is 1.

    The value is rounded to the last digit of the error, and the error shown includes this rounding.
    If the error is not finite, the value has three digits and the error is empty.

    >>> from fem_check.answer.rounding import measured
    >>> print(measured(0.098312, 0.000141).with_unit("mm/s"))
    0.09831 ± 0.00015 mm/s
    >>> print(measured(-1234.5, 46.0).with_unit("mm/s"), measured(2.5e-7, 3e-9).with_unit("L/T"))
    −1230 ± 60 mm/s (2.50 ± 0.03)e-07 L/T
    """
    if error == 0 or not math.isfinite(error):
        return Shown(plain(value), "")
    error = max(error, FINEST * abs(value))
    power = _decimal(max(abs(value), error)).adjusted()
    if PLAIN[0] <= 10.0**power < PLAIN[1]:
        power = 0
    exact, wrong = (_decimal(number).scaleb(-power) for number in (value, error))
    last = Decimal(1).scaleb(_last_place(wrong))
    rounded = exact.quantize(last, ROUND_HALF_EVEN)
    wrong = (wrong + abs(exact - rounded)).quantize(last, ROUND_CEILING)
    end = f"e{power:+03d}" if power else ""
    return Shown(_signed(rounded) + end, f"{wrong:f}{end}")


def rounded_up(size: float) -> str:
    """A number >= 0 rounded up to one digit, or two where the first is 1.

    >>> from fem_check.answer.rounding import rounded_up
    >>> print(rounded_up(0.00021), rounded_up(1.41), rounded_up(0), rounded_up(3e-9))
    0.0003 1.5 0 3e-09
    """
    if size == 0 or not math.isfinite(size):
        return f"{size:g}"
    exact = _decimal(size)
    up = exact.quantize(Decimal(1).scaleb(_last_place(exact)), ROUND_CEILING)
    return f"{float(up):g}"


def plain(value: float, digits: int = 3) -> str:
    """A number without an error, to `digits` significant digits.

    >>> from fem_check.answer.rounding import plain
    >>> print(plain(0.8), plain(-0.10702), plain(40.0))
    0.8 −0.107 40
    """
    return f"{value:.{digits}g}".replace("-", MINUS, 1) if value < 0 else f"{value:.{digits}g}"


def _signed(number: Decimal) -> str:
    return f"{number:f}".replace("-", MINUS)


def _last_place(error: Decimal) -> int:
    """Power of ten of the last digit of the error that is shown."""
    first = error.adjusted()
    return first - 1 if error.scaleb(-first) < 2 else first


def _decimal(number: float) -> Decimal:
    """The shortest decimal that represents this double, so that rounding up 0.3 gives 0.3."""
    return Decimal(repr(float(number)))
