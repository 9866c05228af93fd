"""The nonlinear shell on problems with known answers, as a table of the write-up.

    python -m paper.numbers.shell [--out FILE]

Writes paper/generated/shell.csv: half a minute of computing. Problems and references are those of the
tests (`tests/shell_cases.py`, `tests/test_shell_tables.py`), where their sources stand.
"""

import argparse
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from figures.common import output
from tests import shell_cases, test_shell_tables
from tests.shell_cases import Path as LoadPath

PATH = Path(__file__).parents[1] / "generated" / "shell.csv"
DIGITS = 6
"""Significant digits written: one more than the best reference has."""

QUARTERS = (0.25, 0.5, 0.75, 1.0)


class Row(NamedTuple):
    """problem and element by name, quantity in Typst mathematics; here and reference in units of the
    problem; elements: how many the mesh has."""

    problem: str
    quantity: str
    element: str
    elements: int
    here: float
    reference: float


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


def write(rows: Sequence[Row], path: Path = PATH) -> Path:
    """The rows as CSV."""
    columns = zip(*rows, strict=True)
    table = {name: np.array(values) for name, values in zip(Row._fields, columns, strict=True)}
    return output.write_csv(path, table, DIGITS)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    parser = argparse.ArgumentParser(prog="paper.numbers.shell", description=main.__doc__)
    parser.add_argument("--out", type=Path, default=PATH, metavar="FILE")
    options = parser.parse_args(arguments)
    groups = (bending, pinched, linear)
    rows: list[Row] = []
    with output.Progress("table of shells", len(groups)) as progress:
        for group in groups:
            rows += group()
            progress.advance()
    print(write(rows, options.out))


if __name__ == "__main__":
    main()
