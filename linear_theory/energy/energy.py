"""Where the work of growth goes: the power balance of a crawling sheet, and the measures made of it.

Growth does work on the sheet, which is stored in elastic energy (and that of the ground), raises its
weight on a slope, and is dissipated by friction:

    growth(t) = d(stored)/dt + lift(t) + friction(t),        friction(t) = mu int N f(w) . w dA,

w the velocity against the ground, f the law of friction and N the normal load. As friction is balanced,
int N f(w) . R dA = 0 for every rigid velocity R, friction(t) is the power that the *deformation* spends
against the ground, int N f(w) . v dA: the rigid motion does no work. Over a period of a periodic motion
the stored energy returns to its value, so that the net work of growth is that of lift and friction:
theory needs no stress for it. Friction is first order in alpha and takes load and velocities, known to
second order; it is therefore exact to that order.

All powers are over mu times W, the normal load of the undeformed sheet: a length per time, the mean
speed at which the weight slides. Hence

    cost of transport   work of growth / (W distance) = mu power/|V|, given over mu,
    efficiency          power of dragging the sheet, rigid, at the same speed / power,

Lighthill's efficiency of swimmers on dry ground. To drag a sheet costs f(|V|) |V|, the least friction
by which its weight moves that way: where weight is conserved, int N f(w) . w dA over a period is a mean
of a convex function of w whose mean is V. It is mu W |V| T per period for dry friction, where the
efficiency is mu over the cost of transport. Efficiencies above 1 are possible where the load follows
the area, since what slides may then be lighter than what rests. Under a map of friction on the body,
whose rigid drag is f(|V|) |V| times the mean of the map, they are possible, too: the sheet may slide
where the map is low. Under one on the ground the drag depends on the place, and there is none.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.estimate import Estimate
from linear_theory.common.shown import Shown, with_error
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.maps import FixedTo
from linear_theory.friction.mean_map import PLAIN

Array = NDArray[np.float64]

NONE = Estimate(0.0, 0.0)
"""Of a velocity across."""

DIRECTIONS = 16
"""In which the drag is asked for within the error of a velocity."""


@dataclass(frozen=True, eq=False)
class Energy(Shown):
    """Powers of a periodic motion over mu times the weight, length per time, see the module docstring.

    power: mean net power of growth; spent (T,): what is not stored, friction and lift, at the times of
    the speed; law: of friction; mean_map: of the law over body and period, see `mean_map`, 1 without
    one, NaN where the drag of the rigid sheet is not known; slope: tan(incline)/mu of ground that rises
    towards +y; model_error: of the power, distance to the nonlinear sheet, NaN where not measured.
    across: mean V_x of a motion in time, whose speed has V_y alone; heading: mean angle of the axes of
    the law to those of the velocity, anticlockwise, radians.

    >>> from linear_theory import SineWave, line_balance
    >>> energy = line_balance(SineWave(), alpha=0.1).energy
    >>> print(f"{energy.power.value:.4f} L/T")  # about 2 alpha/pi
    0.0633 L/T
    """

    power: Estimate
    spent: Array = field(repr=False)
    law: FrictionLaw
    mean_map: Estimate
    slope: float = 0.0
    model_error: float = np.nan
    across: Estimate = NONE
    heading: float = 0.0

    def _rows(self) -> Mapping[str, Any]:
        words = f"{with_error(*self.power)} length/time, over mu times the weight"
        slope = {"slope": self.slope} if self.slope else {}
        rest = {"spent": self.spent, "law": self.law.words, "model_error": self.model_error}
        return {"power": words, **rest, **slope}

    @classmethod
    def at_rest(cls, law: FrictionLaw) -> "Energy":
        """Of a sheet that does not grow: growth does no work."""
        return cls(Estimate(0.0, 0.0), np.zeros(1), law, PLAIN, model_error=0.0)

    def in_doubt(self, error: float) -> "Energy":
        """The same with a further error of the power."""
        return replace(self, power=Estimate(self.power.value, self.power.error + error))

    def cost(self, distance: Estimate) -> Estimate:
        """Cost of transport over mu, for a speed >= 0; infinite if nothing is known to move."""
        return self.power.over(distance)

    @property
    def undragged(self) -> str:
        """Why the drag of the rigid sheet is not known, in words; empty if it is."""
        if not np.isnan(self.mean_map.value) or self.law.map is None:
            return ""
        on_ground = self.law.map.fixed_to is FixedTo.GROUND
        return "a map of friction on the ground" if on_ground else "a map on a body of its own outline"

    def efficiency(self, velocity: Array, doubt: float) -> Estimate:
        """Least over actual power of a velocity V_x, V_y with that error.

        NaN where nothing slides, and where the drag of the rigid sheet is not known (`undragged`); of
        infinite error where that of the velocity or of the map is.
        """
        if self.power.value <= self.power.error:
            return Estimate(np.nan, np.nan)
        mean, error = self.mean_map
        drag = self._drag(velocity[:, None], mean)[0]
        if np.isinf(doubt) or np.isinf(error):
            return Estimate(float(drag), np.inf).over(self.power)
        around = _around(velocity, doubt)
        bounds = [self._drag(around, value) for value in (mean - error, mean + error)]
        return Estimate(float(drag), float(abs(bounds - drag).max())).over(self.power)

    def _drag(self, velocity: Array, coefficient: float) -> Array:
        """Power to drag the sheet at velocities (2, n), over mu times the weight, (n,)."""
        cosine, sine = np.cos(self.heading), np.sin(self.heading)
        in_axes = np.array([[cosine, sine], [-sine, cosine]]) @ velocity
        friction = coefficient * self.law.dissipation(in_axes)
        return np.maximum(friction + self.slope * velocity[1], 0.0)


def _around(velocity: Array, doubt: float) -> Array:
    """Velocities at the distance `doubt`, and 0 if that is within, (2, n)."""
    start = np.arctan2(*velocity[::-1])
    angles = start + 2 * np.pi / DIRECTIONS * np.arange(DIRECTIONS)
    around = velocity[:, None] + doubt * np.stack([np.cos(angles), np.sin(angles)])
    return np.hstack([around, np.zeros((2, 1))]) if np.hypot(*velocity) <= doubt else around
