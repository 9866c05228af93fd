"""How public objects and results show themselves, and the plain data that they give."""

import html
import inspect
import json
import re
import tempfile
import typing
from decimal import Decimal
from functools import cache, partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import fem_check
import linear_theory
from fem_check.shell.cycle.frame import BodyFrame
from fem_check.shell.cycle.shapes import cycle_of_shapes
from fem_check.shell.cycle.speed import Cycle
from fem_check.shell.effects.loads import EdgeMoment
from fem_check.shell.kinematics.rates import Affine
from fem_check.shell.kinematics.surface import AnnulusSector, Cylinder, Flat, SpherePart
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.equilibrium import Equilibrium
from fem_check.shell.stepping.further.progress import Progress
from linear_theory.common.shown import LINES, WIDTH, Shown, in_words, number, with_error
from linear_theory.friction.law import Response
from linear_theory.growth.bilayer import Couplings
from linear_theory.speed.plate.quadratic_form import QuadraticForm
from tests.robust.drawn_examples import examples

PACKAGES = (linear_theory, fem_check)

SHEET, SINE = linear_theory.Sheet(), linear_theory.SineWave()
MATERIAL = fem_check.Material(thickness=0.03, poisson=0.5)
MEMBRANE = fem_check.Membrane(MATERIAL)


def lopsided(x, y, t):
    """Growth that turns the sheet."""
    return (1 + 2 * x) * np.sin(2 * np.pi * (y - t))


@cache
def trajectory():
    effects = [MEMBRANE, fem_check.Gravity(3e-6), fem_check.Friction(1.0, slip_speed=0.005)]
    scene = fem_check.Scene(SHEET, SINE, alpha=0.1, effects=effects, cells=(1, 2))
    return fem_check.simulate(scene, periods=1, rtol=0.1)


def full_scene():
    """With every effect that a scene can name."""
    effects = [
        MEMBRANE,
        fem_check.Bending(MATERIAL),
        fem_check.Gravity(2.5e-4),
        fem_check.Ground(0.5, height=fem_check.Terrain(lambda x, y: 0.01 * np.cos(6 * x))),
        fem_check.Friction(0.7, slip_speed=0.01),
        fem_check.Inertia(1.0, MATERIAL),
        fem_check.DeadLoad((0.0, 0.0, 1e-9)),
    ]
    return fem_check.Scene(SHEET, SINE, alpha=0.1, curvature_coupling=10, effects=effects, cells=(2, 4))


@cache
def sunk():
    """Of one motion thrice, as if its ground gave no more."""
    contact = [fem_check.Gravity(2.5e-4), fem_check.Ground(0.5), fem_check.Friction(1.0, 0.001)]
    effects = [MEMBRANE, fem_check.Bending(MATERIAL), *contact]
    scene = fem_check.Scene(SHEET, SINE, alpha=0.02, effects=effects, cells=(1, 2))
    motion = fem_check.simulate(scene, periods=1, rtol=0.5)
    return fem_check.RigidGround((motion,) * 3, 0.1, 1.0)


def many_harmonics():
    return linear_theory.TravellingWave(np.linspace(1, 0.1, 40), np.zeros(40))


@cache
def turning():
    wave = linear_theory.FieldWave(lopsided, period=1.0)
    return linear_theory.crawl_speed(SHEET, wave, alpha=0.25, rtol=5e-2)


@cache
def speed():
    return linear_theory.crawl_speed(SHEET, SINE, alpha=0.25, rtol=1e-2)


def measured():
    y, t = np.linspace(-0.5, 0.5, 12), np.arange(10) / 10
    c = np.sin(2 * np.pi * (y[:, None] - t)) + 0.1 * np.cos(40 * y[:, None] * t)
    return linear_theory.SampledWave(y, t, c, period=1.0)


@cache
def field(kind):
    if kind == "AirySeries":
        return linear_theory.airy_series(SHEET, SINE, rtol=1e-3)
    if kind == "RitzField":
        return linear_theory.ritz_field(SHEET, SINE, rtol=1e-3)
    if kind == "PlaneStressField":
        return fem_check.plane_stress_field(SHEET, SINE, degree=2)
    return linear_theory.deformation.second.field.second_order_field(SHEET, SINE, rtol=1e-2)


def planar(**arguments):
    return fem_check.Scene(SHEET, SINE, alpha=0.1, effects=[MEMBRANE], **arguments)


@cache
def shapes():
    return cycle_of_shapes(planar(cells=(1, 2)), 8)


@cache
def swept():
    scene = linear_theory.Scene(SHEET, SINE, alpha=0.1)
    path = Path(tempfile.mkdtemp()) / "speeds.sqlite"
    return fem_check.sweep(
        scene, {"growth.alpha": [0.1, 0.2]}, path, level="strip", rtol=0.1, workers=1
    )


@cache
def optimum():
    scene = linear_theory.Scene(SHEET, SINE, alpha=0.1)
    return fem_check.optimise(
        scene,
        {"growth.alpha": (0.1, 0.2)},
        level="strip",
        starts=1,
        constraints={"power": fem_check.Bound(at_most=0.07)},
        robust=fem_check.Robust({"friction.law": ["dry", "viscous"]}),
    )


PARTS_OF_OPTIMUM = ("Certificate", "Check", "Limited", "Regime", "Scale", "Speed", "Start")


def part_of_optimum(name):
    found = optimum()
    parts = (found.certificate, found.check, found.objective, found.starts[0], found.scale)
    parts += (found.limits[0], found.regimes[0])
    return next(part for part in parts if type(part).__name__ == name)


def potential():
    model = ShellModel(planar(cells=(1, 2)))
    return model.potential(model.rest(0.1))


@cache
def excited():
    """A wave of two cycles."""
    found = fem_check.excitable_preset("nu = -0.1").on(SHEET, 150.0, 5e-2)
    assert found.cycles.count == 2
    return found


def excited_scene():
    return linear_theory.Scene(SHEET, excited(), alpha=0.1)


@cache
def excited_orbit():
    orbit = excited().periodic()
    assert orbit.uniform
    return orbit


def fed_back():
    """A wave that the strain acts back on."""
    equation = fem_check.excitable_preset("printed").but(feedback=fem_check.StrainFeedback(0.1))
    return equation.on(SHEET, 40.0, 0.1)


def scene_of_gradient():
    """Dry friction of a sine."""
    return linear_theory.Scene(SHEET, SINE, alpha=0.25)


MADE = {
    "AiryAmplitudes": lambda: field("AirySeries").amplitudes([0.1, 0.3]),
    "AirySeries": lambda: field("AirySeries"),
    "AnnulusSector": AnnulusSector,
    "Bending": lambda: fem_check.Bending(MATERIAL),
    "Bound": lambda: fem_check.Bound(at_most=1.0),
    "Blocks": lambda: potential().hessian_blocks(
        ShellModel(planar(cells=(1, 2))).discretisation.zeros()
    )[0],
    "BodyFrame": lambda: BodyFrame.of(shapes()),
    "Contact": linear_theory.Contact,
    "CostGradient": lambda: linear_theory.cost_gradient(scene_of_gradient(), "alpha", rtol=1e-2),
    "Coulomb": linear_theory.Coulomb,
    "Couplings": lambda: fem_check.bilayer(0.2, 0.03),
    "CrawlSpeed": lambda: linear_theory.crawl_speed(SHEET, SINE, alpha=0.25, rtol=1e-2),
    "CrawlSpeed at rest": lambda: linear_theory.crawl_speed(SHEET, SINE, alpha=0.0),
    "CrawlSpeed turning": turning,
    "CycleSpeeds": lambda: fem_check.speeds(excited_scene(), body="line"),
    "CycleWave": lambda: excited().cycle(0),
    "Cycles": lambda: excited().cycles,
    "BackwardDifferences": lambda: fem_check.BackwardDifferences(0.01),
    "Affine": lambda: Affine(30.0, np.zeros((2, 5))),
    "Cycle": lambda: Cycle(planar()),
    "Cylinder": lambda: Cylinder(0.5),
    "DeadLoad": lambda: fem_check.DeadLoad((0.0, 1.0)),
    "Discretisation": lambda: ShellModel(full_scene()).discretisation,
    "EdgeMoment": lambda: EdgeMoment(0.1),
    "Equilibrium": lambda: Equilibrium(np.zeros(8), 1.0, 3, 1e-9, 0.1),
    "Equilibrium buckled": lambda: Equilibrium(np.zeros(8), 1.0, 3, 1e-9, 0.1, -0.1, np.ones(8)),
    "BestCouplings": lambda: made("QuadraticForm").best(0.1, 0.1),
    "Estimate": lambda: linear_theory.Estimate(0.1, 0.01),
    "Excitation": excited,
    "Excitation not solved": lambda: fem_check.Excitation(
        fem_check.excitable_preset("printed"), SHEET, 60.0
    ),
    "ExcitationDrive": lambda: excited().on(SHEET),
    "Exp": linear_theory.Exp,
    "FieldWave": lambda: linear_theory.FieldWave(lambda x, y, t: np.sin(y - t), 1.0, name="a & <b>"),
    "FieldDrive": lambda: linear_theory.FieldWave(lopsided, period=1.0).on(SHEET),
    "FeedbackDrive": lambda: fed_back().on(SHEET),
    "FollowedDrive": lambda: fed_back().on(SHEET).followed(),
    "SpeedGradient": lambda: linear_theory.speed_gradient(scene_of_gradient(), "alpha", rtol=1e-2),
    "SpeedGradient of many": lambda: linear_theory.speed_gradient(
        scene_of_gradient(), [f"wave.sine.{k}" for k in range(9)], rtol=1e-2
    ),
    "StrainFeedback": lambda: fem_check.StrainFeedback(0.1),
    "FitzHughNagumo": lambda: fem_check.excitable_preset("pulse train"),
    "FractionalDrive": lambda: linear_theory.FractionalWave(SINE, 1.5).on(SHEET),
    "FractionalWave": lambda: linear_theory.FractionalWave(SINE, 1.5),
    "FitUncertainty": lambda: measured().uncertainty,
    "Flat": Flat,
    "Friction": lambda: fem_check.Friction(0.7, 0.01),
    "FrictionField": lambda: linear_theory.friction_field(field("AirySeries"), 0.1, [0.1, 0.2], 0, 0.1),
    "Gravity": lambda: fem_check.Gravity(2.5e-4),
    "Ground": lambda: fem_check.Ground(0.5),
    "HeightMap": lambda: fem_check.HeightMap(np.zeros((9, 9)), 1.0, 2.0),
    "Growth": lambda: linear_theory.Growth(0.25),
    "Inertia": lambda: fem_check.Inertia(1.0, MATERIAL),
    "SelfContact": lambda: fem_check.SelfContact(MATERIAL),
    "Directional": lambda: linear_theory.Directional(0.5, 1.5, 0.7, 0.2),
    "DirectionalResponse": lambda: linear_theory.Directional(0.5, 1.5).at(np.ones((2, 3))),
    "GivenMap": lambda: linear_theory.GivenMap(lambda x, y: 1.0),
    "Mapped": lambda: linear_theory.Mapped(linear_theory.Coulomb(), patches()),
    "OnLowerFace": lambda: linear_theory.OnLowerFace(linear_theory.Coulomb()),
    "Patches": lambda: patches(),
    "IsotropicResponse": lambda: linear_theory.Tanh(0.1).at(np.ones((2, 3))),
    "Limit": lambda: sunk().limit,
    "Linear": linear_theory.Linear,
    "Material": lambda: MATERIAL,
    "Membrane": lambda: MEMBRANE,
    "Metric": linear_theory.Metric,
    "Newmark": lambda: fem_check.Newmark(step=5e-3),
    "Motion": lambda: field("PlaneStressField").motion([0.0, 0.1], None, 2),
    "Outline": lambda: fem_check.Outline.trapezoid(0.6, 0.4, 1.0),
    "Outline with a hole": lambda: fem_check.Outline(
        [[0, 0], [1, 0], [0, 1]], [[[0.1, 0.1], [0.2, 0.1], [0.1, 0.2]]]
    ),
    "Path": lambda: linear_theory.rigid_path(turning(), periods=20),
    "PeriodicExcitation": excited_orbit,
    "OrbitUncertainty": lambda: excited_orbit().uncertainty,
    "PlaneStressField": lambda: field("PlaneStressField"),
    "PolynomialDrive": lambda: measured().on(SHEET),
    "PolynomialWave": lambda: measured().smooth,
    "Poses": lambda: trajectory().path.seen_from(0),
    "SteppedPath": lambda: trajectory().path,
    "Potential": potential,
    "Prediction": lambda: fem_check.predict(SHEET, SINE, alpha=0.05, rtol=0.1),
    "RunSettings": lambda: fem_check.RunSettings(steps=64),
    "Progress": lambda: Progress(0.1, 2.0, 7, 0, 1.0, 20.0),
    "Region": lambda: ShellModel(full_scene()).discretisation.interior,
    "Record": lambda: next(swept().rows())[1],
    "Response": lambda: Response(linear_theory.Coulomb(), np.ones((2, 3))),
    "Robust": lambda: fem_check.Robust({"friction.law": ["dry", "viscous"]}),
    "RigidGround": sunk,
    "RestState": lambda: ShellModel(planar()).rest(0.2),
    "RigidSpeed": lambda: turning().turning,
    "RitzField": lambda: field("RitzField"),
    "SampledWave": measured,
    "Scale": lambda: linear_theory.Scale(0.04, 8.0),
    "Scene": full_scene,
    "Scene on a mesh": lambda: planar(mesh=fem_check.Outline.trapezoid(0.5, 0.5, 1.0).mesh(0.3)),
    "QuadraticForm": lambda: linear_theory.second_order(SHEET, SINE, rtol=0.1).coefficients,
    "SecondOrder": lambda: linear_theory.second_order(SHEET, SINE, rtol=0.1),
    "SecondOrderField": lambda: field("SecondOrderField"),
    "Shapes": shapes,
    "Sheet": lambda: SHEET,
    "SineWave": lambda: SINE,
    "Spectrum": lambda: field("PlaneStressField").drive.rates,
    "SpeedErrors": lambda: trajectory().errors,
    "SpherePart": lambda: SpherePart(1.0),
    "Terrain": lambda: fem_check.Terrain(lambda x, y: 0 * x),
    "Sweep": swept,
    "Tanh": lambda: linear_theory.Tanh(0.1),
    "TimeFactors": lambda: many_harmonics().factors([0.0, 0.1]),
    "Tolerance": lambda: linear_theory.Tolerance(1e-3),
    "Trajectory": trajectory,
    "TravellingDrive": lambda: field("PlaneStressField").drive,
    "TravellingWave": lambda: linear_theory.TravellingWave([1.0, 0.5], [0.0, 0.0]),
    "TravellingWave of many": many_harmonics,
    "Viscous": linear_theory.Viscous,
    "Works": lambda: trajectory().power,
    "EnergySI": lambda: linear_theory.Scale(0.04, 8.0).energy(speed(), 2e-3, 0.4),
    "GrowthPower": lambda: speed().growth_power(1e-2),
    "Harmonics": lambda: fem_check.Harmonics(3, largest=1.0),
    "Optimum": optimum,
    **{name: partial(part_of_optimum, name) for name in PARTS_OF_OPTIMUM},
}
"""One of each public type and of what their calls return; what follows a space tells variants apart."""


@cache
def made(name):
    return MADE[name]()


def is_ours(kind):
    return isinstance(kind, type) and kind.__module__.split(".")[0] in ("linear_theory", "fem_check")


def named_in(annotation):
    """Our classes in a type annotation."""
    found = {annotation} if is_ours(annotation) else set()
    return found.union(*(named_in(part) for part in typing.get_args(annotation)), set())


def returned_by(function):
    function = inspect.unwrap(function)
    if "Rational" in str(function.__annotations__.get("return")):
        return set()  # a type of sympy, imported for the checker alone
    return named_in(typing.get_type_hints(function).get("return"))


def functions_of(kind):
    """Public methods and properties."""
    for name in dir(kind):
        member = inspect.getattr_static(kind, name)
        function = getattr(member, "fget", None) or getattr(member, "func", None)
        function = function or getattr(member, "__func__", member)
        if not name.startswith("_") and inspect.isfunction(function):
            yield function


def patches():
    return linear_theory.Patches([(-0.3, 0.3, -0.5, 0.0, 2.0)], edge=0.02)


def public_types():
    """Classes that a user can get in hand: public ones, and all that calls of public names return."""
    public = [getattr(package, name) for package in PACKAGES for name in package.__all__]
    waiting = [v for v in public if isinstance(v, type)]
    for function in filter(inspect.isroutine, public):
        waiting += returned_by(function)
    found = set()
    while waiting:
        kind = waiting.pop()
        if kind not in found:
            found.add(kind)
            waiting += [kind for f in functions_of(kind) for kind in returned_by(f)]
    bare = {k for k in found if inspect.isabstract(k) or getattr(k, "_is_protocol", False)}
    return {kind for kind in found - bare if not issubclass(kind, Exception | str)}


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
