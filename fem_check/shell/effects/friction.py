"""Friction with the ground as the potential of one time step."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.kinematics.point_state import PointState, dot, once_per_state
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from linear_theory.common import validation
from linear_theory.common.pairs import outer, pairs_among, product
from linear_theory.common.shown import Value
from linear_theory.friction.law import FrictionLaw, Response
from linear_theory.friction.laws import Tanh, checked_law, friction_law
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]


WEAK = 0.1
"""Largest strain by friction over that by growth at which a shape counts as not affected by friction.
Dry speeds of the paper's sheet by `simulate` (a sine and a pulse, two loads, alpha = 0.05 and 0.25)
then are within 1.5 % of a cycle's, at a tenth of it within 0.2 %, at three times as much within 8 %."""


def friction_over_growth(scene: Scene) -> float:
    """Strain by friction, mu (weight per area) L/(E h), over that by growth, |alpha|.

    0 without friction, infinite where alpha = 0.
    """
    friction, gravity = scene.find(Friction), scene.find(Gravity)
    if friction is None or gravity is None:
        return 0.0
    material = scene.find(Membrane).material
    strain = friction.coefficient * gravity.weight * scene.sheet.length
    strain /= material.young * material.thickness
    return float(strain / abs(scene.alpha)) if scene.alpha else np.inf


@dataclass(frozen=True, init=False)
class Friction(Value, Effect):
    """The force -mu N f(v) of a law f of friction, whose potential is mu N times that of the law.

    coefficient: mu > 0. slip_speed: v0 > 0, length per time, of the law tanh(|v|/v0) v/|v| of eq. 3; or
    law: any `FrictionLaw` or its name, but for dry friction, which has no derivative at rest. v is the
    velocity along the ground at the end of the step, an affine function of the position, and N the load
    that the step holds fixed. Raises ValueError for values out of range, and unless exactly one of
    slip_speed and law is given.

    >>> from fem_check import Friction
    >>> from linear_theory import Tanh, Viscous
    >>> print(Friction(0.5, slip_speed=0.01) == Friction(0.5, law=Tanh(0.01)))
    True
    >>> print(Friction(0.5, law=Viscous()).law.words)
    viscous friction
    """

    coefficient: float
    law: FrictionLaw
    entries: ClassVar[Entries] = (0,)
    is_static: ClassVar[bool] = False
    moves: ClassVar[bool] = True
    stored_as: ClassVar[None] = None

    def __init__(
        self,
        coefficient: float,
        slip_speed: float | None = None,
        law: FrictionLaw | str | None = None,
    ) -> None:
        object.__setattr__(self, "coefficient", validation.positive("coefficient", coefficient))
        object.__setattr__(self, "law", _law(slip_speed, law))

    @property
    def slip_speed(self) -> float:
        """Width of the law, length per time."""
        return self.law.width

    @property
    def mu(self) -> float:  # type: ignore[override]
        """See Effect."""
        return self.coefficient

    def velocity(self, state: PointState) -> Array:
        """Velocity along the ground, (components, points)."""
        return _along(state, state.step.moving(state.position))

    def force(self, state: PointState) -> Array:
        """Force of the ground on each point, (components, points)."""
        return -self.gradient(state)[0]

    def energy(self, state: PointState) -> Array:
        """See Effect. Time step times dissipation potential."""
        scale = self._limit(state) / state.step.moving.rate
        return np.asarray(scale * self.law.potential(self._met(state).v))

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        limit, force = self._limit(state), self._met(state).force
        if not _is_level(state):
            return np.asarray(limit * _along(state, force))[None]
        out = np.zeros((1, 3, limit.size))
        np.multiply(limit, force, out=out[0, :2])
        return out

    def hessian(self, state: PointState) -> Array:
        """See Effect."""
        scale, tangent = self._limit(state) * state.step.moving.rate, self._met(state).tangent
        if _is_level(state):
            return _spread(scale * tangent)[None, None]
        return np.asarray(scale * _tangent_along(state, tangent))[None, None]

    @once_per_state
    def _met(self, state: PointState) -> Response:
        """The law at the velocities; on level ground at those in the plane, at half the cost."""
        if not _is_level(state):
            return self.law.at(self.velocity(state))
        rule = state.step.moving
        return self.law.at(rule.rate * (state.position[:2] - rule.base[:2]))

    def _limit(self, state: PointState) -> Array:
        """mu N, (points,)."""
        return np.asarray(self.coefficient * state.step.pressed)

    def check_scene(self, scene: Scene) -> None:
        """Raise ValueError for friction without load, and for a law that is wrong in space."""
        checked_law(self.law, scene.components, "law")
        if not any(effect.pressed_by(scene.components) for effect in scene.effects):
            kind, where = ("Gravity", "in the plane") if scene.planar else ("Ground", "in space")
            raise ValueError(f"effects: Friction must come with {kind}, its load {where}")

    def beyond_theory(self, scene: Scene) -> str:
        """Friction so strong that it deforms the sheet."""
        return self.beyond_cycle(scene)

    def beyond_cycle(self, scene: Scene) -> str:
        """Friction so strong that it deforms the sheet."""
        ratio = friction_over_growth(scene)
        if ratio <= WEAK or scene.alpha == 0:
            return ""
        return (
            f"Friction that deforms the sheet: mu weight L/(E h |alpha|) = {ratio:.3g}, must be <= "
            f"{WEAK:g}"
        )

    def check(self, components: int, step: Step | None) -> None:
        """Raise ValueError without a time step."""
        if step is None or step.velocity is None or step.load is None:
            raise ValueError(
                "step: Friction needs one with a velocity and a load; it has no static form"
            )


def _law(slip_speed: float | None, law: FrictionLaw | str | None) -> FrictionLaw:
    """That of the arguments of Friction. Raises ValueError unless they give one with a width."""
    found = friction_law(Tanh.name if law is None else law, slip_speed, "law")
    if found.width == 0:
        raise ValueError(
            f"law = {found!r}: must have a derivative at rest, which a step in time needs; use "
            "Tanh(slip_speed), dry friction for speeds well above its slip speed"
        )
    return found


def _is_level(state: PointState) -> bool:
    """Whether the sheet is in space on level ground, so that vectors along it lie in the plane."""
    return state.components == 3 and state.step.normal is None


def _along(state: PointState, vector: Array) -> Array:
    """The part along the ground of vectors (components, points)."""
    if state.components == 2:
        return vector
    if state.step.normal is None:
        return np.stack([vector[0], vector[1], np.zeros_like(vector[0])])
    normal = state.step.normal
    return np.asarray(vector - normal * dot(normal, vector))


def _tangent_along(state: PointState, tangent: Array) -> Array:
    """P K P of symmetric tensors K (pairs, points), P = 1 - n n along the ground."""
    normal = state.step.normal
    if normal is None:
        return tangent
    across = product(tangent, normal)
    both = outer(normal, across) + outer(across, normal)
    return np.asarray(tangent - both + dot(normal, across) * outer(normal, normal))


def _spread(tangent: Array) -> Array:
    """Tensors of the plane, (3, points), as those of space, (6, points)."""
    out = np.zeros((6, *tangent.shape[1:]))
    out[pairs_among(3, slice(0, 2))] = tangent
    return out
