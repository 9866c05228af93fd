"""The best map of viscous friction, fixed to a body on a line or to a narrow strip.

Viscous friction mu(y) v balances where V = -<(1 + alpha e) v>/<1 + alpha e>, < > being means with the
weight mu: to second order in alpha V = -alpha^2 mean over time of the covariance Cov(e, v) of load and
velocity per unit alpha. For a wave that travels, c = f(2 pi (n y/L - t/T)), the velocity of a body on a
line is v = -(L/nT) c but for a translation, and e = c:

    V = alpha^2 L/(nT) mean Var(c) = alpha^2 L/(nT) sum_k A_k^2/2 (1 - |m_kn|^2),
    m_j = <exp(2 pi i j y/L)>,

with the amplitudes A_k of the harmonics. In a narrow strip of a sheet e = 2 c, and V is twice that. So
V is along the wave whatever the map, and no map is better than the uniform one, or than others whose
m_kn vanish, V = alpha^2 L/(nT) mean c^2. The slowest map between bounds low <= mu <= high, of mean 1
and for one sine, has the largest |m_n|, convex in mu: it is at its bounds everywhere (bang-bang), high
on arcs of the share p = (1 - low)/(high - low) of each wavelength, |m_n| = (high - low) sin(pi p)/pi.
"""

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.friction.maps import FrictionMap
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

POINTS = 20_000
"""Of the midpoint rule along the body."""


def map_share(wave: TravellingWave, friction: FrictionMap) -> float:
    """V with a map over V without one, from 0 to 1: mean Var(c) over that of the uniform body.

    friction: fixed to the body, not kinetic, read at x = 0 in units of the length of the body. Raises
    ValueError for other types, for a kinetic map, and for a wave that does not move.

    >>> from linear_theory import Patches, SineWave
    >>> from linear_theory.line.best.viscous_map import map_share
    >>> print(f"{map_share(SineWave(), Patches([(-1, 1, -1, 0, 3.0)], edge=0.01)):.3f}")
    0.899
    """
    validation.instance("wave", wave, TravellingWave)
    validation.instance("friction", friction, FrictionMap)  # type: ignore[type-abstract]
    if friction.kinetic or not wave.moves:
        raise ValueError("friction, wave: the map must not depend on time, and the wave must move")
    y = (np.arange(POINTS) + 0.5) / POINTS - 0.5
    mu = friction.values(np.zeros_like(y), y)
    powers = wave.cosine**2 + wave.sine**2
    angles = np.multiply.outer(2j * np.pi * wave.count * wave.harmonics, y)
    means = (np.exp(angles) @ mu) / mu.sum()
    return float(powers @ (1 - abs(means) ** 2) / powers.sum())


def slowest_share(low: float, high: float) -> float:
    """The least `map_share` of maps of mean 1 with low <= mu <= high, for a sine.

    Raises ValueError unless 0 < low < 1 < high.

    >>> from linear_theory.line.best.viscous_map import slowest_share
    >>> print(f"{slowest_share(0.5, 1.5):.4f}")  # 1 - 1/pi^2
    0.8987
    """
    low, high = validation.positive("low", low), validation.positive("high", high)
    if not low < 1 < high:
        raise ValueError(f"low = {low:g}, high = {high:g}: must be below and above the mean, 1")
    share = (1 - low) / (high - low)
    return float(1 - ((high - low) * np.sin(np.pi * share) / np.pi) ** 2)
