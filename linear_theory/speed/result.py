"""The answer to the one question: how fast, how sure, at what cost."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.drawable import Drawable
from linear_theory.common.shown import Shown, with_error
from linear_theory.common.tables import SPEED, SPIN, TIME, Column, Tabular
from linear_theory.friction.regime import Regime, regime_of

if TYPE_CHECKING:
    from linear_theory.speed.drawn import Deformation

Array = NDArray[np.float64]


class _Estimate(NamedTuple):
    value: float
    error: float


class Estimate(Shown, _Estimate):
    """A number and the estimate of its numerical error, absolute.

    >>> from linear_theory import Sheet, SineWave, crawl_speed
    >>> found = crawl_speed(Sheet(), SineWave(), alpha=0.25, rtol=1e-2).estimate
    >>> print(f"{found.value:.2f}", found.error < 1e-2 * found.value)
    0.11 True
    """


@dataclass(frozen=True, eq=False)
class RigidSpeed(Shown):
    """The rigid motion of a sheet that does not keep to a line.

    velocity (3, T): V_x, V_y of the centre of mass of the undeformed area and the rate of rotation
    Omega about it (anticlockwise) in the frame of the body (see `second_order`); mean, error (3,):
    their means and the estimates of their numerical errors, absolute.
    """

    velocity: Array
    mean: Array
    error: Array

    @property
    def along(self) -> Estimate:
        """The mean of V_y."""
        return Estimate(float(self.mean[1]), float(self.error[1]))


@dataclass(frozen=True)
class CrawlSpeed(Drawable, Tabular):
    """Speed of a crawling sheet, in length/time; positive is towards +y, the way of the wave.

    estimate: V averaged over one period, `mean`, and the estimate of its numerical error, `error`;
    model_error: distance to the nonlinear sheet, absolute, NaN where it is not known;
    converged: whether error met the tolerance that was asked for; where rigid_error is given, that; and
    the theory reaches so far.
    times (T,), velocity (T,): V_y(t) over one period.
    turning: the whole rigid motion, for motions that are not mirror symmetric in x; None otherwise. Its
    arrays are also rigid (3, T), rigid_mean and rigid_error (3,).
    first_order, second_order: V_1 and V_2 of V = V_1 alpha + V_2 alpha**2 + ..., within this model;
    NaN where they were not computed.
    slip_ratio: slip speed of the friction law over the largest speed relative to the ground: dry
    friction where it is << 1, viscous where it is >> 1; 0 for Coulomb, infinite for viscous, and for
    tanh where nothing moves; NaN without friction. `regime` is what it means.
    sticks: whether at some time part of the sheet is at rest and a range of forces is balanced,
    so that V is the value that the regularised law selects.
    seconds: time spent, set-up and solution; model: what is assumed, in words.
    beyond_reach: why a theory of small growth says nothing at this alpha (see `reach`), in words; empty
    where it does. Such answers are never converged.
    wave_error: the part of error that a measured wave makes (see `wave_error`), 0 for exact ones.
    deformation: how the sheet deforms, for pictures (see `deformation.Deformation`); None where there
    is no shape. It is not part of the value, and a copy or a pickle goes without it.

    >>> from linear_theory import Sheet, SineWave, crawl_speed
    >>> speed = crawl_speed(Sheet(), SineWave(), alpha=0.25, rtol=1e-3)
    >>> print(f"V = {speed.mean:.3f} L/T along the wave, converged {speed.converged}")
    V = 0.106 L/T along the wave, converged True
    >>> print(f"friction is {speed.regime}; {speed.model}")
    friction is dry; small strain (AirySeries), current load, dry friction
    """

    estimate: Estimate
    model_error: float
    converged: bool
    times: Array
    velocity: Array
    seconds: float
    model: str
    slip_ratio: float
    first_order: float = np.nan
    second_order: float = np.nan
    sticks: bool = False
    turning: RigidSpeed | None = None
    beyond_reach: str = ""
    wave_error: float = 0.0
    deformation: "Deformation | None" = field(default=None, repr=False, compare=False)

    def __getstate__(self) -> dict[str, Any]:
        """Without the deformation: a speed that travels between processes is numbers only."""
        return self.__dict__ | {"deformation": None}

    @classmethod
    def steady(cls, speed: float, model: str, slip_ratio: float, seconds: float = 0.0) -> "CrawlSpeed":
        """Of a sheet that does not grow: the same at all times, and exact."""
        return cls(
            Estimate(speed, 0.0),
            0.0,
            True,
            np.zeros(1),
            np.full(1, speed),
            seconds,
            model,
            slip_ratio,
            0.0,
        )

    @property
    def mean(self) -> float:
        """V averaged over one period, length per time."""
        return self.estimate.value

    @property
    def error(self) -> float:
        """Estimate of the numerical error of `mean`, absolute."""
        return self.estimate.error

    @property
    def rigid(self) -> Array | None:
        """V_x, V_y, Omega through the period, (3, T), where the motion is not mirror symmetric."""
        return None if self.turning is None else self.turning.velocity

    @property
    def rigid_mean(self) -> Array | None:
        """Their means, (3,)."""
        return None if self.turning is None else self.turning.mean

    @property
    def rigid_error(self) -> Array | None:
        """Estimates of the numerical errors of the means, (3,)."""
        return None if self.turning is None else self.turning.error

    @property
    def regime(self) -> Regime:
        """Friction as the sheet meets it: "dry", "mixed", "viscous", or "none" where there is none."""
        return regime_of(self.slip_ratio)

    @property
    def reach(self) -> str:
        """What the answer says of the nonlinear sheet, in words."""
        if self.beyond_reach:
            return f"beyond the reach of the theory: {self.beyond_reach}"
        if np.isnan(self.model_error):
            return "distance to the nonlinear sheet not known"
        if self.model_error == 0:
            return "no distance to the nonlinear sheet"
        return f"within {self.model_error:.1g} of the nonlinear sheet"

    def _contents(self) -> Mapping[str, Any]:
        """By the names that programs read, the groups spread out."""
        parts = dict(super()._contents())
        del parts["estimate"], parts["turning"]
        rigid = {name: getattr(self, name) for name in ("rigid", "rigid_mean", "rigid_error")}
        return {"mean": self.mean, "error": self.error, **parts, **rigid}

    def _title(self) -> str:
        return f"CrawlSpeed: {speed_in_words(self.mean, self.error, self.converged)}"

    def _rows(self) -> Mapping[str, Any]:
        """All but what the title says and what was not computed."""
        ratio = "" if np.isnan(self.slip_ratio) else f", slip ratio {self.slip_ratio:.3g}"
        first = {"model_error": self.model_error, "regime": f"{self.regime}{ratio}"}
        rest = {name: v for name, v in self._contents().items() if name not in TOLD and _is_there(v)}
        if not self.wave_error:
            del rest["wave_error"]
        return {**first, **rest}

    def _columns(self) -> Sequence[Column]:
        columns = [
            Column("time", self.times, "time", TIME),
            Column("velocity", self.velocity, "velocity of the sheet along y", SPEED),
        ]
        if self.rigid is not None:
            columns += [
                Column("velocity_x", self.rigid[0], "velocity across the sheet, in its axes", SPEED),
                Column("rotation", self.rigid[2], "rate of rotation, anticlockwise", SPIN),
            ]
        return columns


TOLD = ("mean", "error", "converged", "model_error", "slip_ratio")
"""What the title of a speed and its first rows say."""


def speed_in_words(mean: float, error: float, converged: bool) -> str:
    """A mean speed with its error and direction, and whether its tolerance was met."""
    met = "converged" if converged else "NOT converged"
    return f"mean {with_error(mean, error)} length/time, {direction(mean, error)}, {met}"


def direction(mean: float, error: float) -> str:
    """Which way a speed goes, where its error leaves no doubt."""
    if mean == 0 and error == 0:
        return "at rest"
    if not abs(mean) > error:
        return "direction not resolved"
    return "towards +y" if mean > 0 else "towards -y"


def _is_there(value: Any) -> bool:
    """Whether a field says more than that it was not computed, or is not so."""
    if isinstance(value, float):
        return not np.isnan(value)
    return value is not None and value is not False and not (isinstance(value, str) and not value)
