"""Random questions, each with a better answer to compare with: does any error understate?

    python -m tests.robust.random_trials FAMILY COUNT [SEED]

asks COUNT questions of one of the FAMILIES and prints every trial whose error is understated and the
largest true error over the stated one. A trial is drawn from (seed, number) alone, so that one that
failed can be asked again. The suite asks the first few of each family (`test_random_trials`).
"""

import io
import json
import math
import sys
import warnings
from collections.abc import Callable
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from fem_check.answer.energy import with_model_errors
from fem_check.choice.levels import LEVELS, finer
from fem_check.choice.prediction import predict
from fem_check.command import main
from fem_check.shell.cycle.motion import UnresolvedError
from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.statics.equilibrium import ConvergenceError
from linear_theory import (
    Contact,
    CrawlSpeed,
    FieldWave,
    NotConvergedError,
    Scene,
    Sheet,
    SineWave,
    TravellingWave,
    crawl_speed,
    line_balance,
)
from linear_theory.friction.load import WEIGHTS as LOADS

REFUSALS = (ValueError, NotConvergedError, ConvergenceError, UnresolvedError)
LAWS = ("exp", "linear", "metric")


@dataclass(frozen=True)
class Outcome:
    """What a trial found. stated: its error and that of the better answer together; words: the
    question, and what was refused of it, if anything."""

    words: str
    true: float = 0.0
    stated: float = 0.0

    @property
    def ratio(self) -> float:
        """True error over the stated one; 0 for a refusal."""
        return self.true / self.stated if self.true > 0 else 0.0


Trial = Callable[[np.random.Generator], Outcome]


@cache
def outcome(family: str, seed: int, number: int) -> Outcome:
    """Trial `number` of a family."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # remarks on regimes and reach
        return FAMILIES[family](np.random.default_rng([seed, number]))


def a_sheet(rng: np.random.Generator, widest: float = 2.0) -> Sheet:
    width = float(np.exp(rng.uniform(np.log(0.05), np.log(widest))))
    return Sheet(width=width, poisson=float(rng.uniform(-0.5, 0.5)))


def a_wave(rng: np.random.Generator, harmonics: int = 4) -> TravellingWave:
    """A sine in half of all cases, else a few harmonics that fall off, with or without a mean."""
    count = int(rng.choice([1, 1, 1, 2, -1, -2, 3]))
    if rng.random() < 0.5:
        return SineWave(count)
    order = np.arange(1, rng.integers(2, harmonics + 1) + 1)
    cosine, sine = rng.normal(size=(2, order.size)) / order**1.5
    size = np.abs(cosine).sum() + np.abs(sine).sum()
    mean = float(rng.choice([0.0, rng.uniform(-0.3, 0.3)]))
    return TravellingWave(cosine / size, sine / size, count, 1.0, mean)


def a_law(rng: np.random.Generator, alpha: float) -> dict[str, Any]:
    """Friction; slip speeds from dry to viscous, in units of alpha L/T."""
    name = str(rng.choice(["coulomb", "coulomb", "tanh", "viscous"]))
    slip = {"slip_speed": abs(alpha) * 10.0 ** rng.uniform(-3, 1)} if name == "tanh" else {}
    return {"friction": name, **slip}


def an_alpha(rng: np.random.Generator, largest: float) -> float:
    return float(rng.choice([-1, 1]) * np.exp(rng.uniform(np.log(1e-3), np.log(largest))))


def compared(found: CrawlSpeed, better: CrawlSpeed, words: str) -> Outcome:
    """All three components where there are such, and the power."""
    pairs = [(abs(found.power.value - better.power.value), found.power.error + better.power.error)]
    if found.rigid_mean is None or better.rigid_mean is None:
        pairs.append((abs(found.mean - better.mean), found.error + better.error))
    else:
        differences = abs(found.rigid_mean - better.rigid_mean)
        pairs += zip(differences, found.rigid_error + better.rigid_error, strict=True)
    true, stated = np.array(pairs).T
    worst = int(np.argmax(true / np.maximum(stated, 1e-300)))
    return Outcome(words, float(true[worst]), float(stated[worst]))


def speed(rng: np.random.Generator) -> Outcome:
    """`crawl_speed` of either order, against the other method to a tenth of the tolerance."""
    sheet, wave, alpha = a_sheet(rng), a_wave(rng), an_alpha(rng, 0.3)
    order, method = int(rng.choice([1, 1, 2])), str(rng.choice(["auto", "ritz"]))
    easy = order == 1 and sheet.width < 0.5 and abs(wave.count) == 1
    rtol = 10.0 ** rng.uniform(-5 if easy else -3.5, -2)
    options = {"load": str(rng.choice(LOADS)), "order": order, **a_law(rng, alpha)}
    if order == 2:
        options |= {
            "growth_law": str(rng.choice(LAWS)),
            "area": str(rng.choice(["grown", "undeformed"])),
        }
    words = f"{sheet}, {wave}, {alpha:.4g}, {options}, {method}, rtol {rtol:.1e}"
    other = {"auto": "ritz", "ritz": "auto"}[method] if order == 1 else "ritz"
    try:
        found = crawl_speed(sheet, wave, alpha, rtol=rtol, method=method, **options)
        better = crawl_speed(sheet, wave, alpha, rtol=rtol / 10, method=other, **options)
    except REFUSALS as refusal:
        return Outcome(f"{words}: {refusal}")
    return compared(found, better, words)


def line(rng: np.random.Generator) -> Outcome:
    """`line_balance` of a travelling wave to rounding, against the same wave in samples."""
    wave, alpha = a_wave(rng), an_alpha(rng, 0.9)
    options = {
        "load": str(rng.choice(LOADS)),
        "growth_law": str(rng.choice(LAWS)),
        "body": str(rng.choice(["line", "strip"])),
        **a_law(rng, alpha),
    }
    rtol = 10.0 ** rng.uniform(-4, -2)
    words = f"{wave}, {alpha:.4g}, {options}, rtol {rtol:.1e}"
    sampled = FieldWave(wave.value, wave.period, wave.rate)
    try:
        exact = line_balance(wave, alpha, **options)
        found = line_balance(sampled, alpha, rtol=rtol, length=1.0, **options)
    except REFUSALS as refusal:
        return Outcome(f"{words}: {refusal}")
    return compared(found, exact, words)


def prediction(rng: np.random.Generator) -> Outcome:
    """`predict`, against the nonlinear sheet on three times the default elements each way."""
    sheet = Sheet(width=float(rng.uniform(0.1, 1.0)), poisson=float(rng.uniform(0, 0.5)))
    wave, alpha = SineWave(int(rng.choice([1, -1, 2]))), an_alpha(rng, 0.25)
    load, law = str(rng.choice(LOADS)), str(rng.choice(LAWS))
    rtol = 10.0 ** rng.uniform(-2.5, -0.5)
    scene = Scene(sheet, wave, alpha, growth_law=law, contact=Contact(load))
    words = f"{sheet}, {wave}, {scene.growth}, {load} load, rtol {rtol:.1e}"
    try:
        found = predict(sheet, wave, alpha, law, load=load, rtol=rtol)
        better = cycle_speed(finer(scene, 3), rtol=3e-4, atol=3e-5 * alpha**2)
    except REFUSALS as refusal:
        return Outcome(f"{words}: {refusal}")
    return compared(with_model_errors(found.speed), better, words)


WORDS: tuple[tuple[str, ...], ...] = (
    *(("--alpha", value) for value in ("0.1", "-1e-3", "0", "1e9", "x", "nan")),
    *(("--width", value) for value in ("0.2", "-1")),
    *(("--poisson", value) for value in ("0.3", "2")),
    *(("--count", value) for value in ("2", "-1", "0")),
    *(("--load", value) for value in ("grown", "material", "heavy")),
    *(("--rtol", value) for value in ("0.3", "0.05", "0")),
    *(("--method", level) for level in LEVELS),
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


FAMILIES: dict[str, Trial] = {
    "speed": speed,
    "line": line,
    "prediction": prediction,
    "command": command,
}


def run(family: str, count: int, seed: int) -> float:
    """Print what fails, and the largest ratio, which is returned."""
    worst = 0.0
    for number in range(count):
        found = outcome(family, seed, number)
        worst = max(worst, found.ratio)
        if found.ratio > 1:
            print(f"{number}: {found.ratio:.3g} {found.words}", flush=True)
    print(
        f"{family}, {count} trials of seed {seed}: largest true error over the stated one {worst:.3g}"
    )
    return worst


if __name__ == "__main__":
    sys.exit(run(sys.argv[1], int(sys.argv[2]), int([*sys.argv, "1"][3])) > 1)
