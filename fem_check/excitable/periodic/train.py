"""Periodic wave trains c(y - s t): of one shape that travels without change, as on a ring.

With theta = y/wavelength - t/T, T = wavelength/s, the equation is an ordinary one along theta. Its
harmonics are found by Newton's method, with w as a linear function of c, from the uniform oscillation
on: that is the train of infinite wavelength, and diffusion is raised step by step.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.excitable.kinetics import Equation
from linear_theory.common import validation
from linear_theory.common.errors import NotConvergedError
from linear_theory.common.progress import track
from linear_theory.common.shown import Shown, with_error
from linear_theory.common.threads import one_blas_thread
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

FEWEST, MOST = 64, 1024
"""Points along a wavelength, at first and at most."""

NEWTON, CLOSE = 12, 1e-11
"""Newton steps at most, and the last of them relative to c."""

SMALLEST = 1 / 256
"""Step of diffusion, as a share of the whole, below which the continuation fails."""

ROUNDING = 1e-14
"""Of the frequency, by the solution of the linear equations."""

SETTLING, LONGEST = 400.0, 4000.0
"""Time that the uniform oscillation is given to settle, and after which there is none."""


class Profile(NamedTuple):
    """c at equidistant theta in [0, 1), and 1/T."""

    c: Array
    frequency: float


@dataclass(frozen=True, eq=False)
class WaveTrain(Shown):
    """`count` wavelengths on a length, travelling towards +y.

    period: units of time; speed: length/time; period_error, speed_error, error: estimated, of period,
    speed and c. wave: the train as a TravellingWave, which every level takes; stability is not known.
    """

    wave: TravellingWave
    speed: float
    speed_error: float
    error: float

    @property
    def period(self) -> float:
        """Time after which it repeats."""
        return self.wave.period

    @property
    def period_error(self) -> float:
        """Estimated error of that."""
        return self.period * self.speed_error / self.speed

    def _contents(self) -> Mapping[str, Any]:
        return {
            "period": self.period,
            "speed": self.speed,
            "speed_error": self.speed_error,
            "error": self.error,
            "wave": self.wave,
        }

    def _title(self) -> str:
        return f"WaveTrain: speed {with_error(self.speed, self.speed_error)}, period {self.period:.6g}"


@one_blas_thread
def wave_train(
    equation: Equation, length: float = 1.0, count: int = 1, rtol: float = 1e-6
) -> WaveTrain:
    """The train with `count` wavelengths on a length, for kinetics that oscillate by themselves.

    rtol: of speed and c. Start, pacing and feedback of the equation have no effect, so that the last
    two are refused. Raises ValueError for these and for values out of range; NotConvergedError for
    kinetics that come to rest, and for a wavelength below the shortest one of a train.

    >>> from fem_check.excitable import excitable_preset, wave_train
    >>> train = wave_train(excitable_preset("nu = -0.1"))
    >>> print(f"speed {train.speed:.5f}, period {train.period:.2f}")
    speed 0.02517, period 39.73
    """
    validation.instance("equation", equation, Equation)
    for name in ("pacing", "feedback"):
        if getattr(equation, name) is not None:
            raise ValueError(f"equation: must have {name} = None for a train on its own")
    length, rtol = validation.positive("length", length), validation.tolerance(rtol)
    count = validation.integer("count", count, 1)
    spread = (equation.diffusion_length * count / length) ** 2
    points = FEWEST
    last = _continued(equation, _oscillation(equation, points), spread)
    while True:
        points *= 2
        found = _solved(equation, Profile(_resampled(last.c, points), last.frequency), spread)
        speed_error = (abs(found.frequency - last.frequency) + ROUNDING) * length / count
        error = float(abs(_resampled(last.c, points) - found.c).max())
        speed = found.frequency * length / count
        if speed_error <= rtol * speed and error <= rtol * abs(found.c).max():
            return WaveTrain(_travelling(found, count), speed, speed_error, error)
        if points >= MOST:
            raise NotConvergedError(f"wave train: {MOST} points miss rtol = {rtol:g}", best=None)
        last = found


def _oscillation(equation: Equation, points: int) -> Profile:
    """The uniform one, as the train without diffusion."""
    from scipy.integrate import solve_ivp

    def rates(_: float, u: Array) -> Array:
        return np.concatenate(equation.reaction(u[:1], u[1:]))

    def trough(t: float, u: Array) -> float:
        return float(rates(t, u)[0])

    trough.direction = 1.0  # type: ignore[attr-defined]
    options: dict[str, Any] = {"rtol": 1e-9, "atol": 1e-11, "method": "LSODA"}
    slow = max(1.0, 0.01 / max(abs(equation.threshold), 1e-3))  # to settle near a Hopf point
    found = solve_ivp(rates, (0, slow * LONGEST), np.array([0.3, 0.0]), events=trough, **options)
    late = found.t_events[0] > slow * SETTLING
    if late.sum() < 2 or np.ptp(found.y[0, found.t > slow * LONGEST / 2]) < 1e-3:
        raise NotConvergedError(
            "wave train: the kinetics come to rest, they do not oscillate by themselves", best=None
        )
    state, period = found.y_events[0][late][-1], float(np.diff(found.t_events[0][late])[-1])
    times = period * np.arange(points) / points
    c = solve_ivp(rates, (0, period), state, t_eval=times, **options).y[0]
    return Profile(np.roll(c[::-1], 1), 1 / period)  # c at theta is c at time -theta T


def _continued(equation: Equation, first: Profile, spread: float) -> Profile:
    """From no diffusion to all of it, in steps as long as Newton's method bears."""
    found, share, step = _solved(equation, first, 0.0), 0.0, 0.25
    for _ in track("the wave train", range(2 * math.ceil(1 / SMALLEST))):
        tried = min(1.0, share + step)
        try:
            found, share, step = _solved(equation, found, tried * spread), tried, 1.5 * step
        except NotConvergedError:
            step /= 2
        if share == 1.0:
            return found
        if step < SMALLEST:
            break
    raise NotConvergedError(
        f"wave train: none was followed beyond a wavelength of {1 / math.sqrt(max(share, 1e-12)):.3g} "
        "times the one that was asked for; trains have a shortest wavelength",
        best=None,
    )


def _solved(equation: Equation, start: Profile, spread: float) -> Profile:
    """Newton's method for c and the frequency, with the phase held where it was."""
    c, frequency, points = start.c, start.frequency, start.c.size
    orders = 2j * np.pi * np.fft.rfftfreq(points, 1 / points)
    orders[-1] = 0.0  # the cosine of the shortest wave has no slope at the points
    rate, decay = equation.recovery_rate, equation.recovery_rate * equation.recovery_decay
    slope_before = np.fft.irfft(orders * np.fft.rfft(c), points)
    for _ in range(NEWTON):
        recovery = rate / (decay - frequency * orders + (decay == 0) * (orders == 0))
        linear = frequency * orders + spread * orders**2 - recovery
        coupled = orders - orders * recovery**2 / rate if rate > 0 else orders
        spectrum = np.fft.rfft(c)
        cubic = c * (1 - c) * (c - equation.threshold)
        missed = np.fft.irfft(linear * spectrum, points) + cubic
        matrix = np.zeros((points + 1, points + 1))
        matrix[:-1, :-1] = _circulant(linear, points) + np.diag(equation.slope(c))
        matrix[:-1, -1] = np.fft.irfft(coupled * spectrum, points)
        matrix[-1, :-1] = slope_before
        step = np.linalg.solve(matrix, -np.append(missed, 0.0))
        c, frequency = c + step[:-1], frequency + float(step[-1])
        if not abs(c).max() < 10 or frequency <= 0:
            break
        if abs(step[:-1]).max() <= CLOSE * abs(c).max() and np.ptp(c) > 1e-3:
            return Profile(c, frequency)
    raise NotConvergedError("wave train: Newton's method found none", best=None)


def _circulant(symbol: Array, points: int) -> Array:
    """The matrix of a product in Fourier space."""
    first = np.fft.irfft(symbol, points)
    index = np.arange(points)
    return np.asarray(first[(index[:, None] - index) % points])


def _resampled(c: Array, points: int) -> Array:
    """The same harmonics at more points."""
    return np.asarray(np.fft.irfft(np.fft.rfft(c), points) * points / c.size)


def _travelling(profile: Profile, count: int) -> TravellingWave:
    """phi = 2 pi theta."""
    terms = np.fft.rfft(profile.c)[:-1] / profile.c.size
    return TravellingWave(
        2 * terms[1:].real, -2 * terms[1:].imag, count, 1 / profile.frequency, float(terms[0].real)
    )
