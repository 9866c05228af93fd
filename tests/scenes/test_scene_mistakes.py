"""Mistakes in scene files: each named with its line, table and key, all of them at once."""

import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fem_check import Gravity
from fem_check.files import SceneFileError, gallery, read
from fem_check.files.mistakes import line_of
from fem_check.files.reading import parsed
from linear_theory import Scene
from tests.robust.drawn_examples import examples

HERE = Path("scene.toml")


def scene_of(text: str, folder: Path = Path()) -> Scene:
    return parsed(text, folder / "scene.toml").scene


def mistakes_of(text: str, folder: Path = Path()) -> list[str]:
    """Without the name of the file."""
    with pytest.raises(SceneFileError) as refused:
        parsed(text, folder / "scene.toml")
    return [line.partition("scene.toml")[2].lstrip(":") for line in refused.value.mistakes]


BASE = '[sheet]\nlength = "40 mm"\nyoung = "1 MPa"\n[wave]\nperiod = "8 s"\n[growth]\nalpha = 0.01\n'
PLAIN = "[growth]\nalpha = 0.01\n"
SPACE = PLAIN + "[bending]\n[gravity]\nweight = 1e-4\n[ground]\nstiffness = 0.5\n"

REFUSED = {
    "unit of something else": ('[sheet]\nlength = "40 kg"', "1", "length = '40 kg': is not a length"),
    "no unit": ('[sheet]\nlength = "40 mmm"', "2", "length = '40 mmm': 'mmm' is not a known unit"),
    "no number": ('[wave]\nperiod = "soon"', "2", "[wave] period = 'soon': must be a time such"),
    "truth": ("[sheet]\nwidth = true", "2", "[sheet] width = True: must be a length"),
    "nan": ("[sheet]\nwidth = nan", "2", "[sheet] width = nan: must be finite"),
    "nan as text": ('[sheet]\nwidth = "nan mm"', "2", "[sheet] width = 'nan mm': must be finite"),
    "inf": ("[growth]\nalpha = inf", "2", "[growth] alpha = inf: must be a finite number"),
    "negative": ("[sheet]\nthickness = -1", "2", "[sheet] thickness = -1: must be > 0"),
    "poisson": ("[sheet]\npoisson = 0.7", "2", "[sheet] poisson = 0.7: must be in (-1, 0.5]"),
    "key": ("[sheet]\nwidht = 1", "2", "[sheet] widht: is not a key; did you mean 'width'?"),
    "key like none": ("[bending]\nq = 1", "2", "[bending] q: is not a key; must be one of none"),
    "key in a hole": (
        '[outline]\nshape = "rectangle"\n[[outline.holes]]\ndiamter = 1',
        "4",
        "[outline] holes[0].diamter: is not a key; did you mean 'diameter'?",
    ),
    "table": ("[grond]\n", "1", "[grond] is not a table of a scene; did you mean 'ground'?"),
    "loose key": ("lenght = 3\n", "1", "[lenght] is not a table"),
    "no table": ("sheet = 3\n", "1", "[sheet] is 3: must be a table"),
    "count": ("[wave]\ncount = 0", "2", "[wave] count = 0: must be a non-zero integer"),
    "count not whole": ("[wave]\ncount = 1.5", "2", "[wave] count = 1.5: must be an integer"),
    "kind": ('[wave]\nkind = "puls"', "2", "[wave] kind = 'puls': must be 'sine', 'pulse', 'harm"),
    "width of a sine": ("[wave]\nwidth = 0.2", "2", "[wave] width: must be left out, only"),
    "no width": ('[wave]\nkind = "pulse"', "1", "[wave] width: must be given for a pulse"),
    "narrow": ('[wave]\nkind = "pulse"\nwidth = "1 %"', "3", "width = 0.01: must be in [0.02, 1)"),
    "no harmonics": ('[wave]\nkind = "harmonics"', "1", "must be one-dimensional, of one length >= 1"),
    "amplitude": (
        '[wave]\nkind = "harmonics"\nsine = [1, "a"]',
        "3",
        "[wave] sine[1] = 'a': must be a number, not text",
    ),
    "alpha in per cent": (
        '[growth]\nalpha = "12 %"',
        "2",
        "must be a plain number, without a unit; growth of lengths at the crest is swelling = '12 %'",
    ),
    "number as text": ('[growth]\nalpha = "0.1"', "2", "alpha = '0.1': must be a number: write it"),
    "count as text": ('[wave]\nmean = "x"', "2", "[wave] mean = 'x': must be a number, not text"),
    "pulse of the command": ("[wave]\npulse = 0.2", "2", "a pulse is kind = 'pulse' with width = 0.2"),
    "word of the command": ("[friction]\nfriction = 1", "2", "friction: is not a key; it is law here"),
    "key of the paper": ("[friction]\nmu = 1", "2", "mu: is not a key; it is coefficient here"),
    "travelling": (
        '[wave]\nkind = "travelling"',
        "2",
        "'harmonics' or 'excitable'; every wave travels: 'sine', 'pulse', or 'harmonics' with lists",
    ),
    "poisson as text": ('[sheet]\npoisson = "0.3"', "2", "must be a number: write it without quotes"),
    "Coulomb": ('[friction]\nlaw = "coulomb"', "2", "or 'viscous'; Coulomb's law is 'dry'"),
    "slope as angle": ('[gravity]\nweight = 1\nincline = "5 %"', "3", "= '5 %': is not an angle"),
    "angle as share": ('[run]\nrtol = "5 deg"', "2", "[run] rtol = '5 deg': is not a share"),
    "tolerance": ("[run]\nrtol = 2", "2", "[run] rtol = 2: must be in [1e-13, 1)"),
    "rtol and steps": ("[run]\nrtol = 0.1\nsteps = 9", "3", "steps = 9: must be left out where rtol"),
    "cells": ("[run]\ncells = [4]", "2", "[run] cells = [4]: must have at least 2 items"),
    "element": ('[run]\nelement = "os.system(1)"', "2", "must be a scikit-fem element"),
    "slip speed of dry": (
        '[friction]\nlaw = "dry"\nslip_speed = 1',
        "3",
        "[friction] slip_speed: must be left out but for law = 'tanh'",
    ),
    "no slip speed": ('[friction]\nlaw = "tanh"', "1", "[friction] slip_speed: must be given for law"),
    "coefficient alone": (
        "[friction]\ncoefficient = 1.0",
        "1",
        "[friction] slip_speed: must be given with a coefficient",
    ),
    "coefficient of dry": (
        '[friction]\nlaw = "dry"\ncoefficient = 1.0',
        "2",
        "[friction] law = 'dry': must be 'tanh' where a coefficient is given",
    ),
    "direction": (
        '[friction]\nforward = 1\nbackward = 2\nheading = "360 deg"',
        "4",
        "[friction] heading = '360 deg': must be from -180 deg to 180 deg",
    ),
    "no load": ("[friction]\ncoefficient = 1.0\nslip_speed = 0.1", "", "must come with Gravity"),
    "no ground": ("[bending]\n[gravity]\nweight = 1.0", "", "Gravity must come with Ground"),
    "weight and density": ("[gravity]\n", "1", "[gravity] weight, density: one of them must be given"),
    "plain density": ("[gravity]\ndensity = 1", "2", "[gravity] density: must have a unit"),
    "two outlines": (
        '[outline]\nshape = "ellipse"\nmesh = "a.msh"',
        "1",
        "[outline] shape and mesh: only one of shape, corners, mesh, vertices may be given",
    ),
    "no outline": ("[outline]\nsize = 1", "1", "[outline] one of shape"),
    "trapezoid": ('[outline]\nshape = "trapezoid"', "1", "[outline] rear: must be given for shape"),
    "rear of an ellipse": (
        '[outline]\nshape = "ellipse"\nrear = 1',
        "3",
        "[outline] rear: must be left out but for shape = 'trapezoid'",
    ),
    "no mesh file": ('[outline]\nmesh = "a.msh"', "2", "mesh = 'a.msh': there is no such"),
    "hole without size": (
        '[outline]\nshape = "rectangle"\n[[outline.holes]]\nx = 0',
        "1",
        "[outline] holes[0].diameter: must be given for shape = 'circle'",
    ),
    "hole outside": (
        '[outline]\nshape = "rectangle"\n[[outline.holes]]\nx = 3\ndiameter = 0.1',
        "1",
        "[outline] holes[0]: must lie within corners",
    ),
    "unit beside plain": (
        '[outline]\ncorners = [[0, 0], [1, 0], [0, 1]]\nunit = "mm"',
        "3",
        "[outline] unit = 'mm': must be left out, all other numbers are plain",
    ),
    "unit of what": ('[outline]\nunit = "kg"', "2", "[outline] unit = 'kg': must be a unit of length"),
    "elements": (
        "[outline]\nvertices = [[0, 0], [1, 0], [0, 1]]\nelements = [[0, 1, 3]]",
        "3",
        "[outline] elements: must be numbers of vertices, from 0 to 2",
    ),
    "other size": (
        "[outline]\ncorners = [[0, 0], [40, 0], [0, 40]]",
        "1",
        "[outline] mesh",
    ),
    "measured wave": ('[wave]\ncsv = "a.csv"\ncount = 2', "2", "csv: must not be combined with count"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_a_mistake_is_named_with_its_place(name: str) -> None:
    text, line, words = REFUSED[name]
    growth = "" if "[growth]" in text else "\n[growth]\nalpha = 0.01\n"
    found = mistakes_of(text + growth)
    assert len(found) == 1, found
    assert words in found[0]
    assert " ".join(found[0].split()) == found[0].strip()
    if line and "is not a length" not in words:
        assert found[0].startswith(f"{line}: "), found[0]


GROWTHS = {
    "none": ("[growth]\n", "[growth] one of alpha, swelling, bilayer must be given"),
    "two": ('[growth]\nalpha = 0.1\nswelling = "3 %"', "[growth] alpha and swelling: only one of"),
    "per cent": ("[growth]\nswelling = 12", "[growth] swelling = 12: a plain number is a share"),
    "no bending": (
        "[growth]\nalpha = 0.1\ncurvature_coupling = 1",
        "curvature_coupling = 1: must be 0 without the effect Bending",
    ),
    "law": ('[growth]\nalpha = 0.1\nlaw = "log"', "[growth] law = 'log': must be 'exp', 'linear' or"),
    "ratio of layers": (
        "[growth.bilayer]\ngrowth = 0.1\nthickness_ratio = 1e308",
        "thickness_ratio = 1e+308: must be in [1e-50, 1e+50]",
    ),
    "bent onto itself": (
        "[self_contact]\n[bending]\n[run]\ncells = [4, 16]\n[growth]\nalpha = 0.1\n"
        "curvature_coupling = -60.0",
        "1: [self_contact] curvature_coupling: bends the sheet by 60, must be by <= ",
    ),
    "wide gap": (
        "[self_contact]\ngap = 1e9\n[bending]\n[growth]\nalpha = 0.1\ncurvature_coupling = 5.0",
        "gap 1e+09; or the gap must be <= 0.",
    ),
    "long elements": (
        "[self_contact]\n[bending]\n[sheet]\nthickness = 1e-3\n[run]\ncells = [2, 4]\n[growth]\n"
        "alpha = 0.1\ncurvature_coupling = 20.0",
        "1: [self_contact] cells: elements are 0.354 long",
    ),
    "bilayer": ("[growth]\nbilayer = 3", "[growth] bilayer = 3: must be a table"),
    "missing": ("", "[growth]: must be given, with alpha, swelling or bilayer"),
    "too much": (
        '[growth]\nalpha = 1.5\nlaw = "linear"\n[gravity]\nweight = 1.0',
        "alpha c = -1.5 is not within -1",
    ),
}


@pytest.mark.parametrize("name", GROWTHS)
def test_a_mistake_of_growth_is_named(name: str) -> None:
    text, words = GROWTHS[name]
    (found,) = mistakes_of(text)
    assert words in found


TERRAINS = {
    "none": ("", "[ground.terrain] one of amplitude, expression, map, heights"),
    "eq. 13": ("amplitude = 0.1", "wavelength_x: must be given with amplitude"),
    "formula": ('expression = "log(x)"', "expression = 'log(x)': 'log(x)' is not understood"),
    "program": ("expression = \"__import__('os')\"", "is not understood"),
    "map": ('map = "a.npy"\nwidth = 3\nlength = 3', "map = 'a.npy': there is no such file"),
    "size": ('map = "a.npy"', "width: must be given for a map"),
    "small": ("heights = [[1.0, 2.0]]\nwidth = 0.5\nlength = 9", "width = 0.5: must be >= 1"),
    "ragged": ("heights = [[1.0], [1.0, 2.0]]\nwidth = 3\nlength = 3", "rows of one length"),
    "few": ("heights = [[1.0]]\nwidth = 3\nlength = 3", "heights has shape (1, 1): must be (6, 6)"),
    "beside": ('expression = "x"\nwidth = 3', "width: must be left out beside expression"),
    "kink": ('expression = "sqrt(x**2)"', "must be smooth"),
}


@pytest.mark.parametrize("name", TERRAINS)
def test_a_mistake_of_the_terrain_is_named(name: str) -> None:
    text, words = TERRAINS[name]
    (found,) = mistakes_of(f"{SPACE}[ground.terrain]\n{text}")
    assert words in found


MIXED = {
    "width": ("[sheet]\nwidth = 3", "needs a unit, as in '40 mm', beside [sheet] length = '40 mm'"),
    "slip": ("[friction]\nslip_speed = 3", "slip_speed = 3: needs a unit, as in '0.1 mm/s'"),
}


@pytest.mark.parametrize("name", MIXED)
def test_numbers_with_and_without_units_are_not_mixed(name: str) -> None:
    text, words = MIXED[name]
    table, _, rest = text.partition("\n")
    mixed = BASE.replace(f"{table}\n", f"{text}\n") if table in BASE else f"{BASE}{text}\n"
    (found,) = mistakes_of(mixed)
    assert rest.partition(" ")[0] in found
    assert words in found


def test_what_units_need_is_asked_for() -> None:
    assert mistakes_of('[sheet]\nwidth = "3 mm"\n[growth]\nalpha = 0.1') == [
        " [wave] period: must be given, such as '8 s', beside [sheet] width = '3 mm'",
        "1: [sheet] length: must be given, such as '40 mm', beside [sheet] width = '3 mm'",
    ]
    (young,) = mistakes_of(BASE.replace('young = "1 MPa"\n', "") + '[gravity]\nweight = "8 Pa"\n')
    assert "young: must be given, such as '1 MPa', beside [gravity] weight = '8 Pa'" in young
    assert scene_of(f'{BASE}[gravity]\nweight = "8 Pa"\nincline = 0\n').find(Gravity).incline == 0


def test_all_mistakes_are_told_in_the_order_of_the_file() -> None:
    text = """
[sheet]
length = "40 kg"
widht = 3

[wave]
kind = "puls"
[growth]
alpha = "much"
[gravity]
weight = 0
[outline]
shape = "rectangle"
[[outline.holes]]
diameter = 0.1
[[outline.holes]]
diameter = "2 kg"
"""
    found = mistakes_of(text)
    assert [int(line.partition(":")[0]) for line in found] == [3, 4, 7, 9, 11, 17]
    # parts that are right, each for itself, are tried as well
    text = "[sheet]\nwidht = 1\n[wave]\nwidth = 0.2\n[growth]\nalpha = 0.1\n[run]\nrtol = 3\n"
    assert [line.partition("]")[0] for line in mistakes_of(text)] == [
        "2: [sheet",
        "4: [wave",
        "8: [run",
    ]


def test_lines_of_keys() -> None:
    text = '[a]\nb = 1\n"c" = 2\na.d = 3\n[a.e]\nf = 4\n# f = 5\n[[a.g]]\nh = 1\n'
    places = {
        ("a",): 1, ("a", "b"): 2, ("a", "c"): 3, ("a", "e", "f"): 6, ("a", "e", "x"): 5,
        ("a", "g", 0, "h"): 9, ("z",): 0, ("a", "nothing"): 1,
    }  # fmt: skip
    assert {place: line_of(text, place) for place in places} == places


@pytest.mark.parametrize("name", ["inchworm", "hole", "bumpy"])
def test_a_file_that_was_cut_off_is_a_scene_or_refused(name: str) -> None:
    """Nothing but SceneFileError, wherever it ends."""
    text = gallery.text(name)
    start, rng = text.index("[sheet]"), np.random.default_rng(0)
    for end in rng.integers(start, text.rindex("[ground" if name == "bumpy" else "["), 40):
        with pytest.raises(SceneFileError):
            parsed(text[: int(end)] + "\n[run]\nrtol = 5\n", HERE)


@examples(150)
@given(st.sampled_from(["hydrogel", "viscous", "paper"]), st.data())
def test_a_damaged_file_is_a_scene_or_refused(name: str, data: Any) -> None:
    text = gallery.text(name)
    at = data.draw(st.integers(text.index("[sheet]"), len(text) - 1))
    changed = text[:at] + data.draw(st.text(max_size=3)) + text[at + data.draw(st.integers(0, 9)) :]
    try:
        found: Any = parsed(changed, HERE).scene
    except SceneFileError as refused:
        found = refused
    lines = getattr(found, "mistakes", None)
    assert isinstance(found, Scene) if lines is None else lines
    assert all(line.startswith("scene.toml") for line in lines or ())


@pytest.mark.parametrize(
    "unit", ["m/0", "m**9**9**9**9", "(9**9)**9", "m**1000", "1/", "__import__", "m" * 99]
)
def test_what_is_no_unit_is_refused_at_once(unit: str) -> None:
    (found,) = mistakes_of(f'[sheet]\nlength = "40 {unit}"\n[growth]\nalpha = 0.1')
    assert "is not a known unit" in found


def test_a_mark_at_the_start_of_a_file_is_no_mistake(tmp_path: Path) -> None:
    """As some editors on Windows leave it."""
    path = tmp_path / "a.toml"
    path.write_text(gallery.text("paper"), encoding="utf-8-sig")
    assert read(path).scene == parsed(gallery.text("paper"), path).scene


def test_many_mistakes_are_counted_in_bounded_time() -> None:
    keys = "\n".join(f"key{n} = {n}" for n in range(20_000))
    tables = "\n".join(f"[table{n}]" for n in range(5_000))
    start = time.process_time()
    found = mistakes_of(f"[growth]\nalpha = 0.1\n[sheet]\n{keys}\n{tables}")
    assert time.process_time() - start < 10  # 20 mistakes of a table are looked up, not 25 000
    assert len(found) == 41
    assert found[-1] == " has 24960 more mistakes"


def test_a_file_without_an_end_is_refused() -> None:
    with pytest.raises(SceneFileError, match="/dev/zero: is larger than 50 MB"):
        read("/dev/zero")


@pytest.mark.parametrize("size", ["1e200 mm", "1e-200 mm"])
def test_sizes_whose_squares_are_no_numbers_are_refused(size: str) -> None:
    (found,) = mistakes_of(BASE.replace('"40 mm"', f'"{size}"'))
    assert "length = " in found
    assert "must be in [1e-100, 1e+100]" in found


def test_what_is_no_file_of_text_is_refused(tmp_path: Path) -> None:
    binary = tmp_path / "a.toml"
    binary.write_bytes(b"\xff\xfe\x00[sheet]")
    cases = {
        binary: "is not TOML: it is no text in UTF-8",
        tmp_path: "is a folder, must be a scene file",
    }
    cases[tmp_path / "none.toml"] = "there is no such file"
    cases[binary / "b.toml"] = "cannot be read: Not a directory"
    for path, words in cases.items():
        with pytest.raises(SceneFileError, match=words):
            read(path)
    with pytest.raises(SceneFileError, match="cannot be read"):
        read("a\0b.toml")
    assert mistakes_of("[sheet\nlength = 1") == ["1: is not TOML: Expected ']' at the end of a table "
                                                 "declaration at column 7"]  # fmt: skip
    assert "is not TOML" in mistakes_of("a = " + "[" * 5000)[0]
    assert "at its end" in mistakes_of('a = """')[0]
