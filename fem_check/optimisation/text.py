"""An optimum on the screen, in the style of the block of an answer."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from fem_check.answer.block import LEVEL_WORDS, wrapped
from fem_check.answer.rounding import plain
from fem_check.optimisation.asked import grows
from fem_check.optimisation.words import LITTLE, against, percent, shown
from linear_theory.common.shown import number
from linear_theory.optimisation.certificate import GAIN

if TYPE_CHECKING:
    from fem_check.optimisation.result import Optimum

WIDTH = 80

NOTHING = 1e-6
"""Amplitudes below this share of the largest are not printed."""

SHOWN = 12
"""Values that are printed; of a wave of more harmonics the largest ones."""


def text(found: "Optimum") -> str:
    """The lines."""
    return "\n".join(wrapped(label, words, WIDTH) for label, words in _lines(found) if words)


def _lines(found: "Optimum") -> Iterator[tuple[str, str]]:
    unit = f" {found.unit}" if found.unit else ""
    yield "best", f"{found.objective.name} {shown(found.value)}{unit}, {_improvement(found)}"
    yield "at", _values(found)
    yield "at rest", _at_rest(found)
    yield "no effect", _idle(found)
    yield "outside", _outside(found)
    if not found.converged:
        yield "NOT MET", _doubts(found)
    yield "proof", _proof(found)
    yield "held by", ", ".join(found.certificate.held)
    yield "limits", _limits(found)
    yield "regimes", _regimes(found)
    yield "starts", _starts(found)
    yield "depends", _sensitivities(found)
    yield "check", _check(found)
    words = LEVEL_WORDS.get(found.level, found.level)
    yield "took", f"{number(float(f'{found.seconds:.2g}'))} s, {found.answers} answers by {words}"


def _improvement(found: "Optimum") -> str:
    if found.start is None:
        return "the scene as given has none"
    before = found.start.value
    if abs(before) <= found.start.error or not before:
        return f"{plain(before)} as given"
    return against(found.value.value, before)


def _values(found: "Optimum") -> str:
    weights = {name: _weight(found, name) for name in found.values}
    least = NOTHING * max((w for w in weights.values() if w < math.inf), default=0.0)
    names = sorted(weights, key=lambda name: -weights[name])[:SHOWN]
    names = [name for name in found.values if name in names and weights[name] > least]
    told = [
        f"{name} = {plain(float(found.values[name]))} {found.field_units.get(name, '')}".strip()
        for name in names
    ]
    more = len(found.values) - len(told)
    return ", ".join(told) + (f"; and {more} smaller amplitude{'s' * (more > 1)}" if more else "")


def _idle(found: "Optimum") -> str:
    if not found.without_effect:
        return ""
    names = ", ".join(found.without_effect)
    return f"of {names} within the errors: the value above is that at both bounds, too"


def _at_rest(found: "Optimum") -> str:
    """Of a scene that is best as it does not move."""
    if grows(found.scene) or found.value.value:
        return ""
    return "the best scene does not grow, and so does not move: growth of either sign is worse"


def _outside(found: "Optimum") -> str:
    if not found.outside:
        return ""
    words = "; ".join(found.outside)
    return f"the scene as given lies outside of the bounds, its climb began inside: {words}"


def _weight(found: "Optimum", name: str) -> float:
    """Fields first, then amplitudes by their size."""
    harmonic = name not in found.field_units
    return abs(float(found.values[name])) if harmonic else math.inf


def _doubts(found: "Optimum") -> str:
    missed = [f"{one.name} is missed by {percent(one.beyond)}" for one in found.limits if one.beyond]
    if missed:
        return "; ".join(missed)
    if found.certificate.kink:
        return found.certificate.kink
    if not math.isfinite(found.left):
        return "the error of the gradient is not known"
    return f"a gain of {100 * found.left:.2g} % may be left, allowed is {100 * GAIN:g} %"


def _proof(found: "Optimum") -> str:
    proof, share = found.certificate, found.scale.share
    words = f"projected gradient {percent(share(proof.slope))} per range of the unknowns"
    if share(proof.doubt) > max(0.1 * share(proof.slope), LITTLE):
        words += f" ± {percent(share(proof.doubt))}"
    if proof.highest == -math.inf:
        words += "; bounds hold every direction"
    elif math.isnan(proof.highest):
        words += "; curvature not computed"
    elif found.scale.size:
        words += f"; largest curvature {plain(proof.highest / found.scale.size, 2)}"
    words += f"; gain left {percent(share(proof.gain))}"
    if share(found.rounding) >= LITTLE:
        words += f"; what was climbed differs from the value above by {percent(share(found.rounding))}"
    if found.scale.words:
        unit = f" {found.unit}" if found.unit else ""
        words += f"; shares are of {plain(found.scale.size)}{unit}, {found.scale.words}"
    return words


def _limits(found: "Optimum") -> str:
    """Each number with its bound, and what moving the bound brings where it holds."""
    own, words = f" {found.unit}" if found.unit else "", []
    for one in found.limits:
        unit = found.in_units(one.unit)
        said = f"{one.name}: {shown(one.value)} {unit}".rstrip()
        if one.brings:
            said += f" (moving the bound brings {plain(one.brings)}{own} per {unit or 1})"
        words.append(said)
    return "; ".join(words)


def _regimes(found: "Optimum") -> str:
    if not found.regimes:
        return ""
    each = ", ".join(f"{one.name}: {shown(one.value)}" for one in found.regimes)
    return f"the value above is the {found.by} of {len(found.regimes)}: {each}"


def _starts(found: "Optimum") -> str:
    ends = ", ".join("none" if math.isnan(one.value) else plain(one.value) for one in found.starts)
    bad = {one.words for one in found.starts if one.words != "converged"}
    near = "" if not found.scale.words else f"of {plain(found.scale.size)} "
    words = f"{found.agreed} of {len(found.starts)} ended within {100 * GAIN:g} % {near}of the best"
    words += f" ({ends})"
    return words + "".join(f"; {one}" for one in sorted(bad))


def _sensitivities(found: "Optimum") -> str:
    held = [name for name in found.field_units if _bound(found, name)]
    fields = {name: found.at_bounds[name] for name in held}
    unit = f" {found.unit}" if found.unit else ""
    return ", ".join(
        f"{plain(value)}{unit} per {found.field_units.get(name) or 1} of {name}"
        for name, value in fields.items()
    )


def _bound(found: "Optimum", name: str) -> bool:
    """Whether a bound holds a field: elsewhere the derivative is 0 but for what the search has left."""
    return any(held.endswith(f" bound of {name}") for held in found.certificate.held)


def _check(found: "Optimum") -> str:
    check = found.check
    if check is None:
        return ""
    level = LEVEL_WORDS.get(check.level, check.level)
    if check.best is None:
        return f"none by {level}: {check.failed}"
    unknown = "" if math.isfinite(check.best.error) else ", its error not known,"
    words = f"{shown(check.best)}{unknown} by {level}"
    if check.start is None or not check.start.value:
        return words
    return f"{words}, {against(check.best.value, check.start.value)}"
