"""Internal units in which numbers are of order 1, whatever the user's units of length and time."""

import math


def power_of_two(size: float) -> float:
    """The largest power of two not above size > 0; 1 for size 0, which defines no unit.

    Division by a power of two is exact: results computed from the quotients do not depend on the unit.

    >>> from linear_theory.common.units import power_of_two
    >>> print(power_of_two(1.0), power_of_two(5e9) == 2.0**32, power_of_two(0.7e-9) == 2.0**-31)
    1.0 True True
    """
    return math.ldexp(0.5, math.frexp(size)[1]) if size > 0 else 1.0
