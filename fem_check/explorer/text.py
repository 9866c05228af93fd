"""The numbers of the page as HTML; `data-` attributes hold them to the last digit."""

import html
import math
from collections.abc import Mapping

from fem_check.answer.block import LEVEL_WORDS
from fem_check.answer.rounding import measured, rounded_up
from fem_check.explorer.nonlinear import Predicted
from fem_check.explorer.small_strain import FIRST, STRIP, Answer
from linear_theory.common.progress import Progress

UNIT = "length/period"
"""Of speeds: the unit of length of the sliders per period of the wave."""

PREDICTED = "nonlinear"
"""Row of the answer of `predict`."""

ROWS = {STRIP: "Narrow strip", FIRST: "Sheet, small strain", PREDICTED: "Sheet, nonlinear"}
"""Rows of the table by level."""

CALLS = {STRIP: "predict, level='strip'", FIRST: "crawl_speed", PREDICTED: "predict"}
"""What a row is in Python."""

Found = Answer | Predicted | Progress | None
"""Content of a row: None and Progress while it is being computed."""


def table(found: Mapping[str, Found]) -> str:
    """Speed, error and cost by level; found: content of the rows by level.

    >>> from fem_check.explorer.text import table
    >>> from fem_check.explorer.small_strain import Answer
    >>> shown = table({"first order": Answer("first order", 0.1, 0.0226, 0.0003, 0.002, 0.03)})
    >>> "0.0226 ± 0.0023" in shown, "30 ms" in shown
    (False, True)
    """
    rows = "".join(_row(level, found.get(level)) for level in ROWS)
    heads = "", f"V, {UNIT}", "numerical error", "distance to the nonlinear sheet", "took"
    head = "".join(f"<th>{words}</th>" for words in heads)
    return f"<table class='speeds'><tr>{head}</tr>{rows}</table>"


def headline(found: Mapping[str, Found]) -> str:
    """The best speed known so far, in one line, and what is to be thought of it."""
    last = found.get(PREDICTED)
    if isinstance(last, Predicted) and math.isnan(last.mean):
        return "<h2>No answer</h2><small>the sheet has none here, see the sentences below</small>"
    for level in reversed(ROWS):
        one = found.get(level)
        if isinstance(one, Answer | Predicted) and math.isfinite(one.mean):
            words = "; ".join([ROWS[level].lower(), *_doubts(one)])
            return f"<h2>V = {_speed(one)} {UNIT}</h2><small>{words}</small>"
    return "<h2>V: computing</h2><small>&nbsp;</small>"


def _doubts(one: Answer | Predicted) -> list[str]:
    """What a speed in the headline lacks."""
    found = ["distance to the nonlinear sheet unknown"] if math.isnan(one.model_error) else []
    if isinstance(one, Answer):
        found.append("the nonlinear answer follows")
    elif not one.converged:
        found.append("the tolerance is not met")
    return found


def messages(found: Mapping[str, Found]) -> str:
    """What is wrong or to be minded, one sentence per level; empty if nothing is."""
    lines = [
        f"<p><b>{ROWS[level]}</b>: {html.escape(one.problem)}.</p>"
        for level in ROWS
        if (one := found.get(level)) and isinstance(one, Answer | Predicted) and one.problem
    ]
    return f"<div class='messages' role='status'>{''.join(lines)}</div>" if lines else ""


def refused(problem: Exception) -> str:
    """A question that no level can answer, as one sentence."""
    said = html.escape(" ".join(str(problem).split()))
    return f"<div class='messages' role='alert'><p>{said}.</p></div>"


def _row(level: str, one: Found) -> str:
    name = f"<th scope='row'>{ROWS[level]}<br><small>{html.escape(CALLS[level])}</small></th>"
    if one is None or isinstance(one, Progress):
        return f"<tr data-level='{level}'>{name}<td colspan='4'>{_waiting(one)}</td></tr>"
    exact = f"data-level='{level}' data-mean='{one.mean!r}' data-error='{one.error!r}'"
    if math.isnan(one.mean):
        return f"<tr {exact}>{name}<td colspan='3'>no answer</td><td>{duration(one.seconds)}</td></tr>"
    took = f"{duration(one.seconds)}{_by(one)}"
    errors = f"<td>{rounded_up(one.error)}</td><td>{_distance(one)}</td>"
    return f"<tr {exact}>{name}<td><b>{_speed(one)}</b></td>{errors}<td>{took}</td></tr>"


def _speed(one: Answer | Predicted) -> str:
    """V with its numerical plus model error, or, where the latter is unknown, three digits."""
    return measured(one.mean, one.error + one.model_error).with_unit("")


def _waiting(progress: Progress | None) -> str:
    if progress is None:
        return "<span class='waiting'>computing</span>"
    done = f"{html.escape(progress.task)}, {progress.share:.0%}; {progress.seconds:.0f} s so far"
    return f"<span class='waiting'>{done}</span>"


def _by(one: Answer | Predicted) -> str:
    """The level that `predict` chose, in words."""
    if not isinstance(one, Predicted):
        return ""
    missed = "" if one.converged else "; the tolerance is not met"
    return f", by {LEVEL_WORDS[one.level]}{missed}"


def _distance(one: Answer | Predicted) -> str:
    """What is known of the distance to the nonlinear sheet."""
    return "unknown" if math.isnan(one.model_error) else rounded_up(one.model_error)


def duration(seconds: float) -> str:
    """A time as people say it.

    >>> from fem_check.explorer.text import duration
    >>> duration(0.0304), duration(2.34)
    ('30 ms', '2.3 s')
    """
    return f"{seconds:.1f} s" if seconds >= 1 else f"{1e3 * seconds:.0f} ms"
