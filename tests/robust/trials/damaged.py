"""`sheetcrawl check` of scene files that are damaged at random."""

import io
import math
import tempfile
from contextlib import redirect_stderr, redirect_stdout
from pathlib import Path

import numpy as np

from fem_check import files
from fem_check.command import main
from tests.robust.trials.outcome import Outcome

SCENES = Path(files.__file__).parent / "scenes"

TOKENS = (
    b"nan",
    b"-1",
    b"0",
    b"1e400",
    b'"x"',
    b"[]",
    b"{}",
    b"true",
    b'"3 kg"',
    b"\xff",
    b"\x00",
    b"=",
    b"[[",
)


def damaged(rng: np.random.Generator) -> Outcome:
    """Status 0 where it is still a scene, else 1 or 2 with something said, never a traceback."""
    path = str(rng.choice(sorted(str(path) for path in SCENES.glob("*.toml"))))
    lines = Path(path).read_bytes().split(b"\n")
    done = [_damage(lines, rng) for _ in range(rng.integers(1, 4))]
    out, err, status = io.StringIO(), io.StringIO(), -1
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "scene.toml"
        place.write_bytes(b"\n".join(lines))
        for beside in SCENES.glob("*.csv"):
            (Path(folder) / beside.name).write_bytes(beside.read_bytes())
        with redirect_stdout(out), redirect_stderr(err):
            try:
                main(["check", str(place)])
            except SystemExit as end:
                status = end.code if isinstance(end.code, int) else 1
    fine = status == 0 or (
        status in (1, 2) and "Traceback" not in err.getvalue() and err.getvalue() != ""
    )
    words = f"{Path(path).name}, {', '.join(done)}: {status} {err.getvalue()}"
    return Outcome(words, 0.0 if fine else math.inf, 1.0)


def _damage(lines: list[bytes], rng: np.random.Generator) -> str:
    """Do something to one of the lines; what was done."""
    place = int(rng.integers(len(lines)))
    line, kind = lines[place], int(rng.integers(6))
    token = TOKENS[int(rng.integers(len(TOKENS)))]
    key, _, _ = line.partition(b"=")
    at = int(rng.integers(len(line) + 1))
    if kind == 0:
        del lines[place]
        lines.append(b"")
    elif kind == 1:
        lines.insert(place, line)
    elif kind == 2:
        lines[place] = key + b"= " + token
    elif kind == 3:
        lines[place] = line[:at] + token + line[at:]
    elif kind == 4:
        lines[place] = line[:at] + line[at + 1 :]
    else:
        del lines[place + 1 :]
        lines[place] = line[:at]
    return f"line {place} {('dropped', 'twice', 'given', 'inserted', 'cut', 'truncated')[kind]}"
