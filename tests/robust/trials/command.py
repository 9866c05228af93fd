"""The program under random words."""

import io
import json
import math
from contextlib import redirect_stderr, redirect_stdout

import numpy as np

from fem_check.choice.levels import LEVELS
from fem_check.command import main
from tests.robust.trials.outcome import Outcome

WORDS: tuple[tuple[str, ...], ...] = (
    *(("--alpha", value) for value in ("0.1", "-1e-3", "0", "1e9", "x", "nan")),
    *(("--width", value) for value in ("0.2", "-1")),
    *(("--poisson", value) for value in ("0.3", "2")),
    *(("--count", value) for value in ("2", "-1", "0")),
    *(("--load", value) for value in ("grown", "material", "heavy")),
    *(("--rtol", value) for value in ("0.3", "0.05", "0")),
    *(("--level", level) for level in LEVELS),
    *(("--friction", "viscous"), ("--friction", "tanh"), ("--slip-speed", "0.01")),
    *(("--length", "2"), ("--period", "3"), ("--growth-law", "metric"), ("--area", "undeformed")),
    *(("--sine", "1", "0.2"), ("--cosine", "0.5"), ("--atol", "1e-4"), ("--unknown", "1")),
)


def command(rng: np.random.Generator) -> Outcome:
    """The program under random words: status 0, 1 or 2, one line of complaint, JSON that is JSON."""
    picked = rng.choice(len(WORDS), size=rng.integers(1, 6), replace=False)
    words = ["--alpha", "0.05", "--rtol", "0.3", "--json", *(w for i in picked for w in WORDS[i])]
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err):
        try:
            main(words)
        except SystemExit as end:
            status = end.code if isinstance(end.code, int) else 1
    answered = status in (0, 1) and out.getvalue() != ""
    if answered:
        said = json.loads(out.getvalue(), parse_constant=lambda name: math.nan / 0)
        fine = said["converged"] == (status == 0)
    else:
        fine = status in (1, 2)
    return Outcome(f"{words}: {status} {err.getvalue()}", 0.0 if fine else math.inf, 1.0)
