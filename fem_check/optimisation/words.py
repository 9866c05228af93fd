"""Numbers of an optimum in words."""

from fem_check.answer.rounding import measured, plain
from linear_theory.common.estimate import Estimate

EXACT = 1e-5
"""Relative errors below it are not shown: five digits are."""


LITTLE = 1e-4
"""Shares below it are rounding and what the search leaves."""


def shown(value: Estimate) -> str:
    """A value with its error, where five digits show it.

    >>> from fem_check.optimisation.words import shown
    >>> from linear_theory import Estimate
    >>> print(shown(Estimate(0.19204, 3e-4)), shown(Estimate(0.123456, 1e-16)), sep=", ")
    0.1920 ± 0.0004, 0.12346
    """
    if value.error < EXACT * abs(value.value):
        return plain(value.value, 5)
    return measured(value.value, value.error).with_unit("").strip()


def percent(share: float) -> str:
    """A share >= 0, which is not told where it is below LITTLE.

    >>> from fem_check.optimisation.words import percent
    >>> print(percent(0.0123), percent(1e-9), sep=", ")
    1.2 %, below 0.01 %
    """
    return f"{plain(100 * share, 2)} %" if share >= LITTLE else f"below {plain(100 * LITTLE)} %"


def against(value: float, before: float) -> str:
    """One value beside another one, that of the scene as it was given.

    >>> from fem_check.optimisation.words import against
    >>> print(against(0.3, 0.1), against(0.1, 0.1), against(0.3, -0.1), sep=", ")
    3 times the 0.1 as given, 0.1 as given, −0.1 as given
    """
    if value * before <= 0 or plain(value / before) == "1":
        return f"{plain(before)} as given"
    return f"{plain(value / before)} times the {plain(before)} as given"
