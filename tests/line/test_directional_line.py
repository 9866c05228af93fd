"""Friction with a direction: its law, and bodies on a line against formulas of others."""

import itertools
import math
import warnings

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import quad
from scipy.optimize import brentq

from linear_theory import (
    Coulomb,
    Directional,
    FieldWave,
    SineWave,
    Tanh,
    TravellingWave,
    Viscous,
    line_balance,
)
from linear_theory.friction.isotropic import Isotropic
from linear_theory.friction.law import FrictionLaw, Opposite
from linear_theory.friction.trial import check_law

Array = NDArray[np.float64]

FORMS: tuple[Isotropic, ...] = (Coulomb(), Tanh(0.3), Viscous(2.0))


def ratchet(r: float, form: FrictionLaw | None = None) -> Directional:
    """(mu_b - mu_f)/(mu_b + mu_f) = r."""
    return Directional(1 - r, 1 + r, form=Coulomb() if form is None else form)


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("heading", [0.0, 0.7, -2.0])
@pytest.mark.parametrize("sizes", [(0.4, 1.7, 0.8), (1.0, 1.0, 0.3), (3.0, 0.2, None)])
def test_methods_agree(form: Isotropic, heading: float, sizes: tuple[float, ...]) -> None:
    """Gradient, tangent, convexity, differences, scaling: the trial of laws; also reversed."""
    law = Directional(*sizes, heading=heading, form=form)
    for components in (1, 2, 3) if heading == 0 else (2, 3):
        check_law(law, components)
        check_law(law.opposite, components)
        check_law(Opposite(law), components)


def test_gauge_is_that_of_two_half_ellipses() -> None:
    """phi(v) = max of F . v over the forces in the set, by brute force; a convex function."""
    law, angle = Directional(0.4, 1.7, 0.8, heading=0.3), np.linspace(-np.pi, np.pi, 200_001)
    force = np.stack([0.8 * np.cos(angle), np.where(angle > 0, 0.4, 1.7) * np.sin(angle)])
    turn = np.array([[math.cos(0.3), -math.sin(0.3)], [math.sin(0.3), math.cos(0.3)]])
    random = np.random.default_rng(0)
    v, w = random.normal(size=(2, 2, 50))
    best = np.array([((turn @ force) * one[:, None]).sum(0).max() for one in v.T])
    np.testing.assert_allclose(law.gauge(v), best, rtol=1e-9)
    np.testing.assert_allclose(law.potential(v), best, rtol=1e-9)
    share = random.uniform(size=50)
    between = law.potential(share * v + (1 - share) * w)
    assert np.all(
        between <= share * law.potential(v) + (1 - share) * law.potential(w) + 1e-14
    )  # convex
    np.testing.assert_allclose(law.opposite.potential(v), law.potential(-v), rtol=1e-15)


@pytest.mark.parametrize("step", [1.0, 1e-4, 1e-9, 1e-13])
@pytest.mark.parametrize("form", FORMS)
def test_differences_across_the_crease_do_not_cancel(step: float, form: Isotropic) -> None:
    """Against the same in extended precision, where v_n changes sign on the way."""
    random, law = np.random.default_rng(1), Directional(0.4, 1.7, 0.8, form=form)
    change = random.normal(size=(2, 400))
    v = np.stack([random.normal(size=400), -step * change[1] * random.uniform(size=400)])

    def slow(v: NDArray[np.longdouble]) -> NDArray[np.longdouble]:
        m = np.stack(np.broadcast_arrays(law.factors[0], np.where(v[1] < 0, *law.factors[:0:-1])))
        w = m * v
        r = np.sqrt((w**2).sum(0))
        size = {"coulomb": r * 0 + 1, "tanh": np.tanh(r / 0.3), "viscous": r / 2}[form.name]
        return m * size * w / r

    wide, moved = v.astype(np.longdouble), change.astype(np.longdouble)
    wanted = (slow(wide + step * moved) - slow(wide)) / step
    found = law.force_difference(v, change, step)
    scale = np.abs(wanted).max(0) + np.hypot(*change) / np.hypot(*v)
    allowed = 1e-12 + 40 * np.finfo(np.longdouble).eps / step
    assert (abs(found - wanted) / scale).max() < allowed


SINE = {(0.1, 0.5): 0.0752137, (0.3, 0.5): 0.2454053}
"""n T V of a sine with stretch 1 + alpha c for (alpha, r), of external derivation."""


@pytest.mark.parametrize(("alpha", "r"), SINE)
def test_sine_wave(alpha: float, r: float) -> None:
    """theta - alpha cos theta = (pi/2) r, V = (alpha/nT) sin theta, and its series."""
    theta = brentq(lambda a: a - alpha * math.cos(a) - math.pi / 2 * r, -2, 2, xtol=1e-15)
    wave = SineWave(count=2, period=0.5)
    found = line_balance(wave, alpha, friction=ratchet(r))
    assert found.mean == pytest.approx(SINE[alpha, r], abs=6e-8)
    assert abs(found.mean - alpha * math.sin(theta)) <= found.error + 1e-15
    assert found.error < 1e-13
    assert found.first_order == pytest.approx(math.sin(math.pi * r / 2), rel=1e-13)
    assert found.second_order == pytest.approx(math.cos(math.pi * r / 2) ** 2, rel=1e-13)


@pytest.mark.parametrize("count", [1, -2])
@pytest.mark.parametrize("alpha", [0.2, -0.2])
@pytest.mark.parametrize("form", [*FORMS, Tanh(1e-3), Tanh(30.0)])
def test_any_profile_against_a_literal_balance(count: int, alpha: float, form: Isotropic) -> None:
    """Sum of w f(V + v) over 40 000 points; both ways of the library."""
    wave = TravellingWave([1.0, 0.4], [0.2, -0.5], count=count, period=0.7)
    law, phase = Directional(0.4, 1.1, form=form), 2 * np.pi * (np.arange(40_000) + 0.5) / 40_000
    c = np.asarray(wave.value(0.0, phase / (2 * np.pi * count), 0.0))
    v = -alpha * (c - wave.mean) / (count * 0.7)

    def force(speed: float) -> float:
        slip = (speed + v)[None]
        return float(((1 + alpha * c) * law.force(slip)[0]).sum())

    exact = brentq(force, -1.0, 1.0, xtol=1e-14)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # wide tanh laws act as viscous
        found = line_balance(wave, alpha, friction=law)
    # the sum sees a step of the points, unless its terms are smooth at rest
    assert abs(found.mean - exact) < (2e-4 if form.width < 0.01 else 2e-6) * abs(alpha)
    assert found.error < 1e-12


@pytest.mark.parametrize("form", [Coulomb(), Tanh(0.02), Viscous()])
def test_the_two_ways_agree_within_their_errors(form: Isotropic) -> None:
    wave = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y - t)) + 0 * x, period=1.0)
    for alpha, r in itertools.product((0.1, -0.3), (0.5, -0.9)):
        exact = line_balance(SineWave(), alpha, friction=ratchet(r, form))
        found = line_balance(wave, alpha, friction=ratchet(r, form), length=1.0, rtol=1e-3)
        assert abs(found.mean - exact.mean) <= found.error
        assert found.converged
        if form == Coulomb():
            assert found.first_order == pytest.approx(exact.first_order, rel=1e-3)
            assert found.second_order == pytest.approx(exact.second_order, rel=0.2)


@pytest.mark.parametrize(("form", "power"), [(Coulomb(), 1.0), (Viscous(), 0.5)])
@pytest.mark.parametrize("r", [0.3, -0.8])
def test_breathing(form: Isotropic, power: float, r: float) -> None:
    """Net displacement r Delta (dry), (sqrt mu_b - sqrt mu_f)/(sqrt mu_b + sqrt mu_f) Delta (viscous).

    Delta is the range of the length, at any strain.
    """
    breath = FieldWave(lambda x, y, t: np.sin(2 * np.pi * t) + 0 * x * y, period=1.0)
    alpha = 0.4
    found = line_balance(breath, alpha, friction=ratchet(r, form), length=1.0, rtol=1e-4)
    forward, backward = (1 - r) ** power, (1 + r) ** power
    wanted = (backward - forward) / (backward + forward) * 2 * alpha
    assert abs(found.mean - wanted) <= found.error
    assert abs(found.mean - wanted) < 3e-4 * abs(wanted)


def test_reciprocal_motion_goes_nowhere_dry_and_somewhere_by_tanh() -> None:
    """One degree of freedom, however uneven in time; tanh is not independent of the rate."""

    def uneven(x: Array, y: Array, t: float) -> Array:
        return np.sin(2 * np.pi * t + 0.8 * np.sin(2 * np.pi * t)) * np.where(y > 0, 1.0, -0.4) + 0 * x

    wave = FieldWave(uneven, period=1.0)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        still = line_balance(wave, 0.2, length=1.0, load="material", rtol=1e-2, atol=1e-5)
        moves = line_balance(wave, 0.2, length=1.0, friction=ratchet(0.0, Tanh(0.2)), rtol=1e-2)
    assert abs(still.mean) <= still.error + 1e-9
    assert moves.mean > max(2e-3, 10 * moves.error)  # 4e-3 in a trial elsewhere of another motion


def test_viscous_speed_is_the_variance_of_the_stretch() -> None:
    """V = Var(lambda)/(<lambda> nT), which friction with a direction has for equal coefficients."""
    alpha = 0.3
    mean = quad(lambda a: math.exp(alpha * math.sin(a)) / (2 * math.pi), 0, 2 * math.pi)[0]
    square = quad(lambda a: math.exp(2 * alpha * math.sin(a)) / (2 * math.pi), 0, 2 * math.pi)[0]
    for law in (
        Viscous(),
        Directional(1, 1, form=Viscous()),
        Directional(2, 2 + 1e-12, form=Viscous()),
    ):
        found = line_balance(SineWave(), alpha, friction=law, growth_law="exp")
        assert found.mean == pytest.approx(square / mean - mean, rel=1e-9)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"forward": -1.0, "backward": 1.0}, "forward = -1: must be > 0"),
        ({"forward": 1.0, "backward": 0.0}, "backward = 0: must be > 0"),
        ({"forward": 1.0, "backward": 1.0, "sideways": 1e60}, r"sideways = 1e\+60: must be from 1e-50"),
        ({"forward": 1.0, "backward": 1.0, "heading": 4.0}, "heading = 4: must be from -pi to pi"),
        (
            {"forward": 1.0, "backward": 1.0, "fixed_to": "sky"},
            "fixed_to = 'sky': must be one of 'body'",
        ),
        ({"forward": 1.0, "backward": 1.0, "form": "tanh"}, "form = 'tanh': must be an Isotropic"),
    ],
)
def test_bad_input(arguments: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        Directional(**arguments)  # type: ignore[arg-type]


def test_a_heading_has_no_meaning_on_a_line() -> None:
    with pytest.raises(ValueError, match=r"heading = 0\.3: must be 0 on a line"):
        line_balance(SineWave(), 0.1, friction=Directional(1, 2, heading=0.3))


@pytest.mark.parametrize("r", [-0.5, 0.3, 0.8])
def test_power_of_a_standing_wave_is_that_of_a_fine_grid(r: float) -> None:
    """The weight that slips forward meets forward friction; load by area, literally."""
    alpha, law, places, times = 0.3, ratchet(r), 2000, 400
    y = (np.arange(places) + 0.5) / places - 0.5
    powers = []
    for t in (np.arange(times) + 0.5) / times:
        # c = cos(2 pi y + 1) sin(2 pi t), and the velocity of what it stretches
        c = np.cos(2 * np.pi * y + 1) * np.sin(2 * np.pi * t)
        own = alpha * np.sin(2 * np.pi * y + 1) * np.cos(2 * np.pi * t)
        weight, order = 1 + alpha * c, np.argsort(own)
        below = np.cumsum(weight[order]) / weight.sum()
        # slip own + V: what is below slips backward, and bears (1 + r) of its weight
        slip = own - own[order][np.searchsorted(below, (1 - r) / 2)]
        powers.append(np.mean(weight * np.where(slip > 0, (1 - r) * slip, -(1 + r) * slip)))
    wave = FieldWave(
        lambda x, y, t: np.cos(2 * np.pi * y + 1) * np.sin(2 * np.pi * t) + 0 * x, period=1.0
    )
    found = line_balance(wave, alpha, friction=law, rtol=1e-4, length=1.0)
    # The grid: a cell of the quantile moves the power at second order, the times likewise
    assert found.power.value == pytest.approx(np.mean(powers), rel=3e-4)
