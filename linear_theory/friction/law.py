"""What a law of friction is: a convex potential of the velocity against the ground.

The force on a point that slides with velocity v is -mu N times the gradient of the potential, N its
normal load. All is written over velocity vectors, so that a law may depend on direction: theory and
shell ask for nothing else. A body on a line (`line_balance`) takes the laws that have names and
`Directional` ones only, which it integrates exactly. The coefficient mu cancels in the balance of a
sheet that friction does not deform.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.pairs import pairs_among
from linear_theory.common.shown import Shown, Value

Array = NDArray[np.float64]

ALL = slice(None)


class FrictionLaw(Value, ABC):
    """Potential, force and tangent of the velocity v, per unit of mu N: Coulomb, Tanh, Viscous, or a
    class of one's own.

    v: (components, ...), length per time; 1 component on a line (y), 2 along the ground (x, y), which
    on a slope are those of the level, tilted with it; the laws with names take 3, too. Directions are
    those of x and y, which a sheet is taken not to turn away from by much unless `follows_body` or
    `follows_ground` say what they belong to. At rest potential and force are 0, and the tangent of a
    law that has a width is finite. A new law is a frozen dataclass that inherits from this class, or
    from `Isotropic`. name: by which it is called. Where a scene takes it in, its methods are compared
    with each other (see `trial`), so that none is wrong unnoticed: a ValueError names the method and
    its numbers. Raises ValueError for a slip speed that is not positive.

    >>> import numpy as np
    >>> from linear_theory import Coulomb, FrictionLaw, Tanh, Viscous
    >>> v = np.array([[0.3], [0.4]])  # one velocity in the plane
    >>> for law in (Coulomb(), Tanh(slip_speed=0.5), Viscous()):
    ...     print(f"{law.words}: force {law.force(v).ravel().round(3)}", isinstance(law, FrictionLaw))
    dry friction: force [0.6 0.8] True
    friction tanh(v/0.5): force [0.457 0.609] True
    viscous friction: force [0.3 0.4] True
    >>> print(Coulomb().tangent(v).ravel().round(2))  # xx, xy, yy: nothing along v, 1/|v| across
    [ 1.28 -0.96  0.72]
    """

    name: ClassVar[str]
    map: ClassVar[Any] = None
    """Of the coefficient, a `maps.FrictionMap`; None where it is the same everywhere."""

    def __str__(self) -> str:
        return self.name

    @property
    def even(self) -> bool:
        """Whether the potential is the same for all of (+-v_x, +-v_y).

        Then mirrored motions have mirrored forces and opposite ones opposite forces. Of a law that does
        not say so no symmetry is assumed.
        """
        return False

    @property
    def mirrored(self) -> bool:
        """Whether the potential is the same for (-v_x, v_y): mirrored motions have mirrored forces."""
        return self.even

    @property
    def reversible(self) -> bool:
        """Whether the potential is the same for -v: opposite motions have opposite forces."""
        return self.even

    @property
    def crease(self) -> tuple[float, float] | None:
        """n of the line n . v = 0 across which the tangent jumps; None if it does so at rest alone."""
        return None

    @property
    def on_lower_face(self) -> bool:
        """Whether it acts on the lower face of a sheet that bends, not on its mid-surface."""
        return False

    @property
    def follows_body(self) -> bool:
        """Whether it has axes that turn with the sheet."""
        return False

    @property
    def follows_ground(self) -> bool:
        """Whether it has axes that stay with the ground where the sheet turns."""
        return False

    @property
    @abstractmethod
    def width(self) -> float:
        """Least speed over which the force changes sign: 0 for dry friction, infinite for viscous."""

    @property
    def regularised(self) -> bool:
        """Whether it stands for dry friction and has a width all the same."""
        return 0 < self.width < math.inf

    @property
    def limited(self) -> bool:
        """Whether the force is at most mu N at any speed, as for all laws but the viscous one."""
        return self.width < math.inf

    @property
    def limits(self) -> tuple[float, float]:
        """Largest force against slip towards -y and towards +y, over mu N; infinite if unlimited."""
        largest = 1.0 if self.limited else math.inf
        return largest, largest

    def creep(self, force: float) -> float:
        """Speed along y, signed, of a point that is pulled along y by that force, signed, over mu N."""
        return math.copysign(self.speed_at(abs(force)), force) if force else 0.0

    @property
    def words(self) -> str:
        """What kind of friction it is, for people."""
        return f"{self.name} friction"

    @property
    def details(self) -> str:
        """Its direction and its map, for people; empty if it has neither."""
        return ""

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
    def potential(self, v: Array) -> Array:
        """Dissipation potential, (...), length per time."""

    @abstractmethod
    def force(self, v: Array) -> Array:
        """Its gradient, (components, ...): what the ground takes the point back with."""

    @abstractmethod
    def tangent(self, v: Array) -> Array:
        """Its second derivative, time per length, (pairs, ...): component pairs c <= d (`PAIRS`)."""

    @abstractmethod
    def force_difference(self, v: Array, change: Array, step: float) -> Array:
        """[force(v + step change) - force(v)]/step without cancellation, (components, ...)."""

    @abstractmethod
    def scaled(self, factor: float) -> "FrictionLaw":
        """The law for velocities divided by `factor`: its force at v/factor is this one's at v."""

    @abstractmethod
    def speed_at(self, share: float) -> float:
        """Speed along y at which the force is that share of mu N, in (0, 1) for a law with a limit."""

    def dissipation(self, v: Array) -> Array:
        """Power of friction, force times velocity, (...), length per time.

        >>> import numpy as np
        >>> from linear_theory import Coulomb, Viscous
        >>> v = np.array([[0.3], [0.4]])
        >>> print(Coulomb().dissipation(v), Viscous(speed=2.0).dissipation(v))
        [0.5] [0.125]
        """
        return np.asarray((self.force(v) * v).sum(0))

    @property
    def opposite(self) -> "FrictionLaw":
        """The law whose potential at v is that of this one at -v."""
        return self if self.reversible else Opposite(self)

    def per(self, alpha: float) -> "FrictionLaw":
        """The law for velocities divided by alpha, of either sign; itself for 0."""
        return (self.opposite if alpha < 0 else self).scaled(abs(alpha) or 1.0)

    def at(self, v: Array, kept: slice = ALL) -> "Response":
        """The law at given velocities; kept: the components of forces that are asked for."""
        return Response(self, v, kept)


class Response(Shown):
    """A law at velocities v (components, ...): forces of the kept components, tangents among these.

    Each quantity is evaluated once, when it is first asked for. Laws that share work between force,
    tangent and difference have a response of their own.
    """

    def __init__(self, law: FrictionLaw, v: Array, kept: slice = ALL) -> None:
        self.law, self.v, self.kept = law, v, kept

    def _contents(self) -> Mapping[str, Any]:
        return {"law": self.law, "v": self.v}

    @cached_property
    def force(self) -> Array:
        """See FrictionLaw."""
        return self.law.force(self.v)[self.kept]

    @cached_property
    def tangent(self) -> Array:
        """See FrictionLaw."""
        return self.law.tangent(self.v)[pairs_among(len(self.v), self.kept)]

    def moved(self, change: Array, step: float) -> "tuple[Response, Array]":
        """The law at v + step change, and the difference of the forces over the step."""
        after = self.law.at(self.v + step * change, self.kept)
        return after, self.law.force_difference(self.v, change, step)[self.kept]


@dataclass(frozen=True)
class Derived(FrictionLaw):
    """A law made from another one, `law`, with its axes and its width."""

    law: FrictionLaw

    @property
    def crease(self) -> tuple[float, float] | None:
        """See FrictionLaw."""
        return self.law.crease

    @property
    def on_lower_face(self) -> bool:
        """See FrictionLaw."""
        return self.law.on_lower_face

    @property
    def follows_body(self) -> bool:
        """See FrictionLaw."""
        return self.law.follows_body

    @property
    def follows_ground(self) -> bool:
        """See FrictionLaw."""
        return self.law.follows_ground

    @property
    def width(self) -> float:
        """See FrictionLaw."""
        return self.law.width


@dataclass(frozen=True)
class Opposite(Derived):
    """The law of opposite velocities, for one that is not `reversible`."""

    name: ClassVar[str] = "opposite"

    @property
    def mirrored(self) -> bool:
        """See FrictionLaw."""
        return self.law.mirrored

    @property
    def words(self) -> str:
        """See FrictionLaw."""
        return f"{self.law.words}, reversed"

    @property
    def opposite(self) -> FrictionLaw:
        """See FrictionLaw."""
        return self.law

    @property
    def limits(self) -> tuple[float, float]:
        """See FrictionLaw."""
        backward, forward = self.law.limits
        return forward, backward

    def potential(self, v: Array) -> Array:
        """See FrictionLaw."""
        return self.law.potential(-v)

    def force(self, v: Array) -> Array:
        """See FrictionLaw."""
        return -self.law.force(-v)

    def tangent(self, v: Array) -> Array:
        """See FrictionLaw."""
        return self.law.tangent(-v)

    def force_difference(self, v: Array, change: Array, step: float) -> Array:
        """See FrictionLaw."""
        return -self.law.force_difference(-v, -change, step)

    def scaled(self, factor: float) -> "Opposite":
        """See FrictionLaw."""
        return Opposite(self.law.scaled(factor))

    def creep(self, force: float) -> float:
        """See FrictionLaw."""
        return -self.law.creep(-force)

    def speed_at(self, share: float) -> float:
        """See FrictionLaw."""
        return self.creep(share)
