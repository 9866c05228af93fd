"""Uneven ground: derivatives by differences, from expressions and by hand; what is refused."""

import math
import pickle
import types
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import sympy
from numpy.typing import NDArray
from scipy.interpolate import RectBivariateSpline

from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.terrain import Terrain
from fem_check.shell.stepping.simulation import simulate
from linear_theory import Sheet
from linear_theory.identity.content import content_key
from linear_theory.scene.scene import Scene
from tests.shell.shell_scenes import lying

pytestmark = pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
Array = NDArray[np.float64]
X, Y = sympy.symbols("x y")
HEIGHTS = {
    "waves": 0.05 * sympy.sin(7 * X + 1) * sympy.cos(5 * Y),
    "short waves": 0.001 * sympy.sin(100 * X + 60 * Y),
    "hill": 0.3 / (1 + 4 * (X - sympy.Rational(1, 5)) ** 2 + 9 * Y**2),
    "slope": X / 5 - Y / 7,
    "saddle far above": 1000 + X * Y + X**2 / 3 - Y**2 / 2,
}
RNG = np.random.default_rng(1)
POINTS = RNG.uniform(-1, 1, (2, 200))


def exact(expression: Any, x: Array, y: Array) -> Array:
    """The six rows by sympy, one number after the other."""
    f = expression
    rows = (f, f.diff(X), f.diff(Y), f.diff(X, 2), f.diff(Y, 2), f.diff(X, Y))
    pairs = list(zip(x, y, strict=True))
    return np.array([[float(r.evalf(20, {X: a, Y: b})) for a, b in pairs] for r in rows])


def plain(expression: Any) -> Callable[[Array, Array], Any]:
    return sympy.lambdify((X, Y), expression)


def by_hand(expression: Any, wrong: int | None = None) -> Callable[[Array, Array], Array]:
    """The six rows; one of them too large by a hundredth if it is wrong."""
    f = expression
    rows = [plain(r) for r in (f, f.diff(X), f.diff(Y), f.diff(X, 2), f.diff(Y, 2), f.diff(X, Y))]
    factors = np.ones(6)
    if wrong is not None:
        factors[wrong] = 1.01
    return lambda x, y: np.stack([c * r(x, y) + 0 * x for c, r in zip(factors, rows, strict=True)])


@pytest.mark.parametrize("name", HEIGHTS)
def test_derivatives_of_a_function_and_of_an_expression(name: str) -> None:
    expression = HEIGHTS[name]
    x, y = POINTS[:, :50]
    expected = exact(expression, x, y)
    symbolic, differences = Terrain(expression), Terrain(plain(expression), length=1.0)
    size = np.abs(expected).max(1, keepdims=True) + np.abs(expected[0]).max()
    wrong, symbolic_wrong = (np.abs(t(x, y) - expected) / size for t in (differences, symbolic))
    assert symbolic_wrong.max() < 1e-13  # roundoff of the arguments
    # roundoff of f: 4096 and 4096**2 times 1e-16, of which the weights add up to a few
    allowed = np.array([1e-13, 4e-12, 4e-12, 3e-8, 3e-8, 3e-8])
    assert np.all(wrong.max(axis=1) < allowed)
    for terrain in (symbolic, differences):
        np.testing.assert_array_equal(terrain.values(x, y), terrain(x, y)[0])
        np.testing.assert_allclose(terrain.slopes(x, y), terrain(x, y)[1:3], rtol=1e-15)


@pytest.mark.parametrize("unit", [1e-6, 1e6])
def test_differences_do_not_depend_on_the_unit_of_length(unit: float) -> None:
    f = plain(HEIGHTS["waves"])
    x, y = POINTS
    one = Terrain(f, length=1.0)(x, y)
    other = Terrain(lambda a, b: unit * f(a / unit, b / unit), length=unit)(unit * x, unit * y)
    powers = np.array([1, 0, 0, -1, -1, -1])[:, None]
    np.testing.assert_allclose(other / unit**powers, one, rtol=1e-6, atol=1e-8)


def on(height: object, cells: tuple[int, int] = (1, 2)) -> Scene:
    scene = lying(cells=cells)
    effects = [replace(e, height=height) if isinstance(e, Ground) else e for e in scene.effects]
    return scene.but(effects=tuple(effects))


def test_a_bumpy_floor_in_three_spellings_is_one_floor() -> None:
    """The sheet, a few thicknesses of wave under it, takes the same steps on all of them."""
    bumps = 0.02 * sympy.cos(9 * X + 1) * sympy.sin(8 * Y)
    runs = [
        simulate(on(height), periods=1, steps=6)
        for height in (bumps, plain(bumps), by_hand(bumps), Terrain(by_hand(bumps), name="bumps"))
    ]
    assert np.ptp(runs[0].positions(1.5)[2]) > 0.02
    for run in runs[1:]:
        # minimisations leave 1e-8 of the size; slopes by differences are right to 1e-13
        np.testing.assert_allclose(run.positions(1.5), runs[0].positions(1.5), atol=1e-8)
        assert run.speed.mean == pytest.approx(runs[0].speed.mean, rel=1e-6)


@pytest.mark.parametrize(
    "height",
    [lambda x, y: 0.3, lambda x, y: 0.3 + 0 * x, sympy.Rational(3, 10), lambda x, y: np.array([0.3])],
    ids=["number", "array", "expression", "one entry"],
)
def test_a_floor_at_another_height_lifts_the_sheet(height: object) -> None:
    flat, lifted = (simulate(on(h), periods=1, steps=4) for h in (None, height))
    rise = np.array([0, 0, 0.3])[:, None]
    np.testing.assert_allclose(lifted.positions(1.5) - rise, flat.positions(1.5), atol=1e-8)


def test_whole_numbers_are_heights() -> None:
    steps = Terrain(lambda x, y: np.zeros(np.shape(x), int), length=1.0)
    np.testing.assert_array_equal(steps(*POINTS), np.zeros((6, 200)))
    np.testing.assert_array_equal(Terrain(lambda x, y: np.ones((6, 1)))(*POINTS), np.ones((6, 200)))


@pytest.mark.parametrize("row", range(1, 6))
@pytest.mark.parametrize("name", ["waves", "hill"])
def test_wrong_derivatives_are_refused_with_their_place(row: int, name: str) -> None:
    names = ("f", "f_x", "f_y", "f_xx", "f_yy", "f_xy")
    on(by_hand(HEIGHTS[name]))
    with pytest.raises(ValueError, match=rf"at x = .*, y = .* {names[row]} is .* by differences"):
        on(by_hand(HEIGHTS[name], row))


def test_exchanged_rows_and_signs_are_refused() -> None:
    rows = by_hand(HEIGHTS["waves"])
    for order in ([0, 2, 1, 3, 4, 5], [0, 1, 2, 3, 5, 4]):
        with pytest.raises(ValueError, match="by differences"):
            on(lambda x, y, order=order: rows(x, y)[order])
    with pytest.raises(ValueError, match="f_x is"):
        on(lambda x, y: np.stack([0.1 * x, -0.1 + 0 * x, 0 * x, 0 * x, 0 * x, 0 * x]))
    with pytest.raises(ValueError, match="f_xx is 0, must be 2 by differences"):
        on(lambda x, y: np.stack([x**2, 2 * x, 0 * x, 0 * x, 0 * x, 0 * x]))


def test_right_derivatives_on_both_sides_of_a_kink_are_accepted() -> None:
    """Differences are not sure across a kink, and do not contradict there."""
    zero = lambda x: 0 * x  # noqa: E731
    on(lambda x, y: np.stack([0.1 * abs(y), zero(x), 0.1 * np.sign(y), zero(x), zero(x), zero(x)]))


CORNERS = {
    "roof": lambda x, y: 0.1 * np.abs(y - 0.1),
    "oblique roof": lambda x, y: 0.01 * np.abs(y - 0.3 * x),
    "step": lambda x, y: np.where(y > 0.3, 0.1, 0.0),
    "stairs": lambda x, y: 0.1 * np.floor(5 * y),
    "cone": lambda x, y: 0.1 * np.hypot(x, y),
    "single precision": lambda x, y: np.sin(3 * x).astype(np.float32) + 0 * y,
}


@pytest.mark.parametrize("name", CORNERS)
def test_functions_that_are_not_smooth_are_refused(name: str) -> None:
    with pytest.raises(ValueError, match=r"height: at x = .* its slope jumps; smooth it, or give"):
        on(CORNERS[name])


def test_a_measured_terrain_as_a_cubic_spline() -> None:
    """Whose third derivatives jump: slopes are right to 1e-7."""
    x, y = np.linspace(-2, 2, 41), np.linspace(-3, 3, 61)
    spline = RectBivariateSpline(x, y, 0.02 * np.sin(5 * x[:, None]) * np.cos(4 * y))
    scene = on(spline.ev)
    terrain = scene.find(Ground).height
    expected = [spline.ev(*POINTS, dx=1), spline.ev(*POINTS, dy=1)]
    np.testing.assert_allclose(terrain.slopes(*POINTS), expected, atol=1e-7)
    assert content_key(scene.find(Ground)) == content_key(on(spline.ev).find(Ground))


@pytest.mark.parametrize(
    ("height", "message"),
    [
        (0.1, r"height = 0.1: must be a function"),
        ("x + y", "must be a function"),
        (lambda x: x, r"height has the signature \(x\): must be \(x, y\)"),
        (lambda x, y, t: x, r"height has the signature \(x, y, t\): must be \(x, y\)"),
        (np.sin, "height has the signature of 1 arguments"),
        (X + sympy.Symbol("z"), r"no symbols but x and y, has \['z'\]"),
        (sympy.Eq(X, Y), "must be an expression with a value"),
        (sympy.Abs(X), "must be smooth, but f_xx = 2*"),
        (sympy.Function("g")(X), "must be smooth, but f_x = Derivative"),
    ],
)
def test_heights_that_are_refused_at_once(height: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Ground(1.0, height=height)
    for options in ({"length": 0.0}, {"name": ""}):
        with pytest.raises(ValueError, match=next(iter(options))):
            Terrain(X, **options)


@pytest.mark.parametrize(
    ("height", "message"),
    [
        (lambda x, y: math.sin(x) + y, "must take arrays x, y"),
        (lambda x, y: x if x > 0 else y, "must take arrays x, y"),
        (lambda x, y: x + 1j, "dtype complex128: must be real"),
        (lambda x, y: np.zeros((3, np.size(x))), r"shape \(3, 7\) at 7 points: must be \(7,\)"),
        (lambda x, y: np.where(y > 0.6, np.nan, 0.0), "it is not finite"),
        (sympy.sqrt(sympy.Rational(6, 10) - Y), "it is not finite"),
    ],
)
@pytest.mark.filterwarnings("ignore:invalid value")
def test_heights_that_are_refused_in_a_scene(height: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        on(height)


def test_differences_need_a_length() -> None:
    ground = Ground(1.0, height=plain(HEIGHTS["waves"]))
    with pytest.raises(ValueError, match="need the length of the sheet"):
        ground.height(*POINTS)


def test_a_scene_checks_its_ground_once_per_sheet(monkeypatch: pytest.MonkeyPatch) -> None:
    calls = []

    def height(x: Array, y: Array) -> Array:
        calls.append(np.size(x))
        return 0 * x

    scene = on(height)
    count = len(calls)
    again = scene.but(alpha=0.01)
    assert len(calls) == count
    assert again.find(Ground).height is scene.find(Ground).height
    on(height)
    assert len(calls) > count


def test_terrains_are_pickled_and_known_by_content() -> None:
    terrain = Terrain(HEIGHTS["hill"]).under(Sheet())
    copy = pickle.loads(pickle.dumps(terrain))
    np.testing.assert_array_equal(copy(*POINTS), terrain(*POINTS))
    assert copy == terrain
    assert content_key(copy) == content_key(terrain)
    keys = {
        content_key(Terrain(h, name=n))
        for h, n in ((X, None), (Y, None), (types.SimpleNamespace.__call__, "a"), (pow, "b"))
    }
    assert len(keys) == 4
