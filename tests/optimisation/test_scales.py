"""Shares of a gain have a scale; unknowns without effect, and scenes outside of bounds, are told."""

import math

import numpy as np
import pytest

from fem_check import Scene, optimise
from fem_check.optimisation.objectives import Given, Speed
from fem_check.optimisation.result import Scale
from fem_check.sweeps import Between
from linear_theory import Sheet, SineWave, crawl_speed, line_balance
from linear_theory.common.estimate import Estimate
from linear_theory.optimisation.search import Ascent

STRIP = Scene(Sheet(width=0.1), SineWave(), alpha=0.1)
ASKED = {"level": "strip", "check": False}


def test_an_objective_that_is_0_at_its_best_is_certified():
    """A kink at 0, whose place is that of the speed 0.02."""
    found = optimise(
        STRIP, {"growth.alpha": (0.05, 0.4)}, lambda s: -abs(s.mean - 0.02), **ASKED, starts=2
    )
    assert found.converged
    assert found.agreed == 2
    alpha = found.values["growth.alpha"]
    assert line_balance(SineWave(), alpha, body="strip", growth_law="exp").mean == pytest.approx(
        0.02, abs=1e-4
    )
    assert 0.005 < found.scale.size < 0.2
    said = str(found)
    assert "the distance of the starts from the best" in " ".join(said.split())


def test_scales_of_values_that_are_0_and_that_are_not():
    far = [-1.0, -3.0, math.nan, -2.0]
    assert Scale.of(Speed(), Estimate(5.0, 0.1), far).size == 5.0
    assert Scale.of(Speed(), Estimate(0.0, 0.1), far).size == 2.0
    assert Scale.of(Given(abs), Estimate(1e-9, 0.0), far).size == pytest.approx(2.0)
    nothing = Scale.of(Speed(), Estimate(0.0, 0.0), [0.0])
    assert (nothing.share(0.0), nothing.share(1e-9)) == (0.0, math.inf)


def test_errors_of_functions_are_those_of_their_speed():
    """Against the change of the function by the true error of coarse speeds, at places with slope 0,
    too."""
    random = np.random.default_rng(0)
    fine = {alpha: crawl_speed(Sheet(), SineWave(), alpha, rtol=1e-4) for alpha in (0.1, 0.3)}
    for alpha, exact in fine.items():
        coarse = crawl_speed(Sheet(), SineWave(), alpha, rtol=0.1)
        for centre in (0.0, exact.mean, *random.uniform(-0.2, 0.2, 3)):
            for function in (
                lambda s, c=centre: -abs(s.mean - c),
                lambda s, c=centre: (s.mean - c) ** 2,
                lambda s: s.power.value,
                lambda s: np.float32(s.velocity.max()),
            ):
                found = Given(function).of(coarse, STRIP)
                true = abs(found.value - Given(function).of(exact, STRIP).value)
                assert true <= found.error + 1e-6


def test_an_unknown_without_effect_and_a_scene_outside_are_told():
    over = {"growth.alpha": (0.05, 0.08), "sheet.width": (0.05, 0.15)}
    found = optimise(STRIP, over, **ASKED, starts=2)
    assert found.without_effect == ("sheet.width",)
    assert found.outside == ("growth.alpha = 0.1, not from 0.05 to 0.08",)
    given = line_balance(SineWave(), 0.1, body="strip", growth_law="exp").mean
    assert found.start.value == pytest.approx(given)
    said = " ".join(str(found).split())
    assert "no effect of sheet.width within the errors" in said
    assert "outside the scene as given lies outside of the bounds" in said


@pytest.mark.parametrize(
    ("over", "words"),
    [
        ({"sheet.width": (-2, 1.0)}, "sheet.width: lower bound -2.0: must be > 0"),
        ({"sheet.poisson": (0.2, 0.8)}, r"sheet.poisson: upper bound 0.8: must be in \(-1, 0.5\]"),
        ({"growth.law": (0.0, 1.0)}, "growth.law: lower bound 0.0: must be 'exp'"),
        ({"wave.cosine": (0, 1)}, "wave.cosine: amplitudes change together, as harmonics of the wave"),
        ({"run.rtol": (0.1, 0.2)}, "run.rtol: says how a scene is answered, not what it is"),
        ({"growth.alpha": Between(0, 1, count=3)}, "growth.alpha: count = 3: must be left out"),
        ({"growth.alpha": (True, 1)}, "growth.alpha = True: must be a finite number"),
        ({"sheet.width": ("1 mm", "2 mm")}, r"sheet.width: \[sheet\] length = 1: needs a unit"),
        ({"friction.map.edge": (0.1, 0.2)}, r"friction.map.edge: \[friction.map\] x: must be given"),
    ],
)
def test_bounds_that_no_scene_has_are_refused_before_any_work(over, words):
    with pytest.raises(ValueError, match=f"over: {words}"):
        optimise(STRIP, over, **ASKED)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"how": 3}, "how = 3: must be an Ascent"),
        ({"file": 3}, "file = 3: must be the name of a file"),
        ({"check": "no"}, "check = 'no': must be True or False"),
    ],
)
def test_options_of_another_kind_are_refused(options, words):
    with pytest.raises(ValueError, match=words):
        optimise(STRIP, {"growth.alpha": (0.05, 0.08)}, **{**ASKED, **options})


def test_more_starts_use_the_answers_of_fewer(tmp_path):
    asked = {**ASKED, "file": tmp_path / "a.jsonl"}
    over = {"growth.alpha": (0.05, 0.4)}
    optimise(STRIP, over, starts=1, **asked)
    more = optimise(STRIP, over, starts=2, how=Ascent(iterations=50), **asked)
    assert more.answers < optimise(STRIP, over, starts=2, **ASKED).answers
    assert not list(tmp_path.glob("*.lock"))
