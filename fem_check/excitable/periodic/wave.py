"""The periodic orbit that a solution approaches, as a wave that every level takes."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.excitable.drives import check_body
from fem_check.excitable.kinetics import Equation
from fem_check.excitable.methods import Method
from fem_check.excitable.periodic.expansion import smooth_wave
from fem_check.excitable.periodic.nodal import NodalWave
from fem_check.excitable.periodic.orbit import ATTRACTS, Orbit, orbit
from fem_check.excitable.periodic.uncertainty import OrbitUncertainty
from fem_check.excitable.solution import SHARE, Solution
from fem_check.excitable.space import Body
from linear_theory.common.shown import Shown, number, with_error
from linear_theory.common.threads import one_blas_thread
from linear_theory.identity import content_key
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.measured.polynomial import PolynomialDrive, PolynomialWave
from linear_theory.wave.places import Places
from linear_theory.wave.protocol import Drive
from linear_theory.wave.sampled import SampledDrive

Array = NDArray[np.float64]

RESIDUAL = 1e-4
"""Of rtol: largest change of c and w over a period. A state is farther from an orbit that attracts
slowly than its change in one period."""

PHASES = 64
"""Times at which two orbits are compared."""


class Found(NamedTuple):
    """The orbit on the mesh of the solution and on one twice as coarse, and their waves."""

    orbit: Orbit
    coarse: Orbit
    wave: PolynomialWave | NodalWave
    other: PolynomialWave | NodalWave


@dataclass(frozen=True, eq=False)
class PeriodicExcitation(Shown):
    """The periodic orbit near the solution at time `after`, found when it is first asked for.

    Arguments as for `Excitation`, whose method `periodic` makes it. It repeats exactly: on a sheet it
    is a sum of polynomials and harmonics, elsewhere of harmonics at the nodes of its mesh. Speeds count
    its error in theirs (`uncertainty`). multiplier: factor by which a small deviation grows over a
    period; above 1 the orbit is unstable and no solution stays near it.

    Raises NotConvergedError, when it is found, where there is no such orbit.

    >>> from fem_check.excitable import excitable_preset
    >>> from linear_theory import Sheet, line_balance
    >>> train = excitable_preset("pulse train").on(Sheet(), until=450.0, rtol=1e-2).periodic()
    >>> print(train.period, train.attracts)
    150.0 True
    >>> speed = line_balance(train, alpha=0.1, length=1.0, rtol=0.05)
    >>> print(f"{speed.mean * train.period:.3f} lengths per pulse, converged {speed.converged}")
    -0.009 lengths per pulse, converged True
    """

    equation: Equation
    body: Body
    after: float
    rtol: float = 1e-3
    method: Method | None = None

    def __post_init__(self) -> None:
        start = Solution(self.equation, self.body, self.after, self.rtol, self.method)
        object.__setattr__(self, "after", start.until)
        object.__setattr__(self, "method", start.method)
        object.__setattr__(self, "_start", start)

    @classmethod
    def of(cls, solution: Solution) -> "PeriodicExcitation":
        """The orbit that a solution approaches, without solving for that again."""
        found = cls(solution.equation, solution.body, solution.until, solution.rtol, solution.method)
        object.__setattr__(found, "_start", solution)
        return found

    @cached_property
    @one_blas_thread
    def _found(self) -> Found:
        """The orbit and its waves."""
        solution: Solution = self._start  # type: ignore[attr-defined]
        pair, cycles = solution._pair, solution.cycles
        fine, tolerance = pair.fine, RESIDUAL * self.rtol * solution.size
        start, level = float(fine.times[-1]), cycles.level
        first = orbit(fine.system, fine.states[-1], start, solution.period, level, tolerance)
        nodes, shares = fine.space.weights(*pair.coarse.space.nodes)
        parts = np.split(first.state, 2)
        state = np.concatenate([np.einsum("kn,kn->n", shares, part[nodes]) for part in parts])
        second = orbit(pair.coarse.system, state, start, first.period, level, tolerance)
        wave, resolution = smooth_wave(first, self.rtol)
        return Found(first, second, wave, smooth_wave(second, self.rtol, resolution)[0])

    @property
    def period(self) -> float:
        """Units of time."""
        return self._found.orbit.period

    @property
    def period_error(self) -> float:
        """Its estimated error."""
        return SHARE * abs(self.period - self._found.coarse.period)

    @property
    def multiplier(self) -> float:
        """Factor by which a small deviation grows over a period."""
        return self._found.orbit.multiplier

    @property
    def attracts(self) -> bool:
        """Whether solutions nearby approach the orbit."""
        return self.multiplier <= ATTRACTS

    @cached_property
    def samples(self) -> Array:
        """c of the orbit and of the coarse one at PHASES times and all nodes, (2, PHASES, n)."""
        x, y = self._found.orbit.system.space.nodes
        phases = np.arange(PHASES)[:, None] / PHASES
        pair = self._found.wave, self._found.other
        return np.stack([wave.value(x, y, wave.period * phases) for wave in pair])

    @property
    def error(self) -> float:
        """Estimated error of c at the same phase, absolute."""
        exact = self._found.orbit.states(PHASES)[:, : self._found.orbit.system.space.size]
        x, y = self._found.orbit.system.space.nodes
        times = self._found.orbit.start + self.period * np.arange(PHASES)[:, None] / PHASES
        series = abs(self._found.wave.value(x, y, times) - exact).max()
        missed = self._found.orbit.residual / max(abs(1 - self.multiplier), 1e-3)
        return float(SHARE * abs(self.samples[0] - self.samples[1]).max() + series + missed)

    @property
    def size(self) -> float:
        """Largest |c|."""
        return float(abs(self.samples[0]).max())

    @property
    def converged(self) -> bool:
        """Whether the error meets rtol."""
        return self.error <= self.rtol * self.size

    @property
    def uniform(self) -> bool:
        """Whether c is the same everywhere, so that no phase runs along the body and it cannot
        crawl."""
        return bool(np.ptp(self.samples[0], axis=1).max() <= max(self.error, self.rtol * self.size))

    @property
    def words(self) -> str:
        """What it is, in a few words."""
        return f"an excitable wave of period {self.period:.4g}"

    @property
    def uncertainty(self) -> OrbitUncertainty:
        """How far the true orbit may be."""
        return OrbitUncertainty(self._found.wave, self._found.other, SHARE)

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """c; x, y, t broadcast. The body is known: `length` has no effect."""
        return self._found.wave.value(x, y, t)

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """dc/dt likewise."""
        return self._found.wave.rate(x, y, t)

    def on(self, sheet: Sheet, places: Places | None = None) -> Drive:
        """The wave on a body within that rectangle, which must be the one that it was solved on."""
        check_body(self.body, self.equation.start.depends_on_x, sheet)
        wave = self._found.wave
        if isinstance(wave, NodalWave):
            return SampledDrive(wave, sheet, places)
        return PolynomialDrive(wave, sheet, places)

    def identified_by(self) -> object:
        """What its content key is made of."""
        return self._contents()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PeriodicExcitation):
            return NotImplemented
        return self is other or content_key(self) == content_key(other)

    def __hash__(self) -> int:
        return hash((self.equation, self.after))

    def __getstate__(self) -> dict[str, Any]:
        """Without what was found: a copy finds it again."""
        names = (*self._contents(), "_start")
        return {name: getattr(self, name) for name in names}

    def _contents(self) -> Mapping[str, Any]:
        names = ("equation", "body", "after", "rtol", "method")
        return {name: getattr(self, name) for name in names}

    def _title(self) -> str:
        if "_found" not in self.__dict__:
            return "PeriodicExcitation: not solved yet"
        kind = "uniform oscillation" if self.uniform else "wave"
        if not self.attracts:
            kind = f"unstable {kind}"
        return f"PeriodicExcitation: {kind} of period {with_error(self.period, self.period_error)}"

    def _rows(self) -> Mapping[str, Any]:
        rows = dict(self._contents())
        if "_found" in self.__dict__:
            c = self.samples[0]
            met = "" if self.converged else ", rtol NOT met"
            rows["c"] = f"{number(float(c.min()))} ... {with_error(float(c.max()), self.error)}{met}"
            rows["multiplier"] = self.multiplier
        return rows
