"""A speed on the screen: the question, speed and direction, accuracy, energy, assumptions and cost.

The command prints this block, and so does `print` of a `Prediction` in Python.
"""

import math
import re
import textwrap
from collections.abc import Iterator
from typing import TYPE_CHECKING

from fem_check.answer.energy import energy
from fem_check.answer.growth import extremes
from fem_check.answer.motion import heading, per_period, sideways_and_turning
from fem_check.answer.rounding import measured, plain, rounded_up
from fem_check.answer.units import Units
from fem_check.answer.wave_words import arrows, wave_words
from linear_theory.growth.laws import Exp
from linear_theory.scene.scene import Scene
from linear_theory.wave.uncertain import doubt_of, error_words

if TYPE_CHECKING:
    from fem_check.choice.result import Prediction

WIDTH = 80
"""Default width of the block, in columns."""

STEPPED = "stepped"
"""The level on which friction acts back on the sheet."""

LABEL = 10
"""Columns taken by the labels on the left."""

LEVEL_WORDS = {
    "strip": "the closed-form balance of a narrow strip",
    "line": "the balance of a one-dimensional body with its weight per length",
    "first order": "small-strain theory",
    "second order": "second-order theory in alpha",
    "cycle": "a cycle of static shapes",
    "stepped": "steps in time",
}
"""What a level is, by its name in `levels.LEVELS` or `ways.WAYS`."""

Line = tuple[str, str]
"""Label on the left, and text."""

GLUED = re.compile(r"(?<=\d) (?=\S)|(?<=[=×±]) | (?=[=×±])")
"""Blanks at which no line is broken: between a number and its unit, around operators."""


def block(
    found: "Prediction",
    units: Units | None = None,
    width: int = WIDTH,
    hints: tuple[str, str] = ("", ".reason says why"),
) -> str:
    """The answer in lines of at most `width` columns.

    units: by default the length L of the sheet and the period T of the wave. hints: where to find
    more, appended to the lines "left out" and "took".
    """
    q = found.scene
    units = units or Units.of_sheet(q.sheet.length, q.period)
    lines = [*_asked(found, units), *_answer(found, units), *_assumed(found, units, hints)]
    return "\n".join(wrapped(label, text, width) for label, text in lines if text)


def _asked(found: "Prediction", units: Units) -> Iterator[Line]:
    """The sheet, its wave and its growth, each with the way that it goes."""
    speed = found.mean if abs(found.mean) > _error(found) else 0.0
    yield from zip(arrows(found.scene.drive, speed), asked(found.scene, units), strict=True)


def asked(scene: Scene, units: Units) -> tuple[str, str]:
    """The sheet with its wave, and its growth, in words."""
    sizes = (scene.sheet.length, scene.sheet.width, scene.sheet.thickness)
    told = " × ".join(plain(units.of_length(size)) for size in sizes)
    own = units == Units.of_sheet(scene.sheet.length, scene.period)
    period = f", T = {plain(units.of_time(scene.period), 6)} {units.time}"
    words = f"{told} {units.length}, {wave_words(scene.drive, scene.wave)}"
    return words + (_own_units(units) if own else period), _growth(scene, units)


def _growth(scene: Scene, units: Units) -> str:
    """How much lengths grow, and with it the curvature."""
    most = extremes(scene)
    growth = f"growth {plain(100 * most.crest)} % of length at the crest"
    if round(1e3 * most.trough):
        trough = f"{plain(100 * most.trough)} % in trough"
        growth = f"{growth.replace('the crest', 'crest')}, {trough}"
    law = "" if scene.growth.law == Exp() else f", law {scene.growth.law.name!r}"
    bent = ""
    if scene.curvature_coupling:
        curvature = plain(scene.curvature_coupling / units.of_length(1.0), 4)
        bent = f"; curvature {curvature}/{units.length} c"
    return f"{growth} (alpha = {plain(scene.alpha, 4)}{law}){bent}"


def _own_units(units: Units) -> str:
    """Values of L and T in the units of the question, where they are not 1."""
    named = (units.length, units.length_factor), (units.time, units.time_factor)
    return "".join(f", {name} = {1 / factor:.6g}" for name, factor in named if factor != 1)


def _answer(found: "Prediction", units: Units) -> Iterator[Line]:
    """Speed, direction, sideways motion and turning, and whether the tolerance is met."""
    error = _error(found)
    shown = measured(units.of_speed(found.mean), units.of_speed(error))
    way = heading(found.scene.drive, found.mean, error)
    doubt = " with unknown error" if math.isinf(error) else ""
    yield "speed", f"{shown.with_unit(units.speed)}{doubt}, {way}; {per_period(found, units, error)}"
    yield from sideways_and_turning(found.speed, found.scene.period, units)
    if found.speed.beyond_reach:
        yield "NO ANSWER", found.speed.reach
    if found.caution:
        yield "CAUTION", found.caution
    if not found.speed.beyond_reach and (missed := _missed(found, units)):
        yield "NOT MET", missed
    yield "accuracy", _accuracy(found, units)
    yield "energy", energy(found)


def _missed(found: "Prediction", units: Units) -> str:
    """A missed tolerance and the error, in per cent of the speed, or as speeds; or a wave that is in
    doubt; empty if it is met."""
    if doubt := doubt_of(found.scene.wave):
        return f"the wave is not known well enough: {doubt}"
    if found.tolerance is None:
        return ""
    allowed, size = found.tolerance.allowed(found.mean), abs(found.mean)
    relative = allowed <= found.tolerance.rtol * size
    factor, unit = (100 / size, "%") if relative else (units.of_speed(1.0), units.speed)
    asked = f"the tolerance, {plain(factor * allowed)} {unit}"
    if math.isnan(found.error):
        return f"{asked}, may not be met: the model error (distance to the nonlinear sheet) is unknown"
    if found.error <= allowed:
        return ""
    if math.isinf(found.error):
        return f"{asked}, is not met: the error is unknown"
    return f"{asked}, is not met: the error is {rounded_up(factor * found.error)} {unit}"


def _accuracy(found: "Prediction", units: Units) -> str:
    """Relative error, with its numerical and model parts, and what is not part of it."""
    lacking = f"not estimated: {', '.join(found.not_in_error)}" if found.not_in_error else ""
    if math.isinf(found.speed.error):
        return f"the error is unknown{lacking and f'; {lacking}'}"
    speed, numerical = found.speed, found.speed.error - found.speed.wave_error
    numbers = f"numerical {rounded_up(units.of_speed(numerical))}"
    if speed.wave_error:
        numbers += f", {error_words(found.scene.wave)} {rounded_up(units.of_speed(speed.wave_error))}"
    if not (found.not_in_error and math.isnan(speed.model_error)):
        numbers += f", model {_model(found, units)}"
    if lacking:
        numbers += f"; {lacking}"
    if found.mean == 0 and _error(found) == 0:
        return f"exact: nothing moves ({numbers})"
    if _error(found) >= abs(found.mean):
        return f"the error is as large as the speed ({numbers})"
    return f"{rounded_up(100 * _error(found) / abs(found.mean))} % ({numbers})"


def _model(found: "Prediction", units: Units) -> str:
    error = found.speed.model_error
    if math.isnan(error):
        return "unknown: the distance of this theory to the nonlinear sheet was not measured here"
    if error == 0:
        return "0: this is the nonlinear flat sheet"
    target = "the nonlinear flat sheet" if found.scene.planar else "a cycle of its nonlinear shapes"
    return f"{rounded_up(units.of_speed(error))}, its distance to {target}"


def _assumed(found: "Prediction", units: Units, hints: tuple[str, str]) -> Iterator[Line]:
    """Friction, what is left out, and the cost."""
    yield "friction", _friction(found, units)
    yield "left out", _hinted("; ".join(found.left_out), hints[0])
    more = "" if found.scene.planar or found.level != "second order" else " and beta"
    took = f"{_seconds(found.seconds)}, by {LEVEL_WORDS[found.level]}{more}"
    yield "took", _hinted(took, hints[1])


def _friction(found: "Prediction", units: Units) -> str:
    """The friction regime and its meaning."""
    regime, law = found.speed.regime, found.scene.contact.friction
    name = f"{regime}, {law.details}" if law.details else regime
    sticks = "; part of the sheet sticks at times" if found.speed.sticks else ""
    where = ""
    if law.regularised and math.isfinite(found.speed.slip_ratio):
        share = f"{plain(100 * found.speed.slip_ratio, 2)} % of the largest sliding speed"
        where = f" (slip speed {plain(units.of_speed(law.width))} {units.speed}, {share})"
    felt = next((effect.mu for effect in found.scene.effects if effect.mu), None)
    if felt is not None and found.level == STEPPED:
        return f"{name}: coefficient {plain(felt)}, which deforms the sheet, too{where}{sticks}"
    means = {
        "dry": "the speed does not depend on the coefficient while the sheet is stiff",
        "mixed": "between dry and viscous, the speed depends on the slip speed",
        "viscous": "force proportional to the sliding velocity; the coefficient does not matter",
        "none": "no friction acts",
    }
    return f"{name}: {means[regime]}{where}{sticks}"


def _seconds(spent: float) -> str:
    return f"{spent:.1f} s" if spent >= 0.1 else f"{1e3 * spent:.0f} ms"


def _hinted(text: str, hint: str) -> str:
    return f"{text}  ({hint})" if hint else text


def _error(found: "Prediction") -> float:
    """Numerical plus model error where the latter is known, else the numerical error alone."""
    return found.speed.error if math.isnan(found.error) else found.error


def wrapped(label: str, text: str, width: int = WIDTH) -> str:
    """A labelled line, with continuation lines indented to the text."""
    indent = " " * (2 + LABEL)
    filled = textwrap.fill(
        GLUED.sub("\N{NO-BREAK SPACE}", text),
        max(width, 40),
        initial_indent=f"  {label:<{LABEL}}",
        subsequent_indent=indent,
        break_on_hyphens=False,
        break_long_words=False,
    )
    return filled.replace("\N{NO-BREAK SPACE}", " ")


def why(found: "Prediction", width: int = WIDTH) -> str:
    """Why each level was or was not chosen."""
    taken = "chosen: it meets the tolerance"
    if found.tolerance is None:
        taken = "chosen: no tolerance was asked for"
    elif not found.converged:
        taken = "chosen, but it misses the tolerance"
    if not found.passed and found.reason.startswith("requested"):
        taken = f"chosen: {found.reason}"
    rows = [(one.level, f"not chosen: {one.why}", one.seconds) for one in found.passed]
    rows.append((found.level, taken, found.speed.seconds))
    seen = {level for level, _, _ in rows}
    lines = [f"{level}: {text} ({_seconds(spent)})" for level, text, spent in rows]
    lines += [f"{level}: not tried" for level in LEVEL_WORDS if level not in seen]
    return "\n".join(wrapped("why" if i == 0 else "", line, width) for i, line in enumerate(lines))
