"""The laws of friction that have names: dry, dry with a width (eq. 3), viscous."""

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.validation import shown
from linear_theory.friction.isotropic import Isotropic, IsotropicResponse
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.trial import check_law

Array = NDArray[np.float64]

EXTREME = 1e100
"""Bound of the speed of viscous friction and of its inverse, so that squares of forces are numbers."""


@dataclass(frozen=True)
class Coulomb(Isotropic):
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

    def energy(self, r: Array) -> Array:
        """See Isotropic."""
        return r

    def size(self, r: Array) -> Array:
        """See Isotropic."""
        return np.ones_like(r)

    def slope(self, r: Array) -> Array:
        """See Isotropic."""
        return np.zeros_like(r)

    def rise(
        self,
        before: IsotropicResponse,
        after: IsotropicResponse,
        change: Array,
        step: float | Array,
    ) -> Array:
        """See Isotropic."""
        return np.zeros_like(change)


@dataclass(frozen=True)
class Tanh(Isotropic):
    """Regularised dry friction, f = tanh(r/slip_speed) (eq. 3).

    slip_speed: length per time, > 0, else ValueError. Small against the speeds it is
    dry friction, large against them viscous.
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

    def energy(self, r: Array) -> Array:
        """slip_speed log cosh(r/slip_speed): about r^2/(2 slip_speed) near 0, r - log 2 slip_speed far
        away."""
        s = self._argument(r)
        near = np.log1p(2 * np.sinh(np.minimum(s, 1) / 2) ** 2)
        if s.max(initial=0) < 1:
            return np.asarray(self.width * near)
        far = np.log1p(self._decay(r)) - math.log(2)
        return np.asarray(np.where(s < 1, self.width * near, r + self.width * far))

    def size(self, r: Array) -> Array:
        """See Isotropic; also for r < 0, odd."""
        return np.tanh(self._argument(r))

    def slope(self, r: Array) -> Array:
        """See Isotropic. 1/(slip_speed cosh(r/slip_speed)^2)."""
        decay = self._decay(r)
        return np.asarray(4 * decay / (1 + decay) ** 2 / self.width)

    def rise(
        self,
        before: IsotropicResponse,
        after: IsotropicResponse,
        change: Array,
        step: float | Array,
    ) -> Array:
        """See Isotropic. By tanh b - tanh a = tanh(b - a) (1 - tanh a tanh b)."""
        a, b = self._decay(before.speed), self._decay(after.speed)
        return np.asarray(self.size(step * change) / step * (2 * (a + b) / ((1 + a) * (1 + b))))

    def _decay(self, r: Array) -> Array:
        """exp(-2 r/slip_speed), what tanh is from 1, for r >= 0."""
        return np.exp(-2 * self._argument(r))

    def _argument(self, r: Array) -> Array:
        """r/slip_speed; infinite beyond doubles, where tanh is 1 and its slope 0 all the same."""
        with np.errstate(over="ignore"):
            return np.asarray(r / self.width)


@dataclass(frozen=True)
class Viscous(Isotropic):
    """f = r/speed.

    speed: at which the force is mu N, length per time, from 1e-100 to 1e100, else ValueError. On level
    ground, for a sheet that friction does not deform, it does not count.
    """

    speed: float = 1.0
    name: ClassVar[str] = "viscous"
    width: ClassVar[float] = math.inf

    def __post_init__(self) -> None:
        speed = validation.positive("speed", self.speed)
        if not 1 / EXTREME <= speed <= EXTREME:
            raise ValueError(f"speed = {speed:g}: must be from {1 / EXTREME:g} to {EXTREME:g}")
        object.__setattr__(self, "speed", speed)

    def speed_at(self, share: float) -> float:
        """See FrictionLaw."""
        return share * self.speed

    def scaled(self, factor: float) -> "Viscous":
        """See FrictionLaw."""
        return Viscous(self.speed / factor)

    def energy(self, r: Array) -> Array:
        """See Isotropic."""
        return np.asarray(r * r / (2 * self.speed))

    def size(self, r: Array) -> Array:
        """See Isotropic."""
        return np.asarray(r / self.speed)

    def slope(self, r: Array) -> Array:
        """See Isotropic."""
        return np.full_like(r, 1 / self.speed)

    def rise(
        self,
        before: IsotropicResponse,
        after: IsotropicResponse,
        change: Array,
        step: float | Array,
    ) -> Array:
        """See Isotropic."""
        return np.asarray(change / self.speed)


FRICTION_LAWS: dict[str, type[FrictionLaw]] = {law.name: law for law in (Coulomb, Tanh, Viscous)}


def checked_law(law: FrictionLaw, components: int, argument: str = "friction") -> FrictionLaw:
    """The law, once its methods are tried for velocities of so many components; those here need not be.

    Raises ValueError as `trial.check_law` does.
    """
    if type(law) not in FRICTION_LAWS.values():
        check_law(law, components, argument)
    return law


DRY = "dry"
"""Another name of Coulomb's law, that of scene files and of answers."""


def friction_law(
    friction: object = "coulomb", slip_speed: object = None, argument: str = "friction"
) -> FrictionLaw:
    """A law, or that of a name: "coulomb" or "dry", "tanh" with its slip_speed, or "viscous".

    argument: its name, for messages. Raises ValueError for anything else, for a slip_speed that is
    missing or of no use, and for a law of one's own whose methods contradict each other in the plane.
    """
    if isinstance(friction, FrictionLaw):
        if slip_speed is not None:
            raise ValueError(f"slip_speed = {shown(slip_speed)}: must be None beside {shown(friction)}")
        return checked_law(friction, 2, argument)
    if isinstance(friction, str) and friction == DRY:
        friction = Coulomb.name
    name = validation.choice(argument, friction, FRICTION_LAWS)
    if name == Tanh.name:
        if slip_speed is None:
            raise ValueError(f"slip_speed = None: must be > 0 for {argument} = 'tanh'")
        return Tanh(slip_speed)  # type: ignore[arg-type]  # checked there
    if slip_speed is not None:
        raise ValueError(f"slip_speed = {shown(slip_speed)}: only {argument} = 'tanh' has one")
    return Coulomb() if name == Coulomb.name else Viscous()
