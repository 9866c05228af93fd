"""What a scene names is honoured or refused: effects, loads, friction, slopes, by every level."""

from dataclasses import dataclass, replace
from importlib import import_module
from pkgutil import walk_packages

import numpy as np
import pytest

from fem_check import (
    Bending,
    DeadLoad,
    Friction,
    Gravity,
    Ground,
    Inertia,
    Material,
    Membrane,
    Scene,
    cycle_speed,
    predict,
    simulate,
)
from fem_check.shell import effects as package
from fem_check.shell.abilities import CYCLE, LEVELS, STEPPED, WORDS
from fem_check.shell.cycle.contact import creep
from fem_check.shell.effects.contact.self_contact import SelfContact
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import WEAK, friction_over_growth
from fem_check.shell.effects.loads import EdgeMoment
from fem_check.shell.effects.restraint import Restraint
from figures.measure.limits import friction_strength
from linear_theory import FieldWave, Sheet, SineWave, TravellingWave, ViscousRegimeWarning, rigid_path

ALPHA, WEIGHT, SLIP = 0.1, 3e-7, 5e-4
MATERIAL = Material(0.03, 0.5)
MEMBRANE, BENDING = Membrane(MATERIAL), Bending(MATERIAL)
FRICTION = Friction(1.0, SLIP)
PULSE = TravellingWave([0.5, 0.3], [0.2, 0.1])


def scene(
    *effects: object, alpha: float = ALPHA, sheet: Sheet | None = None, **options: object
) -> Scene:
    options = {"wave": SineWave(), "cells": (2, 4), **options}
    return Scene(sheet or Sheet(), alpha=alpha, effects=(MEMBRANE, *effects), **options)


def sloping(incline: float, load: str = "current", mu: float = 1.0, **options: object) -> Scene:
    return scene(Gravity(WEIGHT, load, incline), Friction(mu, SLIP), **options)


@dataclass(frozen=True)
class Wind:
    """An effect that answers all questions of a scene, and is no `Effect`."""

    needs_space = stretches = bends = moves = False
    incline, law, mu = 0.0, None, None

    def under(self, sheet: Sheet) -> "Wind":
        return self

    def pressed_by(self, components: int) -> None:
        return None

    def check_scene(self, scene: Scene) -> None:
        pass

    def beyond_theory(self, scene: Scene) -> str:
        return "Wind"


WINDY = (MEMBRANE, Gravity(WEIGHT), FRICTION, Wind())


@pytest.mark.parametrize("level", LEVELS)
def test_an_effect_that_knows_of_no_level_is_refused_by_all(level: object) -> None:
    with pytest.raises(ValueError, match=r"cannot represent Wind; no level can"):
        level.require(Scene(Sheet(), SineWave(), ALPHA, effects=WINDY))


def test_every_effect_has_words_for_what_leaves_it_out() -> None:
    """`left_out` tells of all but stretching and loads, which are a user's own.

    Nor of contact with itself: an answer says so where a sheet without it passes through itself; nor of
    the springs that slow down a snap from step to step.
    """
    names = [one.name for one in walk_packages(package.__path__, f"{package.__name__}.")]
    modules = [import_module(name) for name in names]
    named = {kind for one in modules for kind in vars(one).values() if isinstance(kind, type)}
    effects = {kind for kind in named if issubclass(kind, Effect)}
    assert effects - {Effect, Membrane, DeadLoad, EdgeMoment, SelfContact, Restraint} == set(WORDS)


GROUNDED = (BENDING, Gravity(WEIGHT), Ground(0.5))
BEYOND_A_CYCLE = {
    "dead load": ("DeadLoad", (Gravity(WEIGHT), FRICTION, DeadLoad((0.0, -1e-6)))),
    "inertia": ("Inertia", (Gravity(WEIGHT), FRICTION, Inertia(1e-4, MATERIAL))),
    "damped ground": (
        r"Ground\(damping = 1e-05\)",
        (BENDING, Gravity(WEIGHT), Ground(0.5, 1e-5), FRICTION),
    ),
    "current area": (
        r"Gravity\(load = 'current'\).*; Ground\(load = 'current'\)",
        (BENDING, Gravity(WEIGHT, "current"), Ground(0.5, load="current"), FRICTION),
    ),
    "slope in space": (
        r"Gravity\(incline = 0.1\)",
        (BENDING, Gravity(WEIGHT, incline=0.1), Ground(0.5), FRICTION),
    ),
    "strong friction": (r"Friction that deforms .* = 0\.333", (Gravity(1e-3), FRICTION)),
}  # fmt: skip


@pytest.mark.parametrize("name", BEYOND_A_CYCLE)
def test_what_a_cycle_would_drop_is_refused_with_the_level_that_can(name: str) -> None:
    message, effects = BEYOND_A_CYCLE[name]
    with pytest.raises(
        ValueError, match=rf"cycle_speed\(scene\) cannot represent {message}.*simulate\(scene\) can"
    ):
        cycle_speed(scene(*effects))
    STEPPED.require(scene(*effects))


def test_a_slope_without_friction_is_refused_by_all() -> None:
    with pytest.raises(ValueError, match=r"incline = 0.1\) without Friction.*no level can"):
        cycle_speed(scene(Gravity(WEIGHT, incline=0.1)))


def test_the_stepper_names_the_cycle_for_what_has_no_motion_in_time() -> None:
    with pytest.raises(ValueError, match=r"without Friction and Inertia.*cycle_speed\(scene\) can"):
        simulate(scene(Gravity(WEIGHT)))


def test_a_rest_curvature_needs_bending() -> None:
    with pytest.raises(
        ValueError, match=r"curvature_coupling = 0.5: must be 0 without the effect Bending"
    ):
        scene(curvature_coupling=0.5)


@pytest.mark.parametrize("load", ["current", "grown", "material"])
def test_the_load_of_a_cycle_is_that_of_its_gravity(load: str) -> None:
    """Against the same balance with the load given by argument, for a scene that names none."""
    named = cycle_speed(scene(Gravity(WEIGHT, load)), rtol=1e-2)
    given = cycle_speed(scene(), load, rtol=1e-2)
    assert (named.mean, named.error) == (given.mean, given.error)
    assert f"{load} load" in named.model


def test_a_conserved_weight_crawls_backwards_as_in_the_stepper() -> None:
    found = cycle_speed(scene(Gravity(WEIGHT, "material"), FRICTION), rtol=1e-2)
    few, many = (
        simulate(scene(Gravity(WEIGHT, "material"), FRICTION), periods=1, steps=n).speed.mean
        for n in (32, 64)
    )
    assert found.mean < 0
    # steps are of second order; friction over stiffness is 1e-4
    assert found.mean == pytest.approx((4 * many - few) / 3, rel=1e-2)


def test_the_friction_of_a_cycle_is_that_of_its_scene() -> None:
    wide = Friction(0.3, 0.05)
    named = cycle_speed(scene(Gravity(WEIGHT, "current"), wide), rtol=1e-2)
    given = cycle_speed(scene(), "current", "tanh", 0.05, rtol=1e-2)
    dry = cycle_speed(scene(), "current", rtol=1e-2)
    assert (named.mean, named.slip_ratio) == (given.mean, given.slip_ratio)
    assert abs(named.mean - dry.mean) > 3 * (named.error + dry.error)
    assert np.isnan(named.model_error)
    assert given.model_error == 0


DISAGREEING = {
    "load": (r"load = 'material': must be None or 'grown', the load of", {"load": "material"}),
    "ground": (r"load = 'ground': the scene must name the effect Ground", {"load": "ground"}),
    "law": (r"friction = Coulomb\(\): must be None or that of the scene", {"friction": "coulomb"}),
    "slip": (r"friction = Tanh\(slip_speed=0.01\): must be None", {"slip_speed": 0.01}),
}  # fmt: skip


@pytest.mark.parametrize("name", DISAGREEING)
def test_two_settings_that_disagree_are_an_error(name: str) -> None:
    message, options = DISAGREEING[name]
    with pytest.raises(ValueError, match=message):
        cycle_speed(scene(Gravity(WEIGHT), FRICTION), **options)
    grounded = scene(*GROUNDED)
    with pytest.raises(ValueError, match=r"must be None or 'ground', the load of the scene's effects"):
        cycle_speed(grounded, "current")


@pytest.mark.parametrize(
    ("incline", "wave"), [(0.1, SineWave()), (-0.1, SineWave()), (0.3, SineWave()), (0.2, PULSE)]
)
def test_on_a_slope_the_cycle_agrees_with_the_stepper(incline: float, wave: TravellingWave) -> None:
    found = cycle_speed(sloping(incline, wave=wave), rtol=1e-2)
    few, many = (simulate(sloping(incline, wave=wave), periods=1, steps=n).speed.mean for n in (48, 96))
    # 1e-3 of the speed that the slope makes, alpha L/T times its share of friction: step and stiffness
    assert found.mean == pytest.approx(
        (4 * many - few) / 3, abs=1e-3 * ALPHA * abs(incline) + found.error
    )
    assert found.mean * incline < 0 or abs(incline) < 0.15  # steep enough, it slides down


@pytest.mark.parametrize("load", ["current", "material"])
@pytest.mark.parametrize("slope", [-0.6, 0.05, 0.3])
def test_on_a_slope_a_narrow_strip_moves_by_a_shifted_quantile(slope: float, load: str) -> None:
    """Literally: sum w sgn(v + V) = -slope sum w, stretch exp(alpha c), weight its square or 1."""
    phase = 2 * np.pi * (np.arange(200_000) + 0.5) / 200_000
    stretch = np.exp(ALPHA * np.sin(phase))
    slip = -(stretch - stretch.mean())  # of the body at rest in the mean, n = T = 1
    weight = stretch**2 if load == "current" else np.ones_like(stretch)
    order = np.argsort(slip)
    below = np.cumsum(weight[order]) / weight.sum()
    quantile = slip[order][np.searchsorted(below, (1 + slope) / 2)]
    narrow = sloping(np.arctan(slope), load, sheet=Sheet(width=0.02), cells=(2, 24))
    found = cycle_speed(narrow, rtol=1e-2)
    # width: (2 pi W)^2 = 0.016 of V of second order; slip speed 5e-4: SLIP/ALPHA of the quantile
    assert found.mean == pytest.approx(-quantile, abs=0.02 * ALPHA**2 + 2 * SLIP * abs(slope))


def test_a_turning_sheet_feels_the_moment_of_its_weight_on_a_slope() -> None:
    """Its load does not lie evenly about the centre of mass; the stepper balances all three, too."""
    lopsided = FieldWave(lambda x, y, t: (1 + 2 * x) * np.sin(2 * np.pi * (y - t)), 1.0)
    effects = (Gravity(WEIGHT, incline=0.2), Friction(1.0, 0.02))
    crawling = scene(*effects, wave=lopsided)
    path = rigid_path(cycle_speed(crawling, rtol=1e-2), periods=1)
    runs = [simulate(crawling, periods=1, steps=n) for n in (32, 64)]
    moved = []
    for run in runs:
        begin = int(np.abs(run.stored_times - run.start).argmin())
        seen = run.path.seen_from(begin)
        moved.append([*seen.position[:, -1], seen.heading[-1]])
    stepped = (4 * np.array(moved[1]) - np.array(moved[0])) / 3
    # the slope turns the sheet as it goes: its axes are those of the ground at t = 0 only
    np.testing.assert_allclose([*path.step, path.turn], stepped, atol=0.02 * ALPHA)


def test_too_steep_is_refused_and_creep_is_not_rest() -> None:
    with pytest.raises(ValueError, match=r"incline = 0.6: friction cannot hold .* within \+-0.4636 "):
        cycle_speed(sloping(0.6, mu=0.5))
    with pytest.warns(ViscousRegimeWarning):  # at speeds below its slip speed
        still = cycle_speed(sloping(0.2, alpha=0.0))
    assert still.mean == pytest.approx(-SLIP * np.arctanh(np.tan(0.2)), rel=1e-12)
    assert creep(replace(sloping(0.2).contact, slope=0.0)) == 0


def test_strong_friction_is_what_the_cycle_cannot_have() -> None:
    """The measure of it, mu weight L/(E h alpha), in any units."""
    strong = scene(Gravity(2 * WEAK * ALPHA * 0.03), FRICTION)
    assert friction_over_growth(strong) == pytest.approx(2 * WEAK)
    stiff = Material(30.0, 0.5, young=2e9)
    big = Scene(
        Sheet(1000.0, 500.0, thickness=30.0), SineWave(), ALPHA, cells=(2, 4),
        effects=(Membrane(stiff), Gravity(2 * WEAK * ALPHA * 2e9 * 0.03), Friction(1.0, 0.5)),
    )  # fmt: skip
    assert friction_over_growth(big) == pytest.approx(2 * WEAK)
    assert CYCLE.objections(strong)
    assert CYCLE.objections(big)


def test_friction_that_counts_as_weak_changes_little() -> None:
    """Random sheets, waves, loads and laws: by 2e-3 alpha L/T at `WEAK`, and with its square."""
    rows = friction_strength.TABLE.read()
    assert len(rows) >= 24
    assert {row.slip for row in rows} == set(friction_strength.SLIPS)
    assert max(abs(row.strong * row.speed) for row in rows) < 2.2e-3
    assert max(abs(row.tenth * row.speed) for row in rows) < 3e-5
    # but where orders of alpha nearly cancel, as in pulses with V = -0.0039 and -0.0105 alpha L/T
    assert max(abs(row.strong) for row in rows if abs(row.speed) > 0.02) < 0.031


def test_weak_friction_is_measured_as_its_command_says() -> None:
    """A few steps on few elements, whose errors cancel between the strengths."""
    sheet, _, wave, load, slip, alpha = friction_strength.chosen()[7]
    strong, weak = (
        friction_strength.stepped(sheet, wave, load, slip * alpha, alpha, share * WEAK, steps=12)
        for share in (1.0, 1e-3)
    )
    (kept,) = (row for row in friction_strength.TABLE.read() if row.scene == 7)
    assert weak / alpha == pytest.approx(kept.speed, rel=0.1)
    assert strong / weak - 1 == pytest.approx(kept.strong, rel=0.4)


def test_a_prediction_says_what_it_leaves_out() -> None:
    found = predict(Sheet(), SineWave(), 0.25, rtol=0.2)
    assert any("bending" in words and "thickness" in words for words in found.left_out)
    assert "the ground" in found.left_out
    assert predict(Sheet(thickness=1e-3), SineWave(), 0.25, rtol=0.2).mean == found.mean
