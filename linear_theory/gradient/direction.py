"""A direction in the space of scenes, along which a derivative is taken."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.maps import FrictionMap
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]
Function = Callable[[Array, Array, Array], Array]

SAME = 1e-11
"""Difference of dc(t + T/2) and -dc(t), over the largest |dc|, below which they are the same."""

PLACES = np.array([-0.43, -0.17, 0.08, 0.31])
"""Shares of length, width and period at which that is tried."""


class Harmonic(NamedTuple):
    """cosine cos(k phi) + sine sin(k phi), phi = 2 pi (n y/L - t/T) as in its wave, k >= 0."""

    k: int
    cosine: float
    sine: float = 0.0


class GrowthChange(NamedTuple):
    """dc and its rate as functions of x, y, t that broadcast, per unit of a parameter.

    across: whether they depend on x.
    """

    value: Function
    rate: Function
    across: bool = True

    @classmethod
    def between(cls, ahead: Drive, behind: Drive, apart: float) -> "GrowthChange":
        """By a central difference of two drives."""

        def value(x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
            return np.asarray((ahead.value(x, y, t) - behind.value(x, y, t)) / apart)

        def rate(x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
            return np.asarray((ahead.rate(x, y, t) - behind.rate(x, y, t)) / apart)

        return cls(value, rate, ahead.depends_on_x or behind.depends_on_x)

    def changes_sign(self, drive: Drive) -> bool:
        """Whether dc(t + T/2) = -dc(t), at some points."""
        sheet, period = drive.sheet, drive.period
        x, y = sheet.width * PLACES[:, None], sheet.length * PLACES
        t = period * PLACES[:, None, None]
        now, later = self.value(x, y, t), self.value(x, y, t + period / 2)
        return bool(abs(now + later).max() <= SAME * abs(now).max())


class LawsAside(NamedTuple):
    """Two laws of friction on either side of the own one, and by what their number differs."""

    ahead: FrictionLaw
    behind: FrictionLaw
    apart: float


class MapsAside(NamedTuple):
    """The same of maps of friction."""

    ahead: FrictionMap
    behind: FrictionMap
    apart: float


@dataclass(frozen=True)
class Direction:
    """What a parameter changes in a scene, per unit of it.

    harmonics, growth: c, of which the first is for scenes with a `TravellingWave`; alpha: the growth
    coupling; slip, period, width: the logarithms of the slip speed, of the period and of the width of
    the sheet; poisson: Poisson's ratio; law, map: friction. bending: whether it is one that a sheet has
    that bends on its ground alone, see `parameters.bending`.
    """

    harmonics: tuple[Harmonic, ...] = ()
    growth: GrowthChange | None = None
    alpha: float = 0.0
    slip: float = 0.0
    period: float = 0.0
    width: float = 0.0
    poisson: float = 0.0
    law: LawsAside | None = None
    map: MapsAside | None = None
    bending: bool = False

    @property
    def deforms(self) -> bool:
        """Whether it changes the deformation of a sheet that bends, or the ratio of its couplings."""
        couplings = bool(self.alpha) or self.bending
        return couplings or bool(self.harmonics or self.growth or self.width or self.poisson)

    @property
    def highest(self) -> int:
        """The highest harmonic, 0 if there is none."""
        return max((one.k for one in self.harmonics), default=0)

    def keeps_sign(self, drive: Drive) -> bool:
        """Whether c(t + T/2) = -c(t) and friction that is the same for -v are kept."""
        law, growth = self.law, self.growth
        if law is not None and not (law.ahead.reversible and law.behind.reversible):
            return False
        if not all(one.k % 2 for one in self.harmonics):
            return False
        return growth is None or growth.changes_sign(drive)
