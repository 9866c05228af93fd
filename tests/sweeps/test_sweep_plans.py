"""Which scenes a sweep has: fields, values, ranges, designs, and what is wrong with them."""

import json
import math
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fem_check import Bending, Gravity, Ground, Material, Membrane, Scene, bilayer
from fem_check.command.actions.sweep import example
from fem_check.files import RunSettings, SceneFileError
from fem_check.files.tables import TABLES
from fem_check.sweeps import Between, Grid, LatinHypercube, Paired, Plan, Random
from fem_check.sweeps.plan import Refused, plan_of
from fem_check.sweeps.points.axes import axes_of
from fem_check.sweeps.points.fields import checked, paths, takes_whole_numbers, with_value
from fem_check.sweeps.schema import schema
from fem_check.sweeps.sweep_file import parsed
from linear_theory import FieldWave, Sheet, SineWave, pulse_wave
from tests.robust.drawn_examples import examples

BASE = Scene(Sheet(), SineWave(), alpha=0.1)


def planned(over: Any, scene: Any = BASE, design: Any = None, **settings: Any) -> Plan:
    return plan_of(scene, over, design or Grid(), RunSettings(**settings))


def scenes(plan: Plan) -> list[Scene]:
    return [plan.question(point).scene for point in plan.points()]


def test_scenes_are_those_that_python_makes() -> None:
    found = scenes(planned({"growth.alpha": [0.05, 0.2], "sheet.poisson": [0.0, 0.3]}))
    wanted = [BASE.but(alpha=a, sheet=Sheet(poisson=p)) for a in (0.05, 0.2) for p in (0.0, 0.3)]
    assert found == wanted


@pytest.mark.parametrize(
    ("path", "values", "change"),
    [
        ("growth.law", ["linear", "metric"], lambda v: {"growth_law": v}),
        ("wave.count", [1, -2], lambda v: {"wave": SineWave(v)}),
        ("wave.period", [0.5, 2.0], lambda v: {"wave": SineWave(period=v)}),
        ("run.cells", [[2, 4], [3, 6]], lambda v: {"cells": tuple(v)}),
        ("sheet.width", np.array([0.2, 0.4]), lambda v: {"sheet": Sheet(width=v)}),
    ],
)
def test_any_field_may_differ(path: str, values: Any, change: Any) -> None:
    assert scenes(planned({path: values})) == [BASE.but(**change(v)) for v in values]


def test_effects_may_differ_and_their_material_goes_with_the_sheet() -> None:
    material = Material(thickness=0.03, poisson=0.5)
    effects = [Membrane(material), Bending(material), Gravity(1e-4), Ground(0.5)]
    scene = Scene(
        Sheet(), SineWave(), alpha=0.01, curvature_coupling=1.0, effects=effects, cells=(2, 4)
    )
    soft, thin = scenes(
        planned({"ground.stiffness": [0.1, 0.5], "sheet.thickness": [0.03, 0.01]}, scene, Paired())
    )
    assert soft.find(Ground).stiffness == 0.1
    assert thin.find(Bending).material.thickness == 0.01
    curved = scenes(planned({"growth.curvature_coupling": [0.5, 2.0]}, scene))
    assert [one.curvature_coupling for one in curved] == [0.5, 2.0]


def test_one_way_to_say_the_growth_replaces_the_others() -> None:
    (found,) = scenes(planned({"growth.swelling": ["10 %"]}))
    assert found.alpha == pytest.approx(math.log(1.1), rel=1e-12)
    bent = BASE.but(effects=[Membrane(Material(0.03, 0.5)), Bending(Material(0.03, 0.5))])
    (layers,) = scenes(planned({"growth.bilayer.growth": [0.2]}, bent))
    assert layers.alpha == bilayer(0.2, 0.03).alpha


def test_settings_may_differ_too() -> None:
    plan = planned({"run.rtol": [0.1, 0.01]}, level="second order")
    found = [plan.question(point) for point in plan.points()]
    assert [q.settings.rtol for q in found] == [0.1, 0.01]
    assert {q.settings.level for q in found} == {"second order"}
    assert len({q.key() for q in found}) == 2


def bump(x: Any, y: Any, t: float) -> Any:
    """A wave that no text holds."""
    return np.sin(2 * np.pi * (y - t)) + 0 * x


def test_a_wave_that_is_a_function_stays_and_has_no_fields() -> None:
    wave = FieldWave(bump, period=1.0)
    scene = Scene(Sheet(), wave, alpha=0.1)
    assert [one.wave for one in scenes(planned({"growth.alpha": [0.1, 0.2]}, scene))] == [wave, wave]
    with pytest.raises(ValueError, match=r"over: wave\.period: a FieldWave has no fields that a sweep"):
        planned({"wave.period": [1.0]}, scene)


def test_scenes_one_by_one() -> None:
    given = [BASE, BASE.but(alpha=0.2)]
    assert scenes(planned(None, given)) == given
    with pytest.raises(ValueError, match="over: must be left out"):
        planned({"growth.alpha": [1.0]}, given)
    with pytest.raises(ValueError, match=r"scene\[1\] = 3: must be a Scene"):
        planned(None, [BASE, 3])


def test_heavy_parts_are_made_once(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = []
    monkeypatch.setattr(
        "fem_check.files.parts.scene_file.wave_of", lambda *a: calls.append(a) or pulse_wave(0.2)
    )
    plan = planned({"growth.alpha": [0.1, 0.2, 0.3]}, Scene(Sheet(), pulse_wave(0.2), alpha=0.1))
    found = scenes(plan)
    assert len(calls) == 1
    assert found[0].wave is found[2].wave


@examples(100)
@given(
    low=st.floats(1e-6, 1e3), factor=st.floats(1.001, 1e6), count=st.integers(2, 50), log=st.booleans()
)
def test_ranges_have_both_ends_and_equal_steps(
    low: float, factor: float, count: int, log: bool
) -> None:
    given = Between(low, low * factor, count, "log" if log else "linear")
    values = np.array(given.on("growth.alpha").values())
    assert values.size == count
    assert (values[0], values[-1]) == pytest.approx((low, low * factor), rel=1e-12)
    steps = np.diff(np.log(values) if log else values)
    assert np.allclose(steps, steps.mean(), rtol=1e-6, atol=1e-9 * abs(values).max())


def test_quantities_are_in_the_unit_of_the_first() -> None:
    (axis,) = axes_of({"sheet.width": ["1 cm", "5 mm"]})
    assert (axis.values(), axis.unit) == ([1.0, 0.5], "cm")
    (axis,) = axes_of({"sheet.width": Between("5 mm", "1 cm", count=2)})
    assert ([axis.said(v) for v in axis.values()], axis.unit) == (["5.0 mm", "10.0 mm"], "mm")


def test_whole_numbers_stay_whole() -> None:
    assert takes_whole_numbers("wave.count")
    assert takes_whole_numbers("run.steps")
    assert not takes_whole_numbers("growth.alpha")
    (axis,) = axes_of({"run.periods": Between(1, 3, count=3)})
    assert axis.values() == [1, 2, 3]
    found = [p for (p,) in Random(600, seed=2).points([axis])]
    assert {found.count(value) > 150 for value in (1, 2, 3)} == {True}
    with pytest.raises(ValueError, match="not so many whole numbers"):
        axes_of({"run.periods": Between(1, 3, count=5)})[0].values()


def test_designs() -> None:
    axes = axes_of(
        {"growth.alpha": Between(0.0, 0.3, count=4), "sheet.width": Between(0.1, 10.0, 4, "log")}
    )
    assert len(list(Grid().points(axes))) == Grid().size(axes) == 16
    assert list(Paired().points(axes))[1] == pytest.approx((0.1, 0.1 * 100 ** (1 / 3)))
    cube = np.array(list(LatinHypercube(64, seed=5).points(axes)))
    parts = np.stack([cube[:, 0] / 0.3, np.log10(cube[:, 1] / 0.1) / 2]) * 64
    assert (np.sort(parts.astype(int), axis=1) == np.arange(64)).all()
    for design in (Random(50, seed=1), LatinHypercube(50, seed=1)):
        points = list(design.points(axes))
        assert points == list(design.points(axes))
        assert points != list(type(design)(50, seed=2).points(axes))
        assert all(0 <= a <= 0.3 and 0.1 <= w <= 10 for a, w in points)
    words = axes_of({"growth.law": ["exp", "linear"]})
    assert {law for (law,) in Random(40).points(words)} == {"exp", "linear"}


REFUSED = {
    "unknown": (
        {"growth.alhpa": [1]},
        "'growth.alhpa': is not a field of a scene; did you mean 'growth.al",
    ),
    "table": ({"poisson": [1]}, "did you mean 'sheet.poisson'"),
    "table misspelled": ({"fiction.law": ["dry"]}, "did you mean 'friction.law'"),
    "name misspelled": ({"lenght": [1]}, "did you mean 'sheet.length'"),
    "like no name": ({"time": [1]}, "is not a field of a scene; must be one of sheet.length, "),
    "other table": ({"bending.curvature": [1]}, "did you mean 'growth.curvature"),
    "no list": ({"growth.alpha": 0.1}, "growth.alpha = 0.1: must be a list of values, or a range"),
    "empty": ({"growth.alpha": []}, "growth.alpha = []: is an empty list"),
    "nan": ({"growth.alpha": [0.1, math.nan]}, "nan: must be finite"),
    "none": ({}, "must map fields to values"),
    "mixed": ({"sheet.width": ["5 mm", 3]}, "3: needs a unit, beside '5 mm'"),
    "other unit": ({"sheet.width": ["5 mm", "3 s"]}, "'3 s': must be a quantity in mm or the like"),
    "no count": ({"growth.alpha": Between(0, 1)}, "growth.alpha: must have a count, or be a list"),
    "order": ({"growth.alpha": Between(1, 0, 3)}, "must be from the lower to the higher"),
    "log": ({"growth.alpha": Between(0, 1, 3, "log")}, "must be > 0 for spacing = 'log'"),
    "words": ({"growth.alpha": Between("a", 1, 3)}, "must be a finite number, with or without"),
    "all": ({"growth.alhpa": [1], "sheet.with": [1]}, "sheet.width"),
    "many": (
        {"growth.alpha": Between(0, 1, 10**6), "sheet.width": Between(1, 2, 10**6)},
        "at most|to 1000",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_no_plan(case: str) -> None:
    over, words = REFUSED[case]
    with pytest.raises(ValueError, match=words.replace("[", r"\[").replace("(", r"\(")):
        planned(over)


def test_pairs_must_be_as_long() -> None:
    with pytest.raises(
        ValueError, match=r"growth\.alpha has 2, sheet\.width has 1: must all have as many"
    ):
        planned({"growth.alpha": [1, 2], "sheet.width": [1]}, design=Paired())
    with pytest.raises(ValueError, match="design = 'grid': must be a Grid, Paired, Random"):
        plan_of(BASE, {"growth.alpha": [1]}, "grid", RunSettings())  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="level = 'third order': must be one of 'auto'"):
        planned({"growth.alpha": [1]}, level="third order")
    with pytest.raises(ValueError, match="count = 0: must be >= 1"):
        Random(0)


def test_a_scene_that_cannot_be_is_refused_with_the_words_of_a_scene_file() -> None:
    plan = planned({"sheet.poisson": [0.7]})
    with pytest.raises(Refused, match=r"\[sheet\] poisson = 0.7: must be in \(-1, 0.5\]"):
        plan.question((0.7,))


def test_every_path_can_be_set_and_no_other() -> None:
    for path in paths():
        assert checked(path) == path
        assert path.partition(".")[0] in with_value({}, path, 1)
    assert {path.partition(".")[0] for path in paths()} == {
        n for n, t in TABLES.items() if t.model_fields
    }


HERE = Path("sweep.toml")

MISTAKES = {
    "table": ("[scen]\n", "1: [scen] is not a table of a sweep; did you mean 'scene'?"),
    "field": (
        "[over]\ngrowth.alhpa = [1]\n",
        "2: [over] growth.alhpa: is not a field of a scene; did you mean",
    ),
    "quoted": ('[over]\n"growth.alhpa" = [1]\n', "2: [over] growth.alhpa: is not a field"),
    "range": (
        "[over]\ngrowth.alpha = { low = 0, heigh = 1 }\n",
        "2: [over] growth.alpha heigh: is not a key; did you mean 'high'?",
    ),
    "spacing": (
        '[over]\nsheet.width = { low = 1, high = 2, spacing = "lin" }\n',
        "spacing = 'lin': must be 'linear' or 'log'",
    ),
    "design": (
        '[over]\nsheet.width = [1]\n[sweep]\ndesign = "gird"\n',
        "4: [sweep] design = 'gird': must be 'grid'",
    ),
    "count": (
        "[over]\nsheet.width = [1]\n[sweep]\ncount = 3\n",
        "4: [sweep] count: must be left out for design",
    ),
    "no count": (
        '[over]\nsheet.width = [1]\n[sweep]\ndesign = "random"\n',
        "[sweep] count: must be given",
    ),
    "no over": ("[sweep]\n", "[over] must be given, with fields such as"),
    "unit": (
        '[over]\nsheet.width = ["1 mm", 2]\n',
        "2: [over] sheet.width = ['1 mm', 2]: 2: needs a unit",
    ),
}


@pytest.mark.parametrize("case", MISTAKES)
def test_mistakes_in_a_sweep_file_have_their_lines(case: str) -> None:
    text, words = MISTAKES[case]
    with pytest.raises(SceneFileError) as refused:
        parsed(text + "\n[scene.growth]\nalpha = 0.1\n", HERE)
    lines = refused.value.mistakes
    assert any(words in line for line in lines), lines


def test_mistakes_in_the_scene_of_a_sweep_file() -> None:
    with pytest.raises(SceneFileError) as refused:
        parsed(
            "[over]\nsheet.width = [1]\n[scene.growth]\nalpa = 0.1\n[scene.sheet]\npoisson = 2\n", HERE
        )
    first, second = refused.value.mistakes
    assert first == "sweep.toml:4: [scene.growth] alpa: is not a key; did you mean 'alpha'?"
    assert second.startswith("sweep.toml:6: [scene.sheet] poisson = 2: must be in (-1, 0.5]")


def test_a_scene_file_may_be_named(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text("[growth]\nalpha = 0.1\n")
    text = (
        'scene = "mine.toml"\n[over]\nsheet.width = [0.2]\n[sweep]\nlevel = "strip"\ntime = "2 min"\n'
    )
    plan = parsed(text, tmp_path / "sweep.toml").plan
    assert scenes(plan) == [BASE.but(sheet=Sheet(width=0.2))]
    assert plan.seconds == 120.0
    (tmp_path / "mine.toml").write_text("[growth]\nalpa = 0.1\n")
    with pytest.raises(SceneFileError, match=r"mine.toml:2: \[growth\] alpa: is not a key"):
        parsed(text, tmp_path / "sweep.toml")


def test_lengths_and_times_stay_in_the_units_of_the_scene() -> None:
    text = (
        '[scene.sheet]\nlength = "40 mm"\n[scene.wave]\nperiod = "8 s"\n[scene.growth]\nalpha = 0.1\n'
        '[over]\nsheet.length = ["2 cm", "4 cm"]\nwave.period = ["1 min"]\n'
    )
    plan = parsed(text, HERE).plan
    found = scenes(plan)
    assert [(one.sheet.length, one.period) for one in found] == [(20.0, 60.0), (40.0, 60.0)]
    assert plan.units is not None
    assert plan.units.speed == "mm/s"


def test_the_example_is_what_the_schema_allows() -> None:
    assert parsed(example(), HERE).plan.size == 12
    given, known = tomllib.loads(example()), schema()
    assert given.keys() == known["properties"].keys()
    over = known["properties"]["over"]
    assert given["over"]["growth"].keys() <= over["properties"]["growth"]["properties"].keys()
    assert set(paths()) <= over["properties"].keys()
    assert not over["additionalProperties"]
    assert given["sweep"].keys() <= known["$defs"]["SweepTable"]["properties"].keys()
    assert json.loads(json.dumps(known)) == known
