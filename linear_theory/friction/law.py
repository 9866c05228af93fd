"""Friction: how the force on a point depends on its speed (law) and on what rests on it (load).

The force on an element is -mu N f(|w|) w/|w|, w its velocity against the ground. The coefficient mu
cancels in the balance of a sheet that friction does not deform.
"""

import math
import warnings
from dataclasses import dataclass
from decimal import ROUND_DOWN, Context

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.errors import ViscousRegimeWarning
from linear_theory.common.shown import Value
from linear_theory.motion.cells import gauss
from linear_theory.motion.motion import Motion
from linear_theory.speed.result import DRY_RATIO, CrawlSpeed

Array = NDArray[np.float64]

LOADS = ("current", "grown", "material")
LAWS = ("coulomb", "tanh", "viscous")

FAR = 1e3
"""Slip speeds from rest at which tanh is 1 to rounding, and its slope 0, by far."""


@dataclass(frozen=True)
class FrictionLaw(Value):
    """f(r) of the speed r: 1 ("coulomb"), tanh(r/slip_speed) ("tanh", eq. 3), or r ("viscous").

    slip_speed: length per time, > 0, for "tanh" only. Raises ValueError otherwise.
    """

    name: str = "coulomb"
    slip_speed: float | None = None

    def __post_init__(self) -> None:
        validation.choice("friction", self.name, LAWS)
        if self.name == "tanh":
            if self.slip_speed is None:
                raise ValueError("slip_speed = None: must be > 0 for friction = 'tanh'")
            object.__setattr__(self, "slip_speed", validation.positive("slip_speed", self.slip_speed))
        elif self.slip_speed is not None:
            raise ValueError(f"slip_speed = {self.slip_speed!r}: only friction = 'tanh' has one")

    @property
    def width(self) -> float:
        """Speed over which the force turns round: 0 for Coulomb, infinite for viscous friction."""
        return {"coulomb": 0.0, "viscous": np.inf}.get(self.name, self.slip_speed or 0.0)

    def slip_ratio(self, fastest: float) -> float:
        """`width` over the largest speed (see `CrawlSpeed`); Coulomb friction is dry at rest, too."""
        if self.width == 0:
            return 0.0
        return self.width / fastest if fastest > 0 else math.inf

    def scaled(self, factor: float) -> "FrictionLaw":
        """The law for speeds divided by `factor`."""
        if self.slip_speed is None:
            return self
        return FrictionLaw(self.name, self.slip_speed / factor)

    def ratio(self, r: Array) -> Array:
        """f(r)/r."""
        if self.name == "viscous":
            return np.ones_like(r)
        return self._force(r) / r

    def ratio_slope(self, r: Array) -> Array:
        """d(f(r)/r)/dr / r."""
        if self.name == "viscous":
            return np.zeros_like(r)
        if self.name == "coulomb":
            return -(r**-3)
        x = self._argument(r)
        sech2 = 1 - np.tanh(x) ** 2
        # x sech^2 x - tanh x, which is -2/3 x^3 for small x, where it would cancel
        series = x**3 * (-2 / 3 + x * x * (8 / 15 - x * x * 34 / 105))
        return np.asarray(np.where(x < 0.03, series, x * sech2 - np.tanh(x)) / r**3)

    def ratio_quotient(self, before: Array, after: Array, slope: Array, step: float) -> Array:
        """[f(r')/r' - f(r)/r]/step for r' = r + step slope, without cancellation."""
        if self.name == "viscous":
            return np.zeros_like(before)
        if self.name == "coulomb":
            return -slope / (before * after)
        t, t_after = np.tanh(self._argument(before)), np.tanh(self._argument(after))
        change = np.tanh(self._argument(step * slope)) / step * (1 - t * t_after)
        return np.asarray((change * before - t * slope) / (before * after))

    def _force(self, r: Array) -> Array:
        return np.ones_like(r) if self.name == "coulomb" else np.tanh(self._argument(r))

    def _argument(self, r: Array) -> Array:
        """r/width, of "tanh", without overflow where that is 1 to rounding anyway."""
        return np.asarray(np.clip(r, -FAR * self.width, FAR * self.width) / self.width)


def warn_if_viscous(found: CrawlSpeed, slip_speed: float | None) -> None:
    """Warn where friction tanh(v/slip_speed), which stands for dry friction, acts as viscous.

    slip_speed: None for laws that have none, which are what they are called. To be called by the
    function that the user calls, to whose line the warning points. No warning where nothing moves.
    """
    if slip_speed is None or found.regime != "viscous" or math.isinf(found.slip_ratio):
        return
    fastest = slip_speed / found.slip_ratio
    warnings.warn(
        f"slip_speed = {slip_speed:.4g} is {found.slip_ratio:.3g} times the largest speed against the "
        f"ground, {fastest:.3g}: friction tanh(v/slip_speed) acts as viscous; at such speeds it is dry "
        f"for a slip_speed below about {DRY_RATIO * fastest:.3g}",
        ViscousRegimeWarning,
        stacklevel=3,
    )


def load_rate(load: str, dilation: Array, growth: Array) -> Array:
    """e of the load 1 + alpha e per reference area, from tr(strain) and c per unit alpha.

    "current": weight grows with the current area, e = tr(strain), J of eq. 11; "grown": with the area
    of the grown reference, e = 2c; "material": weight is conserved, e = 0. Raises ValueError for other
    names.
    """
    validation.choice("load", load, LOADS)
    return {"current": dilation, "grown": 2 * growth, "material": np.zeros_like(growth)}[load]


def check_load(motion: Motion, rate: Array, alpha: float) -> None:
    """Raise ValueError where the load 1 + alpha e is not positive, edges included, and say where."""
    to_edges = gauss(rate.shape[-1]).with_ends
    everywhere = to_edges @ rate @ to_edges.T
    lowest = 1 + alpha * everywhere
    if lowest.min() > 0:
        return
    _, cell, i, j = np.unravel_index(lowest.argmin(), lowest.shape)
    x, y = (to_edges @ motion.position[:, cell] @ to_edges.T)[:, i, j]
    limit = -1 / everywhere.min() if alpha > 0 else -1 / everywhere.max()
    raise ValueError(
        f"alpha = {alpha:g}: the area element 1 + alpha tr(strain) would be {lowest.min():.3g} at "
        f"x = {x:.3g}, y = {y:.3g}; must be {'<' if alpha > 0 else '>'} {_towards_zero(limit)}"
    )


def _towards_zero(limit: float, digits: int = 4) -> str:
    """A limit in so many digits that never promise more than it allows."""
    return f"{float(Context(prec=digits, rounding=ROUND_DOWN).create_decimal(limit)):g}"
