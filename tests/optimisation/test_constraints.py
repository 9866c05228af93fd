"""Constraints and robust optima: against bisection of closed forms, published formulas and refusals."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from fem_check import Bound, Robust, Scene, optimise
from fem_check.optimisation import adjoint, values
from fem_check.optimisation.finding import NothingFound
from fem_check.optimisation.kept import KeptError
from fem_check.optimisation.options.quantities import QUANTITIES
from linear_theory import (
    Contact,
    Sheet,
    SineWave,
    Tanh,
    TravellingWave,
    crawl_speed,
    line_balance,
)
from linear_theory.optimisation.climbing import Ascent, Best, restored
from linear_theory.optimisation.limits import Limit
from linear_theory.optimisation.problem import Evaluation, Region, Unusable

STRIP = Scene(Sheet(width=0.1), SineWave(), alpha=0.1)
ASKED = {"level": "strip", "check": False, "starts": 1}
ALPHA = {"growth.alpha": (0.02, 0.4)}
LAWS = Robust({"friction.law": ["dry", "viscous"]})


def on_line(alpha, **contact):
    return line_balance(SineWave(), alpha, body="strip", growth_law="exp", **contact)


def viscous(alpha):
    return on_line(alpha, friction="viscous").mean


def test_a_bound_on_a_smoothed_number_holds_for_the_number_itself():
    """Dry friction is smoothed in the search: the bound is tightened by what that changes."""
    pulse = TravellingWave(cosine=[1.0, 0.2], sine=[0.0, 0.0])
    strip = Scene(Sheet(width=0.1), pulse, alpha=0.2)
    bound = {"speed": Bound(at_least=0.01)}
    found = optimise(
        strip, {"growth.alpha": (0.01, 0.3)}, "speed towards -y", constraints=bound, **ASKED
    )

    def speed(alpha):
        return line_balance(pulse, alpha, body="strip", growth_law="exp", rtol=1e-6).mean

    alpha = brentq(lambda a: speed(a) - 0.01, 0.1, 0.2)
    assert found.values["growth.alpha"] == pytest.approx(alpha, rel=1e-4)
    assert speed(found.scene.alpha) >= 0.01
    assert found.converged
    assert found.limits[0].beyond == 0
    assert "no scene" not in found.starts[0].words
    missed = replace(found, limits=(replace(found.limits[0], beyond=3e-4),))
    assert not missed.converged
    assert "NOT MET   speed >= 0.01 is missed by 0.03 %" in str(missed)


def test_the_way_back_to_a_limit_that_is_missed_by_little():
    """The square of what is beyond a limit, over itself, is steep there."""
    limit = Limit("x", lambda p: Evaluation(p[0], 0.0, np.ones(1), np.zeros(1)), 0.5, 1.0, 0.1)
    region = Region(np.zeros(1), np.ones(1), np.full(1, 0.5), np.ones(1))
    for beyond in (1e-8, 1e-6, 1e-4, 1e-2, 0.3):
        best = Best(limit.of, region, [limit])
        assert limit.excess(restored(best, region, np.array([0.5 + beyond]), Ascent()))[0] <= 0


def test_a_bound_on_the_power_holds_where_bisection_says():
    """And what moving it brings is the quotient of the slopes of speed and power."""
    found = optimise(STRIP, ALPHA, constraints={"power": Bound(at_most=0.05)}, **ASKED)
    alpha = brentq(lambda a: on_line(a).power.value - 0.05, 0.02, 0.4)
    assert found.values["growth.alpha"] == pytest.approx(alpha, rel=1e-4)
    assert found.converged
    (limit,) = found.limits
    assert 0.04999 < limit.value.value <= 0.05
    one, other = on_line(alpha * 1.001), on_line(alpha * 0.999)
    slope = (one.mean - other.mean) / (one.power.value - other.power.value)
    assert limit.brings == pytest.approx(slope, rel=1e-3)
    said = " ".join(str(found).split())
    assert "held by power <= 0.05" in said
    assert "limits power <= 0.05: 0.05 length/time (moving the bound brings " in said


def test_two_bounds_and_a_start_that_keeps_to_neither():
    """The cheapest is the one of the largest stretch, exp(alpha), from a start that is too slow; the
    speed counts as what a function returns."""
    slow, bounds = (
        STRIP.but(alpha=0.02),
        {"stretch": Bound(at_most=1.2), "fast": Bound(at_least=0.01, of=lambda s: s.mean)},
    )
    found = optimise(slow, ALPHA, "cost of transport", constraints=bounds, **ASKED)
    assert found.values["growth.alpha"] == pytest.approx(math.log(1.2), rel=1e-4)
    assert found.certificate.held == ("stretch <= 1.2",)
    assert {one.name: one.brings == 0 for one in found.limits} == {
        "stretch <= 1.2": False,
        "fast >= 0.01": True,
    }


def test_a_fixed_mean_of_friction():
    """V = a sin(theta) L/T for a strip of stretch 1 + a sin in both directions. Load of weight
    w = (1 + a sin)^2 that slips back less that which slips forward is r of all, r = (backward -
    forward)/(backward + forward), which is largest at the bound of forward. (With the weight 1 + a sin
    of a line: theta - a cos theta = (pi/2) r.)"""
    over = {"friction.forward": (0.5, 2.0), "friction.backward": (0.5, 2.0)}
    mean = Bound(exactly=1.0, of=dict.fromkeys(over, 0.5))
    scene = Scene(Sheet(width=0.1), SineWave(), alpha=0.1, growth_law="linear")
    found = optimise(scene, over, constraints={"mean friction": mean}, **ASKED)
    assert found.values == pytest.approx({"friction.forward": 0.5, "friction.backward": 1.5})
    a, r = 0.1, 0.5

    def missing(t):
        weights = 4 * t - 8 * a * math.cos(t) + a * a * (2 * t - math.sin(2 * t))
        return weights - r * math.pi * (2 + a * a)

    assert found.value.value == pytest.approx(a * math.sin(brentq(missing, 0, 2)), rel=1e-6)
    assert "mean friction = 1" in found.certificate.held


def test_the_worst_of_two_laws_is_best_where_they_are_equally_bad():
    """Of -|V - 0.02| under dry and viscous friction: V_dry + V_viscous = 0.04."""
    found = optimise(STRIP, ALPHA, lambda s: -abs(s.mean - 0.02), robust=LAWS, **ASKED)
    alpha = brentq(lambda a: on_line(a).mean + viscous(a) - 0.04, 0.02, 0.4)
    exact = 0.02 - on_line(alpha).mean
    assert found.values["growth.alpha"] == pytest.approx(alpha, rel=1e-4)
    assert found.value.value == pytest.approx(-abs(exact), rel=1e-4)
    assert found.converged
    assert found.certificate.held == ("friction.law = dry", "friction.law = viscous")
    one, other = (regime.value.value for regime in found.regimes)
    assert one == pytest.approx(other, rel=1e-3)
    assert "the value above is the worst of 2: friction.law = dry" in " ".join(str(found).split())


def test_the_mean_of_two_laws_is_weighted():
    def missed(speed):
        return -((speed.mean - 0.02) ** 2)

    robust = Robust(LAWS.regimes, "mean", weights=(3.0, 1.0))
    found = optimise(STRIP, ALPHA, missed, robust=robust, **ASKED)
    exact = minimize_scalar(
        lambda a: 0.75 * (on_line(a).mean - 0.02) ** 2 + 0.25 * (viscous(a) - 0.02) ** 2,
        bounds=(0.02, 0.4),
        method="bounded",
    )
    assert found.values["growth.alpha"] == pytest.approx(exact.x, rel=1e-3)
    assert found.value.value == pytest.approx(-exact.fun, rel=1e-4)
    scenes = [STRIP, STRIP.resting(friction="viscous")]
    bounds = {"power": Bound(at_most=0.05)}
    robust = Robust(scenes, "mean")
    kept = optimise(STRIP, ALPHA, robust=robust, constraints=bounds, **ASKED)
    alpha = brentq(lambda a: on_line(a).power.value - 0.05, 0.02, 0.4)  # dry is the costly one
    value = (on_line(alpha).mean + viscous(alpha)) / 2
    assert kept.value.value == pytest.approx(value, rel=1e-4)
    assert kept.certificate.held == ("power <= 0.05 with scene 1",)


def test_what_nothing_meets_is_told_with_the_nearest():
    least = on_line(0.02).power.value
    with pytest.raises(NothingFound, match=r"constraints: power <= 0.001: no start meets it") as told:
        optimise(STRIP, ALPHA, constraints={"power": Bound(at_most=0.001)}, **ASKED)
    assert float(str(told.value).rpartition(" ")[2]) == pytest.approx(least, rel=1e-3)
    with pytest.raises(NothingFound, match="the sheet lies flat on the ground"):
        optimise(STRIP, ALPHA, constraints={"height": Bound(at_most=1)}, **ASKED)


@pytest.mark.parametrize(
    ("made", "words"),
    [
        (lambda: Bound(), "at_most, at_least, exactly: one of them must be given"),
        (lambda: Bound(exactly=1), "exactly: must be alone, and of a sum of fields"),
        (lambda: Bound(at_most=math.nan), "at_most = nan: must be a finite number"),
        (lambda: Bound(at_most=1, of=3), "of = 3: must be a function of the speed, or map"),
        (lambda: Bound(at_most=1, of={}), r"of = \{\}: must map unknowns to weights"),
        (lambda: Robust([STRIP]), "regimes: 1 scenes: must be two or more"),
        (lambda: Robust(3), "regimes = 3: must map fields to lists of values, or be scenes"),
        (lambda: Robust({}, "best"), "by = 'best': must be one of 'worst', 'mean'"),
        (lambda: Robust({}, weights=(1,)), "weights: must be left out for by = 'worst'"),
        (lambda: Robust({}, "mean", weights=(0,)), "weights = 0: must be > 0"),
    ],
)
def test_options_refuse_by_name(made, words):
    with pytest.raises(ValueError, match=words):
        made()


SUM = {"growth.alpha": 1.0}


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"constraints": {"powr": Bound(at_most=1)}}, "constraints: 'powr': must be one of 'speed'"),
        ({"constraints": {"power": 1}}, "constraints: power = 1: must be a Bound"),
        ({"constraints": 3}, "constraints = 3: must map names to a Bound"),
        ({"constraints": {"power": Bound(at_most="1 mm")}}, "power: at_most = '1 mm': must be a plain"),
        ({"constraints": {"speed": Bound(2, 3)}}, "speed: at_least = 3: must be < at_most = 2"),
        ({"constraints": {"a": Bound(1, of={"b": 1})}}, "a: of 'b': must be among what may change"),
        ({"constraints": {"a": Bound(0.01, of=SUM)}}, "constraints: a <= 0.01: no point meets it"),
        ({"constraints": {"a": Bound(exactly=0.5, of=SUM)}}, "a = 0.5: no point meets it"),
        ({"robust": 3}, "robust = 3: must be a Robust"),
        ({"robust": Robust({"growth.alpha": [1, 2]})}, "regimes: growth.alpha: must not be among"),
        ({"robust": Robust({"friction.lw": ["dry"]})}, "regimes: 'friction.lw': is not a field"),
        ({"robust": Robust({"friction.law": ["dry"]})}, "regimes: 1: must be from 2 to 32"),
        ({"robust": Robust({"sheet.poisson": [0.2, 0.7]})}, "regimes: .*poisson = 0.7: must be in"),
        ({"robust": Robust(LAWS.regimes, "mean", (1, 2, 3))}, "weights: 3: must be 2"),
    ],
)
def test_searches_refuse_by_name_before_any_work(options, words):
    with pytest.raises(ValueError, match=words):
        optimise(STRIP, ALPHA, **options, **ASKED)


def test_the_stretch_of_a_sine_is_that_of_its_crest():
    speed = crawl_speed(Sheet(), SineWave(), 0.2)
    value, error = QUANTITIES["stretch"].of(speed, Scene(Sheet(), SineWave(), alpha=0.2))
    assert abs(value - math.exp(0.2)) <= error + 1e-3
    assert QUANTITIES["turning rate"].of(speed, STRIP) == (0.0, 0.0)
    with pytest.raises(Unusable, match="height: the sheet lies flat"):
        QUANTITIES["height"].of(speed, STRIP)


def test_a_search_with_constraints_and_regimes_goes_on_from_its_file(tmp_path):
    """Other constraints are another question."""
    bounds = {"power": Bound(at_most=0.05)}
    asked = {**ASKED, "robust": LAWS, "file": tmp_path / "a.jsonl"}
    first = optimise(STRIP, ALPHA, constraints=bounds, **asked)
    again = optimise(STRIP, ALPHA, constraints=bounds, **asked)
    assert first.answers > 0
    assert again.answers == 0
    assert again.value == first.value
    assert again.limits == first.limits
    with pytest.raises(KeptError, match="holds answers to another question"):
        optimise(STRIP, ALPHA, constraints={"power": Bound(at_most=0.06)}, **asked)
    assert [path.name for path in tmp_path.iterdir()] == ["a.jsonl"]


def test_limits_by_an_adjoint_agree_with_a_search_along_the_power(monkeypatch):
    """A sheet under tanh friction: at the bound of its power, found by bisection of other answers.

    Objective and limit are of one solve at a point, whole answers of the start and of the end alone.
    """
    solves = {"adjoint": 0, "answer": 0}

    def counted(name, function):
        def call(*given, **named):
            solves[name] += 1
            return function(*given, **named)

        return call

    way = adjoint.WAYS["first order"]
    counting = way._replace(motion=counted("adjoint", way.motion))
    monkeypatch.setattr(adjoint, "WAYS", {"first order": counting})
    monkeypatch.setattr(values, "solve", counted("answer", values.solve))
    contact = Contact("current", Tanh(0.05))
    scene = Scene(Sheet(), SineWave(), alpha=0.1, contact=contact)
    asked = {**ASKED, "level": "first order", "rtol": 1e-2}
    found = optimise(scene, ALPHA, constraints={"power": Bound(at_most=0.05)}, **asked)
    (limit,) = found.limits
    assert solves["adjoint"] <= found.answers / 2 + 2
    assert solves["adjoint"] <= 20
    assert solves["answer"] <= 4

    def power(alpha):
        law = {"friction": "tanh", "slip_speed": 0.05}
        return crawl_speed(Sheet(), SineWave(), alpha, rtol=1e-3, **law).power.value - 0.05

    alpha = brentq(power, 0.05, 0.3, rtol=1e-4)
    assert found.values["growth.alpha"] == pytest.approx(alpha, rel=5e-3)
    assert limit.value.value <= 0.05
    assert limit.brings > 0
