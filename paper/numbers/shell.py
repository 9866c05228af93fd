"""The nonlinear shell on problems with known answers, as a table of the write-up.

    python -m paper.numbers.shell [--out FILE]

Writes paper/generated/shell.csv: half a minute of computing. Problems and references are those of the
tests (`tests/shell/shell_cases.py`, `tests/shell/test_shell_tables.py`), where their sources stand.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from figures.common.output import tracked
from figures.common.records import Table
from tests.shell import shell_cases, test_shell_tables
from tests.shell.shell_cases import Path as LoadPath

DIGITS = 6
"""Significant digits written: one more than the best reference has."""

QUARTERS = (0.25, 0.5, 0.75, 1.0)


@dataclass(frozen=True)
class Row:
    """problem and element by name, quantity in Typst mathematics; here and reference in units of the
    problem; elements: how many the mesh has."""

    problem: str
    quantity: str
    element: str
    elements: int
    here: float
    reference: float


TABLE = Table(
    Path(__file__).parents[1] / "generated" / "shell.csv",
    Row,
    "python -m paper.numbers.shell",
    "in the units of each problem",
    DIGITS,
)


def bending() -> Iterator[Row]:
    """Cantilevers and the slit annulus: large rotations."""
    shear = "cantilever, end shear"
    yield from _rows(
        shear, ("-u", "w"), 8, lambda e, n: shell_cases.end_shear(e, n), test_shell_tables.SHEAR[1.0]
    )
    circle = test_shell_tables.koiter_circle(1.0)
    path = shell_cases.end_moment("argyris", 4, QUARTERS)
    yield Row("cantilever, end moment", "-u", "argyris", path.elements, path.values[1.0][0], circle[0])
    path = shell_cases.slit_annulus("argyris", 2, 16)
    for name, value, reference in zip(
        ('w "outer"', 'w "inner"'), path.values[1.0], test_shell_tables.ANNULUS, strict=True
    ):
        yield Row("slit annulus, lift", name, "argyris", path.elements, value, reference)


def _rows(
    problem: str,
    names: Sequence[str],
    n: int,
    solve: Callable[[str, int], LoadPath],
    references: Sequence[float],
) -> Iterator[Row]:
    for element in shell_cases.ELEMENTS:
        path = solve(element, n)
        for name, value, reference in zip(names, path.values[1.0], references, strict=True):
            yield Row(problem, name, element, path.elements, value, reference)


def pinched() -> Iterator[Row]:
    """A point load on a semi-cylinder, at half and at full load."""
    path = shell_cases.semi_cylinder("argyris", 6, 6, (0.5, 1.0))
    for share, values in path.values.items():
        reference = test_shell_tables.SEMI_CYLINDER[share]
        name = 'w "full load"' if share == 1 else 'w "half load"'
        yield Row("pinched semi-cylinder", name, "argyris", path.elements, values[0], reference)


def linear() -> Iterator[Row]:
    """Small loads: a clamped plate and the Scordelis-Lo roof."""
    problems = (
        ("clamped plate", "w D\\/q L^4", shell_cases.clamped_plate, test_shell_tables.PLATE),
        ("Scordelis-Lo roof", "w", shell_cases.scordelis_lo, test_shell_tables.ROOF),
    )
    for problem, quantity, solve, reference in problems:
        for element, n in (("bfs", 8), ("argyris", 4)):
            count = n * n if element == "bfs" else 2 * n * n
            yield Row(problem, quantity, element, count, solve(element, n), reference)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments)
    groups = tracked("table of shells", (bending, pinched, linear))
    rows = [row for group in groups for row in group()]
    print(TABLE.write(rows, options.out))


if __name__ == "__main__":
    main()
