"""Options as they are typed: their names and their quantities, for messages in the user's words."""

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


def option(name: str) -> str:
    """As it is typed."""
    return f"--{name.replace('_', '-')}"
