"""The command `sheetcrawl`: the one question from the shell.

    sheetcrawl --alpha 0.25                       the paper's sheet and wave, to 1 %
    sheetcrawl --alpha 0.25 --width 0.2 --rtol 1e-3 --json

Exit status: 0 where the tolerance is met, 1 where it is not or the answer cannot be written, 2 for bad
arguments, 130 after Ctrl-C, 141 where the reader of the answer has gone (`sheetcrawl ... | true`).
Warnings go to stderr, a line each.
"""

import argparse
import contextlib
import json
import math
import os
import re
import sys
import warnings
from collections.abc import Sequence
from typing import Any, NoReturn

import numpy as np

from fem_check.prediction import METHODS, Prediction, predict
from linear_theory.errors import SheetcrawlError
from linear_theory.friction import LAWS, LOADS
from linear_theory.second_field import AREAS, GROWTH_LAWS
from linear_theory.sheet import Sheet
from linear_theory.waves import SineWave, TravellingWave

MET, MISSED, BAD_ARGUMENTS = 0, 1, 2
INTERRUPTED, CLOSED_PIPE = 130, 141
"""As shells report a program that SIGINT or SIGPIPE has ended."""

_NEGATIVE = re.compile(r"-(\d+\.?\d*|\.\d+)(e[-+]?\d+)?|-inf(inity)?|-nan", re.IGNORECASE)


class _Parser(argparse.ArgumentParser):
    """Answers bad arguments by one line, without the usage."""

    def error(self, message: str) -> NoReturn:
        self.exit(BAD_ARGUMENTS, f"{self.prog}: {message}\n")


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Answer and exit."""
    try:
        status = run(sys.argv[1:] if arguments is None else arguments)
        sys.stdout.flush()
    except KeyboardInterrupt:
        print("sheetcrawl: interrupted", file=sys.stderr)
        status = INTERRUPTED
    except BrokenPipeError:  # who reads has seen enough
        _forget_output()
        status = CLOSED_PIPE
    except OSError as problem:
        _forget_output()
        print(f"sheetcrawl: cannot write the answer: {problem}", file=sys.stderr)
        status = MISSED
    sys.exit(status)


def run(arguments: Sequence[str]) -> int:
    """Print the answer; the exit status."""
    # argparse takes -1e-3 for an option, but not where a blank is before it
    options = parser().parse_args([f" {a}" if _NEGATIVE.fullmatch(a) else a for a in arguments])
    with warnings.catch_warnings(record=True, action="always") as seen:
        try:
            found = answer(options)
        except ValueError as problem:
            parser().error(str(problem))
        except SheetcrawlError as problem:
            sys.exit(f"sheetcrawl: {problem}")  # status 1
    print(json.dumps(record(found), indent=1) if options.json else words(found))
    for warning in seen:
        print(f"sheetcrawl: warning: {warning.message}", file=sys.stderr)
    return MET if found.converged else MISSED


def _forget_output() -> None:
    """Let what is not yet written go nowhere, or the interpreter would try again at its end."""
    with contextlib.suppress(OSError, ValueError):  # a stream that stands for stdout has no number
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def answer(options: argparse.Namespace) -> Prediction:
    """Ask `predict`. Raises what it raises."""
    sheet = Sheet(options.length, options.width, options.poisson)
    return predict(
        sheet,
        _wave(options),
        options.alpha,
        options.growth_law,
        options.area,
        options.load,
        options.friction,
        options.slip_speed,
        options.rtol,
        options.atol,
        options.method,
    )


def words(found: Prediction) -> str:
    """The answer for people."""
    speed = found.speed
    lines = [
        f"V = {found.mean:.6g} length/time, error {found.error:.1g}"
        f" (numbers {speed.error:.1g}, model {speed.model_error:.1g})",
        f"level: {found.reason}",
        f"model: {speed.model}; {speed.regime} friction",
        f"left out: {'; '.join(found.left_out)}",
        f"cost: {found.seconds:.2g} s",
    ]
    if not found.converged:
        lines.insert(1, "the tolerance is NOT met, or not known to be")
    return "\n".join(lines)


def record(found: Prediction) -> dict[str, Any]:
    """The answer for programs, in length/time and seconds; what is unknown is None."""
    speed = found.speed
    numbers = {
        "mean": found.mean,
        "error": found.error,
        "numerical_error": speed.error,
        "model_error": speed.model_error,
        "slip_ratio": speed.slip_ratio,
        "seconds": found.seconds,
    }
    return {
        **{name: value if math.isfinite(value) else None for name, value in numbers.items()},
        "converged": found.converged,
        "regime": speed.regime,
        "level": found.level,
        "reason": found.reason,
        "model": speed.model,
        "reach": speed.reach,
        "left_out": list(found.left_out),
    }


def parser() -> argparse.ArgumentParser:
    """Options, named and defaulted like the arguments of `predict`, `Sheet` and the waves."""
    options = _Parser(
        prog="sheetcrawl", description="How fast a sheet driven by a wave of growth crawls."
    )
    options.add_argument("--alpha", type=float, required=True, help="growth coupling")
    sheet = options.add_argument_group("sheet")
    sheet.add_argument("--length", type=float, default=1.0)
    sheet.add_argument("--width", type=float, default=0.5)
    sheet.add_argument("--poisson", type=float, default=0.5)
    wave = options.add_argument_group("wave, towards +y; a sine unless harmonics are given")
    wave.add_argument("--count", type=int, default=1, help="waves on the sheet, negative towards -y")
    wave.add_argument("--period", type=float, default=1.0)
    for name in ("sine", "cosine"):
        wave.add_argument(f"--{name}", type=float, nargs="+", default=[], metavar="AMPLITUDE")
    model = options.add_argument_group("model")
    for name, names in (
        ("growth-law", GROWTH_LAWS),
        ("area", AREAS),
        ("load", LOADS),
        ("friction", LAWS),
    ):
        model.add_argument(f"--{name}", choices=tuple(names), default=next(iter(names)))
    model.add_argument("--slip-speed", type=float, help="of tanh friction, length/time")
    cost = options.add_argument_group("tolerance and level")
    cost.add_argument("--rtol", type=float, default=1e-2, help="of numbers and model together")
    cost.add_argument("--atol", type=float, help="length/time")
    cost.add_argument("--method", choices=METHODS, default="auto")
    cost.add_argument("--json", action="store_true", help="print the answer as JSON")
    return options


def _wave(options: argparse.Namespace) -> TravellingWave:
    if not options.sine and not options.cosine:
        return SineWave(options.count, options.period)
    size = max(len(options.sine), len(options.cosine))
    cosine, sine = (
        np.pad(values, (0, size - len(values))) for values in (options.cosine, options.sine)
    )
    return TravellingWave(cosine, sine, options.count, options.period)
