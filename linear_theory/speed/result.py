"""The speed of a sheet, with its errors, regime and cost."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.drawable import Drawable
from linear_theory.common.estimate import Estimate as Estimate
from linear_theory.common.shown import Shown, flat, plain, with_error
from linear_theory.common.tables import SPEED, SPIN, TIME, Column, Tabular
from linear_theory.energy.energy import Energy
from linear_theory.energy.growth import GrowthPower, checked_strain, growth_times
from linear_theory.friction.regime import Regime, regime_of

if TYPE_CHECKING:
    from linear_theory.speed.drawn import Deformation

Array = NDArray[np.float64]


UNKNOWN = Estimate(np.nan, np.nan)

SOLVED = "must be of a sheet that was solved here"
POWERED = "must be of a theory, cycle_speed, or simulate with Friction and Gravity"
"""What an energy needs, in words."""


@dataclass(frozen=True, eq=False)
class RigidSpeed(Shown):
    """The rigid motion of a sheet without mirror symmetry: along, sideways and turning.

    velocity (3, T): V_x, V_y of the centre of mass of the undeformed area and the rate of rotation
    Omega about it (anticlockwise) in the frame of the body (see `second_order`); mean, error (3,):
    their means and estimated numerical errors, absolute.
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
    """Speed of a crawling sheet, length/time, positive towards +y, the direction of the wave.

    estimate: V averaged over one period, `mean`, and its estimated numerical error, `error`;
    model_error: distance to the nonlinear sheet, absolute, NaN where unknown;
    converged: whether the numerical error (rigid_error, if given) meets the tolerance and the theory is
    valid at this alpha.
    times (T,), velocity (T,): V_y(t) over one period.
    turning: the full rigid motion, for motions without mirror symmetry in x; None otherwise. Its
    arrays are also available as rigid (3, T), rigid_mean and rigid_error (3,).
    first_order, second_order: V_1 and V_2 in V = V_1 alpha + V_2 alpha**2 + ..., within this model;
    NaN if not computed.
    slip_ratio: slip speed of the friction law over the largest speed relative to the ground: << 1 for
    dry, >> 1 for viscous friction; 0 for Coulomb, infinite for viscous friction and for tanh if nothing
    moves; NaN without friction. `regime` puts it into words.
    sticks: whether at some time part of the sheet is at rest, where friction can balance a range of
    forces, so that V is the value selected by the regularised law.
    seconds: time for set-up and solution; model: assumptions, in words.
    beyond_reach: why a theory of small growth is not valid at this alpha (see `reach`), in words; empty
    if it is. Such results are never converged.
    wave_error: the part of error due to a measured wave (see `wave_error`), 0 for an exact one.
    energy: power of growth and friction, None if not known, as for steps without weight or friction;
    `power`, `cost_of_transport` and `efficiency` are made of it.
    deformation: the deformation of the sheet, for pictures (see `drawn.Deformation`); None if there
    is no shape. It is not part of the value and is not copied or pickled.

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
    energy: Energy | None = field(default=None, repr=False, compare=False)
    deformation: "Deformation | None" = field(default=None, repr=False, compare=False)

    def __getstate__(self) -> dict[str, Any]:
        """The state without the deformation: a pickled speed contains numbers only."""
        return self.__dict__ | {"deformation": None}

    @classmethod
    def steady(cls, speed: float, model: str, slip_ratio: float, seconds: float = 0.0) -> "CrawlSpeed":
        """The exact, constant speed of a sheet that does not grow."""
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
        """Estimated numerical error of `mean`, absolute."""
        return self.estimate.error

    @property
    def rigid(self) -> Array | None:
        """V_x, V_y, Omega over the period, (3, T), if the motion is not mirror symmetric."""
        return None if self.turning is None else self.turning.velocity

    @property
    def rigid_mean(self) -> Array | None:
        """Means of V_x, V_y, Omega, (3,)."""
        return None if self.turning is None else self.turning.mean

    @property
    def rigid_error(self) -> Array | None:
        """Estimated numerical errors of `rigid_mean`, (3,)."""
        return None if self.turning is None else self.turning.error

    @property
    def regime(self) -> Regime:
        """Friction regime by `slip_ratio`: "dry", "mixed", "viscous", or "none" without friction."""
        return regime_of(self.slip_ratio)

    @property
    def power(self) -> Estimate:
        """Mean net power of growth over mu times the weight, length/time, see `energy.energy`.

        NaN where it is not known, as are `cost_of_transport` and `efficiency`.
        """
        return UNKNOWN if self.energy is None else self.energy.power

    @property
    def cost_of_transport(self) -> Estimate:
        """Work of growth over weight times distance, over mu; infinite if the sheet stays in place.

        Distances are along and, without mirror symmetry, across the sheet, in its own axes; those of a
        motion in time are along the ground.

        >>> from linear_theory import Sheet, SineWave, crawl_speed
        >>> speed = crawl_speed(Sheet(), SineWave(), alpha=0.25)
        >>> print(f"{speed.cost_of_transport.value:.3f} mu, efficiency {speed.efficiency.value:.3f}")
        2.017 mu, efficiency 0.496
        """
        return UNKNOWN if self.energy is None else self.energy.cost(self._distance)

    @property
    def efficiency(self) -> Estimate:
        """Power of dragging the rigid sheet at the same speed over that of growth (Lighthill's)."""
        if self.energy is None:
            return UNKNOWN
        return self.energy.efficiency(self._velocity, self._distance.error)

    def growth_power(self, friction_strain: float) -> GrowthPower:
        """Power of growth over a period, with that of the elastic energy, and both ways to count it.

        friction_strain: of the sheet by friction, mu (weight per area) L/(E h) > 0, by which friction
        and elastic energy compare; see `energy.growth`. Raises ValueError for another one, and for a
        speed without a shape: of a body on a line, or one that was copied.

        >>> from linear_theory import Sheet, SineWave, crawl_speed
        >>> power = crawl_speed(Sheet(), SineWave(), alpha=0.1).growth_power(friction_strain=1e-4)
        >>> print(f"{power.positive.value / power.net.value:.1f} times as much if none is taken back")
        11.8 times as much if none is taken back
        """
        strain = checked_strain(friction_strain)
        if self.deformation is None or self.energy is None:
            needed = f"shape, {SOLVED}" if self.deformation is None else f"known power, {POWERED}"
            raise ValueError(f"speed: has no {needed}")
        drive = self.deformation.drive
        times = growth_times(drive.period)
        spent = np.interp(times, self.times, self.energy.spent, period=drive.period)
        rate, error = self.deformation.storing(times)
        unit = drive.sheet.length / strain
        return GrowthPower.of(self.energy, times, spent, unit * rate, unit * error)

    @property
    def _velocity(self) -> Array:
        """Mean V_x, V_y."""
        if self.turning is not None:
            return self.turning.mean[:2]
        return np.array([0.0 if self.energy is None else self.energy.across.value, self.mean])

    @property
    def _distance(self) -> Estimate:
        """Speed in any direction."""
        across = 0.0 if self.energy is None else self.energy.across.error
        errors = (across, self.error) if self.turning is None else self.turning.error[:2]
        return Estimate(float(np.hypot(*self._velocity)), float(np.hypot(*errors)))

    @property
    def reach(self) -> str:
        """Relation of the speed to that of the nonlinear sheet, in words."""
        if self.beyond_reach:
            return f"beyond the reach of the theory: {self.beyond_reach}"
        if np.isnan(self.model_error):
            return "distance to the nonlinear sheet unknown"
        if self.model_error == 0:
            return "agrees with the nonlinear sheet"
        return f"within {self.model_error:.1g} of the nonlinear sheet"

    def to_row(self) -> dict[str, Any]:
        """A row of a table of many results: numbers and texts by name, None where unknown.

        >>> from linear_theory import Sheet, SineWave, crawl_speed
        >>> row = crawl_speed(Sheet(), SineWave(), alpha=0.25, rtol=1e-3).to_row()
        >>> print(*list(row)[:5], "...", row["regime"])
        mean error wave_error model_error converged ... dry
        """
        names = ("mean", "error", "wave_error", "model_error", "converged", "regime", "slip_ratio")
        values = {name: getattr(self, name) for name in (*names, "beyond_reach", "seconds", "model")}
        return flat(plain(values | self.energies()))

    def _contents(self) -> Mapping[str, Any]:
        """Values under the names that programs read, with groups flattened."""
        parts = dict(super()._contents())
        del parts["estimate"], parts["turning"]
        rigid = {name: getattr(self, name) for name in ("rigid", "rigid_mean", "rigid_error")}
        return {"mean": self.mean, "error": self.error, **parts, **rigid, **self.energies()}

    def energies(self) -> dict[str, float]:
        """Power, cost of transport and efficiency with their errors by name; none if not known."""
        found: dict[str, float] = {}
        for name in ENERGIES if self.energy is not None else ():
            found[name], found[f"{name}_error"] = getattr(self, name)
        return found

    def _title(self) -> str:
        return f"CrawlSpeed: {speed_in_words(self.mean, self.error, self.converged)}"

    def _rows(self) -> Mapping[str, Any]:
        """All values except those in the title and those not computed."""
        ratio = "" if np.isnan(self.slip_ratio) else f", slip ratio {self.slip_ratio:.3g}"
        first = {"model_error": self.model_error, "regime": f"{self.regime}{ratio}"}
        told = (*TOLD, *self.energies())
        rest = {name: v for name, v in self._contents().items() if name not in told and _is_there(v)}
        if self.energy is not None:
            first["energy"] = energy_in_words(self)
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
        if self.energy is not None and self.energy.spent.shape == self.times.shape:
            words = "power of friction and lift over mu times the weight"
            columns.append(Column("power", self.energy.spent, words, SPEED))
        return columns


TOLD = ("mean", "error", "converged", "model_error", "slip_ratio")
"""Values shown in the title of a speed and its first rows."""


ENERGIES = ("power", "cost_of_transport", "efficiency")
"""Measures of energy."""


def energy_in_words(speed: CrawlSpeed) -> str:
    """Cost of transport and efficiency, or why there is none."""
    cost, power = speed.cost_of_transport, speed.power
    spent = f"power {with_error(*power)} length/time over mu weight"
    if np.isinf(power.error):
        return f"{spent}, cost of transport unknown: the error of the speed is not known"
    if np.isnan(cost.value):
        return "none is spent: nothing moves"
    if np.isinf(cost.value):
        return f"{spent}, cost of transport infinite: no distance is resolved"
    lacking = speed.energy and speed.energy.undragged
    efficiency = f"unknown: {lacking}" if lacking else with_error(*speed.efficiency)
    return f"cost of transport {with_error(*cost)} mu, efficiency {efficiency}, {spent}"


def speed_in_words(mean: float, error: float, converged: bool) -> str:
    """A mean speed with its error and direction, and whether it converged."""
    met = "converged" if converged else "NOT converged"
    return f"mean {with_error(mean, error)} length/time, {direction(mean, error)}, {met}"


def direction(mean: float, error: float) -> str:
    """Direction of a speed, if its error resolves the sign."""
    if mean == 0 and error == 0:
        return "at rest"
    if not abs(mean) > error:
        return "direction not resolved"
    return "towards +y" if mean > 0 else "towards -y"


def _is_there(value: Any) -> bool:
    """Whether a field has a value other than None, NaN, False or empty."""
    if isinstance(value, float):
        return not np.isnan(value)
    return value is not None and value is not False and not (isinstance(value, str) and not value)
