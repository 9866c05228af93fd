"""How a sheet meets the ground: what rests on it, how it rubs, and how steep the ground is."""

from dataclasses import dataclass

from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.laws import Coulomb, friction_law
from linear_theory.friction.load import Load


@dataclass(frozen=True)
class Contact(Value):
    """The normal load, the law of friction, and the pull of a slope.

    load: a `Load` or its name; friction: a `FrictionLaw` or its name. slope: force of the weight down
    the slope (towards -y) over mu times its load, tan(incline)/mu. Raises ValueError for other names
    and numbers that are not finite.

    >>> from linear_theory import Contact, Tanh
    >>> print(Contact("grown", Tanh(0.01)))
    Contact(load=grown, friction=Tanh(slip_speed=0.01), slope=0)
    """

    load: Load = Load.CURRENT
    friction: FrictionLaw = Coulomb()  # noqa: RUF009 - a frozen value
    slope: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "load", Load.named(self.load, tuple(Load)))
        object.__setattr__(self, "friction", friction_law(self.friction))
        object.__setattr__(self, "slope", validation.real("slope", self.slope))

    @classmethod
    def named(
        cls, load: object = None, friction: object = None, slip_speed: object = None
    ) -> "Contact":
        """From names or objects; None for the defaults, "current" load and "coulomb" friction."""
        kind = Load.CURRENT if load is None else Load.named(load)
        return cls(kind, friction_law("coulomb" if friction is None else friction, slip_speed))
