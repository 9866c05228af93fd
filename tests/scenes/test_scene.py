"""Scenes: the same content is the same scene, in every process and from plain data."""

import json
import math
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import skfem

from fem_check import (
    Bending,
    Friction,
    Gravity,
    Ground,
    Inertia,
    Material,
    Membrane,
    Outline,
    cycle_speed,
    predict,
    simulate,
)
from linear_theory import (
    Contact,
    Coulomb,
    Exp,
    FieldWave,
    Growth,
    Linear,
    Load,
    Scene,
    Sheet,
    SineWave,
    Tanh,
    Tolerance,
    TravellingWave,
    Viscous,
    crawl_speed,
    line_balance,
    pulse_wave,
    second_order,
)
from linear_theory.common.errors import Unidentifiable, ViscousRegimeWarning

MATERIAL = Material(0.03, 0.5)
PLANE = (Membrane(MATERIAL), Gravity(3e-6), Friction(1.0, 5e-3))
SPACE = (Membrane(MATERIAL), Bending(MATERIAL), Gravity(2.5e-4), Ground(0.5), Friction(0.3, 1e-2))
TRIANGLES = Outline([(-0.25, -0.5), (0.25, -0.5), (0.1, 0.5), (-0.1, 0.5)]).mesh(0.3)

SCENES = {
    "plain": Scene(Sheet(), SineWave(), 0.25),
    "pulse, laws": Scene(
        Sheet(width=0.3, poisson=-0.2),
        pulse_wave(0.2, count=-2),
        -0.1,
        growth_law=Linear(),
        area="undeformed",
        contact=Contact(Load.MATERIAL, Tanh(0.02)),
    ),
    "plane": Scene(Sheet(), SineWave(period=2.0), 0.1, effects=PLANE, cells=(1, 2)),
    "incline": Scene(
        Sheet(), SineWave(), 0.1, effects=(PLANE[0], Gravity(3e-6, "current", 0.1), PLANE[2])
    ),
    "space": Scene(
        Sheet(), SineWave(), 0.1, 2.0, SPACE, curvature="undeformed", element=skfem.ElementQuadBFS()
    ),
    "inertia": Scene(Sheet(), SineWave(), 0.1, effects=(*PLANE, Inertia(1e-3, MATERIAL))),
    "mesh": Scene(Sheet(), SineWave(), 0.1, effects=PLANE, mesh=TRIANGLES),
    "degree": Scene(Sheet(), SineWave(), 0.1, effects=PLANE, element=skfem.ElementQuadP(3)),
}


@pytest.mark.parametrize("name", SCENES)
def test_a_scene_comes_back_from_its_data(name: str) -> None:
    scene = SCENES[name]
    again = Scene.from_dict(json.loads(json.dumps(scene.to_dict())))
    assert again == scene
    assert again.key() == scene.key()
    assert hash(again) == hash(scene)
    assert repr(again) == repr(scene)
    assert again.contact == scene.contact


def test_different_scenes_have_different_keys() -> None:
    keys = {scene.key() for scene in SCENES.values()}
    assert len(keys) == len(SCENES)
    assert all(len(key) == 64 for key in keys)


CHANGES = {
    "alpha": {"alpha": 0.11},
    "coupling": {"curvature_coupling": 2.5},
    "law": {"growth_law": "metric"},
    "curvature": {"curvature": "grown"},
    "area": {"area": "undeformed"},
    "sheet": {"sheet": Sheet(length=1.01)},
    "wave": {"wave": SineWave(count=2)},
    "wave's last digit": {"wave": TravellingWave([0.0], [1 + 2.3e-16])},
    "cells": {"cells": (3, 6)},
    "element": {"element": skfem.ElementQuadBFS(), "cells": (7, 8)},
    "effects": {"effects": (*SPACE[:-1], Friction(0.3, 1.01e-2))},
}


@pytest.mark.parametrize("name", CHANGES)
def test_any_change_changes_the_key(name: str) -> None:
    scene = SCENES["space"]
    other = scene.but(**CHANGES[name])
    assert other != scene
    assert other.key() != scene.key()
    back = {part: getattr(scene, part) for part in ("sheet", "wave", "growth", "effects")}
    assert other.but(**back, cells=None, element=skfem.ElementQuadBFS()) == scene


def test_the_key_is_the_same_in_another_process() -> None:
    code = (
        "import sys; sys.path.insert(0, sys.argv[1])\n"
        "from tests.scenes.test_scene import SCENES\n"
        "print(*(scene.key() for scene in SCENES.values()))"
    )
    root = str(Path(__file__).parents[2])
    done = subprocess.run(
        [sys.executable, "-c", code, root], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == [scene.key() for scene in SCENES.values()]


def test_names_and_objects_say_the_same() -> None:
    named = Scene(Sheet(), SineWave(), 0.1, growth_law="linear", area="undeformed")
    whole = Scene(Sheet(), SineWave(), growth=Growth(0.1, Linear(), energy_area="undeformed"))
    assert named == whole
    assert Growth(0.1, "exp") == Growth(0.1, Exp())
    assert Contact("grown", "viscous") == Contact(Load.GROWN, Viscous())
    assert Contact.named() == Contact(Load.CURRENT, Coulomb())


def test_functions_are_known_by_content_or_name() -> None:
    def wave(scale: float, name: str | None = None) -> FieldWave:
        return FieldWave(lambda x, y, t: scale * np.sin(2 * np.pi * (y - t)) + 0 * x, 1.0, name=name)

    same = [Scene(Sheet(), wave(1.0), 0.1) for _ in range(2)]
    assert same[0] == same[1]
    assert same[0] != Scene(Sheet(), wave(1.1), 0.1)
    assert Scene(Sheet(), wave(1.0, "a"), 0.1) != Scene(Sheet(), wave(1.0, "b"), 0.1)
    nameless = FieldWave(np.random.default_rng().normal, 1.0)
    with pytest.raises(Unidentifiable, match=r"wave"):
        Scene(Sheet(), nameless, 0.1).key()
    with pytest.raises(ValueError, match=r"wave: a FieldWave .*Scene.from_dict\(data, wave=wave\)"):
        Scene.from_dict(same[0].to_dict())
    assert Scene.from_dict(same[0].to_dict(), wave=wave(1.0)) == same[0]


def test_uneven_ground_is_given_again() -> None:
    hill = Ground(0.5, height=lambda x, y: 0.01 * np.cos(3 * y) + 0 * x)
    effects = (*SPACE[:3], hill, SPACE[-1])
    scene = Scene(Sheet(), SineWave(), 0.1, effects=effects)
    with pytest.raises(ValueError, match=r"effects\[4\].*a Terrain cannot be restored"):
        Scene.from_dict(scene.to_dict())
    assert Scene.from_dict(scene.to_dict(), effects=effects) == scene


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ({}, "data = {}: must be what Scene.to_dict"),
        ({"type": "Scene"}, "a Scene must have sheet, wave, growth, contact, effects, cells"),
        (
            SCENES["plain"].to_dict() | {"sheet": {"type": "Sheet", "size": 1}},
            "sheet.size: a Sheet has no such key",
        ),
        (SCENES["plain"].to_dict() | {"sheet": {"type": "os"}}, "a os cannot be restored"),
        (SCENES["plain"].to_dict() | {"element": "os.system(1)"}, "must be a scikit-fem element"),
        (SCENES["plain"].to_dict() | {"cells": [0, 1]}, "cells = 0: must be >= 1"),
    ],
)
def test_what_is_no_scene_is_refused(data: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match=words.replace("{}", r"\{\}")):
        Scene.from_dict(data)


def test_a_scene_is_short_to_look_at() -> None:
    for scene in SCENES.values():
        assert len(repr(scene).splitlines()) <= 12
        assert max(map(len, repr(scene).splitlines())) <= 100


def test_what_a_scene_says_of_its_contact() -> None:
    assert SCENES["plain"].contact == Contact()
    assert SCENES["plane"].contact == Contact(Load.GROWN, Tanh(5e-3))
    assert SCENES["space"].contact == Contact(Load.GROUND, Tanh(1e-2))
    slope = SCENES["incline"].contact.slope
    assert slope == pytest.approx(math.tan(0.1) / 1.0, rel=1e-15)


def test_every_level_reads_the_same_scene() -> None:
    """Against the calls with plain arguments, which build it."""
    scene = Scene(
        Sheet(width=0.4), SineWave(), 0.1, growth_law="linear", contact=Contact("grown", Tanh(0.05))
    )
    options = {"load": "grown", "friction": "tanh", "slip_speed": 0.05}
    grown = {**options, "growth_law": "linear"}
    plain = Sheet(width=0.4), SineWave(), 0.1
    for order in (1, 2):
        one, other = (
            crawl_speed(scene, rtol=1e-2, order=order),
            crawl_speed(*plain, rtol=1e-2, order=order, **grown),
        )
        assert (one.mean, one.error, one.model) == (other.mean, other.error, other.model)
    assert predict(scene, rtol=0.3).mean == predict(*plain, rtol=0.3, **grown).mean
    bare = scene.but(contact=None)
    one, other = cycle_speed(scene, rtol=1e-2), cycle_speed(bare, **options, rtol=1e-2)
    assert (one.mean, one.error) == (other.mean, other.error)
    per_alpha = {**grown, "slip_speed": 0.05 / 0.1}  # length per time and unit alpha
    both = second_order(scene, rtol=1e-2), second_order(*plain[:2], rtol=1e-2, **per_alpha)
    assert both[0].second == both[1].second
    assert line_balance(SineWave(), 0.1).mean != 0


def test_theory_refuses_what_it_cannot_represent() -> None:
    for name, words in {
        "space": "Bending; Gravity; Ground",
        "inertia": "Inertia",
        "incline": "a slope of 0.100",
        "mesh": "a mesh of its own outline",
    }.items():
        calls = (crawl_speed, second_order, predict)
        for call in calls if name != "space" else (crawl_speed,):
            with pytest.raises(ValueError, match=rf"cannot represent.*{words}"):
                call(SCENES[name])
    with pytest.raises(ValueError, match=r"wave = SineWave\(.*must be None if a scene is given"):
        crawl_speed(SCENES["plain"], SineWave())
    with pytest.raises(ValueError, match="alpha = None: must be given"):
        crawl_speed(Sheet(), SineWave())
    # on its ground the second order is that of a plate, and `predict` has a cycle; not with inertia
    with pytest.raises(ValueError, match=r"cannot represent.*Inertia"):
        predict(SCENES["space"].but(effects=[*SCENES["space"].effects, Inertia(1e-5, MATERIAL)]))
    assert second_order(SCENES["space"]).coefficients.lift_off[1] > 0
    with pytest.raises(ValueError, match=r"cannot represent.*Inertia"):
        second_order(SCENES["space"].but(effects=[*SCENES["space"].effects, Inertia(1e-5, MATERIAL)]))


def test_a_scene_without_effects_stretches() -> None:
    scene = Scene(Sheet(), SineWave(), 0.25, cells=(2, 4))
    named = scene.but(effects=[Membrane(MATERIAL)])
    one, other = (cycle_speed(s, rtol=1e-2) for s in (scene, named))
    assert (one.mean, one.error) == (other.mean, other.error)
    with pytest.raises(ValueError, match="without Friction and Inertia"):
        simulate(scene)


SAID = Scene(
    Sheet(), SineWave(), 0.1, growth_law="linear", contact=Contact("grown", Tanh(0.05)), cells=(2, 4)
)
CALLS = (crawl_speed, predict, second_order, cycle_speed)


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize(
    ("name", "value", "own"),
    [("load", "current", "'grown'"), ("friction", "viscous", r"Tanh\(slip_speed=0.05\)")],
)
def test_arguments_beside_a_scene_must_agree_with_it(call, name, value, own) -> None:
    with pytest.raises(ValueError, match=rf"{name} = .*must be None or that of the scene, {own}"):
        call(SAID, **{name: value})
    agreeing = {"load": "grown", "friction": Tanh(0.05)}[name]
    one, other = call(SAID, rtol=0.1, **{name: agreeing}), call(SAID, rtol=0.1)
    if call is not second_order:  # there a slip speed given in the call is per unit alpha
        assert (one.mean, one.error) == (other.mean, other.error)


@pytest.mark.parametrize("call", CALLS[:3])
def test_growth_beside_a_scene_must_agree_with_it(call) -> None:
    with pytest.raises(ValueError, match=r"growth_law = Exp\(\): must be None .* Linear\(\)"):
        call(SAID, growth_law="exp")
    with pytest.raises(ValueError, match=r"area = 'undeformed': must be None .* 'grown'"):
        call(SAID, area="undeformed")


def test_growth_is_given_once() -> None:
    growth = Growth(0.2, "linear")
    with pytest.raises(ValueError, match=r"alpha = 0.1: must be None if growth is given"):
        Scene(Sheet(), SineWave(), 0.1, growth=growth)
    with pytest.raises(ValueError, match=r"growth_law = 'exp': must be None if growth is given"):
        SAID.but(growth=growth, growth_law="exp")
    with pytest.raises(ValueError, match=r"alpha = None: must be given"):
        SAID.but(alpha=None)
    assert SAID.but(growth=growth).growth == growth


@pytest.mark.parametrize("effects", [PLANE, SPACE])
def test_a_slope_that_the_effects_do_not_have_is_refused(effects) -> None:
    own = Scene(Sheet(), SineWave(), 0.1, effects=effects).contact
    with pytest.raises(ValueError, match=r"slope = 0.7: must be 0 or 0"):
        Scene(Sheet(), SineWave(), 0.1, effects=effects, contact=Contact(own.load, own.friction, 0.7))


def test_the_stepper_refuses_a_contact_that_it_does_not_use() -> None:
    effects = [Membrane(MATERIAL), Inertia(1e-3, MATERIAL)]
    scene = Scene(Sheet(), SineWave(), 0.1, effects=effects, contact=Contact("grown", Viscous()))
    with pytest.raises(ValueError, match=r"simulate\(scene\) cannot represent a contact"):
        simulate(scene, periods=1)


def test_no_meaning_is_in_the_order_of_effects_and_the_sign_of_zero() -> None:
    one, other = (Scene(Sheet(), SineWave(), 0.1, effects=e) for e in (SPACE, SPACE[::-1]))
    assert one == other
    assert one.effects == other.effects
    level = Scene(Sheet(), SineWave(), 0.0)
    assert level == Scene(Sheet(), SineWave(), -0.0, contact=Contact(slope=-0.0))


def test_a_slip_speed_needs_an_alpha_to_count_against() -> None:
    with pytest.raises(ValueError, match=r"alpha = 0: must not be 0 for friction tanh\(v/0.05\)"):
        second_order(SAID.but(alpha=0.0))


def test_refusals_name_the_level_that_can() -> None:
    slope = Scene(Sheet(), SineWave(), 0.1, contact=Contact(slope=0.1))
    for call in (crawl_speed, second_order, predict):
        with pytest.raises(ValueError, match=r"a slope of 0.1 .*; cycle_speed\(scene\) can"):
            call(slope)


@pytest.mark.parametrize("tangent", [0.75, 1.2])
def test_viscous_friction_holds_on_any_slope(tangent) -> None:
    """Without growth the sheet creeps at tan(incline)/mu times the speed scale of the law."""
    effects = [
        Membrane(MATERIAL),
        Gravity(1e-7, "current", incline=math.atan(tangent)),
        Friction(0.5, law=Viscous(0.2)),
    ]
    scene = Scene(Sheet(), SineWave(), 0.05, effects=effects, cells=(2, 4))
    still = cycle_speed(scene.but(alpha=0.0))
    assert still.mean == pytest.approx(-tangent / 0.5 * 0.2, rel=1e-12)
    growing, stepped = cycle_speed(scene, rtol=1e-3), simulate(scene, periods=1, rtol=1e-2).speed
    assert abs(growing.mean - stepped.mean) <= growing.error + stepped.error
    with pytest.raises(ValueError, match=r"slope = 1.5: friction cannot hold the sheet"):
        cycle_speed(Scene(Sheet(), SineWave(), 0.1, contact=Contact(slope=1.5)))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Viscous(5e-324), r"speed = 4.94066e-324: must be from 1e-100"),
        (lambda: Growth(0.1, law="a"), r"law = 'a': must be one of 'exp', 'linear', 'metric'"),
        (lambda: Growth(0.1, energy_area="a"), r"energy_area = 'a': must be one of 'grown'"),
        (lambda: Contact("a"), r"load = 'a': must be one of 'current', 'grown'"),
        (lambda: Gravity(1.0, "grown", area="grown"), r"area = 'grown': must be None if load is given"),
        (lambda: predict(Sheet(), SineWave(), 800.0), r"alpha = 800: alpha c = .* stretches by more"),
        (lambda: Tolerance(1e-3).of_speed(0.1, -1.0), r"unit = -1: must be"),
    ],
)
def test_values_out_of_range_are_named(make, words) -> None:
    with pytest.raises(ValueError, match=words):
        make()


@pytest.mark.parametrize("width", [1e150, 1e300])
def test_a_law_of_any_width_is_viscous_friction(width) -> None:
    with pytest.warns(ViscousRegimeWarning):
        wide = crawl_speed(Sheet(), SineWave(), 0.1, friction=Tanh(width), rtol=1e-2)
    viscous = crawl_speed(Sheet(), SineWave(), 0.1, friction="viscous", rtol=1e-2)
    assert wide.mean == pytest.approx(viscous.mean, rel=1e-2)
