"""Laws that are another law at each point, and say something more: a map, the face on which it acts."""

from abc import abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.friction.law import ALL, Derived, FrictionLaw, Response

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Wrapped(Derived):
    """A law with the forces of `law` at each velocity, its axes, its width and its symmetries."""

    @abstractmethod
    def around(self, law: FrictionLaw) -> Self:
        """The same around another law."""

    @property
    def even(self) -> bool:
        """See FrictionLaw."""
        return self.law.even

    @property
    def mirrored(self) -> bool:
        """See FrictionLaw."""
        return self.law.mirrored

    @property
    def reversible(self) -> bool:
        """See FrictionLaw."""
        return self.law.reversible

    @property
    def limits(self) -> tuple[float, float]:
        """See FrictionLaw."""
        return self.law.limits

    @property
    def formula(self) -> str:
        """See FrictionLaw."""
        return self.law.formula

    @property
    def opposite(self) -> Self:
        """See FrictionLaw."""
        return self.around(self.law.opposite)

    def scaled(self, factor: float) -> Self:
        """See FrictionLaw."""
        return self.around(self.law.scaled(factor))

    def potential(self, v: Array) -> Array:
        """See FrictionLaw."""
        return self.law.potential(v)

    def force(self, v: Array) -> Array:
        """See FrictionLaw."""
        return self.law.force(v)

    def tangent(self, v: Array) -> Array:
        """See FrictionLaw."""
        return self.law.tangent(v)

    def force_difference(self, v: Array, change: Array, step: float) -> Array:
        """See FrictionLaw."""
        return self.law.force_difference(v, change, step)

    def creep(self, force: float) -> float:
        """See FrictionLaw."""
        return self.law.creep(force)

    def speed_at(self, share: float) -> float:
        """See FrictionLaw."""
        return self.law.speed_at(share)

    def at(self, v: Array, kept: slice = ALL) -> Response:
        """See FrictionLaw."""
        return self.law.at(v, kept)


@dataclass(frozen=True)
class OnLowerFace(Wrapped):
    """A law of friction that acts on the lower face of a sheet, not on its mid-surface.

    The lower face lies at x - (h/2) n, h the thickness and n the unit normal, upwards. Where the sheet
    turns it slips by -(h/2) dn/dt in addition, +(h/2) grad(w_t) for a small deflection w upwards. Two
    sheets that are mirror images of each other, upside down, differ: the lower face of one is the upper
    face of the other. The ground presses as before, by the height of the mid-surface. law: any law
    that does not say this itself. Raises ValueError for anything else.

    >>> from linear_theory import Coulomb, OnLowerFace
    >>> print(OnLowerFace(Coulomb()).words)
    dry friction, on the lower face
    """

    name: ClassVar[str] = "on lower face"

    def __post_init__(self) -> None:
        kind: Any = FrictionLaw
        validation.instance("law", self.law, kind)
        if self.law.on_lower_face:
            raise ValueError(f"law = {validation.shown(self.law)}: must be a law without a face")

    @property
    def on_lower_face(self) -> bool:
        """See FrictionLaw."""
        return True

    @property
    def map(self) -> Any:
        """That of the law."""
        return self.law.map

    @property
    def words(self) -> str:
        """See FrictionLaw."""
        return f"{self.law.words}, on the lower face"

    @property
    def details(self) -> str:
        """See FrictionLaw."""
        return ", ".join(filter(None, [self.law.details, "on the lower face"]))

    def around(self, law: FrictionLaw) -> "OnLowerFace":
        """See Wrapped."""
        return OnLowerFace(law)
