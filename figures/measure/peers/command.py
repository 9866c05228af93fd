"""Two scenes on the ground by this package and by codes for soft bodies that install as wheels.

    python -m figures.measure.peers [--out FILE]

Writes figures/data/peers.csv, two minutes of the processor and, at the first time, four more in
which kernels are compiled; it goes on where the file ends. `make peers` makes the environment of
the other codes, build/peers-venv, from requirements-peers.lock, and draws figure and page too. Each
run of another code is a process of that environment. Scenes and exact results:
`figures.measure.peers.problems`.
"""

import json
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from figures.common.filling import Filling
from figures.common.folders import DATA, FIGURES
from figures.common.records import Table
from figures.measure.meters import machine
from figures.measure.peers import ours
from figures.measure.peers.problems import MUJOCO, NEWTON, OURS, Answer, Case, cases, exact

ROOT = FIGURES.parent
PEERS = ROOT / "build" / "peers-venv" / "bin" / "python"
MODULES = {MUJOCO: "mujoco_flex", NEWTON: "newton_vbd"}

LONGEST = 900
"""Seconds after which a run is stopped."""


@dataclass(frozen=True)
class Row:
    """Distance or height in m, its exact value, and the relative error; drift in m/s, see `Answer`;
    seconds of the processor; NaN where the run failed, and the remark why ("none" if it did not)."""

    problem: str
    code: str
    knob: str
    value: float
    exact: float
    error: float
    drift: float
    seconds: float
    version: str
    remark: str


TABLE = Table(
    DATA / "peers.csv",
    Row,
    "python -m figures.measure.peers",
    f"lengths in m, drift in m/s, processor seconds of one thread: {machine()}",
    4,
)


def measured(case: Case) -> Row:
    """A run and what is wrong with its result."""
    found = ours.solve(case) if case.code == OURS else _elsewhere(case)
    true = exact(case.problem)
    return Row(
        case.problem,
        case.code,
        case.knob,
        found.value,
        true,
        abs(found.value / true - 1),
        found.drift,
        found.seconds,
        found.version,
        found.remark or "none",
    )


def _elsewhere(case: Case) -> Answer:
    """By a process of the other environment, whose last line is the answer."""
    nan = float("nan")
    module = f"figures.measure.peers.{MODULES[case.code]}"
    words = [str(PEERS), "-m", module, json.dumps(asdict(case))]
    try:
        run = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, timeout=LONGEST)
    except subprocess.TimeoutExpired:
        return Answer(nan, nan, nan, "none", f"not done in {LONGEST} s")
    if run.returncode != 0:
        said = (run.stderr.strip().splitlines() or ["no message"])[-1]
        return Answer(nan, nan, nan, "none", said)
    return Answer(**json.loads(run.stdout.strip().splitlines()[-1]))


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure what is missing, and print the table."""
    options = TABLE.options(__doc__, arguments)
    if not Path(PEERS).exists():
        sys.exit(f"{PEERS.relative_to(ROOT)}: does not exist; `make peers` makes it")
    by_key = {(case.problem, case.code, case.knob): case for case in cases()}
    filling = Filling(TABLE, options.out, lambda row: (row.problem, row.code, row.knob))
    for row in filling.fill(list(by_key), lambda key: measured(by_key[key])):
        print(
            f"{row.problem:<6} {row.code:<12} {row.knob:<16} error {row.error:.1e}, "
            f"drift {row.drift:.1e} m/s, {row.seconds:.2g} s  {row.remark}"
        )
    print(options.out)
