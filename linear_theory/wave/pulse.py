"""A smooth travelling pulse of any width."""

import math

import numpy as np

from linear_theory.common import validation
from linear_theory.wave.travelling import EPS, TravellingWave

NARROWEST = 0.02
"""Smallest width in wavelengths: narrower pulses need hundreds of harmonics and elements."""


def pulse_wave(width: float, count: int = 1, period: float = 1.0) -> TravellingWave:
    """c = exp(k (cos phi - 1)), phi = 2 pi (count y/L - t/period): 1 at its crest, falling to exp(-2k).

    width: fraction of a wavelength in which c > 1/2, in [0.02, 1); it determines k = ln 2/(1 - cos(pi
    width)). This profile (von Mises) is smooth, periodic and nowhere negative; its harmonics
    2 exp(-k) I_n(k) are kept down to rounding. count, period as in `TravellingWave`.

    Raises ValueError for values out of range.

    >>> from linear_theory import pulse_wave
    >>> pulse = pulse_wave(width=0.2)
    >>> print(pulse.value(x=0.0, y=[0.0, 0.1, 0.5], t=0.0).round(2))
    [1.  0.5 0. ]
    """
    from scipy.special import ive  # here: scipy takes long to import

    width = validation.real("width", width)
    if not NARROWEST <= width < 1:
        raise ValueError(f"width = {width:g}: must be in [{NARROWEST:g}, 1), in wavelengths")
    steepness = math.log(2) / (1 - math.cos(math.pi * width))
    most = math.ceil(16 + 10 * math.sqrt(steepness))  # I_n(k)/I_0(k) is about exp(-n^2/(2k))
    amplitudes = 2 * ive(np.arange(most + 1), steepness)
    kept = amplitudes[1 : 1 + max(int(np.sum(amplitudes[1:] > EPS * amplitudes[1])), 1)]
    return TravellingWave(kept, np.zeros_like(kept), count, period, float(amplitudes[0] / 2))
