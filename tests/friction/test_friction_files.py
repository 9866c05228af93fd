"""Friction with a direction and its maps: scene files, plain data, options, figure."""

import math
from pathlib import Path
from typing import Any

import pytest

from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane, Scene
from fem_check.command import main
from fem_check.command.options import Options
from fem_check.command.quantities import asked
from fem_check.files import read, writing
from fem_check.files.writing import toml_of
from figures.draw import directional as figure
from figures.measure import directional as table
from linear_theory import (
    Contact,
    Coulomb,
    Directional,
    FrictionLaw,
    GivenMap,
    Mapped,
    OnLowerFace,
    Patches,
    Sheet,
    SineWave,
    Tanh,
    Viscous,
    line_balance,
)
from linear_theory.friction.maps import FixedTo

PATCHES = Patches([(-1, 1, -1, -0.25, 3.0), (-0.1, 0.1, 0, 0.2, 0.5)], 0.1, 0.8, fixed_to="ground")
LAWS: dict[str, FrictionLaw] = {
    "direction": Directional(0.5, 1.5, form=Tanh(1e-3)),
    "all": Mapped(Directional(0.5, 1.5, 2, 0.3, "ground", Tanh(1e-3)), PATCHES),  # type: ignore[arg-type]
    "map": Mapped(Tanh(0.01), Patches([(0, 1, 0, 1, 2.0)], 0.1)),
}


@pytest.mark.parametrize("name", LAWS)
def test_scenes_come_back(name: str, tmp_path: Path) -> None:
    """From files and from data, with the effect or with the contact alone."""
    effects = [Membrane(Material(0.03, 0.5)), Gravity(3e-6), Friction(1.0, law=LAWS[name])]
    for scene in (
        Scene(Sheet(), SineWave(), 0.1, effects=effects),
        Scene(Sheet(), SineWave(), 0.1, contact=Contact(friction=LAWS[name])),
    ):
        assert Scene.from_toml(scene.to_toml(tmp_path / "scene.toml")) == scene
        assert Scene.from_dict(scene.to_dict()) == scene
        other = scene.but(alpha=0.2)
        assert other.contact.friction == LAWS[name]


@pytest.mark.parametrize("name", LAWS)
def test_lower_face_comes_back(name: str, tmp_path: Path) -> None:
    """Around any law, as an effect and as the contact alone."""
    material, law = Material(0.03, 0.5), OnLowerFace(LAWS[name])
    bends: list[Any] = [Membrane(material), Bending(material), Gravity(2.5e-4), Ground(0.5)]
    for scene in (
        Scene(Sheet(), SineWave(), 0.1, effects=[*bends, Friction(1.0, law=law)]),
        Scene(Sheet(), SineWave(), 0.1, effects=bends, contact=Contact("ground", law)),
    ):
        assert Scene.from_toml(scene.to_toml(tmp_path / "scene.toml")) == scene
        assert Scene.from_dict(scene.to_dict()) == scene
        assert scene.contact.friction.on_lower_face


def test_surface_in_a_file(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    text = "[growth]\nalpha = 0.1\n[bending]\n[gravity]\nweight = 1e-4\n[ground]\nstiffness = 0.5\n"
    path.write_text(text + '[friction]\nlaw = "viscous"\nsurface = "bottom"\n')
    assert Scene.from_toml(path).contact.friction == OnLowerFace(Viscous())
    path.write_text(text + '[friction]\nsurface = "top"\n')
    with pytest.raises(ValueError, match=r"surface.*'middle' or 'bottom'"):
        Scene.from_toml(path)


def test_lower_face_needs_bending() -> None:
    with pytest.raises(ValueError, match=r"friction = .*without the effect Bending"):
        Scene(Sheet(), SineWave(), 0.1, contact=Contact(friction=OnLowerFace(Coulomb())))
    with pytest.raises(ValueError, match=r"law = .*: must be a law without a face"):
        OnLowerFace(OnLowerFace(Coulomb()))
    with pytest.raises(ValueError, match=r"mid-surface; write OnLowerFace\(Mapped\(law, map\)\)"):
        Mapped(OnLowerFace(Coulomb()), PATCHES)
    with pytest.raises(ValueError, match="surface = 'top': must be"):
        Friction(1.0, 0.1, surface="top")
    with pytest.raises(ValueError, match="surface = 'middle': must be None or 'bottom'"):
        Friction(1.0, law=OnLowerFace(Viscous()), surface="middle")


def test_laws_that_no_file_holds(tmp_path: Path) -> None:
    law = Mapped(Coulomb(), GivenMap(lambda x, y: 1 + 0 * x * y))
    scene = Scene(Sheet(), SineWave(), 0.1, contact=Contact(friction=law))
    with pytest.raises(ValueError, match="a scene file holds no functions, must be Patches"):
        scene.to_toml(tmp_path / "scene.toml")


FILE = """
[sheet]
length = "40 mm"
[wave]
period = "8 s"
[growth]
swelling = "12 %"
[friction]
"""


def law_of(text: str, tmp_path: Path) -> Any:
    path = tmp_path / "scene.toml"
    path.write_text(FILE + text)
    return read(path).scene.contact.friction


def test_units_of_a_file(tmp_path: Path) -> None:
    found = law_of(
        'forward = 0.5\nbackward = 1.5\nheading = "90 deg"\nlaw = "viscous"\n'
        '[friction.map]\nx = [["-1 cm", "10 mm"]]\ny = [["0 mm", "2 cm"]]\nmu = [3.0]\nedge = "2 mm"',
        tmp_path,
    )
    assert found.law == Directional(0.5, 1.5, 1.0, heading=math.pi / 2, form=Viscous())
    assert found.map.patches[0] == pytest.approx((-10, 10, 0, 20, 3))
    assert found.map.edge == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("forward = 0.5", "backward: must be given beside forward"),
        ("sideways = 0.5", "forward: must be given beside sideways"),
        ("forward = 0.5\nbackward = -1.0", "backward"),
        ('forward = 0.5\nbackward = 1.0\nfixed_to = "sky"', "fixed_to"),
        ("forward = 0.5\nbackward = 1.0\nheading = 20", r"heading = 20: needs a unit, .*'5 deg' or '0"),
        (
            '[friction.map]\nx = [["0 mm", "1 mm"]]\ny = [["0 mm", "1 mm"]]\nmu = [1.0, 2.0]\n'
            'edge = "1 mm"',
            "must have one entry for each patch",
        ),
        (
            '[friction.map]\nx = [["2 mm", "1 mm"]]\ny = [["0 mm", "1 mm"]]\nmu = [1.0]\nedge = "1 mm"',
            r"map: x\[0\] = \[2 mm, 1 mm\]: must have x_min < x_max",
        ),
    ],
)
def test_mistakes_in_files(text: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=words):
        law_of(text, tmp_path)


def test_friction_that_no_file_can_say() -> None:
    """Named in words of the scene, without a file that there is not; plain data hold it."""
    law = Directional(0.5, 1.5, form=Viscous())
    effects = [Membrane(Material(0.03, 0.5)), Gravity(3e-6), Friction(1.0, law=law)]
    scene = Scene(Sheet(), SineWave(), 0.1, effects=effects)
    with pytest.raises(
        ValueError, match=r"^law = Directional.* beside a coefficient.*to_dict\(\)"
    ) as told:
        toml_of(scene)
    assert "scene.toml" not in str(told.value)
    assert Scene.from_dict(scene.to_dict()) == scene


def test_a_text_that_cannot_be_read_back_names_no_file(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(writing, "tables_of", lambda *_: {"sheet": {"width": -1.0}, "wave": {}})
    with pytest.raises(ValueError, match=r"^scene: a scene file cannot say this") as told:
        toml_of(Scene(Sheet(), SineWave(), 0.1))
    assert "[sheet] width = -1" in str(told.value)
    assert "scene.toml" not in str(told.value)


def test_options_of_the_command() -> None:
    question = asked(Options(alpha=0.1, forward=0.5, backward=1.5, sideways=0.7))
    assert question.scene.contact.friction == Directional(0.5, 1.5, 0.7)
    turned = Options(alpha=0.1, forward=0.5, backward=1.5, heading="90 deg", fixed_to="ground")
    on_ground = FixedTo.GROUND
    wanted = Directional(0.5, 1.5, heading=math.pi / 2, fixed_to=on_ground)
    assert asked(turned).scene.contact.friction == wanted
    for given, words in (
        ({"forward": 0.5}, "--backward: must be given beside --forward"),
        ({"heading": "5 deg"}, "--forward: must be given beside --heading"),
        ({"fixed_to": "ground", "forward": 1.0}, "--backward: must be given"),
        (
            {"forward": 1.0, "backward": 2.0, "heading": "20"},
            "--heading '20': needs a unit, as in '5 deg'",
        ),
        ({"forward": 1.0, "backward": 2.0, "heading": "20 mm"}, "--heading '20 mm': is not an angle"),
        (
            {"forward": 1.0, "backward": 2.0, "heading": "360 deg"},
            "^--heading '360 deg': must be from -180 deg to 180 deg",
        ),
        (
            {"forward": 1.0, "backward": 2.0, "friction": "tanh"},
            "^--slip-speed: must be given beside --friction tanh, such as '0.1 mm/s'",
        ),
        ({"friction": "tanh"}, "^--slip-speed: must be given beside --friction tanh"),
        ({"slip_speed": "0.1"}, "^--slip-speed '0.1': must be left out, only --friction tanh has one"),
        ({"friction": "tanh", "slip_speed": "-0.1"}, "^--slip-speed '-0.1': must be > 0"),
    ):
        with pytest.raises(ValueError, match=words):
            asked(Options(alpha=0.1, **given))


def test_half_a_turn_is_within_range() -> None:
    for text, wanted in (("180 deg", math.pi), ("-0.5 turn", -math.pi), ("200 grade", math.pi)):
        options = Options(alpha=0.1, forward=0.5, backward=1.5, heading=text)
        assert asked(options).scene.contact.friction == Directional(0.5, 1.5, heading=wanted)


def test_answer_says_what_the_direction_belongs_to(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["--alpha", "0.01", "--forward", "0.5", "--backward", "1.5", "--fixed-to"]
    for where in ("ground", "body"):
        with pytest.raises(SystemExit):
            main([*words, where, "--rtol", "0.3"])
        (line,) = (x for x in capsys.readouterr().out.splitlines() if x.startswith("  friction"))
        assert f"dry, 0.5 forward, 1.5 backward, 1 sideways, fixed to the {where}: " in f"{line} "


def test_figure_agrees_with_formulas_and_its_table_with_the_code() -> None:
    rows = table.TABLE.read()
    r, speed = figure.select(rows, "line", "breathing")
    for one, found in zip(r, speed, strict=True):  # r Delta, by exp(alpha c)
        assert found == pytest.approx(2 * one * math.sinh(0.1) / 0.1, abs=4e-3)
    _, nonlinear = figure.select(rows, "nonlinear", "breathing")
    assert nonlinear == pytest.approx(speed[::4], abs=5e-3)
    border = figure.equal_at(0.1, 1)
    wave = line_balance(SineWave(), 0.1, friction=table.law(border))
    assert wave.mean == pytest.approx(2 * border * 0.1)
    assert border == pytest.approx(0.19, abs=0.005)  # as the page says
    assert figure.numbers_shown(rows)["alpha"] == 0.1
