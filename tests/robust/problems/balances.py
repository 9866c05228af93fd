"""Speeds of the linear theory: limits, a literal second balance, and the other field solver."""

import numpy as np

from linear_theory import (
    FieldWave,
    Sheet,
    SineWave,
    TravellingWave,
    airy_series,
    crawl_speed,
    line_balance,
    line_speed,
    second_order,
)
from linear_theory.friction.contact import Contact
from linear_theory.wave.protocol import Wave
from tests.robust.problems.line import samples, stopping
from tests.robust.problems.problem import Outcome, Problem, case, family, of_speed
from tests.theory import reference_balance

PAPER, SINE = Sheet(), SineWave()

SMALL = 1e-4
"""alpha at which V/alpha^2 is its limit to 1e-7: the next term is of order alpha^2, about 5 of them."""


def narrow_strip(alpha: float, width: float = 0.002, count: int = 1, rtol: float = 1e-4) -> Outcome:
    """x as on a line, weight 1 + 2 alpha c: half of the line's speed at twice the coupling."""
    sheet = Sheet(width=width)
    found = crawl_speed(sheet, SineWave(count), alpha, rtol=rtol)
    exact = float(line_speed(2 * alpha, count)) / 2
    # corrections are of order (2 pi n W/L)^2; that they are below this share is measured at larger W
    return of_speed(found, exact, (2 * np.pi * count * width) ** 2 * abs(exact), unit=alpha**2)


def limit_of_small_alpha(alpha: float) -> Outcome:
    """V/alpha^2 against its value at a moderate alpha by Ritz, where nothing is small."""
    exact = crawl_speed(PAPER, SINE, 1e-2, rtol=1e-5, method="ritz")
    found = crawl_speed(PAPER, SINE, alpha, rtol=1e-4)
    # even in alpha: 1 + O(alpha^2), measured at twice the coupling
    twice = crawl_speed(PAPER, SINE, 2e-2, rtol=1e-5, method="ritz").mean / 4e-4
    value = exact.mean / 1e-4
    return Outcome(
        found.mean / alpha**2,
        value - (twice - value) / 3,
        found.error / alpha**2,
        2 * exact.error / 1e-4,
        found.converged,
    )


def literal(alpha: float) -> Outcome:
    """Eq. 11 on one grid of midpoints by bisection, at times of a Gauss rule over half a period."""
    found = crawl_speed(PAPER, SINE, alpha, rtol=1e-3)
    field = airy_series(PAPER, SINE, rtol=1e-7)
    means = []
    for points in (5, 10):
        nodes, weights = np.polynomial.legendre.leggauss(points)
        times = (nodes + 1) / 4 + 0.25  # V(T/2 - t) = V(t) and V(t + T/2) differ by terms odd in alpha
        speeds = [
            (
                reference_balance.speed_at(field, alpha, t, points=(100, 200))
                + reference_balance.speed_at(field, alpha, t + 0.5, points=(100, 200))
            )
            / 2
            for t in times
        ]
        means.append(float(weights @ speeds) / 2)
    return of_speed(found, means[1], abs(means[1] - means[0]))


def by_ritz(
    sheet: Sheet, wave: Wave, alpha: float, rtol: float = 1e-3, fine: float = 0.1, **options: object
) -> Outcome:
    """The series against Ritz at a tenth of the tolerance: another field, finer cells and times."""
    found = crawl_speed(sheet, wave, alpha, rtol=rtol, **options)
    exact = crawl_speed(sheet, wave, alpha, rtol=fine * rtol, method="ritz", **options)
    return of_speed(found, exact.mean, exact.error, unit=alpha**2)


def slip(speed: float) -> Outcome:
    """tanh friction: dry and viscous friction are its limits, with corrections of known order."""
    found = crawl_speed(PAPER, SINE, 0.1, friction="tanh", slip_speed=speed, rtol=1e-4)
    law = "coulomb" if speed < 1 else "viscous"
    exact = crawl_speed(PAPER, SINE, 0.1, friction=law, rtol=1e-5, method="ritz")
    fastest = 0.1
    # dry: a layer of relative width v0/v around the points at rest; viscous: tanh s = s (1 - s^2/3)
    correction = speed / fastest if speed < 1 else (fastest / speed) ** 2
    return of_speed(found, exact.mean, exact.error + correction * abs(exact.mean))


def joining(speed: float) -> Outcome:
    """tanh friction between its limits, against the literal balance of one time, eq. 11 with eq. 3."""
    from linear_theory.balance.crawl import Crawl, first_resolution
    from linear_theory.friction.laws import Tanh

    field, alpha, t = airy_series(PAPER, SINE, rtol=1e-8), 0.25, 0.06
    law = Tanh(speed)
    motion = Crawl(field, alpha, Contact(friction=law), first_resolution(1e-6)).balance(np.array([t]))
    found = alpha * (motion.leading + alpha * motion.remainder)[0, 1]
    exact = reference_balance.speed_at(field, alpha, t, force=lambda r: np.tanh(r / speed) / r)
    # midpoints: the cells at points at rest, 1/320000 of the area each, times the speed 0.04
    return Outcome(float(found), exact, 1e-6 * abs(exact), 2e-6, stated=True)


def pulse(points: int, width: float) -> TravellingWave:
    """A bell of that width in phase."""
    return samples(lambda p: np.exp(-(((p - 3) / width) ** 2) / 2), points)


def square(harmonics: int) -> TravellingWave:
    """The first harmonics of the sign of the sine."""
    k = np.arange(1, harmonics + 1)
    return TravellingWave(np.zeros(harmonics), np.where(k % 2 == 1, 4 / (np.pi * k), 0.0))


def gap(points: int) -> TravellingWave:
    """cos^2 on a third of the wave, nothing elsewhere, but for the ringing of its series."""
    return samples(lambda p: np.where(abs(p - 3) < 1, np.cos((p - 3) * np.pi / 2) ** 2, 0.0), points)


def stuck_strip() -> Outcome:
    """Next to nothing moves but the pulse; with conserved weight a strip is a line."""
    wave = pulse(32, 0.4)
    found = crawl_speed(Sheet(width=0.02), wave, 0.1, load="material", rtol=3e-2)
    exact = line_balance(wave, 0.1, "material").mean
    # corrections of order (width/length of the pulse)^2
    return of_speed(found, exact, (0.02 / (0.4 / np.pi)) ** 2 * abs(exact))


def stops() -> Outcome:
    """A wave that stands still for half of each period carries the sheet as far as a steady one."""
    steady = crawl_speed(PAPER, SINE, 0.1, rtol=1e-4)
    found = crawl_speed(PAPER, stopping(), 0.1, rtol=1e-2)
    return of_speed(found, steady.mean, steady.error)


def resting(rtol: float = 1e-2) -> Outcome:
    """All rest at once and always: growth that does not change."""
    wave = FieldWave(lambda x, y, t: np.sin(2 * np.pi * y) + 0 * x + 0 * t, 1.0)
    return of_speed(crawl_speed(PAPER, wave, 0.1, rtol=rtol), 0.0)


def coefficient(sheet: Sheet, rtol: float = 1e-3) -> Outcome:
    """V_2 of a narrow strip: 7/4 with exponential growth and current load."""
    found = second_order(sheet, SINE, rtol=rtol)
    converged = found.second_error <= rtol * abs(found.second)
    allowance = (2 * np.pi * sheet.width) ** 2 * 1.75
    return Outcome(found.second, 1.75, found.second_error, allowance, converged)


LITERAL = "eq. 11 by midpoints and bisection"
FINER = "Legendre-Ritz field at a tenth of the tolerance"

PROBLEMS: tuple[Problem, ...] = family(
    "Speeds of the linear theory",
    case(
        "speed: strip, alpha = 1e-12",
        "small parameter, aspect",
        "V is alpha^2 of velocities of order alpha, W = L/500",
        "2 alpha^2 L/T",
        lambda: narrow_strip(1e-12),
    ),
    case(
        "speed: sheet, alpha = 1e-12",
        "small parameter",
        "the same on the 2 : 1 sheet",
        "V/alpha^2 of alpha = 0.01 and 0.02, extrapolated, by Ritz",
        lambda: limit_of_small_alpha(1e-12),
    ),
    case(
        "speed: sheet, alpha = -1e-6",
        "small parameter",
        "growth of the other sign",
        "the same",
        lambda: limit_of_small_alpha(-1e-6),
    ),
    case(
        "speed: alpha = 0.43",
        "large growth",
        "the load nearly vanishes at a point of the edge",
        LITERAL,
        lambda: literal(0.43),
    ),
    case(
        "speed: alpha = 0.437",
        "large growth",
        "1e-4 below the largest",
        FINER,
        lambda: by_ritz(PAPER, SINE, 0.437, 1e-2),
    ),
    case(
        "speed: alpha = 0.4378",
        "large growth",
        "the area element of the linear theory vanishes at the edge",
        "1 + alpha tr(strain) > 0",
        lambda: by_ritz(PAPER, SINE, 0.4378, 1e-2),
        expected="refused",
        limit=r"alpha = 0\.4378: the area element .* at x = 0\.25, .* must be < 0\.437",
    ),
    case(
        "speed: width L/100",
        "aspect",
        "a strip",
        "half of a line's speed at twice the coupling",
        lambda: narrow_strip(0.2, 0.01, rtol=1e-3),
    ),
    *(
        case(
            f"speed: width {width:g} L",
            "aspect",
            "only the sheet's ends move, all else is pushed sideways: V is what is left of edge layers",
            FINER,
            lambda w=width, r=rtol: by_ritz(Sheet(width=w), SINE, 0.1, r),
            expected=expected,
        )
        for width, rtol, expected in ((10.0, 3e-2, "flagged"), (100.0, 0.3, "flagged"))
    ),
    case(
        "speed: 10 waves",
        "aspect",
        "edge layers of a twentieth of the width",
        FINER,
        lambda: by_ritz(PAPER, SineWave(10), 0.1, 1e-2),
    ),
    case(
        "speed: 50 waves on a strip",
        "aspect, slow",
        "5000 times longer than wide, with 50 waves",
        "half of a line's speed at twice the coupling",
        lambda: narrow_strip(0.1, 2e-4, 50, 1e-2),
    ),
    *(
        case(
            f"speed: nu = {nu:g}",
            "material",
            "how much the sheet moves sideways",
            FINER,
            lambda n=nu: by_ritz(Sheet(poisson=n), SINE, 0.2),
        )
        for nu in (-0.99, 0.0, 0.5)
    ),
    *(
        case(
            f"speed: slip speed {speed:g} wave speeds",
            "stiff",
            "friction changes sign over the slip speed" if speed < 1 else "friction is all but viscous",
            "its limit, dry or viscous friction, by Ritz",
            lambda v=speed: slip(v),
        )
        for speed in (1e-6, 1e3)
    ),
    case(
        "speed: slip speed 0.01 wave speeds",
        "stiff",
        "neither dry nor viscous, at one time",
        LITERAL,
        lambda: joining(0.01),
    ),
    case(
        "speed: square wave of 9 harmonics",
        "rough",
        "fronts and ringing",
        FINER,
        lambda: by_ritz(PAPER, square(9), 0.1, 3e-2),
    ),
    case(
        "speed: square wave of 85 harmonics",
        "rough, slow",
        "fronts of a hundredth of the length",
        "Legendre-Ritz field at the same tolerance",
        lambda: by_ritz(PAPER, square(85), 0.1, 3e-2, fine=0.9),
    ),
    case(
        "speed: pulse of 1/15 of the wave",
        "rough, stuck",
        "most of the sheet moves as one, slowly",
        FINER,
        lambda: by_ritz(PAPER, pulse(32, 0.2), 0.1, 3e-2),
    ),
    case(
        "speed: pulse on a strip, weight conserved",
        "rough, stuck, aspect",
        "all but the pulse is at rest",
        "the body on a line, with corrections of order (width/pulse)^2",
        stuck_strip,
    ),
    case(
        "speed: pulse with a gap",
        "rough, stuck",
        "two thirds of the profile are 0 up to ringing",
        FINER,
        lambda: by_ritz(PAPER, gap(24), 0.1, 3e-2),
    ),
    case(
        "speed: wave that stops",
        "stuck",
        "at rest for half of each period",
        "rate independence: the steady wave's distance",
        stops,
    ),
    case(
        "speed: growth that never changes",
        "stuck",
        "no velocity at any time to measure a tolerance by",
        "0",
        resting,
    ),
    case(
        "speed: V_2 of a strip",
        "small parameter, aspect",
        "a second-order field",
        "7/4, exponential growth on a line with squared weight",
        lambda: coefficient(Sheet(width=0.02)),
    ),
    case(
        "speed: alpha = NaN",
        "small parameter",
        "no number",
        "alpha finite",
        lambda: by_ritz(PAPER, SINE, float("nan")),
        expected="refused",
        limit="alpha contains nan",
    ),
)
