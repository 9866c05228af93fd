"""An optimum on the screen, in the style of the block of an answer."""

import math
from collections.abc import Iterator

from fem_check.answer.block import LEVEL_WORDS, wrapped
from fem_check.answer.rounding import measured, plain
from fem_check.optimisation.result import GAIN, Optimum
from linear_theory.common.estimate import Estimate
from linear_theory.common.shown import number

WIDTH = 80

SHOWN = 12
"""Values that are printed; of a wave of more harmonics the largest ones."""


def text(found: Optimum) -> str:
    """The lines."""
    return "\n".join(wrapped(label, words, WIDTH) for label, words in _lines(found) if words)


def _lines(found: Optimum) -> Iterator[tuple[str, str]]:
    unit = f" {found.unit}" if found.unit else ""
    yield "best", f"{found.objective.name} {_shown(found.value)}{unit}, {_improvement(found)}"
    yield "at", _values(found)
    if not found.converged:
        yield "NOT MET", _doubts(found)
    yield "proof", _proof(found)
    yield "held by", ", ".join(found.certificate.held)
    yield "starts", _starts(found)
    yield "depends", _sensitivities(found)
    yield "check", _check(found)
    words = LEVEL_WORDS.get(found.level, found.level)
    yield "took", f"{number(float(f'{found.seconds:.2g}'))} s, {found.answers} answers by {words}"


def _improvement(found: Optimum) -> str:
    if found.start is None:
        return "the scene as given has none"
    before = found.start.value
    if abs(before) <= found.start.error or not before:
        return f"{plain(before)} as given"
    return _against(found.value.value, before)


def _against(value: float, before: float) -> str:
    """One value beside another one."""
    if value * before <= 0:
        return f"{plain(before)} as given"
    return f"{plain(value / before)} times the {plain(before)} as given"


def _shown(value: Estimate) -> str:
    """With its error, where five digits show it."""
    if value.error < 1e-5 * abs(value.value):
        return plain(value.value, 5)
    return measured(value.value, value.error).with_unit("").strip()


def _values(found: Optimum) -> str:
    names = sorted(found.values, key=lambda name: -_weight(found, name))[:SHOWN]
    told = [
        f"{name} = {number(float(found.values[name]))} {found.field_units.get(name, '')}".strip()
        for name in found.values
        if name in names
    ]
    more = len(found.values) - len(told)
    return ", ".join(told) + (f"; and {more} smaller amplitudes" if more else "")


def _weight(found: Optimum, name: str) -> float:
    """Fields first, then amplitudes by their size."""
    harmonic = "[" in name or name == "wave.mean"
    return abs(float(found.values[name])) if harmonic else math.inf


def _doubts(found: Optimum) -> str:
    if found.certificate.kink:
        return found.certificate.kink
    if math.isnan(found.left):
        return "the error of the gradient is not known"
    return f"a gain of {100 * found.left:.2g} % may be left, allowed is {100 * GAIN:g} %"


def _proof(found: Optimum) -> str:
    proof, size = found.certificate, max(abs(found.value.value), 1e-300)
    words = f"projected gradient {plain(100 * proof.slope / size, 2)} % per range of the unknowns"
    if proof.doubt > 0.1 * proof.slope:
        words += f" ± {plain(100 * proof.doubt / size, 2)} %"
    if proof.highest == -math.inf:
        words += "; bounds hold every direction"
    elif math.isnan(proof.highest):
        words += "; curvature not computed"
    else:
        words += f"; largest curvature {plain(proof.highest / size, 2)}"
    words += f"; gain left at most {plain(100 * proof.gain / size, 2)} %"
    if found.rounding:
        words += f"; smoothed friction differs by {plain(100 * found.rounding / size, 2)} %"
    return words


def _starts(found: Optimum) -> str:
    ends = ", ".join(plain(one.value) for one in found.starts)
    bad = {one.words for one in found.starts if one.words != "converged"}
    words = f"{found.agreed} of {len(found.starts)} ended within {100 * GAIN:g} % of the best ({ends})"
    return words + "".join(f"; {one}" for one in sorted(bad))


def _sensitivities(found: Optimum) -> str:
    fields = {n: v for n, v in found.sensitivities.items() if "[" not in n and n != "wave.mean"}
    unit = f" {found.unit}" if found.unit else ""
    return ", ".join(
        f"{plain(value)}{unit} per {found.field_units.get(name) or 1} of {name}"
        for name, value in fields.items()
    )


def _check(found: Optimum) -> str:
    check = found.check
    if check is None:
        return ""
    level = LEVEL_WORDS.get(check.level, check.level)
    if check.best is None:
        return f"none by {level}: {check.failed}"
    words = f"{_shown(check.best)} by {level}"
    if check.start is None or not check.start.value:
        return words
    return f"{words}, {_against(check.best.value, check.start.value)}"
