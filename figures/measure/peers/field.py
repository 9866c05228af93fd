"""The displacement of the paper's sheet as it grows: this package, NGSolve and SfePy in one run.

    build/peers-venv/bin/python -m figures.measure.peers.field [--out FILE]

Writes figures/data/peers_field.csv, half a minute. `make peers` runs it in the environment of the other
codes, into which the pins of this package are installed, too. NGSolve is a wheel; SfePy is built from
its sources, so that it is measured where somebody has installed it there. Errors are relative L2 errors
at the worst phase, as in panel (a) of `make cost`.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib.metadata import version

from figures.common.folders import DATA
from figures.common.records import Table
from figures.measure.cost.cases import P4, RITZ, TAIL, Case, measured
from figures.measure.cost.fields import Fields
from figures.measure.cost.peers.peer import MODULES
from figures.measure.meters import machine
from linear_theory import __version__

OURS = {TAIL: "modes", RITZ: "degree", P4: "L/size"}
"""Ways of this package that are compared, and what is varied."""

PATIENCE = 0.4
"""Seconds for the repeats of one measurement."""


@dataclass(frozen=True)
class Row:
    """A solution: what is varied and its value, relative error, seconds of the processor, version."""

    code: str
    knob: str
    value: int
    error: float
    seconds: float
    version: str


TABLE = Table(
    DATA / "peers_field.csv",
    Row,
    "python -m figures.measure.peers.field",
    f"relative errors, processor seconds of one thread: {machine()}",
    4,
)


def cases(fields: Fields) -> Iterator[Case]:
    """Of this package one series, one basis of polynomials, one element; all of the other codes."""
    for case in fields.cases():
        other = any(case.level.lower().startswith(name) for name in MODULES)
        if other or OURS.get(case.level) == case.knob:
            yield case


def row(case: Case) -> Row:
    """One case, solved and timed."""
    point = measured(case, PATIENCE)
    name = next((name for name in MODULES if case.level.lower().startswith(name)), "sheetcrawl")
    code = case.level if name in MODULES else f"sheetcrawl, {case.level}"
    return Row(code, case.knob, int(case.value), point.error, point.seconds, f"{name} {_version(name)}")


def _version(name: str) -> str:
    return __version__ if name == "sheetcrawl" else version(name)


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure all that is installed, and print the table."""
    options = TABLE.options(__doc__, arguments)
    rows = [row(case) for case in cases(Fields())]
    for one in rows:
        print(f"{one.code:<28} {one.knob} {one.value:<5} error {one.error:.1e}, {one.seconds:.2g} s")
    print(TABLE.write(rows, options.out))


if __name__ == "__main__":
    main()
