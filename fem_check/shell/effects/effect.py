"""The interface of effects.

An effect is a potential: a sum over points of a density that depends on the position and its
derivatives. It states which derivatives (`entries`) it reads and returns, at every point, its value,
gradient and Hessian with respect to them, in arrays of its own. Sums over elements and unknowns are
computed for all effects together. No other code depends on the class of an effect: effects are an open
set.

The Hessian is symmetric in (entry, component); the blocks of the component pairs c <= d are stored, in
the order of `pairs.PAIRS`: block [k, l, (c, d)] belongs to component c of entry k and d of entry l.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import TYPE_CHECKING, ClassVar, Self

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.contact.coupling import Coupling
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.load import Load
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet

if TYPE_CHECKING:  # finite elements, which answers in closed form do not load
    from fem_check.shell.kinematics.discretisation import Discretisation

Array = NDArray[np.float64]


class Effect(ABC):
    """A potential given point by point, and its requirements on the scene.

    Energies are in force times length. A new effect is a frozen dataclass that inherits from this class
    and from `Value`: scene, potential, power balance, cycle and stepper use only this interface.

    entries: which of x, x_1, x_2, x_11, x_22, x_12 (0 ... 5) it reads. reads_rest: whether it needs a
    rest state. needs_space: whether it requires three components. is_static: whether it is defined
    without a velocity. moves: whether it makes a scene time dependent. stretches: whether it gives the
    sheet in-plane stiffness. bends: whether it depends on a rest curvature. damps: whether part of its
    force is dissipative. load: the reference area of its force, if any. incline: of the ground,
    radians. law, mu: of friction. areal_mass: mass per undeformed area. stored_as: the entry of the
    power balance (see `power.Works`) to which its energy belongs; None if it stores none. couples:
    whether it acts between distant parts of the sheet, see `coupling`.
    """

    entries: ClassVar[Entries]
    reads_rest: ClassVar[bool] = False
    needs_space: ClassVar[bool] = False
    is_static: ClassVar[bool] = True
    moves: ClassVar[bool] = False
    stretches: ClassVar[bool] = False
    bends: ClassVar[bool] = False
    damps: ClassVar[bool] = False
    couples: ClassVar[bool] = False
    load: Load | None = None
    incline: float = 0.0
    law: FrictionLaw | None = None
    mu: float | None = None
    areal_mass: float = 0.0
    stored_as: ClassVar[str | None] = "weight"

    @abstractmethod
    def energy(self, state: PointState) -> Array:
        """Energy of each point, (points,)."""

    @abstractmethod
    def gradient(self, state: PointState) -> Array:
        """Derivative with respect to the entries, (entries, components, points)."""

    @abstractmethod
    def hessian(self, state: PointState) -> Array | None:
        """Second derivative, (entries, entries, component pairs, points); None if it vanishes."""

    def under(self, sheet: Sheet) -> Self:
        """The effect adapted to that sheet."""
        return self

    def idle(self, components: int) -> bool:
        """Whether it does no work in a scene with 2 or 3 components."""
        return False

    def pressed_by(self, components: int) -> Load | None:
        """The normal load by which it presses the sheet on the ground; None if it does not."""
        return None

    def normal_load(self, state: PointState) -> Array:
        """Normal force between sheet and ground at each point, (points,), if it presses."""
        raise NotImplementedError

    def coupling(self, discretisation: "Discretisation", scene: Scene) -> Coupling:
        """What it does between distant parts of the sheet, if it `couples`.

        Raises ValueError for a mesh on which that cannot be computed.
        """
        raise NotImplementedError

    @property
    def load_follows_shape(self) -> bool:
        """Whether `normal_load` depends on the position of the sheet."""
        return self.pressed_by(3) is Load.GROUND

    def ground_normal(self, state: PointState) -> Array | None:
        """Unit normal of the ground under each point, (3, points); None if it is e_z."""
        return None

    def check_elements(self, discretisation: "Discretisation", scene: Scene) -> None:  # noqa: B027
        """Raise ValueError if the elements of a scene do not suit it, before any step in time."""

    def check_scene(self, scene: Scene) -> None:  # noqa: B027 - most need nothing
        """Raise ValueError if the scene lacks what the effect requires or contradicts it."""

    def check(self, components: int, step: Step | None) -> None:  # noqa: B027
        """Raise ValueError if a potential lacks what the effect requires."""

    def beyond_theory(self, scene: Scene) -> str:
        """The part that theories of a flat rectangle cannot represent, in words; empty if none."""
        return type(self).__name__

    def beyond_plate(self, scene: Scene) -> str:
        """The part that the theory of a plate on its ground cannot represent; empty if none."""
        return self.beyond_theory(scene)

    @property
    def plate_numbers(self) -> Mapping[str, float | Load]:
        """Numbers that it contributes to `linear_theory`'s `Foundation` of a plate."""
        return {}

    def beyond_cycle(self, scene: Scene) -> str:
        """The part that a cycle of static shapes cannot represent, in words; empty if none."""
        return "" if self.is_static else type(self).__name__
