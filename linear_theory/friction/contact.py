"""How a sheet meets the ground: what rests on it, how it rubs, and how steep the ground is."""

from dataclasses import dataclass

from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.laws import Coulomb, friction_law
from linear_theory.friction.load import Load

DRY = Coulomb()


@dataclass(frozen=True, init=False)
class Contact(Value):
    """The normal load, the law of friction, and the pull of a slope.

    load: a `Load` or its name; friction: a `FrictionLaw` or its name. slope: force of the weight down
    the slope (towards -y) over mu times its load, tan(incline)/mu. Raises ValueError for other names
    and numbers that are not finite.

    >>> from linear_theory import Contact, Tanh
    >>> print(Contact("grown", Tanh(0.01)))
    Contact(load=grown, friction=Tanh(slip_speed=0.01), slope=0)
    """

    load: Load
    friction: FrictionLaw
    slope: float

    def __init__(
        self,
        load: Load | str = Load.CURRENT,
        friction: FrictionLaw | str = DRY,
        slope: float = 0.0,
    ) -> None:
        object.__setattr__(self, "load", Load.named(load, tuple(Load)))
        object.__setattr__(self, "friction", friction_law(friction))
        object.__setattr__(self, "slope", validation.real("slope", slope))

    @classmethod
    def named(
        cls, load: object = None, friction: object = None, slip_speed: object = None
    ) -> "Contact":
        """From names or objects; None for the defaults, "current" load and "coulomb" friction."""
        kind = Load.CURRENT if load is None else Load.named(load)
        return cls(kind, friction_law("coulomb" if friction is None else friction, slip_speed))
