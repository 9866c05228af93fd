"""Laws of friction: the force on a point as a function of its velocity against the ground.

The force on an element is -mu N f(|w|) w/|w|, w its velocity against the ground, N its normal load. The
coefficient mu cancels in the balance of a sheet that friction does not deform.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Value

Array = NDArray[np.float64]

FAR = 1e3
"""Slip speeds from rest at which tanh is 1 to rounding, and its slope 0, by far."""


class FrictionLaw(Value, ABC):
    """f(r) of the speed r: Coulomb, Tanh, Viscous, or a class of one's own.

    name: by which it is called.

    >>> import numpy as np
    >>> from linear_theory import Coulomb, FrictionLaw, Tanh, Viscous
    >>> for law in (Coulomb(), Tanh(slip_speed=0.1), Viscous()):
    ...     print(f"{law.words}: {0.2 * law.ratio(np.array(0.2)):.3f}", isinstance(law, FrictionLaw))
    dry friction: 1.000 True
    friction tanh(v/0.1): 0.964 True
    viscous friction: 0.200 True

    Raises ValueError for a slip speed that is not positive.
    """

    name: ClassVar[str]

    def __str__(self) -> str:
        return self.name

    @property
    @abstractmethod
    def width(self) -> float:
        """Speed over which the force turns round: 0 for dry friction, infinite for viscous."""

    @property
    def regularised(self) -> bool:
        """Whether it stands for dry friction and has a width all the same."""
        return 0 < self.width < math.inf

    @property
    def words(self) -> str:
        """What kind of friction it is, for people."""
        return f"{self.name} friction"

    @property
    def formula(self) -> str:
        """As a formula, for people."""
        return self.name

    def slip_ratio(self, fastest: float) -> float:
        """`width` over the largest speed (see `CrawlSpeed`); Coulomb friction is dry at rest, too."""
        if self.width == 0:
            return 0.0
        return self.width / fastest if fastest > 0 else math.inf

    @abstractmethod
    def speed_at(self, share: float) -> float:
        """The speed at which the force is that share of its limit, or of its slope without one."""

    @abstractmethod
    def scaled(self, factor: float) -> "FrictionLaw":
        """The law for speeds divided by `factor`."""

    @abstractmethod
    def ratio(self, r: Array) -> Array:
        """f(r)/r."""

    @abstractmethod
    def ratio_slope(self, r: Array) -> Array:
        """d(f(r)/r)/dr / r."""

    @abstractmethod
    def ratio_quotient(self, before: Array, after: Array, slope: Array, step: float) -> Array:
        """[f(r')/r' - f(r)/r]/step for r' = r + step slope, without cancellation."""


@dataclass(frozen=True)
class Coulomb(FrictionLaw):
    """Dry friction, f = 1."""

    name: ClassVar[str] = "coulomb"
    words: ClassVar[str] = "dry friction"
    width: ClassVar[float] = 0.0

    def speed_at(self, share: float) -> float:
        """At rest."""
        return 0.0

    def scaled(self, factor: float) -> "Coulomb":
        """See FrictionLaw."""
        return self

    def ratio(self, r: Array) -> Array:
        """See FrictionLaw."""
        return 1 / r

    def ratio_slope(self, r: Array) -> Array:
        """See FrictionLaw."""
        return -(r**-3)

    def ratio_quotient(self, before: Array, after: Array, slope: Array, step: float) -> Array:
        """See FrictionLaw."""
        return -slope / (before * after)


@dataclass(frozen=True)
class Tanh(FrictionLaw):
    """Regularised dry friction, f = tanh(r/slip_speed) (eq. 3).

    slip_speed: length per time, > 0, else ValueError.
    """

    slip_speed: float
    name: ClassVar[str] = "tanh"

    def __post_init__(self) -> None:
        object.__setattr__(self, "slip_speed", validation.positive("slip_speed", self.slip_speed))

    @property
    def width(self) -> float:
        """The slip speed."""
        return self.slip_speed

    @property
    def words(self) -> str:
        """See FrictionLaw."""
        return f"friction tanh(v/{self.slip_speed:g})"

    @property
    def formula(self) -> str:
        """See FrictionLaw."""
        return "tanh(v/slip_speed)"

    def speed_at(self, share: float) -> float:
        """See FrictionLaw."""
        return self.width * math.atanh(share)

    def scaled(self, factor: float) -> "Tanh":
        """See FrictionLaw."""
        return Tanh(self.slip_speed / factor)

    def ratio(self, r: Array) -> Array:
        """See FrictionLaw."""
        return np.tanh(self._argument(r)) / r

    def ratio_slope(self, r: Array) -> Array:
        """See FrictionLaw."""
        x = self._argument(r)
        sech2 = 1 - np.tanh(x) ** 2
        # x sech^2 x - tanh x, which is -2/3 x^3 for small x, where it would cancel
        series = x**3 * (-2 / 3 + x * x * (8 / 15 - x * x * 34 / 105))
        return np.asarray(np.where(x < 0.03, series, x * sech2 - np.tanh(x)) / r**3)

    def ratio_quotient(self, before: Array, after: Array, slope: Array, step: float) -> Array:
        """See FrictionLaw."""
        t, t_after = np.tanh(self._argument(before)), np.tanh(self._argument(after))
        change = np.tanh(self._argument(step * slope)) / step * (1 - t * t_after)
        return np.asarray((change * before - t * slope) / (before * after))

    def _argument(self, r: Array) -> Array:
        """r/slip_speed, without overflow where its tanh is 1 to rounding anyway."""
        return np.asarray(np.clip(r, -FAR * self.width, FAR * self.width) / self.width)


@dataclass(frozen=True)
class Viscous(FrictionLaw):
    """f = r."""

    name: ClassVar[str] = "viscous"
    width: ClassVar[float] = math.inf

    def speed_at(self, share: float) -> float:
        """See FrictionLaw."""
        return share

    def scaled(self, factor: float) -> "Viscous":
        """See FrictionLaw."""
        return self

    def ratio(self, r: Array) -> Array:
        """See FrictionLaw."""
        return np.ones_like(r)

    def ratio_slope(self, r: Array) -> Array:
        """See FrictionLaw."""
        return np.zeros_like(r)

    def ratio_quotient(self, before: Array, after: Array, slope: Array, step: float) -> Array:
        """See FrictionLaw."""
        return np.zeros_like(before)


FRICTION_LAWS = {law.name: law for law in (Coulomb, Tanh, Viscous)}


def friction_law(friction: object = "coulomb", slip_speed: object = None) -> FrictionLaw:
    """A law, or that of a name: "coulomb", "tanh" with its slip_speed, or "viscous".

    Raises ValueError for anything else, and for a slip_speed that is missing or of no use.
    """
    if isinstance(friction, FrictionLaw):
        if slip_speed is not None:
            raise ValueError(f"slip_speed = {slip_speed!r}: must be None beside {friction!r}")
        return friction
    name = validation.choice("friction", friction, FRICTION_LAWS)
    if name == Tanh.name:
        if slip_speed is None:
            raise ValueError("slip_speed = None: must be > 0 for friction = 'tanh'")
        return Tanh(validation.positive("slip_speed", slip_speed))
    if slip_speed is not None:
        raise ValueError(f"slip_speed = {slip_speed!r}: only friction = 'tanh' has one")
    return Coulomb() if name == Coulomb.name else Viscous()
