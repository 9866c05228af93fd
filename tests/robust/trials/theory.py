"""Random speeds of the theory, on sheets and on lines."""

import numpy as np

from linear_theory import FieldWave, crawl_speed, line_balance
from linear_theory.friction.load import WEIGHTS as LOADS
from tests.robust.trials.drawn import a_directional_law, a_law, a_sheet, a_wave, an_alpha
from tests.robust.trials.outcome import REFUSALS, Outcome, compared, refusal

LAWS = ("exp", "linear", "metric")


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
    except REFUSALS as error:
        return refusal(words, error)
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
    except REFUSALS as error:
        return refusal(words, error)
    return compared(found, exact, words)


def direction(rng: np.random.Generator) -> Outcome:
    """`crawl_speed` under friction with a direction, against the other method to a tenth of rtol."""
    sheet, wave, alpha = a_sheet(rng, 1.0), a_wave(rng, 3), an_alpha(rng, 0.3)
    law, load = a_directional_law(rng, alpha), str(rng.choice(LOADS))
    rtol = 10.0 ** rng.uniform(-3.5, -2)
    words = f"{sheet}, {wave}, {alpha:.4g}, {law}, {load} load, rtol {rtol:.1e}"
    try:
        found = crawl_speed(sheet, wave, alpha, load=load, friction=law, rtol=rtol)
        better = crawl_speed(sheet, wave, alpha, load=load, friction=law, rtol=rtol / 10, method="ritz")
    except REFUSALS as error:
        return refusal(words, error)
    return compared(found, better, words)
