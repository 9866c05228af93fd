"""Equilibria under growth and loads: continuation in adaptive increments, with optional buckling.

Koiter's energy has minima with inverted elements, and saddles where a sheet buckles. Applying the full
growth to the flat state can end in either. Therefore growth and loads are ramped, no step may invert
the sheet (`orientation`), and a saddle is reported as such or left along its unstable direction.
"""

import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.extrapolation import extrapolated
from fem_check.shell.statics.equilibrium import ConvergenceError, Equilibrium
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Potential
from linear_theory.common import validation

Array = NDArray[np.float64]

SMALLEST_INCREMENT = 1e-4
"""Smallest increment of the load factor, below which a ramp fails."""

PATIENCE = 5
"""Factor on the usual iterations for a buckling sheet, which moves far."""

ATTEMPTS = 5
"""Largest number of consecutive saddles that are left."""

FEW, MANY = 10, 20
"""Newton iterations below which an increment grows and above which it shrinks."""


def ramp(
    minimiser: Minimiser,
    problem: Callable[[float], Potential],
    start: Array,
    *,
    first: float = 1.0,
    follow: float = 0.0,
    report: Callable[[float, Equilibrium], None] | None = None,
) -> Equilibrium:
    """The equilibrium of problem(1), continued from `start`, that of problem(0), in increments.

    problem: the potential at a load factor in (0, 1], for instance with growth and loads times it.
    first: the first increment. An increment is halved when its minimisation fails and enlarged when it
    converges fast; each starts from an extrapolation of up to three states. follow: if > 0, a buckled
    state is left by a push of this amplitude (length) along its mode, see `follow_mode`. report is
    called after each increment.

    Raises ConvergenceError, with the last state and its load factor, when increments become too small.
    """
    begin = time.perf_counter()
    done, increment, state = 0.0, _share("first", first), np.array(start, float)
    path = [(0.0, state)]
    iterations, result = 0, None
    while done < 1:
        target = min(1.0, done + increment) if done + 1.01 * increment < 1 else 1.0
        try:
            places, states = zip(*path, strict=True)
            guess = extrapolated(places, states, target)
            result = _increment(minimiser, problem(target), guess, state)
            if result.buckled and follow > 0:
                result = follow_mode(minimiser, problem(target), result, follow)
        except ConvergenceError as error:
            increment = (target - done) / 2
            if increment < SMALLEST_INCREMENT:
                raise ConvergenceError(
                    f"continuation failed at load factor {done:.4g}: {error}", state, done
                ) from error
            continue
        iterations += result.iterations
        if result.iterations > MANY or result.iterations < FEW:
            increment = (target - done) * (0.5 if result.iterations > MANY else 1.6)
        done, state = target, result.state
        path = [*path[-2:], (done, state)]
        if report is not None:
            report(done, result)
    assert result is not None
    return replace(result, iterations=iterations, seconds=time.perf_counter() - begin)


def _increment(minimiser: Minimiser, potential: Potential, guess: Array, state: Array) -> Equilibrium:
    """The minimum from the extrapolated state, or from the last one if that fails."""
    orientation = minimiser.orientation
    if not orientation.keeps(orientation.directors(state), orientation.directors(guess)):
        guess = state
    return minimiser.minimise(potential, guess)


def follow_mode(
    minimiser: Minimiser, potential: Potential, buckled: Equilibrium, amplitude: float
) -> Equilibrium:
    """The minimum on one side of a saddle: pushed along its unstable direction, then minimised again.

    amplitude: root mean square of the push over the sheet, in units of length; its sign selects the
    side. Raises ValueError if the state is not buckled, ConvergenceError as `Minimiser.minimise`.
    """
    if buckled.mode is None:
        raise ValueError("buckled.mode = None: must be a mode; the state is a minimum, not a saddle")
    size, result = validation.real("amplitude", amplitude), buckled
    for _ in range(ATTEMPTS):
        if result.mode is None:
            break
        push = result.mode * (size / minimiser.rms(result.mode))
        allowed = potential.reach(result.state, push)
        lower = minimiser.minimise(potential, result.state + allowed * push, PATIENCE)
        seconds, iterations = result.seconds + lower.seconds, result.iterations + lower.iterations
        result = replace(lower, iterations=iterations, seconds=seconds)
    return result


def _share(name: str, value: float) -> float:
    number = validation.real(name, value)
    if not 0 < number <= 1:
        raise ValueError(f"{name} = {number:g}: must be in (0, 1]")
    return number
