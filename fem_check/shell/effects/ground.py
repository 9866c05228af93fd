"""The ground: a repulsion proportional to the square of the penetration, and contact damping."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.gravity import Gravity, check_area, weighed
from fem_check.shell.effects.terrain import Terrain
from fem_check.shell.kinematics.point_state import PointState, once_per_state
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from linear_theory.common import validation
from linear_theory.common.pairs import outer
from linear_theory.common.shown import Value
from linear_theory.friction.load import Load
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]

FORMS = ("clipped", "printed")


@dataclass(frozen=True, init=False)
class Ground(Value, Effect):
    """Pressure k g^2 - beta v on the gap g = z - f(x, y) where g <= 0 (eq. 2), as a potential.

    The pressure acts along the gradient of the gap, (-f_x, -f_y, 1). stiffness: k > 0, force per
    length^4. damping: beta >= 0, force times time per length^3; v is the rate of the gap. form:
    "clipped", the pressure is never negative; "printed", as in eq. 2: damping pulls back a sheet that
    lifts off. load: the reference area of the pressure, a `Load` or its name: "grown", "current" or
    "material"; area is its former name. height: None for the plane z = 0; else a function z = f(x, y),
    one that returns f with its derivatives, a sympy expression in x and y, or a `Terrain` of one of
    these, to which the others are converted.
    Raises ValueError for a stiffness <= 0, a damping < 0, other names and as `Terrain` does.
    """

    stiffness: float
    damping: float
    load: Load
    height: Terrain | None
    form: str
    entries: ClassVar[Entries] = (0,)
    needs_space: ClassVar[bool] = True
    stored_as: ClassVar[str] = "ground"

    def __init__(
        self,
        stiffness: float,
        damping: float = 0.0,
        load: Load | str | None = None,
        height: Any = None,
        form: str = "clipped",
        area: Load | str | None = None,
    ) -> None:
        if validation.real("damping", damping) < 0:
            raise ValueError(f"damping = {damping:g}: must be >= 0")
        flat = height is None or isinstance(height, Terrain)
        object.__setattr__(self, "stiffness", validation.positive("stiffness", stiffness))
        object.__setattr__(self, "damping", float(damping))
        object.__setattr__(self, "load", weighed(load, area))
        object.__setattr__(self, "height", height if flat else Terrain(height))
        object.__setattr__(self, "form", validation.choice("form", form, FORMS))

    def under(self, sheet: Sheet) -> "Ground":
        """The ground for a sheet: its terrain has the length of the sheet and is checked around it."""
        return self if self.height is None else replace(self, height=self.height.under(sheet))

    @property
    def reads_rest(self) -> bool:  # type: ignore[override]
        """Whether the reference area is the grown area of a rest state."""
        return self.load is Load.GROWN

    @property
    def damps(self) -> bool:  # type: ignore[override]
        """Whether there is contact damping."""
        return self.damping != 0

    def pressed_by(self, components: int) -> Load | None:
        """Its reaction."""
        return Load.GROUND

    def gap(self, position: Array) -> Array:
        """z - f(x, y), (points,), at positions (3, points)."""
        if self.height is None:
            return np.asarray(position[2])
        return np.asarray(position[2] - self.height.values(*position[:2]))

    @once_per_state
    def _gap(self, state: PointState) -> Array:
        return self.gap(state.position)

    @once_per_state
    def pressure(self, state: PointState) -> Array:
        """Minus the derivative of the potential per area with respect to the gap, (points,)."""
        gap = self._gap(state)
        drag, base = self._drag(state)
        if not drag:
            return np.asarray(self.stiffness * np.minimum(gap, 0) ** 2)
        pressure = np.where(gap <= 0, self.stiffness * gap**2 - drag * (gap - base), 0)
        return np.maximum(pressure, 0) if self.form == "clipped" else pressure

    def normal_load(self, state: PointState) -> Array:
        """Force of the ground on each point, pressure times area, (points,)."""
        load = self.pressure(state) * state.area_of(self.load)
        return np.asarray(
            load if self.height is None else load * np.sqrt((self.gap_slope(state) ** 2).sum(0))
        )

    def ground_normal(self, state: PointState) -> Array | None:
        """See Effect."""
        if self.height is None:
            return None
        slope = self.gap_slope(state)
        return np.asarray(slope / np.sqrt((slope**2).sum(0)))

    def energy(self, state: PointState) -> Array:
        """See Effect. The integral of the pressure from the gap to 0 (including dissipation)."""
        gap = np.minimum(self._gap(state), 0)
        drag, base = self._drag(state)
        if not drag:
            return -self._spring_work(gap) * state.area_of(self.load)
        start = np.zeros_like(gap)
        if self.form == "clipped":
            # If the base lies below 0, k g^2 - drag (g - base) is negative between 0 and its root.
            deep = np.minimum(base, 0)
            start = (drag - np.sqrt(drag**2 - 4 * self.stiffness * drag * deep)) / (2 * self.stiffness)
            gap = np.minimum(gap, start)
        work = self._spring_work(start) - self._spring_work(gap)
        work += drag * ((gap - base) ** 2 - (start - base) ** 2) / 2
        return np.asarray(work * state.area_of(self.load))

    def _spring_work(self, gap: Array) -> Array:
        """Antiderivative of k g^2; a product, since numpy's power takes thirty times as long."""
        return np.asarray(self.stiffness / 3 * (gap * gap * gap))

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        force = -self.pressure(state) * state.area_of(self.load)
        if self.height is not None:
            return np.asarray(force * self.gap_slope(state))[None]
        out = np.zeros_like(state.position)
        out[2] = force
        return out[None]

    def hessian(self, state: PointState) -> Array:
        """See Effect."""
        gap, area = self._gap(state), state.area_of(self.load)
        drag, _ = self._drag(state)
        pressure = self.pressure(state)
        touching = (gap <= 0) if self.form == "printed" else (pressure > 0)
        rate = np.where(touching, drag - 2 * self.stiffness * gap, 0) * area
        if self.height is None:
            out = np.zeros((6, rate.size))
            out[5] = rate  # zz, the last of the component pairs
            return out[None, None]
        slope = self.gap_slope(state)
        out = rate * outer(slope, slope)
        f = self.height(*state.position[:2])
        for pair, entry in ((0, 3), (1, 5), (3, 4)):  # xx, xy, yy among the component pairs
            out[pair] += pressure * area * f[entry]
        return np.asarray(out)[None, None]

    @once_per_state
    def gap_slope(self, state: PointState) -> Array:
        """Gradient of the gap, (3, points)."""
        slope = np.zeros_like(state.position)
        slope[2] = 1
        if self.height is not None:
            slope[:2] = -self.height.slopes(*state.position[:2])
        return slope

    def _drag(self, state: PointState) -> tuple[float, Array]:
        """damping * rate, and the gap at the start from which its rate is computed."""
        rule = state.step.velocity
        if not self.damping or rule is None:
            return 0.0, np.zeros(state.measure.size)
        return self.damping * rule.rate, self.gap(rule.base)

    def check_scene(self, scene: Scene) -> None:
        """Raise ValueError if nothing presses the sheet on the ground."""
        if scene.find(Gravity) is None:
            names = ", ".join(type(e).__name__ for e in scene.effects)
            raise ValueError(
                f"effects = {names}: Ground must come with Gravity, else there is no contact"
            )

    def beyond_plate(self, scene: Scene) -> str:
        """Uneven or damped ground, or one with pressure per another area than that of the weight."""
        gravity = scene.find(Gravity)
        other = gravity is not None and gravity.load is not self.load
        return self._beyond(
            {f"load = '{self.load}', Gravity has '{gravity.load}'": True} if other else {}
        )

    @property
    def plate_numbers(self) -> Mapping[str, float | Load]:
        """See Effect."""
        return {"stiffness": self.stiffness}

    def beyond_cycle(self, scene: Scene) -> str:
        """Uneven or damped ground, or one with pressure per current area."""
        return self._beyond({"load = 'current'": self.load is Load.CURRENT})

    def _beyond(self, more: Mapping[str, bool]) -> str:
        """Height, damping and `more` where they are there, in words."""
        beyond = {
            "height": self.height is not None,
            f"damping = {self.damping:g}": self.damping != 0,
            **more,
        }
        named = [words for words, there in beyond.items() if there]
        return f"Ground({', '.join(named)})" if named else ""

    def check(self, components: int, step: Step | None) -> None:
        """Raise ValueError in the plane, where nothing can touch the ground."""
        if components == 2:
            raise ValueError("effects: Ground must not be named in a planar scene (components = 2)")
        check_area(self.load, step)
