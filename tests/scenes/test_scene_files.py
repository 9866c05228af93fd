"""Scene files: what is written is read again, units are pint's, and mistakes are named, all of them."""

import json
import math
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import numpy as np
import pint
import pytest
import skfem
import sympy
from hypothesis import given
from hypothesis import strategies as st

from fem_check import (
    Bending,
    DeadLoad,
    Friction,
    Gravity,
    Ground,
    Inertia,
    Material,
    Membrane,
    Outline,
    bilayer,
)
from fem_check.answer.growth import alpha_of
from fem_check.choice.settings import RunSettings
from fem_check.files import SceneFileError, gallery, read, write
from fem_check.files.reading import parsed
from fem_check.files.schema import schema
from fem_check.files.tables import TABLES
from fem_check.files.toml import text_of
from fem_check.files.writing import toml_of
from fem_check.shell.effects.loads import EdgeMoment
from linear_theory import (
    Contact,
    Coulomb,
    FieldWave,
    Load,
    Scene,
    Sheet,
    SineWave,
    Tanh,
    TravellingWave,
    Viscous,
    pulse_wave,
)
from tests.robust.drawn_examples import examples

HERE = Path("scene.toml")
UNITS = pint.UnitRegistry(cache_folder=None)


def scene_of(text: str, folder: Path = Path()) -> Scene:
    return parsed(text, folder / "scene.toml").scene


@pytest.mark.parametrize("name", gallery.names())
def test_a_scene_of_the_gallery_is_written_and_read(name: str, tmp_path: Path) -> None:
    file = read(gallery.FOLDER / f"{name}.toml")
    path = write(file.scene, tmp_path / "again.toml", file.run)
    again = read(path)
    assert again.scene == file.scene
    assert again.scene.key() == file.scene.key()
    assert again.run == file.run
    assert again.units is None
    assert toml_of(again.scene, again.run) == path.read_text()
    assert gallery.title(name)
    assert [p.name for p in tmp_path.iterdir()] == ["again.toml"]


def test_the_gallery_has_what_was_promised() -> None:
    assert set(gallery.names()) == {
        *("paper", "hydrogel", "inchworm", "trapezoid", "hole"),
        *("turning", "bumpy", "pulse", "piezo", "viscous", "measured", "excitable"),
    }
    with pytest.raises(ValueError, match="'gel': is not a scene of the gallery; there are paper"):
        gallery.text("gel")


def test_the_paper_is_the_paper() -> None:
    assert scene_of(gallery.text("paper")) == Scene(Sheet(), SineWave(), 0.25)
    assert scene_of("[growth]\nalpha = 0.25") == Scene(Sheet(), SineWave(), 0.25)


SIZES = st.floats(0.1, 50.0)
NAMES = ("exp", "linear", "metric")
AMPLITUDES = st.lists(st.floats(-1, 1), min_size=1, max_size=3)
X, Y = sympy.symbols("x y")
HEIGHTS = st.builds(
    lambda a, p, q: a * sympy.sin(p * X + 1) * sympy.exp(-((Y / q) ** 2)) + a * sympy.tanh(X / 7) / 3,
    st.floats(1e-3, 0.1),  # not so small that sympy's floats are no doubles
    st.floats(0.1, 3),
    st.integers(2, 9),
)


@st.composite
def waves(draw: Any) -> TravellingWave:
    count, period = draw(st.integers(-3, 3).filter(bool)), draw(SIZES)
    kind = draw(st.integers(0, 2))
    if kind == 0:
        return SineWave(count, period)
    if kind == 1:
        return pulse_wave(draw(st.floats(0.1, 0.9)), count, period)
    cosine = draw(AMPLITUDES)
    return TravellingWave(cosine, cosine[::-1], count, period, draw(st.floats(-1, 1)))


@st.composite
def scenes(draw: Any) -> Scene:
    """All that a file can hold."""
    sheet = Sheet(draw(SIZES), draw(SIZES), draw(st.floats(-0.9, 0.5)), draw(SIZES))
    material = Material(sheet.thickness, sheet.poisson, draw(st.sampled_from([1.0, 1e6, 0.3])))
    growth = {
        "growth_law": draw(st.sampled_from(NAMES)),
        "area": draw(st.sampled_from(["grown", "undeformed"])),
    }
    alpha, effects, space = draw(st.floats(-0.05, 0.05)), [], False
    contact = draw(st.sampled_from([None, Coulomb(), Viscous(), Tanh(0.01 / 3)]))
    weight = draw(st.sampled_from([Load.CURRENT, Load.GROWN, Load.MATERIAL]))
    if draw(st.booleans()):
        effects = [Gravity(draw(st.floats(1e-9, 1.0)), weight, draw(st.floats(-0.5, 0.5)))]
        space = draw(st.booleans())
        if space:
            height = draw(st.none() | HEIGHTS)
            ground = Ground(draw(SIZES), draw(st.floats(0, 1)), weight, height, "printed")
            effects += [Bending(material), ground]
            growth["curvature_coupling"] = draw(st.floats(-1, 1))
            growth["curvature"] = draw(st.sampled_from(["grown", "undeformed"]))
        if contact is None:
            effects.append(Friction(draw(st.floats(0.1, 2)), draw(SIZES)))
        if draw(st.booleans()):
            effects.append(Inertia(draw(SIZES), material))
        if draw(st.booleans()):
            effects.append(DeadLoad((0.1, -0.2, 1 / 3)[: 3 if space else 2]))
    if effects or draw(st.booleans()):
        effects = [Membrane(material), *draw(st.permutations(effects))]
    load = (Load.GROUND if space else weight) if effects[1:] else draw(st.sampled_from([weight]))
    said = (
        None if contact is None else Contact(load, contact, 0.0 if effects else draw(st.floats(0, 0.2)))
    )
    cells = draw(st.none() | st.tuples(st.integers(1, 9), st.integers(1, 9)))
    element = draw(st.sampled_from([None, skfem.ElementQuadBFS(), skfem.ElementQuadP(3)]))
    return Scene(
        sheet,
        draw(waves()),
        alpha,
        effects=effects,
        contact=said,
        cells=cells,
        element=element,
        **growth,
    )


@examples(60)
@given(scenes())
def test_random_scenes_are_the_same_again(scene: Scene) -> None:
    text = toml_of(scene)
    again = scene_of(text)
    assert again == scene
    assert toml_of(again) == text


def test_scenes_write_and_read_themselves(tmp_path: Path) -> None:
    mesh = Outline([(-0.25, -0.5), (0.25, -0.5), (0.1, 0.5), (-0.1, 0.5)]).mesh(0.3)
    scene = Scene(Sheet(), SineWave(), 0.1, mesh=mesh)
    path = scene.to_toml(tmp_path / "deep" / "scene.toml")
    assert Scene.from_toml(path) == Scene.from_toml(str(path)) == scene
    scene.but(alpha=0.2).to_toml(path)
    assert Scene.from_toml(path).alpha == 0.2
    settings = RunSettings("cycle", None, 3, 40)
    assert read(write(scene, path, settings)).run == settings


@pytest.mark.parametrize(
    ("scene", "words"),
    [
        (
            Scene(Sheet(), FieldWave(lambda x, y, t: 0 * x + y + t, 1.0, name="w"), 0.1),
            "wave: a FieldWave",
        ),
        (
            Scene(
                Sheet(),
                SineWave(),
                0.1,
                effects=[
                    Membrane(Material(0.03, 0.5)),
                    Gravity(1e-4),
                    Ground(0.5, height=lambda x, y: 0.01 * np.cos(y) + 0 * x),
                ],
            ),
            "a scene file holds no functions",
        ),
        (
            Scene(
                Sheet(),
                SineWave(),
                0.1,
                effects=[
                    Membrane(Material(0.03, 0.5)),
                    Gravity(1e-4),
                    Ground(0.5, height=0.01 * sympy.log(5 + X)),
                ],
            ),
            "log",
        ),
    ],
    ids=["wave", "function", "formula"],
)
def test_what_no_file_holds_is_refused_and_nothing_written(
    scene: Scene, words: str, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match=words):
        scene.to_toml(tmp_path / "scene.toml")
    assert not list(tmp_path.iterdir())


def test_an_effect_without_a_table_is_refused() -> None:
    effects = [Membrane(Material(0.03, 0.5)), EdgeMoment(0.1), Gravity(1e-4), Ground(0.5)]
    with pytest.raises(ValueError, match=r"effects\[1\]: a EdgeMoment has no table"):
        toml_of(Scene(Sheet(), SineWave(), 0.1, effects=effects))


SHELL = """
[sheet]
length = "4 cm"
width = "15 mm"
thickness = "800 um"
young = "0.5 MPa"
[wave]
period = "2 min"
[growth]
alpha = 0.01
curvature_coupling = "5 1/m"
[bending]
[gravity]
weight = "8 Pa"
incline = "3 deg"
[ground]
stiffness = "50 Pa/mm^2"
damping = "2 Pa*s/mm"
[friction]
coefficient = 0.7
slip_speed = "0.1 mm/s"
[inertia]
density = "1100 kg/m^3"
"""


def test_units_are_those_of_pint() -> None:
    """Each number by hand: lengths in cm, times in min, stresses in 0.5 MPa."""
    scene, q = scene_of(SHELL), UNITS.Quantity
    length, time, stress = q("1 cm"), q("1 min"), q("0.5 MPa")

    def by(text: str, unit: Any) -> Any:
        return pytest.approx((q(text) / unit).to("dimensionless").magnitude, rel=1e-14)

    friction, gravity, ground = (scene.find(kind) for kind in (Friction, Gravity, Ground))
    assert scene.sheet.length == 4.0
    assert scene.sheet.width == by("15 mm", length)
    assert scene.sheet.thickness == by("800 um", length)
    assert scene.period == 2.0
    assert scene.curvature_coupling == by("5 / m", 1 / length)
    assert gravity.weight == by("8 Pa", stress)
    assert gravity.incline == pytest.approx(math.radians(3), rel=1e-14)
    assert ground.stiffness == by("50 Pa/mm^2", stress / length**2)
    assert ground.damping == by("2 Pa*s/mm", stress * time / length)
    assert friction.slip_speed == by("0.1 mm/s", length / time)
    assert scene.find(Inertia).density == by("1100 kg/m^3", stress * time**2 / length**2)
    assert scene.find(Membrane).material.young == 1.0
    units = parsed(SHELL, HERE).units
    assert units is not None
    assert (units.length, units.time) == ("cm", "min")


@pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
def test_another_system_of_units_gives_the_same_speed() -> None:
    """The same sheet in mm and s, and in inches and minutes, to the roundoff of the solution."""
    from fem_check import solve

    other = (
        SHELL.replace('"4 cm"', f'"{40 / 25.4!r} inch"').replace('"2 min"', '"120 s"')
    )  # fmt: skip
    speeds = []
    for text in (SHELL, other):
        flat = text[: text.index("[growth]")] + '[growth]\nswelling = "5 %"\n'
        file = parsed(flat, HERE)
        found = solve(file.scene, "predict", rtol=0.1)
        assert file.units is not None
        speeds.append(UNITS.Quantity(found.mean, file.units.speed).to("mm/s").magnitude)
    assert speeds[0] == pytest.approx(speeds[1], rel=1e-9)


def test_weight_of_a_density() -> None:
    scene = scene_of(SHELL.replace('weight = "8 Pa"', 'density = "1.1 g/cm^3"'))
    expected = 1100 * 9.80665 * 800e-6 / 0.5e6
    assert scene.find(Gravity).weight == pytest.approx(expected, rel=1e-13)


def test_growth_in_three_ways() -> None:
    head = '[sheet]\nlength = "40 mm"\nthickness = "1 mm"\n[wave]\nperiod = "1 s"\n'
    swelling = scene_of(f'{head}[growth]\nswelling = "12 %"\nlaw = "linear"')
    assert swelling.alpha == alpha_of(0.12, swelling.wave, swelling.sheet, "linear")
    layers = '[growth.bilayer]\ngrowth = "20 %"\nthickness_ratio = 2.0\nmodulus_ratio = 0.5\n'
    for side, sign in (("upper", 1), ("lower", -1)):
        scene = scene_of(f'{head}[bending]\n{layers}side = "{side}"')
        alpha, beta = bilayer(0.2, 1.0, 2.0, 0.5)
        assert (scene.alpha, scene.curvature_coupling) == (alpha, sign * beta)


def test_layers_of_extreme_ratios() -> None:
    """The sheet grows as the one layer that is left; beyond, and for endless curvature, an error."""
    for ratio, left in ((1e50, 0.2), (1e-50, 0.0)):
        for one in (bilayer(0.2, 1.0, ratio), bilayer(0.2, 1.0, 1.0, ratio)):
            assert one == pytest.approx((left, 0.0), abs=1e-12)
    for name in ("thickness_ratio", "modulus_ratio"):
        for ratio in (1e308, 5e-324):
            with pytest.raises(ValueError, match=rf"^{name} = \S+: must be in \[1e-50, 1e\+50\]$"):
                bilayer(0.2, 1.0, **{name: ratio})
    with pytest.raises(
        ValueError, match=r"^growth = 1e\+308: must have a finite ratio to thickness = 1e-05"
    ):
        bilayer(1e308, 1e-5)


def test_the_order_of_tables_has_no_meaning() -> None:
    tables = [
        "[bending]",
        "[ground]\nstiffness = 0.5",
        "[gravity]\nweight = 1e-4",
        "[growth]\nalpha = 0.1",
    ]
    assert scene_of("\n".join(tables)) == scene_of("\n".join(tables[::-1]))


@examples(100)
@given(st.dictionaries(st.sampled_from("abc"), st.text() | st.floats(allow_nan=False) | st.integers()))
def test_toml_is_what_python_reads(entries: dict[str, Any]) -> None:
    tables = {"one": entries, "two": {"in": entries, "list": [list(entries.values())]}}
    assert tomllib.loads(text_of(tables, head="a\nb")) == tables


def test_the_schema_names_all_tables_and_keys() -> None:
    found = schema()
    assert set(found["properties"]) == set(TABLES)
    for name, kind in TABLES.items():
        entries = found["$defs"][kind.__name__]["properties"]
        assert set(entries) == set(kind.model_fields), name
        assert all(entry.get("description") for entry in entries.values()), name
    assert found["$defs"]["SheetTable"]["additionalProperties"] is False
    length = found["$defs"]["SheetTable"]["properties"]["length"]
    assert "40 mm" in str(length)


@pytest.fixture(scope="module")
def validator() -> Any:
    """What an editor makes of the schema."""
    found = json.loads(json.dumps(schema()))
    jsonschema.Draft202012Validator.check_schema(found)
    return jsonschema.Draft202012Validator(found)


KEYWORDS = {
    *("type", "enum", "const", "anyOf", "not", "$ref", "properties", "additionalProperties", "items"),
    *("required", "minimum", "exclusiveMinimum", "maximum", "minItems", "maxItems", "pattern"),
    *("title", "description", "default", "examples"),
}
"""Of JSON Schema; editors ignore others without a word."""


def test_the_schema_has_only_words_that_editors_know() -> None:
    def keywords(node: Any) -> set[str]:
        if isinstance(node, list):
            return set().union(*map(keywords, node))
        if not isinstance(node, dict):
            return set()
        named = {*node} - {"properties", "default", "examples", "enum"}
        inner = [*node.get("properties", {}).values(), *(node[name] for name in named)]
        return {*node} | keywords(inner)

    found = schema()
    assert keywords(list(found["$defs"].values())) <= KEYWORDS


@pytest.mark.parametrize("name", gallery.names())
def test_scenes_of_the_gallery_fit_the_schema(validator: Any, name: str) -> None:
    validator.validate(tomllib.loads(gallery.text(name)))


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("[sheet]\nwdth = 1", "wdth"),
        ("[sheet]\npoisson = 0.7", "0.7"),
        ('[wave]\nkind = "saw"', "saw"),
        ("[wave]\ncount = 1.5", "1.5"),
        ("[wave]\ncount = 0", "0"),
        ("[run]\nperiods = 0", "0"),
        ("[nothing]", "nothing"),
    ],
)
def test_the_schema_sees_what_the_reader_refuses(validator: Any, text: str, named: str) -> None:
    text = f"{text}\n[growth]\nalpha = 0.1\n"
    with pytest.raises(SceneFileError, match=named):
        parsed(text, HERE)
    with pytest.raises(jsonschema.ValidationError, match=named):
        validator.validate(tomllib.loads(text))
