"""Friction with a direction and maps of friction: formulas of others, limits, and literal quantiles."""

import math

import mpmath as mp
import numpy as np

from linear_theory import (
    Coulomb,
    Directional,
    FieldWave,
    GivenMap,
    Mapped,
    Patches,
    Sheet,
    SineWave,
    Tanh,
    airy_series,
    crawl_speed,
    line_balance,
    second_order,
)
from linear_theory.friction.law import FrictionLaw
from tests.robust.problems.problem import Outcome, Problem, case, family, of_speed

SINE, PLACES, TIMES = SineWave(), 8000, 128

Array = np.ndarray


def ratchet(r: float, form: FrictionLaw | None = None) -> Directional:
    """(mu_b - mu_f)/(mu_b + mu_f) = r."""
    return Directional(1 - r, 1 + r, form=Coulomb() if form is None else form)


def kepler(alpha: float, r: float) -> float:
    """V of a sine under dry friction: theta - alpha cos(theta) = (pi/2) r, V = alpha sin(theta)."""
    with mp.workdps(40):
        # pi/2 - theta, which is small at r = 1
        gap = mp.findroot(lambda d: d + alpha * mp.sin(d) - mp.pi / 2 * (1 - mp.mpf(r)), 1 - r)
        return float(alpha * mp.cos(gap))


def on_line(alpha: float, r: float) -> Outcome:
    exact = kepler(alpha, r)
    return of_speed(line_balance(SINE, alpha, friction=ratchet(r)), exact, 4e-16 * abs(exact))


def sharp_tanh(slip: float) -> Outcome:
    found = line_balance(SINE, 0.1, friction=ratchet(0.5, Tanh(slip)))
    return of_speed(found, kepler(0.1, 0.5), slip)


def quantile(v: Array, weight: Array, share: float) -> float:
    """Minus the mean of the levels below which that share of the weight has its velocity, (t, n)."""
    order = np.argsort(v, axis=1)
    v, weight = (np.take_along_axis(a, order, 1) for a in (v, weight))
    below = np.cumsum(weight, axis=1) - weight / 2
    levels = [np.interp(share * w.sum(), b, u) for b, u, w in zip(below, v, weight, strict=True)]
    return -float(np.mean(levels))


def sliding(law: Directional) -> float:
    """Share of the weight with less than its velocity: what slips backward bears backward friction."""
    return law.forward / (law.forward + law.backward)


def literal_line(law: Directional, mu: Array, places: int) -> float:
    y, t = (np.arange(places) + 0.5) / places - 0.5, np.arange(TIMES)[:, None] / TIMES
    c = np.sin(2 * np.pi * (y - t))
    return quantile(-0.1 * c, (1 + 0.1 * c) * mu(y), sliding(law))


def mapped_line(law: Directional, mu: object) -> Outcome:
    """A map along a body, against a sorted grid."""
    friction = Mapped(law, GivenMap(lambda x, y: mu(y) + 0 * x))
    found = line_balance(SINE, 0.1, friction=friction, rtol=1e-3)
    exact, coarse = (literal_line(law, mu, n) for n in (PLACES, PLACES // 2))
    return of_speed(found, exact, 4 * abs(exact - coarse) + 1e-6)


def without_sideways(width: float) -> Outcome:
    """A sheet that slips sideways for nothing: the quantile of v_y, with the weight of the theory."""
    sheet, law = Sheet(width=width), Directional(0.5, 1.5, 1e-3)
    found = crawl_speed(sheet, SINE, 0.1, friction=law, rtol=1e-2)
    field, results = airy_series(sheet, SINE, rtol=1e-6), []
    for n in (50, 100):
        x, y = ((np.arange(k) + 0.5) / k - 0.5 for k in (n // 2, n))
        places = (p.ravel() for p in np.meshgrid(width * x, y))
        x, y = places
        t = np.arange(32) / 32
        v = np.stack([0.1 * field.velocity(x, y, s)[1] for s in t])
        weight = np.stack([1 + 0.1 * field.strain(x, y, s)[:2].sum(0) for s in t])
        results.append(quantile(v, weight, sliding(law)))
    return of_speed(found, results[1], 2 * abs(results[1] - results[0]))


def strip(r: float) -> Outcome:
    """x as on a line, weight 1 + 2 alpha c: half of the line's speed at twice the coupling."""
    width, alpha = 0.002, 0.1
    found = crawl_speed(Sheet(width=width), SINE, alpha, friction=ratchet(r), rtol=1e-4)
    exact = kepler(2 * alpha, r) / 2
    return of_speed(found, exact, (2 * np.pi * width) ** 2 * abs(exact))


def small_alpha(alpha: float) -> Outcome:
    law = Directional(0.5, 1.5, 1.0)
    first = second_order(Sheet(), SINE, friction=law, rtol=1e-2)
    found = crawl_speed(Sheet(), SINE, alpha, friction=law, rtol=1e-4)
    return of_speed(found, alpha * first.first, alpha * (first.first_error + 5 * alpha), unit=alpha)


def turned_ellipse() -> Outcome:
    """Axes exchanged: solved without the mirror symmetry and with it."""
    turned = Directional(0.3, 0.3, 2.0, heading=math.pi / 2)
    found, plain = (
        crawl_speed(Sheet(), SINE, 0.1, friction=law, rtol=1e-2)
        for law in (turned, Directional(2.0, 2.0, 0.3))
    )
    return of_speed(found, plain.mean, plain.error)


def cutting(edge: float) -> Outcome:
    """A narrow strip whose rear is four times as rough, against the quantile on a line."""
    law, width = ratchet(0.5), 0.002
    patches = Patches([(-1, 1, -2, -0.13, 4.0)], edge)
    found = crawl_speed(
        Sheet(width=width), SINE, 0.1, friction=Mapped(law, patches), load="material", rtol=1e-3
    )
    y, t = (np.arange(PLACES) + 0.5) / PLACES - 0.5, np.arange(TIMES)[:, None] / TIMES
    mu = np.broadcast_to(patches.values(0.0, y), (TIMES, PLACES))
    exact = quantile(-0.1 * np.sin(2 * np.pi * (y - t)), mu, sliding(law))
    return of_speed(found, exact, ((2 * np.pi * width) ** 2 + 1 / PLACES) * abs(exact))


def unstated_jump(creases: object, rtol: float) -> Outcome:
    """A coefficient that jumps within the sheet, against patches whose edge is as good as none."""
    rough = GivenMap(lambda x, y: np.where(y + 0 * x < -0.13, 4.0, 1.0), mirrored=True, creases=creases)
    sharp = Patches([(-5, 5, -5, -0.13, 4.0)], 1e-5)
    found, exact = (
        crawl_speed(Sheet(), SINE, 0.1, friction=Mapped(Coulomb(), known), rtol=r)
        for known, r in ((rough, rtol), (sharp, 1e-3))
    )
    return of_speed(found, exact.mean, exact.error)


def passing(y: object, t: object) -> Array:
    """A pulse of a fifth of the body that runs in at one end and out at the other, once a period."""
    s = (y + 0.8 - 1.6 * t) / 0.1
    inside = np.clip(1 - s**2, 0.0, None)
    return inside**2 * (1 + 0.5 * s)


def single_pulse(alpha: float) -> Outcome:
    """What is outside is heavier than the pulse and stays: -alpha int c dS per pulse, any shape."""
    wave = FieldWave(lambda x, y, t: passing(y, np.mod(t, 1.0)) + 0 * x, 1.0)
    found = line_balance(wave, alpha, length=1.0, rtol=1e-2)
    return of_speed(found, -alpha * 0.1 * 16 / 15)


FORMULA = "theta - alpha cos(theta) = (pi/2) r, V = alpha sin(theta), mpmath"
SORTED = "weighted quantile on a sorted grid"

PROBLEMS: tuple[Problem, ...] = family(
    "Friction with a direction, and maps of it",
    *(
        case(f"direction: {name}", "stiff", words, FORMULA, lambda a=alpha, r=r: on_line(a, r))
        for name, words, alpha, r in (
            ("r = 1 - 1e-12", "sliding back is a million million times as hard", 0.1, 1 - 1e-12),
            ("r = -0.999999", "all but a millionth of the body slips one way", 0.3, -0.999999),
            ("r = 1e-12", "directions that all but balance", 0.1, 1e-12),
        )
    ),
    case(
        "direction: alpha = 1e-12 on a line",
        "small parameter",
        "V is of order alpha, what is left of it of alpha^2",
        FORMULA,
        lambda: on_line(1e-12, 0.5),
    ),
    case(
        "direction: tanh of slip speed 1e-06 on a line",
        "stiff",
        "the force changes sign over that slip speed",
        FORMULA,
        lambda: sharp_tanh(1e-6),
    ),
    case(
        "direction: single pulse through a body",
        "stuck, rough",
        "all but the pulse is at rest, and all of the body for part of the period",
        "-alpha int c dS per pulse (after Gidoni, Noselli, DeSimone, 2014)",
        lambda: single_pulse(0.2),
    ),
    case(
        "direction: strip of width L/500",
        "aspect",
        "a strip",
        "half of a line's speed at twice the coupling",
        lambda: strip(0.5),
    ),
    case(
        "direction: alpha = 1e-10",
        "small parameter",
        "both orders are found as one",
        "V_1 of second_order",
        lambda: small_alpha(1e-10),
    ),
    case(
        "direction: no sideways friction",
        "stiff, aspect",
        "sideways coefficient 1e-3 of the others, on the paper's sheet",
        SORTED,
        lambda: without_sideways(0.5),
    ),
    case(
        "direction: heading of 90 degrees",
        "stiff",
        "no mirror symmetry is left to use",
        "the ellipse with its axes exchanged",
        turned_ellipse,
    ),
    case(
        "direction: backward = 0",
        "stiff",
        "nothing holds what slips backward",
        "coefficients > 0",
        lambda: on_line(0.1, -1.0),
        expected="refused",
        limit=r"backward = 0: must be > 0",
    ),
    case(
        "map: jump on a line",
        "rough",
        "rear four times as rough",
        SORTED,
        lambda: mapped_line(ratchet(0.3), lambda y: np.where(y < -0.13, 4.0, 1.0)),
    ),
    case(
        "map: foot of a tenth of the body",
        "stiff",
        "a coefficient of 100 on it",
        SORTED,
        lambda: mapped_line(ratchet(0.5), lambda y: 1 + 99 * np.exp(-((y / 0.05) ** 2))),
    ),
    *(
        case(
            f"map: patch with an edge of {edge:g} L",
            "rough, aspect",
            "cuts a strip in two",
            SORTED,
            lambda e=edge: cutting(e),
        )
        for edge in (0.1, 1e-4)
    ),
    case(
        "map: jump at an unknown place",
        "rough",
        "given as a function, within cells",
        "patches with an edge of 1e-5 L",
        lambda: unstated_jump(((), ()), 3e-3),
        expected="flagged",
    ),
    case(
        "map: jump at a given place",
        "rough",
        "the same with its line, along which cells are cut",
        "patches with an edge of 1e-5 L",
        lambda: unstated_jump(((), (-0.13,)), 3e-3),
    ),
)
