"""Files that the program itself keeps, damaged at random: answers, records, snapshots and runs."""

import atexit
import math
import shutil
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from fem_check import optimise, simulate
from fem_check.files import read
from fem_check.runs import finished, run
from fem_check.sweeps.running import run as run_sweep
from linear_theory import Scene, Sheet, SineWave
from linear_theory.common.errors import SheetcrawlError
from linear_theory.optimisation.climbing import Ascent
from tests.robust.trials.outcome import Outcome
from tests.runs.run_cases import PLANE, draw_nothing
from tests.shell.shell_scenes import planar
from tests.sweeps import sweep_cases

Ask = Callable[[Path], object]
"""What is asked of a folder of kept files: the same answer comes back, or a refusal."""


def _answers(folder: Path) -> object:
    """An optimisation that goes on."""
    scene, over = Scene(Sheet(width=0.1), SineWave(), alpha=0.1), {"growth.alpha": (0.05, 0.2)}
    asked = {"level": "strip", "starts": 1, "check": False, "how": Ascent(iterations=3)}
    found = optimise(scene, over, file=folder / "answers.jsonl", **asked)
    return found.value, found.scene


def _records(folder: Path) -> object:
    """A sweep that goes on, and its records as they are exported."""
    found = run_sweep(sweep_cases.plan(8), folder / "sweep.db", workers=1)
    return [(point, record.mean, record.error, record.state) for point, record in found.rows()]


def _snapshot(folder: Path) -> object:
    """Steps that go on from their last snapshot."""
    found = simulate(planar(), periods=1, steps=8, snapshot=folder / "steps.npz", snapshot_every=5)
    return found.speed.mean, found.states.tobytes()


def _run(folder: Path) -> object:
    """A finished run: the speed, the block, and the motion."""
    if not (folder / "run").exists():
        (folder / "scene.toml").write_text(PLANE)
        file = read(folder / "scene.toml")
        with pytest.MonkeyPatch.context() as patch:
            draw_nothing(patch)
            run(file.scene, folder / "run", file.run, file.units)
    found = finished(folder / "run")
    return found.result["answer"], found.recording.place.tobytes()


KINDS: dict[str, tuple[Ask, str]] = {
    "answers": (_answers, "answers.jsonl"),
    "records": (_records, "sweep.db"),
    "snapshot": (_snapshot, "steps.npz"),
    "motion": (_run, "run/trajectory.nc"),
    "result": (_run, "run/result.json"),
}

REFUSALS = (SheetcrawlError, ValueError)


@cache
def _whole(ask: Ask) -> tuple[Path, object]:
    """A folder in which all files are whole, and the answer from them."""
    folder = Path(tempfile.mkdtemp(prefix="sheetcrawl-kept-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    ask(folder)
    return folder, ask(folder)


def kept(rng: np.random.Generator) -> Outcome:
    """From a damaged file comes what would have come from a whole one, or a refusal in one line."""
    kind = str(rng.choice(list(KINDS)))
    ask, name = KINDS[kind]
    whole, right = _whole(ask)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary) / "kept"
        shutil.copytree(whole, folder)
        done = _damage(folder / name, rng)
        try:
            fine = ask(folder) == right
            words = "answered"
        except REFUSALS as refusal:
            words = str(refusal)
            fine = "\n" not in words and words != ""
    return Outcome(f"{kind}, {done}: {words}", 0.0 if fine else math.inf, 1.0)


def _damage(path: Path, rng: np.random.Generator) -> str:
    """Do something to the file; what was done."""
    data, act = bytearray(path.read_bytes()), int(rng.integers(5))
    at = int(rng.integers(len(data)))
    if act == 0:
        data[at] ^= 1 << int(rng.integers(8))
    elif act == 1:
        data[at : at + 64] = rng.bytes(len(data[at : at + 64]))
    elif act == 2:
        del data[at:]
    elif act == 3:
        del data[at : at + int(rng.integers(1, 200))]
    else:
        digits = [place for place, byte in enumerate(data) if 48 <= byte < 58]
        at = digits[int(rng.integers(len(digits)))]
        data[at] = 48 + (data[at] - 47) % 10
    path.write_bytes(data)
    return f"byte {at}: {('flipped', 'overwritten', 'cut off', 'removed', 'another digit')[act]}"
