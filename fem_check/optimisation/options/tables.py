"""Tables of an optimisation file: their keys, and what these take."""

from typing import Annotated, Any, Literal

from pydantic import Field as Limits

from fem_check.files.fields import Natural, PositiveShare, Table
from fem_check.sweeps.sweep_file import End


class HarmonicsTable(Table):
    """The profile of a travelling wave of given size."""

    count: Natural
    """Harmonics."""
    largest: Annotated[float, Limits(gt=0)] | None = None
    """Of |c|."""
    mean_square: Annotated[float, Limits(gt=0)] | None = None
    """Of c, instead."""
    mean: bool = True
    """Whether the mean of c may differ from 0."""


class BoundTable(Table):
    """Bounds of a number of the answer, or of a sum of fields."""

    at_most: End | None = None
    """E.g. 3 or "0.1 mm/s"."""
    at_least: End | None = None
    """Likewise."""
    exactly: End | None = None
    """Of a sum of fields alone."""
    of: dict[str, Any] | None = None
    """Fields, each with its weight in the sum; left out for a number of the answer."""


class RobustTable(Table):
    """Several regimes."""

    by: Literal["worst", "mean"] = "worst"
    """Of the objective in all regimes."""
    weights: list[Annotated[float, Limits(gt=0)]] | None = None
    """Of the mean, one to a regime."""
    paired: bool = False
    """Whether lists go side by side, instead of every value with every other one."""
    over: dict[str, Any]
    """Fields, each with a list of values, or { low = 0.1, high = 0.3, count = 3 }."""


class OptimiseTable(Table):
    """What is to be best, and how it is searched for."""

    objective: Literal["speed", "speed towards -y", "distance per period", "cost of transport"] = (
        "speed"
    )
    """To be large; cost of transport: to be small."""
    level: (
        Literal["auto", "predict", "cycle", "stepped", "strip", "first order", "second order", "line"]
        | None
    ) = None
    """Instead of that of the scene."""
    rtol: PositiveShare | None = None
    """Of the speeds, 0.1 % unless given."""
    starts: Annotated[int, Limits(ge=1)] = 4
    """Climbs."""
    seed: Annotated[int, Limits(ge=0)] = 0
    """Of the points at random."""
    method: Literal["SLSQP", "trust-constr"] = "SLSQP"
    """Of scipy."""
    check: bool = True
    """Whether the next higher level is asked for the best scene and the given one."""
