"""Units in which numbers are of order 1, whatever the unit of length or time of the user is."""

import math


def power_of_two(size: float) -> float:
    """The largest power of two up to a size > 0; 1 for the size 0, which has no unit of its own.

    To divide by it rounds nothing: what is computed from the quotients does not depend on the unit.

    >>> from linear_theory.common.units import power_of_two
    >>> print(power_of_two(1.0), power_of_two(5e9) == 2.0**32, power_of_two(0.7e-9) == 2.0**-31)
    1.0 True True
    """
    return math.ldexp(0.5, math.frexp(size)[1]) if size > 0 else 1.0
