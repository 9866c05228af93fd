"""Numbers about excitable waves, friction with a direction and the best waves (F8)."""

import math

import numpy as np
from numpy.typing import NDArray

from fem_check.excitable.presets import PRESETS
from figures.draw.directional import equal_at, select, wave_speed
from figures.measure import directional as directional_table
from linear_theory.line.best.viscous import best_viscous
from paper.numbers.number import Number, Numbers

Array = NDArray[np.float64]

PRINTED = PRESETS["printed"].equation
"""Eq. 12 with the numbers of the original paper."""

BRISTLES = 0.5
"""The r of which the text tells the speed: coefficients of friction of 1 to 3."""


def oscillation() -> Numbers:
    """Eq. 12 near the onset of its oscillation: what grows, and how far (F8)."""
    rate = -PRINTED.threshold
    return {
        "wave.onset": Number(2 * math.sqrt(rate / 3), "2 sqrt(-threshold/3), threshold = -0.01"),
        "wave.shortest": Number(
            2 * math.pi * PRINTED.diffusion_length / math.sqrt(rate),
            "2 pi diffusion_length/sqrt(-threshold), 0.02 and -0.01",
        ),
    }


def direction() -> Numbers:
    """A wave against a breath, on a line in closed form and on the 2:1 sheet by its table."""
    alpha = directional_table.ALPHA
    rows = directional_table.TABLE.read()
    r, wave = select(rows, "theory", "wave")
    _, breath = select(rows, "theory", "breathing")
    gain = wave_speed(alpha, BRISTLES) / wave_speed(alpha, 0.0)
    return {
        "direction.alpha": Number(alpha, "figures.measure.directional.ALPHA"),
        "direction.gain": Number(gain, "wave_speed(r = 0.5)/wave_speed(r = 0), alpha = 0.1, line"),
        "direction.line": Number(equal_at(alpha, 1), "figures.draw.directional.equal_at(0.1, 1)"),
        "direction.sheet": Number(
            _crossing(np.array(r), np.array(breath) - np.array(wave)),
            "r at which breath and wave are equally fast, figures/data/directional.csv, 2:1 sheet",
        ),
    }


def _crossing(x: Array, y: Array) -> float:
    """Where y changes from below to above zero for the last time, between its points by a line."""
    last = int(np.flatnonzero(y <= 0)[-1])
    return float(np.interp(0.0, y[last : last + 2], x[last : last + 2]))


def best() -> Numbers:
    """The best wave of a finite body on viscous ground."""
    found = best_viscous()
    return {
        "best.viscous": Number(found.gain, "best_viscous().gain"),
        "best.viscous_length": Number(2 * math.pi / found.theta, "2 pi/best_viscous().theta, in L"),
    }
