"""The speed of a bending sheet by the cheapest of two levels, whose target is a cycle of its shapes.

second order  the plate in full contact with level ground     tenths of a second
cycle         static shapes and the friction balance          seconds
"""

import math
import time
import warnings
from dataclasses import replace

from fem_check.choice.answers import answer_of, by_cycle, noise
from fem_check.choice.result import Passed, Prediction, total_error
from fem_check.choice.settings import SHARE
from fem_check.shell.effects.friction import Friction
from linear_theory.common.errors import NotConvergedError, ViscousRegimeWarning
from linear_theory.common.progress import part_of
from linear_theory.common.tolerance import Tolerance
from linear_theory.scene.level import PLATE
from linear_theory.scene.scene import Scene
from linear_theory.speed.crawl import theory_speed
from linear_theory.speed.plate.contact import require_contact
from linear_theory.speed.plate.error import plate_error

BENDING = ("second order", "cycle")
"""Levels of a bending scene, cheapest first; the last one is the target."""


def bending_answer(scene: Scene, tolerance: Tolerance, level: str = "auto") -> Prediction:
    """The answer of the cheapest level that is known to meet the tolerance, or of that of a name.

    Raises ValueError, and errors of the level, as `predict`.
    """
    if level == "second order":
        return replace(_by_plate(scene, tolerance), reason="requested")
    if level == "cycle":
        return replace(_by_cycle(scene, tolerance), reason="requested")
    begin = time.perf_counter()
    obstacle = _obstacle(scene)
    if not obstacle:
        try:
            found = _by_plate(scene, tolerance)
        except NotConvergedError as failure:
            obstacle = str(failure)
        else:
            if found.converged:
                return replace(found, reason="second order meets the tolerance")
            allowed = tolerance.allowed(found.mean)
            obstacle = f"error {found.error:.1g} is above {allowed:.1g}"
    passed = Passed("second order", obstacle, time.perf_counter() - begin)
    found = _by_cycle(scene, tolerance)
    reason = "cycle meets the tolerance" if found.converged else "cycle is the last level"
    return replace(found, reason=f"{reason}; not second order: {obstacle}", passed=(passed,))


def _obstacle(scene: Scene) -> str:
    """Why the plate cannot meet a tolerance, known without its speed; empty if it may."""
    objections = PLATE.objections(scene)
    if objections:
        return f"it cannot represent {'; '.join(objections)}"
    try:
        require_contact(scene)
        unknown = math.isnan(plate_error(scene))
    except (NotConvergedError, ValueError) as problem:
        return str(problem)
    return "its model error is unknown here" if unknown else ""


def _by_plate(scene: Scene, tolerance: Tolerance) -> Prediction:
    """The answer of the plate, its model error included."""
    with part_of("second order"):
        speed = theory_speed(scene, tolerance.share(SHARE), order=2)
    named = {type(effect) for effect in scene.effects} - {Friction}
    found = answer_of("second order", speed, named, scene, tolerance, tuple(noise(speed, scene)), "")
    met = not speed.beyond_reach and total_error(speed) <= tolerance.allowed(speed.mean)
    return replace(found, converged=met)


def _by_cycle(scene: Scene, tolerance: Tolerance) -> Prediction:
    with warnings.catch_warnings(), part_of("cycle"):
        warnings.simplefilter("ignore", ViscousRegimeWarning)  # `predict` warns
        return by_cycle(scene, tolerance)
