"""Ways to integrate the equation in time.

Measured for 80 units of time, error below 1e-5: on a line of 32, 64 and 100 elements the explicit
Runge–Kutta scheme of eighth order takes 0.03 s, 0.1 s and 0.5 s, Radau 0.24 s, 0.28 s and 0.3 s, BDF
0.1 s to 0.13 s; on 10 x 20 elements of a sheet 0.03 s, 0.9 s and 0.3 s. On 8269 nodes of a trapezoid,
for 200 units of time, the explicit scheme takes 200 s, Radau 27 s and BDF 9 s. Both the explicit
scheme and BDF cost in proportion to the nodes, so the rate of diffusion alone decides.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.excitable.system import System
from linear_theory.common import validation
from linear_theory.common.errors import NotConvergedError
from linear_theory.common.progress import track
from linear_theory.common.shown import Value

Array = NDArray[np.float64]

STIFF = 40.0
"""Rate of diffusion, 1/time, above which an implicit scheme is cheaper."""

OF_BDF = 0.1
"""Tolerance of BDF relative to that of the explicit scheme, whose steps err far less than they are
allowed to: on 2095 nodes for 200 units of time BDF is 2e-3, 2e-4 off with 1e-4 and 1e-5."""

STABLE = 5.0
"""Longest explicit step times that rate. At the limit of stability, to which error control alone lets
the steps grow, short waves of the size of the tolerance remain, and dc/dt is their size times the rate:
wrong by more than its own size for a tolerance of 1e-4. Steps that damp them cost a third more."""

SEEN = 4.0
"""Steps during a stimulus, at least."""

LARGEST = 1e6
"""|c| and |w| of a solution that counts as unbounded."""


MOST_RATES = 5_000_000
"""Evaluations of the rates at most, some minutes on a line."""


class Method(Value, ABC):
    """A way to integrate: the states of a system at given times."""

    @abstractmethod
    def states(self, system: System, times: Array, first: Array, rtol: float) -> Array:
        """States (T, 2 n) at ascending times (T,), the first of which has the state `first`.

        rtol: accuracy asked for, relative to the largest |c|. Raises NotConvergedError if c grows
        without bound.
        """

    @abstractmethod
    def coarser(self) -> "Method":
        """The same with an error about twice as large, to estimate it."""


@dataclass(frozen=True)
class Adaptive(Method):
    """scipy's integrators with error control; `share`: of rtol, that one step may take.

    Explicit of eighth order (DOP853) where diffusion is slow, else BDF with a sparse Jacobian.
    """

    share: float = 1e-2

    def __post_init__(self) -> None:
        validation.positive("share", self.share)

    def states(self, system: System, times: Array, first: Array, rtol: float) -> Array:
        """See `Method`."""
        from scipy.integrate import BDF, DOP853

        stiff = is_stiff(system)
        most = self.share * rtol * (OF_BDF if stiff else 1.0)
        tolerance = {"rtol": max(most, 1e-12), "atol": max(0.1 * most, 1e-13)}
        more = {"jac": system.jacobian} if stiff else {}
        kind = BDF if stiff else DOP853
        tolerance["max_step"] = longest_step(system)
        found = np.empty((times.size, first.size))
        found[0] = first
        with np.errstate(over="ignore", invalid="ignore"):  # in steps that are then rejected
            solver = kind(system.rates, times[0], first, times[-1], **tolerance, **more)
            for part in track("the excitable wave", _parts(times)):
                _fill(solver, times, found, part)
        return found

    def coarser(self) -> "Adaptive":
        """See `Method`."""
        return Adaptive(10 * self.share)


def is_stiff(system: System) -> bool:
    """Whether an implicit scheme is cheaper."""
    return system.stiffness > STIFF


def longest_step(system: System) -> float:
    """Largest step: an explicit one must be stable, and none may miss a stimulus of a body at rest."""
    pacing = system.equation.pacing
    seen = math.inf if pacing is None else pacing.duration / SEEN
    return seen if is_stiff(system) else min(seen, STABLE / system.stiffness)


def _parts(times: Array) -> list[slice]:
    """The times but for the first, in about 50 slices."""
    size = max(1, (times.size - 1) // 50)
    return [slice(i, min(i + size, times.size)) for i in range(1, times.size, size)]


def _fill(solver: Any, times: Array, found: Array, part: slice) -> None:
    """Step on until the times of this part are known."""
    for i in range(part.start, part.stop):
        while solver.t < times[i]:
            message = solver.step()
            if solver.nfev > MOST_RATES:
                raise unbounded(float(solver.t), f"{MOST_RATES} evaluations of the rates")
            if solver.status == "failed" or not np.abs(solver.y).max() < LARGEST:
                raise unbounded(float(solver.t), message)
        last = solver.t_old is None or solver.t == times[i]
        found[i] = solver.y if last else solver.dense_output()(times[i])


def unbounded(t: float, message: str | None = None) -> NotConvergedError:
    """The error of a solution that cannot be continued."""
    return NotConvergedError(
        f"the excitable wave could not be followed beyond t = {t:.6g}: c grows without bound or too "
        f"fast{f' ({message})' if message else ''}",
        best=None,
    )


@dataclass(frozen=True)
class Euler(Method):
    """Explicit Euler with equal steps, as in the paper (appendix A.2), dt = 5e-3 there.

    Its error, of first order, is estimated by twice the step. Raises ValueError, when it is used, for a
    step beyond its limit of stability, 2 over the largest rate of diffusion.
    """

    step: float = 5e-3

    def __post_init__(self) -> None:
        validation.positive("step", self.step)

    def states(self, system: System, times: Array, first: Array, rtol: float) -> Array:
        """See `Method`."""
        stable = 2 / max(system.stiffness, 1e-300)
        if self.step > stable:
            raise ValueError(
                f"step = {self.step:g}: must be < {stable:.3g} for explicit Euler on elements so small"
            )
        found = np.empty((times.size, first.size))
        found[0], state = first, first.copy()
        for i in track("the excitable wave", range(1, times.size)):
            for t, dt in self._steps(times[i - 1], times[i]):
                state = state + dt * system.rates(t, state)
            if not np.abs(state).max() < LARGEST:
                raise unbounded(float(times[i]))
            found[i] = state
        return found

    def _steps(self, begin: float, end: float) -> Iterator[tuple[float, float]]:
        """Equal steps between two times at which the state is kept."""
        count = max(1, round((end - begin) / self.step))
        dt = (end - begin) / count
        return ((begin + k * dt, dt) for k in range(count))

    def coarser(self) -> "Euler":
        """See `Method`."""
        return Euler(2 * self.step)
