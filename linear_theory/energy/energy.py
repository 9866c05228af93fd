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
the area, since what slides may then be lighter than what rests.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.estimate import Estimate
from linear_theory.common.shown import Shown, with_error
from linear_theory.friction.law import FrictionLaw

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Energy(Shown):
    """Powers of a periodic motion over mu times the weight, length per time, see the module docstring.

    power: mean net power of growth; spent (T,): what is not stored, friction and lift, at the times of
    the speed; law: of friction; slope: tan(incline)/mu of ground that rises towards +y; model_error: of
    the power, distance to the nonlinear sheet, NaN where it was not measured.

    >>> from linear_theory import SineWave, line_balance
    >>> energy = line_balance(SineWave(), alpha=0.1).energy
    >>> print(f"{energy.power.value:.4f} L/T")  # about 2 alpha/pi
    0.0633 L/T
    """

    power: Estimate
    spent: Array = field(repr=False)
    law: FrictionLaw
    slope: float = 0.0
    model_error: float = np.nan

    def _rows(self) -> Mapping[str, Any]:
        words = f"{with_error(*self.power)} length/time, over mu times the weight"
        slope = {"slope": self.slope} if self.slope else {}
        rest = {"spent": self.spent, "law": self.law.words, "model_error": self.model_error}
        return {"power": words, **rest, **slope}

    @classmethod
    def at_rest(cls, law: FrictionLaw) -> "Energy":
        """Of a sheet that does not grow: growth does no work."""
        return cls(Estimate(0.0, 0.0), np.zeros(1), law, model_error=0.0)

    def in_doubt(self, error: float) -> "Energy":
        """The same with a further error of the power."""
        return replace(self, power=Estimate(self.power.value, self.power.error + error))

    def cost(self, distance: Estimate) -> Estimate:
        """Cost of transport over mu, for a speed >= 0; infinite if nothing is known to move."""
        return self.power.over(distance)

    def efficiency(self, velocity: Array, doubt: float) -> Estimate:
        """Least over actual power of a velocity V_x, V_y with that error; NaN where nothing slides."""
        speed = float(np.hypot(*velocity))
        along = velocity / speed if speed else np.array([0.0, 1.0])
        least, fewest, most = (
            self._drag(max(size, 0.0) * along) for size in (speed, speed - doubt, speed + doubt)
        )
        drag = Estimate(least, max(abs(most - least), abs(fewest - least)))
        if self.power.value <= self.power.error:
            return Estimate(np.nan, np.nan)
        return drag.over(self.power)

    def _drag(self, velocity: Array) -> float:
        """Power to drag the sheet at that velocity, over mu times the weight."""
        friction = float(self.law.dissipation(velocity[:, None])[0])
        return max(friction + self.slope * float(velocity[1]), 0.0)
