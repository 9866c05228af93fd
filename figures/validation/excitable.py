"""Fronts, pulses and trains of FitzHugh-Nagumo's equation."""

from collections.abc import Sequence

import numpy as np

from fem_check.excitable import Adaptive, BumpStart, Excitation, FitzHughNagumo, wave_train
from fem_check.excitable.record import Record
from figures.validation.comparison import (
    ByRefinement,
    ByTolerance,
    Comparison,
    Confirmed,
    Number,
    Source,
)
from figures.validation.scene_files import scene_of
from linear_theory import Estimate, Sheet

TRAIN = "wave_train.toml"

NUMERICS = Source(
    "Travelling waves by Fourier series and Newton's method, in the regime of P. Carter, A. Scheel, "
    "Nonlinearity 31:5536 (2018), arXiv:1712.10296",
    Confirmed.DERIVED,
)


def arrival_speed(record: Record, low: float, high: float, level: float) -> float:
    """Of a front that rises through a level: slope of place over time of arrival."""
    places = np.linspace(low, high, 41)
    fine = np.linspace(0, record.times[-1], 16 * record.times.size)
    times = []
    for y in places:
        c = record.value(0.0, y, fine)
        i = int(np.flatnonzero((c[:-1] < level) & (c[1:] >= level))[0])
        times.append(fine[i] + (level - c[i]) / (c[i + 1] - c[i]) * (fine[i + 1] - fine[i]))
    return float(np.polyfit(times, places, 1)[0])


def followed(equation: FitzHughNagumo, body: Sheet, until: float, size: float) -> Record:
    """On elements of one size."""
    return Excitation(equation, body, until, 1e-3)._solved(size, Adaptive(1e-3))


def front(share: float, threshold: float = 0.1, length: float = 0.02) -> tuple[float]:
    """Speed of a front without recovery over (D/2)^(1/2); share: element over diffusion length."""
    equation = FitzHughNagumo(threshold, 0.0, 0.0, length, BumpStart(1.0, 0.1))
    until = 0.9 / ((1 - 2 * threshold) * length / np.sqrt(2))
    record = followed(equation, Sheet(), until, share * length)
    return (arrival_speed(record, 0.0, 0.33, 0.5) * np.sqrt(2) / length,)


def pulses(size: float) -> tuple[float, ...]:
    """Speeds of two single pulses, D = 1, elements of that size."""
    found = []
    for threshold, decay, rate in ((0.1, 1.0, 0.01), (0.139, 2.54, 0.008)):
        equation = FitzHughNagumo(threshold, decay, rate, 1.0, BumpStart(1.0, 8.0))
        record = followed(equation, Sheet(length=200.0, width=100.0), 420.0, size)
        found.append(arrival_speed(record, 0, 60, 0.4))
    return tuple(found)


def train() -> Sequence[Estimate]:
    """Speed and period of the train of wavelength 1."""
    wave = scene_of(TRAIN).wave
    assert isinstance(wave, Excitation)
    found = wave_train(wave.equation)
    return [
        Estimate(found.speed, found.speed_error),
        Estimate(found.period, found.period_error),
    ]


COMPARISONS = (
    Comparison(
        "front without recovery",
        "the front of c_t = D c_xx + c(1 - c)(c - a), a = 0.1",
        Source("J. D. Murray, Mathematical Biology, 3rd ed., Springer (2003)", Confirmed.DERIVED),
        (Number("speed/(D/2)^(1/2) = 1 - 2 a", 0.8, 1e-15),),
        ByRefinement(front, {"share": 0.5}, {"share": 1.0}),
    ),
    Comparison(
        "single pulses",
        "pulses on an infinite line, D = 1",
        NUMERICS,
        (
            Number("speed, a = 0.1, epsilon = 0.01, kappa = 1", 0.4349184, 5e-8),
            Number("speed, a = 0.139, epsilon = 0.008, kappa = 2.54", 0.3998512, 5e-8),
        ),
        ByRefinement(pulses, {"size": 0.9}, {"size": 1.25}),
        slow=True,
    ),
    Comparison(
        "wave train",
        "oscillatory regime, gamma = 0.02, nu = -0.1, epsilon = 0.05, kappa = 1e-4, wavelength 1",
        NUMERICS,
        (Number("speed", 0.02517, 5e-6), Number("period", 39.73, 5e-3)),
        ByTolerance(train),
        scenes=(TRAIN,),
    ),
)
