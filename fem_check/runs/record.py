"""What is written of a run in result.json: the answer, its errors, what was asked, what it cost."""

import math
import platform
from importlib.metadata import version
from typing import Any

from fem_check.answer.block import block
from fem_check.answer.record import record
from fem_check.answer.units import Units
from fem_check.choice.settings import RunSettings
from fem_check.choice.solving import Solved
from linear_theory.common.shown import plain
from linear_theory.common.version import current_version
from linear_theory.wave.uncertain import error_words

PACKAGES = ("numpy", "scipy", "scikit-fem", "matplotlib")

WIDTH = 80

FAILED = "unknown: the run that tells it failed"
"""Error of which only a further run knows."""


def result_of(
    found: Solved, settings: RunSettings, units: Units | None, files: dict[str, str]
) -> dict[str, Any]:
    """Plain data for JSON. Numbers are in the units of the scene, which `units` names.

    files: checksums of those that belong to this result, by name.
    """
    answer = found.answer
    told = block(answer, units, WIDTH, ("", ""))
    return {
        "answer": record(answer, units),
        "units": None if units is None else {"length": units.length, "time": units.time},
        "errors": errors_of(found),
        "cost": cost_of(found),
        "block": told,
        "run": plain(settings),
        "scene": plain(answer.scene),
        "versions": versions(),
        "files": files,
    }


def errors_of(found: Solved) -> list[dict[str, Any]]:
    """The error budget: parts of the error of the mean speed, absolute; None where not estimated.

    Parts that only some motions have (snap-throughs, feedback, contact) are there where they count.
    """
    speed = found.answer.speed
    if found.motion is None:
        rows = [("numerical: mesh, times, friction balance", speed.error - speed.wave_error)]
        if speed.wave_error:
            rows.append((error_words(found.answer.scene.wave), speed.wave_error))
        target = "the nonlinear flat sheet" if found.answer.scene.planar else "a cycle of its shapes"
        rows.append((f"model: distance to {target}", speed.model_error))
    else:
        of = found.motion.errors
        rows = [("steps in time", of.step), ("difference of the last two periods", of.spread)]
        rows += [("mesh", of.mesh)]
        met = {
            "path through snap-throughs": of.snaps,
            "feedback of the strain on the wave": of.feedback,
            "gap between layers that touch": of.contact,
        }
        rows += [(part, error) for part, error in met.items() if not math.isnan(error)]
        rows += [("distance to dry friction, not part of the error", of.slip_speed)]
    return [{"part": part, "error": _told(float(error))} for part, error in rows]


def _told(error: float) -> Any:
    """An infinite error in words: it is that of a further run that failed."""
    return FAILED if math.isinf(error) else plain(error)


def cost_of(found: Solved) -> list[dict[str, Any]]:
    """Where the time went, in seconds, and how much work was done."""
    answer, motion = found.answer, found.motion
    rows: list[tuple[str, float, str]] = [
        (f"{one.level}, not chosen", one.seconds, one.why) for one in answer.passed
    ]
    work, since = "", ""
    if motion is not None:
        work = f"{motion.times.size - 1} steps, {motion.iterations} iterations"
        since = "" if math.isnan(motion.resumed_at) else ", since the run was resumed"
    rows.append((answer.level, answer.speed.seconds, work))
    spent = found.cost.seconds
    rows += [
        (f"of these for {name}", seconds, f"{found.cost.calls[name]} evaluations{since}")
        for name, seconds in sorted(spent.items(), key=lambda one: -one[1])
    ]
    return [{"part": part, "seconds": seconds, "work": work} for part, seconds, work in rows]


def versions() -> dict[str, str]:
    """Of this program and of what its numbers depend on."""
    found = {"sheetcrawl": current_version(), "python": platform.python_version()}
    return {**found, **{name: version(name) for name in PACKAGES}}
