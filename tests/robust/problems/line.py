"""The body on a line: references in mpmath, or exact."""

import mpmath as mp
import numpy as np

from linear_theory import FieldWave, SineWave, TravellingWave, line_balance, line_speed_viscous
from linear_theory.line import line_speed
from tests.line import reference_line
from tests.robust.problems.problem import Outcome, Problem, case, family, of_speed

SINE = SineWave()
ROUNDING = 4e-16
"""Relative accuracy that `line_speed` promises, 2 ulp."""

EPS = float(np.finfo(float).eps)


def sine(alpha: float) -> Outcome:
    exact = float(alpha * reference_line.kepler_sine(alpha))
    found = float(line_speed(alpha))
    return Outcome(found, exact, ROUNDING * abs(exact), stated=True)


def balanced_sine(alpha: float, count: int = 1) -> Outcome:
    exact = float(alpha * reference_line.kepler_sine(alpha)) / count
    return of_speed(line_balance(SineWave(count), alpha), exact, ROUNDING * abs(exact))


def blunt(slip: float, alpha: float = 0.3) -> Outcome:
    """tanh friction at a slip speed in units of the wave's, L/T."""
    exact = float(alpha * reference_line.tanh_level(alpha, slip / alpha))
    found = line_balance(SINE, alpha, friction="tanh", slip_speed=slip)
    return of_speed(found, exact, ROUNDING * abs(exact))


def samples(profile: object, points: int) -> TravellingWave:
    return TravellingWave.from_samples(profile(2 * np.pi * np.arange(points) / points))


def profile_median(wave: TravellingWave, alpha: float) -> Outcome:
    """A travelling wave of any profile, against its weighted median with 30 digits."""
    found = line_balance(wave, alpha)
    unit = alpha / wave.count / wave.period
    exact = unit * reference_line.travelling_level(wave, alpha, True, found.mean / unit)
    return of_speed(found, float(exact), ROUNDING * abs(float(exact)))


def train(width: float, points: int, alpha: float = 0.5) -> Outcome:
    """A pulse exp((cos phi - 1)/width^2): half of the weight lies within some phi of its crest."""
    found = line_balance(samples(lambda p: np.exp((np.cos(p) - 1) / width**2), points), alpha)
    with mp.workdps(30):
        x = 1 / mp.mpf(width) ** 2
        profile = lambda phi: mp.exp(x * (mp.cos(phi) - 1))  # noqa: E731
        mean = mp.exp(-x) * mp.besseli(0, x)
        half = (1 + alpha * mean) * mp.pi / 2

        def excess(phi: mp.mpf) -> mp.mpf:
            cuts = [phi * k / 8 for k in range(9)]
            return phi + alpha * mp.quad(profile, cuts) - half

        exact = float(alpha * (profile(mp.findroot(excess, mp.pi / 2)) - mean))
    # the pulse is sampled until its series has 16 digits of its height, of which V is a part
    return of_speed(found, exact, EPS * alpha)


def gap(points: int) -> Outcome:
    """cos^2 on a third of the wave, 0 elsewhere: what does not grow is at rest, V = -alpha mean c."""
    wave = samples(lambda p: np.where(abs(p - 3) < 1, np.cos((p - 3) * np.pi / 2) ** 2, 0.0), points)
    found = line_balance(wave, 0.5)
    assert found.sticks
    # the Fourier series rings in the gap by points^-2, which is no error of the balance
    return of_speed(found, -0.5 * wave.mean, points**-2.0)


def jump() -> Outcome:
    """c = +-1: half of the body is heavier by (1 + alpha)/(1 - alpha), and stays where it is."""
    wave = FieldWave(lambda x, y, t: np.where(np.sin(2 * np.pi * (y - t)) > 0, 1.0, -1.0) + 0 * x, 1.0)
    return of_speed(line_balance(wave, 0.1, rtol=1e-3, length=1), 0.1)


def slow_clock(t: object) -> np.ndarray:
    """Runs through a period in its first half, smoothly, and stands still in the second."""
    share = np.clip(2 * np.mod(t, 1.0), 0, 1)
    return share**3 * (10 - 15 * share + 6 * share**2)


def stopping(load: str = "current") -> FieldWave:
    """The sine wave by that clock."""
    return FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y - slow_clock(t))) + 0 * x, 1.0)


def stops() -> Outcome:
    """Dry friction knows no rate: over a period the body comes as far as with the steady wave."""
    return of_speed(line_balance(stopping(), 0.1, rtol=1e-3, length=1), float(line_speed(0.1)))


def stops_viscous() -> Outcome:
    found = line_balance(stopping(), 0.1, friction="viscous", rtol=1e-3, length=1)
    return of_speed(found, float(line_speed_viscous(0.1)))


def large_pulse() -> Outcome:
    """c = (1 + cos)/2 >= 0 and alpha = 3/2: the pulse grows lengths by 150 %."""
    wave = TravellingWave([0.5], [0.0], mean=0.5)
    found = line_balance(wave, 1.5)
    with mp.workdps(30):
        # 1 + alpha c = w(phi) is even: half of its weight lies within phi of the crest
        total = lambda phi: (1.75 * phi + 0.75 * mp.sin(phi)) / (1.75 * mp.pi)  # noqa: E731
        level = mp.cos(mp.findroot(lambda phi: total(phi) - 0.5, 1.2)) / 2
    return of_speed(found, float(1.5 * level), ROUNDING)


KEPLER = "root of theta = alpha cos(theta), mpmath, 50 digits"
MEDIAN = "weighted median of the profile, mpmath, 30 digits"

PROBLEMS: tuple[Problem, ...] = family(
    "Body on a line",
    *(
        case(
            f"line: sine, alpha = {alpha:g}",
            "small parameter" if abs(alpha) < 1e-3 else "large growth",
            "V is alpha^2, the velocities that balance are alpha"
            if abs(alpha) < 1e-3
            else "a part of the body shrinks to nothing",
            KEPLER,
            lambda a=alpha: sine(a),
        )
        for alpha in (1e-12, -1e-6, 0.999999)
    ),
    *(
        case(
            f"line: {count} waves by the balance, alpha = {alpha:g}",
            tags,
            "the same from the sorted profile, without the closed form",
            KEPLER,
            lambda a=alpha, n=count: balanced_sine(a, n),
        )
        for alpha, count, tags in (
            (1e-12, 1, "small parameter"),
            (0.999999, -1, "large growth"),
            (0.3, 50, "aspect"),
        )
    ),
    case(
        "line: alpha = 1",
        "large growth",
        "a point of the body has no length left",
        "1 + alpha c > 0",
        lambda: balanced_sine(1.0),
        expected="refused",
        limit=r"alpha = 1: .*must be < 1",
    ),
    *(
        case(
            f"line: slip speed {slip:g} wave speeds",
            "stiff",
            "the force changes sign over that slip speed"
            if slip < 1
            else "friction is all but viscous",
            "adaptive quadrature of the balance, mpmath",
            lambda s=slip: blunt(s),
        )
        for slip in (1e-6, 1e-3, 1.0, 1e3)
    ),
    *(
        case(
            f"line: pulse of width {width:g}",
            "rough, stuck" if width < 0.1 else "rough",
            f"the body grows on {width / 2:.0%} of the wave, {points // 2} harmonics",
            "half of the weight on either side of the level, mpmath, 30 digits",
            lambda w=width, n=points: train(w, n),
        )
        for width, points in ((0.35, 64), (0.05, 512))
    ),
    case(
        "line: near-square wave",
        "rough",
        "tanh(6 sin): two plateaus, the density at the median is small",
        MEDIAN,
        lambda: profile_median(samples(lambda p: np.tanh(6 * np.sin(p) + 0.5), 48), 0.6),
    ),
    case(
        "line: square wave",
        "rough, stuck",
        "growth jumps, given by a function whose rate is a spike; half of the body is at rest",
        "the heavier half stays where it is, V = alpha L/T",
        jump,
    ),
    case(
        "line: pulse with a gap",
        "stuck, rough",
        "two thirds of the body at rest, balanced by any force up to its limit",
        "limit of the regularised law, V = -alpha mean(c)",
        lambda: gap(1024),
    ),
    case(
        "line: growth of 150 %",
        "large growth",
        "a pulse (1 + cos)/2 with alpha = 3/2",
        "weighted median of a cosine, mpmath",
        large_pulse,
    ),
    case(
        "line: wave that stops, dry",
        "stuck",
        "the wave stands still for half of each period, with all of the body at rest",
        "rate independence: the steady wave's distance per period, closed form",
        stops,
    ),
    case(
        "line: wave that stops, viscous",
        "stuck",
        "the same with viscous friction, which is linear in the rate",
        "alpha^2/2, closed form",
        stops_viscous,
    ),
)
