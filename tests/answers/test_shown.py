"""How public objects and results show themselves, and the plain data that they give."""

import html
import inspect
import json
import re
from decimal import Decimal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import fem_check
import linear_theory
from linear_theory.common.shown import LINES, WIDTH, Shown, in_words, number, with_error
from linear_theory.growth.bilayer import Couplings
from linear_theory.speed.plate.quadratic_form import QuadraticForm
from tests.answers.shown_objects import MADE, is_ours, made, public_types
from tests.answers.shown_parts import MEMBRANE, SHEET, SINE, lopsided
from tests.robust.drawn_examples import examples


def test_one_of_each_public_type_is_made():
    assert {kind.__name__ for kind in public_types()} <= MADE.keys()


def check_shown(value):
    text = repr(value)
    lines = text.splitlines()
    assert len(lines) <= LINES
    assert max(map(len, lines)) <= WIDTH
    assert not re.search(r"0x[0-9a-f]{4}|array\(|np\.float| object at", text)
    assert text == repr(value)
    if isinstance(value, str):
        return  # a name: it is what it says
    table = value._repr_html_()
    assert table.startswith("<table>")
    assert len(table) < 6000
    assert not re.search(r"0x[0-9a-f]{4}|array\(", html.unescape(table))


@pytest.mark.parametrize("name", MADE)
def test_shows_itself_in_a_few_lines(name):
    value = made(name)
    assert type(value).__name__ == name.split()[0]
    assert repr(value).startswith(type(value).__name__)
    check_shown(value)


@pytest.mark.parametrize("name", MADE)
def test_so_does_what_it_holds(name):
    value = made(name)
    names = [n for n in dir(value) if not n.startswith("_") and n != "error"]
    for attribute in (getattr(value, n, None) for n in names):
        parts = attribute if type(attribute) in (tuple, list) else [attribute]
        for part in (p for p in parts if is_ours(type(p))):
            assert isinstance(part, Shown | str) or inspect.ismethod(part), type(part)
            check_shown(part)


@pytest.mark.parametrize("name", MADE)
def test_plain_data_is_json(name):
    value = made(name)
    content = value.to_dict()
    assert json.loads(json.dumps(content, allow_nan=False)) == content
    assert content["type"] == type(value).__name__
    assert len(json.dumps(value.to_dict(arrays=False))) < 5000


def test_internals_of_effects_are_not_shown():
    assert repr(fem_check.Friction(0.7, 0.01)) == "Friction(coefficient=0.7, law=Tanh(slip_speed=0.01))"
    with pytest.raises(TypeError):
        fem_check.Friction(0.7, 0.01, entries=(1,))


def test_value_is_shown_as_its_call():
    assert eval(repr(SHEET), {"Sheet": linear_theory.Sheet}) == SHEET
    assert eval(repr(SINE), {"SineWave": linear_theory.SineWave}) == SINE
    assert eval(repr(MEMBRANE), vars(fem_check)) == MEMBRANE


def test_speed_is_told_in_its_title():
    speed = linear_theory.CrawlSpeed(
        estimate=linear_theory.Estimate(-0.0983, 0.0002),
        model_error=np.nan,
        converged=False,
        times=np.linspace(0, 7.9, 64),
        velocity=np.zeros(64),
        seconds=2.0,
        model="of a test",
        slip_ratio=np.nan,
    )
    assert repr(speed).splitlines() == [
        "CrawlSpeed: mean -0.09830 ± 0.00020 length/time, towards -y, NOT converged",
        "  model_error  unknown",
        "  regime       none",
        "  times        64 values, 0 ... 7.9",
        "  velocity     64 values, 0 ... 0",
        "  seconds      2",
        "  model        of a test",
    ]


@pytest.mark.parametrize(
    ("mean", "error", "words"),
    [(0.1, 0.01, "towards +y"), (-0.1, 0.01, "towards -y"), (0.1, 0.2, "direction not resolved")],
)
def test_direction_is_told_where_it_is_known(mean, error, words):
    assert words in linear_theory.speed.result.speed_in_words(mean, error, True)
    assert "at rest" in repr(made("CrawlSpeed at rest"))


@pytest.mark.parametrize(
    ("value", "error", "words"),
    [
        (0.0983, 0.0002, "0.09830 ± 0.00020"),
        (0.0983, 0.000201, "0.09830 ± 0.00021"),  # an error is never rounded down
        (-1234.567, 98.1, "-1235 ± 99"),
        (-1234.567, 980.1, "-1230 ± 990"),
        (1.23456e-9, 2e-12, "1.2346e-9 ± 2.0e-12"),
        (1.5, 0.0, "1.5"),
        (0.0, 3e-9, "0 ± 3.0e-9"),
        (np.float64(1e9), np.float64(1e-20), "1000000000.0 ± 1.0e-20"),
        (1.5, np.nan, "1.5 ± unknown"),
        (np.nan, np.inf, "unknown ± inf"),
    ],
)
def test_number_with_its_error(value, error, words):
    assert with_error(value, error).replace("E", "e") == words


@examples(100)
@given(st.floats(-1e9, 1e9), st.floats(1e-12, 1e9))
def test_number_with_its_error_says_what_it_is(value, error):
    first, second = (Decimal(part) for part in with_error(value, error).split(" ± "))
    assert Decimal(error) * (1 - Decimal("1e-15")) <= second <= Decimal(error) * Decimal("1.1001")
    assert abs(first - Decimal(repr(value))) <= Decimal("0.051") * second


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (np.arange(64) / 8, "64 values, 0 ... 7.875"),
        (np.ones((3, 5)), "3 x 5 values, 1 ... 1"),
        (np.array([0.5, np.nan, 2.0, np.inf, 1]), "5 values, 0.5 ... 2, 2 not finite"),
        (np.full(9, np.nan), "9 values, none finite"),
        (np.zeros((0, 3)), "0 x 3 values"),
        (np.array([1.0, 2.0]), "(1, 2)"),
        (np.array(1.5), "1.5"),
        (np.float64(np.nan), "unknown"),
        ((1, 0.5), "(1, 0.5)"),
        (tuple(range(20)), "20 values"),
        (SINE, "SineWave(count=1, period=1)"),
        (object(), "object object"),
        (lopsided, "function lopsided"),
        ([object], "(object)"),
        (None, "None"),
        ("two\nlines", "two lines"),
    ],
)
def test_value_in_one_line(value, words):
    assert in_words(value) == words


def test_notebooks_get_escaped_text():
    wave = made("FieldWave")
    assert "a &amp; &lt;b&gt;" in wave._repr_html_()
    assert "<b>" not in wave._repr_html_()


def test_plain_data_has_arrays_whole_and_says_what_is_not_known():
    path = made("Path")
    content = path.to_dict()
    assert content["heading"] == path.heading.tolist()
    assert content["position"] == path.position.tolist()
    errors = made("SpeedErrors").to_dict()
    assert errors["mesh"] is None
    viscous = linear_theory.crawl_speed(SHEET, SINE, 0.1, friction="viscous", rtol=1e-2).to_dict()
    assert float(viscous["slip_ratio"]) == np.inf
    assert "heading" not in path.to_dict(arrays=False)
    assert number(np.nan) == "unknown"


def test_scene_gives_its_own_mesh_as_plain_data():
    scene = made("Scene on a mesh")
    mesh = scene.to_dict()["mesh"]
    assert np.array_equal(mesh["vertices"], scene.mesh.p.T)
    assert np.array_equal(mesh["elements"], scene.mesh.t.T)
    assert f"{scene.mesh.t.shape[1]} triangles" in repr(scene)


def test_named_tuples_are_tuples_still():
    alpha, curvature = fem_check.bilayer(0.2, 0.03)
    assert Couplings(alpha, curvature) == (alpha, curvature)
    assert fem_check.bilayer(0.2, 0.03)._replace(alpha=0.0) == (0.0, curvature)


def test_estimates_are_numbers_with_their_error_in_rows_of_results() -> None:
    """As for the expansion of a sheet that bends; to_dict has all digits."""
    one = linear_theory.Estimate(1.5, 0.01)
    form = QuadraticForm(one, one, linear_theory.Estimate(-0.2, 0.001))
    assert repr(one) == "Estimate(1.500 ± 0.010)"
    assert [line.split(maxsplit=1) for line in repr(form).splitlines()[1:4]] == [
        ["alpha", "1.500 ± 0.010"],
        ["alpha_alpha", "1.500 ± 0.010"],
        ["alpha_beta", "-0.2000 ± 0.0010"],
    ]
    assert one.to_dict() == {"type": "Estimate", "value": 1.5, "error": 0.01}
