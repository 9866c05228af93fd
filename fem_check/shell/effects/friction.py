"""Friction with the ground as the potential of one time step."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.effects.lower_face import LowerFace
from fem_check.shell.kinematics.point_state import PointState, dot, once_per_state
from fem_check.shell.kinematics.rates import Affine, Step
from fem_check.shell.kinematics.region import Entries
from linear_theory.common import validation
from linear_theory.common.pairs import PAIRS, pairs_among
from linear_theory.common.shown import Value
from linear_theory.common.validation import shown
from linear_theory.friction.law import FrictionLaw, Response
from linear_theory.friction.laws import Tanh, checked_law, friction_law
from linear_theory.friction.wrapped import OnLowerFace
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]


WEAK = 0.1
"""Largest strain by friction over that by growth at which a shape counts as not affected by friction.
On random sheets with sines and pulses, three loads, dry to viscous (`figures.measure.limits.
friction_strength`), friction that acts back then changes V by at most 2e-3 alpha L/T: 3 % of V, but
4 and 16 % of two whose orders in alpha nearly cancel. It grows with the square: at a tenth by some
hundredth of that. Dry speeds of the paper's sheet agree (1.5 %, and 8 % at three times as much)."""


SURFACES = ("middle", "bottom")
"""Where friction may act."""


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
    that the step holds fixed. surface: where it acts, on the "middle" surface or at the "bottom", the
    lower face of a sheet that bends: short for a law that is `OnLowerFace`. Raises ValueError for
    values out of range, and unless exactly one of slip_speed and law is given.

    >>> from fem_check import Friction
    >>> from linear_theory import Tanh, Viscous
    >>> print(Friction(0.5, slip_speed=0.01) == Friction(0.5, law=Tanh(0.01)))
    True
    >>> print(Friction(0.5, law=Viscous()).law.words)
    viscous friction
    >>> print(Friction(0.5, law=Viscous(), surface="bottom").law.words)
    viscous friction, on the lower face
    """

    coefficient: float
    law: FrictionLaw
    is_static: ClassVar[bool] = False
    moves: ClassVar[bool] = True
    stored_as: ClassVar[None] = None

    def __init__(
        self,
        coefficient: float,
        slip_speed: float | None = None,
        law: FrictionLaw | str | None = None,
        surface: str | None = None,
    ) -> None:
        object.__setattr__(self, "coefficient", validation.positive("coefficient", coefficient))
        object.__setattr__(self, "law", _on_surface(_law(slip_speed, law), surface))

    @property
    def entries(self) -> Entries:  # type: ignore[override]
        """See Effect."""
        return LowerFace.entries if self.law.on_lower_face else (0,)

    @property
    def slip_speed(self) -> float:
        """Width of the law, length per time."""
        return self.law.width

    @property
    def mu(self) -> float:  # type: ignore[override]
        """See Effect."""
        return self.coefficient

    def touching(self, state: PointState) -> Array:
        """Position of the points on which it acts, (components, points)."""
        return self._lower(state).position if self.law.on_lower_face else state.position

    def moved(self, state: PointState, change: Array) -> Array:
        """Their change to first order by that of the entries, (entries, components, points)."""
        return self._lower(state).moved(change) if self.law.on_lower_face else change[0]

    def slip(self, state: PointState) -> Array:
        """Velocity along the ground in the axes of the law, (2, points)."""
        axes, position, rule = slip_axes(state), self.touching(state), self._rule(state)
        if axes is None:  # two of three components, at less cost
            return np.asarray(rule.rate * (position[:2] - rule.base[:2]))
        return _inward(axes, rule(position))

    def force(self, state: PointState) -> Array:
        """Force of the ground on each point, (components, points)."""
        return -self._pull(state)

    def energy(self, state: PointState) -> Array:
        """See Effect. Time step times dissipation potential."""
        scale = self._limit(state) / self._rule(state).rate
        return np.asarray(scale * self.law.potential(self._met(state).v))

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        pull = self._pull(state)
        return self._lower(state).gradient(pull) if self.law.on_lower_face else pull[None]

    def hessian(self, state: PointState) -> Array:
        """See Effect."""
        stiffness = self.stiffness(state)
        if not self.law.on_lower_face:
            return stiffness[None, None]
        return self._lower(state).hessian(self._pull(state), stiffness)

    def stiffness(self, state: PointState) -> Array:
        """Derivative of minus the force with respect to the points it acts on, (pairs, points)."""
        scale, tangent = self._limit(state) * self._rule(state).rate, self._met(state).tangent
        return _tangent_outward(slip_axes(state), scale * tangent, state.components)

    def _pull(self, state: PointState) -> Array:
        """Minus the force of the ground on each point, (components, points)."""
        force = self._limit(state) * self._met(state).force
        return _outward(slip_axes(state), force, state.components)

    def _rule(self, state: PointState) -> Affine:
        """Velocity of the points it acts on as a function of their position."""
        return state.step.touching.velocity if self.law.on_lower_face else state.step.moving

    @once_per_state
    def _lower(self, state: PointState) -> LowerFace:
        return LowerFace(state, state.step.touching.depth)

    @once_per_state
    def _met(self, state: PointState) -> Response:
        """The law at the slip; on level ground only velocities in the plane are asked for."""
        return self.law.at(self.slip(state))

    def _limit(self, state: PointState) -> Array:
        """mu N, (points,)."""
        return np.asarray(self.coefficient * state.step.pressed)

    def check_scene(self, scene: Scene) -> None:
        """Raise ValueError for friction without load, and for a law that is wrong in space."""
        checked_law(self.law, 2, "law")
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
        if self.law.on_lower_face and step.face is None:
            raise ValueError("step: Friction on the lower face needs one with that face")


def _law(slip_speed: float | None, law: FrictionLaw | str | None) -> FrictionLaw:
    """That of the arguments of Friction. Raises ValueError unless they give one with a width."""
    found = friction_law(Tanh.name if law is None else law, slip_speed, "law")
    if found.width == 0:
        raise ValueError(
            f"law = {shown(found)}: must have a derivative at rest, which a step in time needs; use "
            "Tanh(slip_speed), dry friction for speeds well above its slip speed"
        )
    return found


def _on_surface(law: FrictionLaw, surface: str | None) -> FrictionLaw:
    """The law on that surface; None: where the law says."""
    if surface is None:
        return law
    lower = validation.choice("surface", surface, SURFACES) == SURFACES[1]
    if law.on_lower_face and not lower:
        raise ValueError(f"surface = {surface!r}: must be None or 'bottom' beside {law!r}")
    return OnLowerFace(law) if lower and not law.on_lower_face else law


def slip_axes(state: PointState) -> Array | None:
    """The x and y of the law at each point, (2, components, points or 1); None for those of the ground.

    On uneven ground those of the level, tilted with it by the shortest rotation; turned by the heading
    of the body for a law that is fixed to it.
    """
    step, heading = state.step, state.step.heading
    if step.normal is None and heading == 0:
        return None
    if step.normal is None:
        axes = np.zeros((2, state.components, 1))
        axes[0, 0] = axes[1, 1] = 1.0
    else:
        n_x, n_y, n_z = step.normal
        x, y = n_x / (1 + n_z), n_y / (1 + n_z)
        axes = np.stack([[1 - n_x * x, -n_y * x, -n_x], [-n_x * y, 1 - n_y * y, -n_y]])
    cosine, sine = np.cos(heading), np.sin(heading)
    return np.stack([cosine * axes[0] + sine * axes[1], cosine * axes[1] - sine * axes[0]])


def _inward(axes: Array, vector: Array) -> Array:
    """Components of vectors (components, points) along the axes, (2, points)."""
    return np.stack([dot(axis, vector) for axis in axes])


def _outward(axes: Array | None, vector: Array, components: int) -> Array:
    """Vectors (2, points) along the axes, as (components, points)."""
    if axes is not None:
        return np.asarray(axes[0] * vector[0] + axes[1] * vector[1])
    if components == 2:
        return vector
    return np.stack([vector[0], vector[1], np.zeros_like(vector[0])])


def _tangent_outward(axes: Array | None, tangent: Array, components: int) -> Array:
    """Tensors (xx, xy, yy) along the axes, as those of the components, (pairs, points)."""
    if axes is not None:
        xx, xy, yy = tangent
        x, y = axes
        first, second = (np.asarray(index) for index in PAIRS[components])
        mixed = x[first] * y[second] + y[first] * x[second]
        return np.asarray(xx * x[first] * x[second] + xy * mixed + yy * y[first] * y[second])
    if components == 2:
        return tangent
    out = np.zeros((6, *tangent.shape[1:]))
    out[pairs_among(3, slice(0, 2))] = tangent
    return out
