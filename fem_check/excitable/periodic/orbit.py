"""Periodic orbits: fixed points of the map that follows a state for one period.

Paced, the period is a number of those of the stimulus and the map follows the state for that time. Left
to itself, the map follows a state at which c rises through a level at the rear end until it does so
again (a Poincaré section), which gives the period. Returns are taken as they are before Newton's method
with GMRES does the rest, since Newton alone finds unstable orbits as well. The largest multiplier of
the map says how fast the orbit attracts.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.excitable.methods import is_stiff, longest_step
from fem_check.excitable.system import System
from linear_theory.common.errors import NotConvergedError
from linear_theory.common.progress import track

Array = NDArray[np.float64]

RTOL, ATOL = 1e-9, 1e-11
"""Of the integration over a period."""

FAST = 0.3
"""Largest factor from one change to the next at which more returns are taken than asked for."""

ATTEMPTS = 10, 50, 200
"""Returns, at most, before each attempt with Newton's method; another one is made where it fails or
finds an orbit that does not attract: solutions can stay close to such an orbit for long."""

MOST_STEPS, ATTRACTS = 12, 1.01
"""Newton steps at most, and the largest multiplier of an orbit that counts as attracting."""

KRYLOV, DIFFERENCE = 30, 1e-6
"""Directions of one Newton step, and the size of the differences that give its derivative."""

BEFORE = 0.3
"""Share of the expected period that passes before c may rise through the level again."""

LONGER = 3.0
"""Expected periods after which a return is given up."""


class Return(NamedTuple):
    """The state at the end of a return and the time that it took."""

    state: Array
    period: float


@dataclass(frozen=True, eq=False)
class Orbit:
    """A state on a periodic orbit at time `start`.

    residual: largest change of c and w over a return. multiplier: largest factor by which a small
    deviation grows over a return (magnitude, to about 1 %); below 1 the orbit attracts.
    """

    system: System
    state: Array
    start: float
    period: float
    residual: float
    multiplier: float

    def states(self, count: int) -> Array:
        """At that many equidistant times of the period, the first at `start`, (count, 2 n)."""
        times = self.start + self.period * np.arange(count) / count
        return _integrated(self.system, self.state, self.start, times)


def orbit(
    system: System, state: Array, start: float, period: float, level: float, tolerance: float
) -> Orbit:
    """The orbit near a state at a time `start`; period: expected one; level: of c, see `Cycles`.

    tolerance: largest residual. Raises NotConvergedError where none is found.
    """
    follow = _map(system, start, period, level)
    state = state if system.equation.pacing is not None else follow(state).state
    found, failure = None, None
    for returns in ATTEMPTS:
        try:
            state, last = _settled(follow, state, tolerance, returns)
            near, last = (
                (state, last) if last.residual <= tolerance else _by_newton(follow, state, tolerance)
            )
        except NotConvergedError as error:
            failure = error
            continue
        multiplier = last.factor if last.factor < FAST else _multiplier(follow, near)
        found = Orbit(system, near, start, last.period, last.residual, multiplier)
        if found.multiplier <= ATTRACTS:
            break
    if found is None:
        assert failure is not None
        raise failure
    return found


def _multiplier(follow: Callable[[Array], Return], state: Array) -> float:
    """Largest eigenvalue of the derivative of the map, in magnitude, by Arnoldi's method."""
    from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigs

    base = follow(state).state

    def grown(direction: Array) -> Array:
        size = DIFFERENCE / max(float(abs(direction).max()), 1e-300)
        return np.asarray((follow(state + size * np.ravel(direction)).state - base) / size)

    operator = LinearOperator((state.size, state.size), matvec=grown, dtype=float)
    first = np.random.default_rng(1).standard_normal(state.size)
    try:
        found = eigs(operator, 1, ncv=10, tol=1e-2, v0=first, maxiter=4, return_eigenvectors=False)
    except ArpackNoConvergence as error:
        found = error.eigenvalues
    return float(abs(found).max()) if found.size else np.nan


class _Seen(NamedTuple):
    """Of the last return; factor: from one change to the next, infinite where it is not known."""

    period: float
    residual: float
    factor: float = np.inf


def _map(system: System, start: float, period: float, level: float) -> Callable[[Array], Return]:
    pacing = system.equation.pacing
    if pacing is not None:
        whole = pacing.period * max(1, round(period / pacing.period))
        return lambda state: Return(
            _integrated(system, state, start, np.array([start, start + whole]))[-1], whole
        )
    rear = int(system.space.nodes[1].argmin())
    return lambda state: _returned(system, state, start, period, (rear, level))


def _settled(
    follow: Callable[[Array], Return], state: Array, tolerance: float, returns: int
) -> tuple[Array, _Seen]:
    """So many returns as they are, and more as long as they approach an orbit fast."""
    before = np.inf
    for count in track("returns of the excitable wave", range(ATTEMPTS[-1])):
        found = follow(state)
        change = float(abs(found.state - state).max())
        state = found.state
        if change <= tolerance or (count >= returns and change > FAST * before):
            break
        before = change
    return state, _Seen(found.period, change, change / before)


def _by_newton(
    follow: Callable[[Array], Return], state: Array, tolerance: float
) -> tuple[Array, _Seen]:
    """Newton's method for follow(state) = state, derivatives by differences along Krylov vectors."""
    from scipy.sparse.linalg import LinearOperator, gmres

    for _ in track("Newton steps to the periodic orbit", range(MOST_STEPS)):
        found = follow(state)
        missed = found.state - state
        residual = float(abs(missed).max())
        if residual <= tolerance:
            return found.state, _Seen(found.period, residual)

        def changed(direction: Array, state: Array = state, base: Return = found) -> Array:
            size = DIFFERENCE / max(float(abs(direction).max()), 1e-300)
            return direction - (follow(state + size * direction).state - base.state) / size

        operator = LinearOperator((state.size, state.size), matvec=changed, dtype=float)
        step, _info = gmres(operator, missed, rtol=1e-3, restart=KRYLOV, maxiter=1)
        state = _nearer(follow, state, step, residual)
    raise _lost(f"after {MOST_STEPS} Newton steps the return still changes it by {residual:.2g}")


def _nearer(follow: Callable[[Array], Return], state: Array, step: Array, residual: float) -> Array:
    """The state after the longest of ever shorter steps that reduces the residual."""
    share = 1.0
    while share > 1e-2:
        tried = state + share * step
        try:
            if abs(follow(tried).state - tried).max() < (1 - 0.1 * share) * residual:
                return tried
        except NotConvergedError:
            pass
        share /= 3
    raise _lost(f"no Newton step reduces the change over a return below {residual:.2g}")


def _lost(reason: str) -> NotConvergedError:
    return NotConvergedError(
        f"no periodic orbit was found near the end of the solution: {reason}; "
        "solve for a longer `until`",
        best=None,
    )


def _integrated(system: System, state: Array, start: float, times: Array) -> Array:
    """States at times, the first of which is `start`."""
    from scipy.integrate import solve_ivp

    span = start, float(times[-1])
    found = solve_ivp(system.rates, span, state, t_eval=times, **_options(system))
    if not found.success:
        raise _lost(f"integration failed at t = {found.t[-1]:.6g}")
    return np.asarray(found.y.T)


def _returned(
    system: System, state: Array, start: float, period: float, section: tuple[int, float]
) -> Return:
    """Followed until c at a node rises through a level again."""
    from scipy.integrate import solve_ivp

    node, level = section

    def above(_: float, at: Array) -> float:
        return float(at[node] - level)

    above.terminal, above.direction = True, 1.0  # type: ignore[attr-defined]
    early = start + BEFORE * period
    state = _integrated(system, state, start, np.array([start, early]))[-1]
    span = early, start + LONGER * period
    found = solve_ivp(system.rates, span, state, events=above, **_options(system))
    if not found.t_events or not found.t_events[0].size:
        raise _lost(f"c at the rear end does not rise through {level:.3g} again")
    return Return(np.asarray(found.y_events[0][0]), float(found.t_events[0][0]) - start)


def _options(system: System) -> dict[str, object]:
    """Explicit or implicit as `Adaptive`; of higher order than there, for tolerances so small."""
    tolerances: dict[str, object] = {"rtol": RTOL, "atol": ATOL, "max_step": longest_step(system)}
    if is_stiff(system):
        return {**tolerances, "method": "Radau", "jac": system.jacobian}
    return {**tolerances, "method": "DOP853"}
