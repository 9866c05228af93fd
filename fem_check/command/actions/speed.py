"""`sheetcrawl speed`: has the question answered, and tells the answer as the options want it."""

import json
import shutil
import sys
import warnings
from functools import partial
from pathlib import Path

from fem_check.answer.block import block, why
from fem_check.answer.record import record
from fem_check.answer.units import Units
from fem_check.choice.prediction import predict
from fem_check.choice.result import Prediction
from fem_check.choice.ways import check_shape
from fem_check.command.actions.remarks import tell
from fem_check.command.files import check_files
from fem_check.command.options import Options
from fem_check.command.quantities import Asked, asked
from fem_check.command.status import MET, MISSED
from fem_check.command.text import printable
from fem_check.command.typed import as_typed
from fem_check.command.waiting import Waiting
from linear_theory.common.progress import Report

WIDEST = 100
"""Largest width of the answer, in columns."""

HINTS = "sheetcrawl examples", "--why"


def speed(options: Options, path: Path | None = None) -> int:
    """Answer the options, or a scene file; the exit status.

    Raises ValueError for bad options and files, before any work.
    """
    if options.json and options.csv:
        raise ValueError("--json: must not be combined with --csv")
    check_files(options)
    if path is None:
        with as_typed(options):
            question = asked(options)
        _check_film(options, options.level)
        units, solve = question.units, partial(_predicted, question, options)
    else:
        # Here: it loads all that a scene file may name.
        from fem_check.command.actions.scenes import answered, asked_by_file

        file = asked_by_file(path, options)
        _check_film(options, file.run.level)
        units, solve = file.units, partial(answered, file)
    with warnings.catch_warnings(record=True, action="always") as seen, Waiting() as waiting:
        found = solve(waiting.report)
    print(_told(found, units, options))
    tell(seen)
    _draw(found, units, options)
    return MET if found.converged else MISSED


def _check_film(options: Options, level: str) -> None:
    """Raise ValueError for a film of a level without a shape."""
    if options.movie is not None:
        try:
            check_shape(level)
        except ValueError as problem:
            raise ValueError(f"--movie {options.movie}: {problem}") from None


def _predicted(question: Asked, options: Options, report: Report) -> Prediction:
    rtol, atol, level = question.rtol, question.atol, options.level
    with as_typed(options):
        return predict(question.scene, rtol=rtol, atol=atol, level=level, progress=report)


def _told(found: Prediction, units: Units | None, options: Options) -> str:
    """The answer as printed."""
    if options.json:
        return json.dumps(record(found, units), indent=1)
    if options.csv:
        return table(found, units)
    width = min(shutil.get_terminal_size((WIDEST, 0)).columns, WIDEST)
    text = block(found, units, width, ("", "") if options.why else HINTS)
    if options.why:
        text = f"{text}\n{why(found, width)}"
    return printable(f"\n{text}\n", sys.stdout)


def table(found: Prediction, units: Units | None) -> str:
    """V(t) through one period, in the units of the question."""
    names = (units.time, units.speed) if units else ("time", "length/time")
    rows = zip(found.speed.times.tolist(), found.speed.velocity.tolist(), strict=True)
    return "\n".join([f"t [{names[0]}],V [{names[1]}]", *(f"{t!r},{v!r}" for t, v in rows)])


def _draw(found: Prediction, units: Units | None, options: Options) -> None:
    """Write the requested picture and film."""
    if options.plot is not None:
        from fem_check.output.files import replacing  # here: it loads matplotlib

        (first, *_) = found.plot(units=units)
        with replacing(options.plot) as part:
            first.figure.savefig(part)
    if options.movie is not None:
        found.movie(options.movie, units=units, progress=sys.stderr.isatty())
