"""A row of the table of best numbers, `figures.measure.optimise.scan`."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Row:
    """A question and both answers.

    found, scanned: the numbers in turn; spacing: of the grid; value, error: V in L/T that the search
    has found, towards the side that is asked for, scan_value, scan_error likewise; evaluations, seconds
    of the processor, of all starts and of the scan; ended: starts within 1 % of the best.
    """

    question: str
    names: str
    found: str
    scanned: str
    spacing: str
    value: float
    error: float
    scan_value: float
    scan_error: float
    ended: int
    evaluations: int
    places: int
    seconds: float
    scan_seconds: float


def told(numbers: Sequence[float]) -> str:
    """Numbers in a cell.

    >>> from figures.measure.optimise.rows import told
    >>> print(told([0.25, 1.23456]))
    0.25 1.235
    """
    return " ".join(f"{number:.4g}" for number in numbers)
