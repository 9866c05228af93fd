"""Options as they are typed: their names and their quantities, for messages in the user's words."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from fem_check.files.quantities import UNIT_OF_ANGLE, Quantity, direction, read


def quantity(name: str, text: str, kind: str) -> Quantity:
    """A number and its unit. Raises ValueError for anything else, and for a unit of something else."""
    try:
        return read(text, kind)
    except ValueError as problem:
        raise ValueError(f"{option(name)} {text!r}: {problem}") from None


def angle(name: str, text: str) -> float:
    """A direction in radians.

    Raises ValueError for one without a unit, which might be either, and beyond half a turn.
    """
    found = quantity(name, text, "angle")
    if found.unit is None and found.number:
        raise ValueError(f"{option(name)} {text!r}: {UNIT_OF_ANGLE}")
    try:
        return direction(found)
    except ValueError as problem:
        raise ValueError(f"{option(name)} {text!r}: {problem}") from None


def share(name: str, text: str) -> float:
    """A fraction, plain or in per cent."""
    found = quantity(name, text, "share")
    return found.into("dimensionless")


IN_A_FILE = {
    **dict.fromkeys(("--mu", "--coefficient", "--friction-coefficient"), "[friction] coefficient"),
    **dict.fromkeys(("--incline", "--slope"), "[gravity] incline"),
    **dict.fromkeys(("--weight", "--density"), "[gravity] weight or density"),
    "--young": "[sheet] young",
    "--bending": "[bending]",
    "--ground": "[ground]",
    "--outline": "[outline]",
}
"""Options that `speed` does not have, as they do not matter for a stiff flat sheet on level ground, and
where a scene file has them."""


MEANT = {
    **dict.fromkeys(
        ("--waves", "--wave-count", "--number"), "the number of waves on the sheet is --count"
    ),
    **dict.fromkeys(("--nu", "--poissons-ratio", "--poisson-ratio"), "Poisson's ratio is --poisson"),
    **dict.fromkeys(("--swelling", "--amplitude"), "growth of lengths at the crest is --growth '12 %'"),
    "--method": "the level of theory is --level",
}
"""What is meant by options that `speed` has by another name."""


def elsewhere(name: str) -> str:
    """Where there is what an option that is not there asks for; "" for other options.

    >>> from fem_check.command.typed import elsewhere
    >>> print(elsewhere("--young"))
    --young: is for scene files, as [sheet] young; sheetcrawl new hydrogel writes one to change
    """
    if name in MEANT:
        return f"{name}: is not an option; {MEANT[name]}"
    if name not in IN_A_FILE:
        return ""
    table = IN_A_FILE[name]
    mu = "; a stiff sheet on dry ground has the same speed for any" if "coefficient" in table else ""
    return f"{name}: is for scene files, as {table}{mu}; sheetcrawl new hydrogel writes one to change"


def option(name: str) -> str:
    """As it is typed."""
    return f"--{name.replace('_', '-')}"


NAMED = re.compile(r"(\w+)(?: = [^:]*| contains [^:]*|): ")
"""The argument, with its value, at the start of a message of the library."""


@contextmanager
def as_typed(options: Any) -> Iterator[None]:
    """Within it a ValueError that names an argument of the library names the option that was typed.

    >>> from fem_check.command.options import Options
    >>> from fem_check.command.typed import as_typed
    >>> with as_typed(Options(forward=-1.0)):
    ...     raise ValueError("forward = -1: must be > 0")
    Traceback (most recent call last):
    ...
    ValueError: --forward -1: must be > 0
    """
    try:
        yield
    except ValueError as problem:
        said = NAMED.match(str(problem))
        value = getattr(options, said[1], None) if said else None
        if said is None or value is None or value == getattr(type(options)(), said[1]):
            raise
        shown = f"{value:g}" if isinstance(value, float) else repr(value)
        raise ValueError(f"{option(said[1])} {shown}: {str(problem)[said.end() :]}") from None
