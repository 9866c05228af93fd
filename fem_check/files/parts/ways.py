"""Keys of a table of which exactly one must be given."""

from collections.abc import Sequence

from fem_check.files.fields import Table


def way_of(table: Table, ways: Sequence[str]) -> str:
    """The one of these keys that a table has. Raises ValueError for none and for several.

    >>> from fem_check.files.parts.ways import way_of
    >>> from fem_check.files.tables import GrowthTable
    >>> print(way_of(GrowthTable(alpha=0.1), ("alpha", "swelling")))
    alpha
    """
    said = [name for name in ways if getattr(table, name) is not None]
    if not said:
        raise ValueError(f"one of {', '.join(ways)} must be given")
    if len(said) > 1:
        raise ValueError(f"{' and '.join(said)}: only one of {', '.join(ways)} may be given")
    return said[0]
