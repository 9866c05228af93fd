"""The record of one scene: its answer with the errors and the cost, or why there is none."""

import json
from dataclasses import dataclass, fields
from datetime import UTC, datetime
from enum import StrEnum
from functools import cache
from typing import Any

from fem_check.answer.record import numbers_of
from fem_check.choice.result import Prediction
from fem_check.sweeps.plan import Question
from linear_theory.common.shown import Shown, plain
from linear_theory.common.version import current_version
from linear_theory.speed.result import ENERGIES


class State(StrEnum):
    """How the work on a scene has ended."""

    ANSWERED = "answered"
    REFUSED = "refused"
    FAILED = "could not"
    LATE = "out of time"


FAILURES = tuple(state for state in State if state is not State.ANSWERED)


@dataclass(frozen=True)
class Record(Shown):
    """One row of the file. Numbers are in the units of the scene; None is what is not known.

    key: of the question, scene and settings; state: of `State`; reason: why the level was chosen, and
    what is wrong with its speed if anything is (`Prediction.caution`), or why there is no answer.
    mean: the speed V; error: numerical plus model error, of which numerical_error, wave_error and
    model_error are parts; converged: whether the tolerance is met. power, cost_of_transport,
    efficiency: see `Prediction`, with model errors in theirs; an infinite cost is None. regime: of
    friction. cpu_seconds: of the thread that found the answer; seconds: as a clock tells them.
    warnings: a line each. program: its version; worker: the process; ended: UTC. settings, scene:
    JSON.
    """

    key: str
    state: str
    reason: str
    mean: float | None = None
    error: float | None = None
    numerical_error: float | None = None
    wave_error: float | None = None
    model_error: float | None = None
    level: str | None = None
    converged: bool | None = None
    regime: str | None = None
    slip_ratio: float | None = None
    power: float | None = None
    power_error: float | None = None
    cost_of_transport: float | None = None
    cost_of_transport_error: float | None = None
    efficiency: float | None = None
    efficiency_error: float | None = None
    beyond_reach: str | None = None
    cpu_seconds: float | None = None
    seconds: float | None = None
    warnings: str = ""
    program: str = ""
    worker: str = ""
    ended: str = ""
    settings: str = ""
    scene: str = ""


ENERGY_NUMBERS = tuple(name + end for name in ENERGIES for end in ("", "_error"))
"""Columns of the energy of a speed."""

COLUMNS = tuple(field.name for field in fields(Record))


@cache
def program() -> str:
    """The version of this program, read once."""
    return current_version()


def answer_of(found: Prediction) -> dict[str, Any]:
    """The fields of a record that an answer has."""
    return {
        **numbers_of(found),
        "level": found.level,
        "reason": "; ".join(filter(None, (found.reason, found.caution))),
        "converged": bool(found.converged),
        "regime": str(found.regime),
        "beyond_reach": found.speed.beyond_reach or None,
    }


def circumstances(question: Question, worker: str) -> dict[str, Any]:
    """The fields that every record has: who was asked what, and when that ended."""
    return {
        "program": program(),
        "worker": worker,
        "ended": datetime.now(UTC).isoformat(timespec="milliseconds"),
        "settings": json.dumps(plain(question.settings)),
        "scene": json.dumps(plain(question.scene)),
    }
