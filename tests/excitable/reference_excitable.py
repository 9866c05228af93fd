"""Slow, literal references for excitable waves: travelling waves by Fourier series, limit cycles as
ODEs."""

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
Numbers = tuple[float, float, float, float]
"""Threshold, recovery decay, recovery rate, diffusion length."""


def train(numbers: Numbers, wavelength: float, c: Array, speed: float) -> tuple[Array, float]:
    """c(y - speed t) of a periodic wave train on equidistant points, and its speed; dense Newton.

    With z = y - s t: s c' + D c'' + f(c) - w = 0 and s w' + r (c - k w) = 0, both by Fourier matrices.
    """
    threshold, decay, rate, length = numbers
    count = c.size
    orders = 2 * np.pi * np.fft.fftfreq(count, wavelength / count)
    if count % 2 == 0:
        orders[count // 2] = 0.0
    spread = np.fft.ifft(1j * orders[:, None] * np.fft.fft(np.eye(count), axis=0), axis=0).real
    first_slope = spread @ c
    for _ in range(60):
        # w as a linear function of c and of the speed
        matrix = speed * spread - rate * decay * np.eye(count)
        w = np.linalg.solve(matrix, -rate * c)
        w_c = np.linalg.solve(matrix, -rate * np.eye(count))
        w_s = np.linalg.solve(matrix, -spread @ w)
        diffusion = length**2 * spread @ spread
        residual = speed * spread @ c + diffusion @ c + c * (1 - c) * (c - threshold) - w
        slope = -3 * c**2 + 2 * (1 + threshold) * c - threshold
        jacobian = np.zeros((count + 1, count + 1))
        jacobian[:-1, :-1] = speed * spread + diffusion + np.diag(slope) - w_c
        jacobian[:-1, -1] = spread @ c - w_s
        jacobian[-1, :-1] = first_slope
        step = np.linalg.solve(jacobian, -np.append(residual, 0.0))
        c, speed = c + step[:-1], speed + step[-1]
        if abs(step).max() < 1e-11:
            return c, float(speed)
    raise AssertionError("the reference did not converge")


def pulse_speed(threshold: float, decay: float, rate: float) -> float:
    """Of a single pulse with D = 1, from a train so long that pulses do not feel each other."""
    wavelength, count = 300.0, 480
    y = np.arange(count) * wavelength / count
    found = solve_pulse((threshold, decay, rate, 1.0), y, wavelength)
    return abs(found)


def solve_pulse(numbers: Numbers, y: Array, wavelength: float) -> float:
    """Speed, starting from a pulse that was followed in time on the ring until its shape is steady."""
    threshold, decay, rate, length = numbers
    count = y.size
    step = wavelength / count
    c = np.where(abs(y - 60) < 8, 1.0, 0.0)
    w = np.where((y < 60) & (y > 20), 0.2, 0.0)
    waves = (2 * np.pi * np.fft.rfftfreq(count, step)) ** 2 * length**2
    dt = 0.05
    damp = 1 / (1 + dt * waves)
    for _ in range(4000):  # semi-implicit Euler: good enough to start Newton
        c, w = (
            np.fft.irfft(damp * np.fft.rfft(c + dt * (c * (1 - c) * (c - threshold) - w)), count),
            w + dt * rate * (c - decay * w),
        )
    return train(numbers, wavelength, c, 0.4 * length)[1]


def limit_cycle(numbers: Numbers) -> tuple[float, float, float]:
    """Period, smallest and largest c of the uniform oscillation."""
    threshold, decay, rate, _ = numbers

    def rates(_: float, u: Array) -> list[float]:
        c, w = u
        return [c * (1 - c) * (c - threshold) - w, rate * (c - decay * w)]

    def rising(_: float, u: Array) -> float:
        return float(u[0] - 0.05)

    rising.direction = 1.0  # type: ignore[attr-defined]
    options = {"rtol": 1e-10, "atol": 1e-12, "method": "DOP853"}
    found = solve_ivp(rates, (0, 60 / abs(threshold)), [0.1, 0.0], events=rising, **options)
    period = found.t_events[0][-1] - found.t_events[0][-2]
    once = solve_ivp(
        rates, (0, period), found.y_events[0][-1], t_eval=np.linspace(0, period, 4001), **options
    )
    return float(period), float(once.y[0].min()), float(once.y[0].max())


def multipliers(numbers: Numbers, halves: list[int]) -> list[float]:
    """Largest growth over a period of deviations cos(pi m (y/L + 1/2)) from the uniform oscillation, L
    = 1."""
    threshold, decay, rate, length = numbers
    period, *_ = limit_cycle(numbers)

    def rates(_: float, u: Array) -> Array:
        c, w = u[:2]
        own = np.array([c * (1 - c) * (c - threshold) - w, rate * (c - decay * w)])
        slope = -3 * c**2 + 2 * (1 + threshold) * c - threshold
        jacobian = np.array([[slope - damping, -1.0], [rate, -rate * decay]])
        return np.concatenate([own, (jacobian @ u[2:].reshape(2, 2)).ravel()])

    found, options = [], {"rtol": 1e-10, "atol": 1e-12, "method": "DOP853"}
    damping = 0.0
    first = np.array([0.1, 0.0, 0.0, 0.0, 0.0, 0.0])
    on_cycle = solve_ivp(rates, (0, 60 / abs(threshold)), first, **options).y[:2, -1]
    for m in halves:
        damping = (length * np.pi * m) ** 2
        state = np.concatenate([on_cycle, np.eye(2).ravel()])
        end = solve_ivp(rates, (0, period), state, **options).y[2:, -1]
        found.append(float(abs(np.linalg.eigvals(end.reshape(2, 2))).max()))
    return found


def spread(c: Array) -> Array:
    """Differences of second order to the four neighbours in the last two axes, nothing across edges."""
    found = np.zeros_like(c)
    for axis in (-1, -2):
        step = np.moveaxis(np.diff(c, axis=axis), axis, -1)
        sides = np.moveaxis(found, axis, -1)
        sides[..., :-1] += step
        sides[..., 1:] -= step
    return found


def cores(c: Array, w: Array) -> int:
    """Squares of four points around which the phase of (c - 0.1, 4 w) winds."""
    phase = np.arctan2(4 * w, c - 0.1)
    corners = [phase[:-1, :-1], phase[1:, :-1], phase[1:, 1:], phase[:-1, 1:]]
    turns = [np.roll(corners, -1, 0)[i] - corners[i] for i in range(4)]
    winding = sum((turn + np.pi) % (2 * np.pi) - np.pi for turn in turns)
    return int((abs(winding) > np.pi).sum())


def twins(numbers: Numbers, cells: int, until: float, every: float = 20.0) -> tuple[float, list[int]]:
    """A square from a crossed start, twice with a difference of 1e-6: e-foldings per time at which
    they part in the second half of the time, and the number of cores at every so many units of time."""
    threshold, decay, rate, length = numbers
    x = (np.arange(cells) + 0.5) / cells - 0.5
    c = np.stack(2 * [np.broadcast_to(0.5 * np.tanh(x / 0.1), (cells, cells))])
    w = np.stack(2 * [np.broadcast_to(0.1 * np.tanh(x / 0.1)[:, None], (cells, cells))])
    c[1] += 1e-6 * np.random.default_rng(0).normal(size=c[1].shape)
    share = (length * cells) ** 2
    dt = min(0.2 / share, 0.3)

    def rates(c: Array, w: Array) -> tuple[Array, Array]:
        dc = share * spread(c) + c * (1 - c) * (c - threshold) - w
        return dc, rate * (c - decay * w)

    growth, count, found = 0.0, 0, []
    steps = round(every / dt)
    for k in range(round(until / every)):
        for _ in range(steps):
            (dc, dw) = rates(c, w)
            (ec, ew) = rates(c + dt * dc, w + dt * dw)
            c, w = c + dt / 2 * (dc + ec), w + dt / 2 * (dw + ew)
        apart = float(np.sqrt(np.mean((c[1] - c[0]) ** 2 + (w[1] - w[0]) ** 2)))
        if k > until / every / 2:
            growth, count = growth + np.log(apart / 1e-6), count + 1
        for one in (c, w):
            one[1] = one[0] + (one[1] - one[0]) * 1e-6 / apart
        found.append(cores(c[0], w[0]))
    return growth / (count * steps * dt), found
