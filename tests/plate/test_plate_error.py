"""The bound of the distance of second order to cycles of shapes, and `predict` for bending scenes."""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache

import pytest

from fem_check import Friction, Ground, cycle_speed, predict
from figures.measure import saddle
from figures.measure.plate import model_error, saddle_range
from figures.measure.plate.model_error import Row
from linear_theory import (
    Contact,
    Coulomb,
    Directional,
    FrictionLaw,
    OnLowerFace,
    Scene,
    Sheet,
    SineWave,
    Tanh,
    crawl_speed,
    pulse_wave,
    second_order,
)
from linear_theory.speed.plate import error as rule
from linear_theory.speed.plate.error import plate_error
from linear_theory.speed.plate.terms import PlateTerms

ROWS = model_error.TABLE.read()
PAPER = saddle.PLACES["paper"]


def rows(fitted: bool) -> list[Row]:
    """Within reach of the bound: those that it was made of, or the others."""
    return [row for row in ROWS if (row.number < rule.FITTED) == fitted and model_error.within(row)]


def test_the_bound_is_from_rows_that_it_covers_with_room() -> None:
    known = rows(fitted=True)
    assert len(known) >= 20
    seen = [row for row in known if model_error.off(row) > row.error]
    assert len(seen) >= 10
    assert max(model_error.off(row) / model_error.bound_of(row) for row in seen) < 0.7


def test_the_bound_covers_scenes_that_it_was_not_made_of() -> None:
    held = rows(fitted=False)
    assert len(held) >= 20
    missed = [row for row in held if not model_error.off(row) <= model_error.bound_of(row) + row.error]
    assert len(missed) <= 0.05 * len(held), missed


@cache
def terms_of(ground: str) -> PlateTerms:
    return PlateTerms.of(saddle.scene(saddle.PLACES[ground], SineWave(), Tanh(1.0), 0.01, 0.0), 1e-2)


def test_it_covers_both_lines_of_two_layers() -> None:
    for r in saddle_range.TABLE.read():
        share = r.beta / r.lift_off
        if share > 0.95:
            continue
        form, alpha = saddle_range.form_on(r.ground, r.law), r.beta / saddle_range.BILAYER
        place, law = saddle.PLACES[r.ground], saddle.LAWS[r.law]
        asked = saddle.scene(place, SineWave(), law, alpha, r.way * r.beta)
        known = rule.groups(asked, terms_of(r.ground))
        assert known["share of lift-off"] == pytest.approx(share, rel=1e-3)
        ratio = r.beta / alpha
        bent = abs(form.alpha_beta.value) * ratio + abs(form.beta_beta.value) * ratio**2
        assert abs(r.form - r.cycle) <= rule.bound(known, form.alpha_alpha.value, bent) + r.cycle_error


def test_error_of_predict_covers_the_cycle_of_a_new_scene() -> None:
    row = model_error.drawn(1007)
    row = replace(row, alpha=min(row.alpha, row.alpha / model_error.tension_of(row)))
    asked = model_error.scene(row, 0.0)
    limit = second_order(asked, rtol=1e-2).lift_off[1]
    asked = model_error.scene(row, row.share * limit)
    found, cycle = predict(asked, level="second order"), cycle_speed(asked, rtol=1e-2)
    assert math.isfinite(found.error)
    assert abs(found.mean - cycle.mean) <= found.error + cycle.error


# ---- predict


def scene(beta: float = -0.1, alpha: float = 0.004, law: FrictionLaw | None = None) -> Scene:
    return saddle.scene(PAPER, SineWave(), law or Tanh(0.3), alpha, beta)


def test_the_plate_answers_where_it_meets_the_tolerance() -> None:
    found = predict(scene(), rtol=0.02)
    assert found.level == "second order"
    assert found.converged
    assert found.error <= 0.02 * found.mean
    assert 0 < found.model_error == plate_error(scene()) == crawl_speed(scene(), order=2).model_error
    text = str(found)
    assert "cycle of its nonlinear shapes" in " ".join(text.split())
    assert "bending" not in text[text.index("left out") :]


def test_the_cycle_answers_elsewhere() -> None:
    tight = predict(scene(), rtol=5e-3)
    assert (tight.level, tight.passed[0].level) == ("cycle", "second order")
    assert "not second order: error" in tight.reason
    both = predict(scene(), rtol=0.02), tight
    assert abs(both[0].mean - both[1].mean) <= both[0].error + both[1].error


def test_levels_by_name_and_refusals() -> None:
    assert predict(scene(), rtol=1e-3, level="second order").level == "second order"
    with pytest.raises(ValueError, match="level = 'strip': must be one of"):
        predict(scene(), level="strip")
    damped = [Ground(0.5, damping=0.1) if isinstance(e, Ground) else e for e in scene().effects]
    with pytest.raises(ValueError, match=r"damping = 0\.1.*simulate\(scene\) can"):
        predict(scene().but(effects=damped))


UNKNOWN: dict[str, Scene] = {
    "pulse": scene().but(wave=pulse_wave(0.4)),
    "two waves": scene().but(wave=SineWave(count=2)),
    "growth law": scene().but(growth_law="linear"),
    "area": scene().but(area="undeformed"),
    "direction": scene(law=Directional(0.5, 1.5, form=Tanh(0.3))),
    "lower face": scene(law=OnLowerFace(Tanh(0.3))),
    "near lift-off": scene(beta=0.51),
    "no growth": scene().but(
        alpha=0.0,
        effects=[e for e in scene().effects if not isinstance(e, Friction)],
        contact=Contact("ground", Coulomb()),
    ),
    "strong growth": scene(alpha=0.2, law=Tanh(0.3)),
    "wide": saddle.scene(
        saddle.Place(Sheet(width=2.0), 2.5e-4, 0.5, (4, 4)), SineWave(), Tanh(0.3), 0.002, 0.1
    ),
}


@pytest.mark.parametrize("name", UNKNOWN)
def test_unknown_where_it_was_not_measured(name: str) -> None:
    assert math.isnan(plate_error(UNKNOWN[name]))


def test_a_row_is_what_is_computed() -> None:
    kept: Sequence[Row] = [row for row in ROWS if row.number == 5]
    found = model_error.measured(5)
    assert found.theory == pytest.approx(kept[0].theory, rel=1e-4)
    assert found.cycle == pytest.approx(kept[0].cycle, rel=1e-4)
