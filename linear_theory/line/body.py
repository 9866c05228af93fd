"""A body that carries a travelling wave: velocity and weight as functions of one variable, g.

With n whole waves on the body, s_t = -s_S/(nT), so that in the frame of the mean motion a material
element moves at all times with

    v = -(s - mean s)/(nT) = -(alpha/nT) (z - mean z),   z = (s - s_0)/alpha = g (s_1 + alpha g bend),

s_0, s_1 and `bend` at the mean growth (see `growth`), g = c - mean c. As mean g = 0, mean z =
alpha mean(g^2 bend): of order alpha, without loss of digits.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from linear_theory.line.piece import Piece
from linear_theory.line.profile import Profile
from linear_theory.line.roots import EPS
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

NOISE = 64 * EPS
"""Strains closer to a bound than this fraction of the sum of amplitudes are taken as on it."""


@dataclass(frozen=True)
class Body:
    """A body with a wave of the given profile and |alpha| = `size`; growth: about the mean strain.

    Speeds are in units of |alpha|/(nT), and g has the sign of alpha (c - mean c).
    """

    profile: Profile
    growth: Piece
    size: float

    @classmethod
    def of(cls, wave: TravellingWave, alpha: float, growth: Piece) -> "Body":
        """The body for a wave. Raises ValueError, naming the phase, for a strain out of range."""
        sign = -1.0 if alpha < 0 else 1.0  # (alpha, c) and (-alpha, -c) are equivalent
        profile, size = Profile.of(wave, sign), abs(alpha)
        strain = alpha * wave.mean + size * profile.values
        worst = growth.law.misplaced(
            strain, NOISE * size * (profile.scale + abs(wave.mean)), growth.extreme
        )
        if worst is not None:
            place = f"the phase {profile.nodes[worst]:.4g} of the wave"
            raise growth.law.refusal(alpha, float(strain[worst]), place, growth.extreme)
        growth = growth.about(alpha * wave.mean)
        stretch = growth.law.stretch
        return cls(profile.resolved(lambda g: stretch(growth.start + size * g)), growth, size)

    def height(self, g: Array) -> Array:
        """z."""
        return self.straight(g) + self.bent(g)

    def straight(self, g: Array) -> Array:
        """s_1 g, odd in g."""
        return self.growth.slope(0.0) * g

    def bent(self, g: Array) -> Array:
        """z - s_1 g, of order alpha."""
        return self.size * g**2 * self.growth.bend(self.size * g)

    def slope(self, g: float) -> float:
        """dz/dg."""
        return float(self.growth.slope(self.size * g))

    def at_rest(self, level: float) -> float:
        """The value of g at which z - mean z is the level, or the nearest there is: z rises with g."""
        height = level + self.mean_height
        low, high = float(self.profile.values.min()), float(self.profile.values.max())
        g = min(max(height / self.slope(0.0), low), high)
        for _ in range(50):
            step = (float(self.height(np.array(g))) - height) / self.slope(g)
            g = min(max(g - step, low), high)
            if abs(step) <= 1e-15 * (high - low):
                break
        return g

    def gain(self, g: Array) -> Array:
        """w/w_0 - 1."""
        return self.growth.gain(self.size * g)

    @cached_property
    def mean_height(self) -> float:
        """Mean of z."""
        return self.profile.mean(self.bent)

    @cached_property
    def noise(self) -> float:
        """Rounding error of mean_height: from g, through dz/dg - s_1, and from the sum."""
        steep = self.profile.mean(
            lambda g: abs(self.growth.slope(self.size * g) - self.growth.slope(0.0))
        )
        return 4 * EPS * (self.profile.scale * steep + 2 * abs(self.mean_height))

    @cached_property
    def range(self) -> tuple[float, float]:
        """Smallest and largest speed, z - mean z."""
        ends = self.height(np.array([self.profile.values.min(), self.profile.values.max()]))
        return float(ends[0]) - self.mean_height, float(ends[1]) - self.mean_height

    def fastest(self, level: float) -> float:
        """Largest speed relative to the ground of a body that moves with `level`."""
        return max(abs(end - level) for end in self.range)
