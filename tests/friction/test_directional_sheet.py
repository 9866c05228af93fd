"""Friction with a direction, and maps of it, under sheets: against brute force, and level by level."""

import math
from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize

from fem_check import Friction, Gravity, Material, Membrane, Scene, cycle_speed, simulate
from fem_check.shell.kinematics.rates import Affine, Step
from linear_theory import (
    Contact,
    Coulomb,
    CrawlSpeed,
    Directional,
    FieldWave,
    GivenMap,
    Mapped,
    Patches,
    RitzField,
    Sheet,
    SineWave,
    Tanh,
    Viscous,
    crawl_speed,
    friction_field,
    line_balance,
    rigid_path,
    ritz_field,
)
from linear_theory.balance.crawl import Crawl, first_resolution
from linear_theory.common.pairs import product
from linear_theory.motion.cells import Graded, gauss
from linear_theory.motion.creases import cut
from tests.theory.reference_balance import directional_dissipation

Array = NDArray[np.float64]

ALPHA = 0.1
SLIP = 2e-3


def oblique(x: Array, y: Array, t: float) -> Array:
    return np.sin(2 * np.pi * (y - t)) * (1 + 0.8 * x) + 0.5 * np.cos(2 * np.pi * (x + y - t))


STANDING = FieldWave(lambda x, y, t: np.sin(2 * np.pi * y) * np.sin(2 * np.pi * t) + 0 * x, period=1.0)
BREATH = FieldWave(lambda x, y, t: np.sin(2 * np.pi * t) + 0 * x * y, period=1.0)


@cache
def skewed_field() -> RitzField:
    return ritz_field(Sheet(width=0.6), FieldWave(oblique, period=1.0), rtol=1e-3)


def test_a_cut_integrates_functions_with_a_crease() -> None:
    """|level| and sign(level) for random quadratic levels, against a fine grid."""
    random, n = np.random.default_rng(4), 6
    points, weights = gauss(n).points, gauss(n).weights
    x, y = points[:, None], points[None, :]
    fine = (np.arange(800) + 0.5) / 400 - 1
    for _ in range(8):
        a = random.normal(size=6) * [0.5, 1, 1, 0.3, 0.3, 0.3]

        def level(x: Array, y: Array, a: Array = a) -> Array:
            return a[0] + a[1] * x + a[2] * y + a[3] * x * y + a[4] * x**2 + a[5] * y**2

        values = np.stack([level(x, y), np.ones((n, n))])[:, None]
        cells = Graded(values, np.zeros(1, int), np.ones(1))
        found = cut(cells, lambda v, _: v[0], area=1, halvings=6)
        slow = level(fine[:, None], fine[None, :])
        for function, allowed in ((abs, 2e-5), (np.sign, 8e-3)):
            got = found.integrals((function(found.values[0]) * found.values[1])[None])[0, 0]
            assert abs(got - 4 * function(slow).mean()) < allowed * 4
        area = found.integrals(found.values[1:])[0, 0]
        assert area == pytest.approx(4.0, rel=1e-12)
    assert weights.sum() == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("law", "share"),
    [
        (Directional(0.5, 1.5, 1.0), None),
        (Directional(2.0, 0.7, 0.3, heading=0.6), None),
        (Directional(1.0, 1.0, 0.4, heading=-0.9), None),
        (Directional(0.5, 1.5, 1.0), lambda x, y, t: 1 + 0.6 * np.sin(5 * x + 3 * y + 2 * np.pi * t)),
    ],
    ids=["halves", "turned", "ellipse", "kinetic map"],
)
def test_minimum_by_brute_force(law: Directional, share: object) -> None:
    """No other motion dissipates less, on a fine grid; the motion is that of the least."""
    field, t = skewed_field(), 0.23
    known = law if share is None else Mapped(law, GivenMap(share, kinetic=True))  # type: ignore[arg-type]
    crawl = Crawl(field, ALPHA, Contact(friction=known), first_resolution(1e-3))
    motion = crawl.balance(np.array([t]))
    found = ALPHA * (motion.leading + ALPHA * motion.remainder)[0]

    def waste(q: Array) -> float:
        moved = np.array([*(ALPHA * q[:2]), ALPHA * q[2]])
        return directional_dissipation(field, ALPHA, t, law, moved, (60, 100), share) / ALPHA

    best = minimize(waste, found / ALPHA, method="Nelder-Mead", options={"xatol": 1e-6, "fatol": 1e-12})
    assert waste(found / ALPHA) <= best.fun * (1 + 1e-5)
    np.testing.assert_allclose(found / ALPHA, best.x, atol=6e-3)


@pytest.mark.parametrize("form", [Coulomb(), Tanh(0.02), Viscous()], ids=str)
@pytest.mark.parametrize("alpha", [0.1, -0.1])
def test_stated_errors_hold(form: object, alpha: float) -> None:
    """Against one ten times as accurate; for -alpha the sine is half a period later."""
    law = Directional(0.5, 1.5, 0.6, form=form)  # type: ignore[arg-type]
    fine = crawl_speed(Sheet(), SineWave(), 0.1, friction=law, rtol=3e-4)
    for rtol in (3e-2, 3e-3):
        found = crawl_speed(Sheet(), SineWave(), alpha, friction=law, rtol=rtol)
        assert abs(found.mean - fine.mean) <= found.error + fine.error
        assert found.converged


def test_a_narrow_strip_is_a_line() -> None:
    """Stretch to first order, no sideways slip: the balance of the strip by first-order theory."""
    law = Directional(0.5, 1.5, 1.0)
    strip = crawl_speed(Sheet(width=0.02, poisson=0.0), SineWave(), 0.01, friction=law, rtol=1e-3)
    line = line_balance(SineWave(), 0.01, friction=law, body="strip")
    assert strip.mean == pytest.approx(line.mean, rel=4e-3)


def scene(law: object, wave: object, load: str = "current") -> Scene:
    effects = [
        Membrane(Material(0.03, 0.5)),
        Gravity(3e-6, load=load),
        Friction(1.0, law=law),  # type: ignore[arg-type]
    ]
    return Scene(Sheet(), wave, ALPHA, effects=effects, cells=(2, 4))  # type: ignore[arg-type]


REAR = Patches([(-1, 1, -1, -0.25, 3.0)], edge=0.1)
FEET = GivenMap(lambda x, y, t: 1 + 0.5 * np.sin(2 * np.pi * (y - t) + 1.0), kinetic=True)
RATCHET = Directional(0.5, 1.5, 1.0, form=Tanh(SLIP))

LEVELS = {
    "standing wave": (RATCHET, STANDING, 0.0455),
    "breathing": (RATCHET, BREATH, 0.100),
    "heavy rear": (Mapped(Tanh(SLIP), REAR), SineWave(), 0.0105),
    "feet that grip in turn": (Mapped(Tanh(SLIP), FEET), SineWave(), 0.0382),
}
"""Law, wave, and the size of the speed (L/T), to which 4 % below refer."""


@pytest.mark.parametrize("case", LEVELS)
def test_theory_cycle_and_stepper_agree(case: str) -> None:
    law, wave, size = LEVELS[case]
    given = scene(law, wave)
    cycle = cycle_speed(given, rtol=1e-2)
    stepped: CrawlSpeed = simulate(given, periods=1, steps=32).speed
    theory = crawl_speed(Sheet(), wave, ALPHA, friction=law, rtol=1e-2, order=2)
    if case == "breathing":  # r Delta at any strain
        stretch = math.exp(ALPHA) - math.exp(-ALPHA)
        assert cycle.mean == pytest.approx(0.5 * stretch, rel=0.01)
    assert abs(cycle.mean) == pytest.approx(size, rel=0.04)
    assert stepped.mean == pytest.approx(cycle.mean, rel=0.02)
    assert theory.mean == pytest.approx(cycle.mean, rel=0.04)


@pytest.mark.parametrize("wave", [STANDING, BREATH], ids=["standing", "breathing"])
def test_isotropic_friction_leaves_reciprocal_sheets_where_they_are(wave: FieldWave) -> None:
    for law in (Coulomb(), Directional(1.0, 1.0, 0.5)):
        found = crawl_speed(Sheet(), wave, ALPHA, friction=law, rtol=1e-2)
        assert abs(found.mean) <= found.error + 1e-12


def test_an_incline_shifts_the_quantile() -> None:
    """Of a narrow strip: the share that slips downhill bears (backward - slope)/(forward + backward).

    slope: tan(incline)/mu. Against the formula of the sine with the shifted share.
    """
    sheet = Sheet(width=0.05, poisson=0.0)
    slope, forward, backward = 0.3, 0.6, 1.3
    law = Directional(forward, backward, 1.0)
    given = Scene(
        sheet,
        SineWave(),
        0.02,
        contact=Contact(friction=law, slope=slope, load="material"),
        cells=(1, 6),
    )
    found = cycle_speed(given, rtol=3e-2)
    ahead = (backward - slope) / (forward + backward)  # of the load slips forward
    wanted = 0.02 * math.sin(math.pi * (ahead - 0.5))
    assert found.mean == pytest.approx(wanted, abs=0.015 * 0.02)


def test_friction_holds_a_sheet_on_a_slope_by_its_direction() -> None:
    for slope, held in ((0.6, False), (0.4, True), (-1.4, True), (-1.6, False)):
        law = Directional(1.5, 0.5, 1.0)  # slips down a rising ground backward
        given = Scene(Sheet(), SineWave(), 0.0, contact=Contact(friction=law, slope=slope))
        if held:
            assert cycle_speed(given).mean == 0.0
        else:
            with pytest.raises(ValueError, match=r"must be between -1.5 and 0.5"):
                cycle_speed(given)
    tanh = Directional(1.5, 0.5, 1.0, form=Tanh(0.1))
    creeping = Scene(Sheet(), SineWave(), 0.0, contact=Contact(friction=tanh, slope=0.3))
    speed = cycle_speed(creeping).mean  # 0.5 tanh(0.5 v/v0) = 0.3
    assert 0.5 * math.tanh(0.5 * speed / 0.1) == pytest.approx(-0.3)


@pytest.mark.parametrize("fixed_to", ["body", "ground"])
def test_axes_turn_with_the_body_or_stay(fixed_to: str) -> None:
    """Where a sheet turns: theory and cycle know the axes of the body alone."""
    wave = FieldWave(oblique, period=1.0)
    law = Directional(0.5, 1.5, 1.0, fixed_to=fixed_to, form=Tanh(SLIP))  # type: ignore[arg-type]
    given = scene(law, wave)
    if fixed_to == "ground":
        with pytest.raises(ValueError, match=r"fixed to the ground .*; simulate\(scene\) can"):
            crawl_speed(given)
        with pytest.raises(ValueError, match="a sheet that may turn"):
            cycle_speed(given)
        return
    cycle, stepped = cycle_speed(given, rtol=3e-2), simulate(given, periods=1, steps=32)
    path, once = stepped.path, rigid_path(cycle, periods=1)
    turn = np.diff(path.heading[path.times >= stepped.start - 1e-9][[0, -1]])[0]
    assert turn == pytest.approx(once.turn, rel=0.05)
    assert stepped.speed.mean == pytest.approx(once.step[1], rel=0.03)


@pytest.mark.parametrize("tilted", [False, True])
def test_forces_in_axes_that_turned_are_those_of_a_heading(tilted: bool) -> None:
    """On a level and on a slope, where slip counts along the ground; the tangent by differences."""
    random, angle = np.random.default_rng(7), 0.8
    normal = None
    if tilted:
        normal = np.array([[0.2], [-0.5], [1.0]]) * np.ones(9)
        normal /= np.linalg.norm(normal, axis=0)
    v, load = random.normal(size=(3, 9)), random.uniform(1, 2, 9)

    def friction(heading: float, body: float, v: Array) -> tuple[Array, Array]:
        law = Directional(0.5, 1.5, 0.8, heading=heading, form=Tanh(0.5))
        rule = Affine(2.0, np.zeros_like(v))
        step = Step(velocity=rule, load=load, normal=normal, heading=body)
        state: Any = SimpleNamespace(step=step, position=v / 2, components=3, found={})
        effect = Friction(1.0, law=law)
        return effect.force(state), effect.hessian(state)[0, 0]

    force, tangent = friction(0.0, angle, v)
    for found, wanted in zip(friction(angle, 0.0, v), (force, tangent), strict=True):
        np.testing.assert_allclose(found, wanted, atol=1e-13)
    if normal is not None:
        np.testing.assert_allclose((force * normal).sum(0), 0.0, atol=1e-14)
    change, h = random.normal(size=v.shape), 1e-6
    ahead, behind = (friction(0.0, angle, v + s * h * change)[0] for s in (1, -1))
    slope = -(ahead - behind) / (2 * h)
    np.testing.assert_allclose(product(tangent, change) / 2, slope, atol=1e-7)


def test_a_map_weighs_the_forces_of_a_picture() -> None:
    field = ritz_field(Sheet(), SineWave(), rtol=1e-3)
    law = Mapped(Coulomb(), REAR)
    found = friction_field(field, ALPHA, 0.1, [-0.4, 0.4], 0.1, friction=law, rtol=1e-3)
    strain = field.strain(0.1, np.array([-0.4, 0.4]), 0.1)[:2].sum(0)
    sizes = np.hypot(*found.force) / (1 + ALPHA * strain)
    np.testing.assert_allclose(sizes, REAR.values(0.1, [-0.4, 0.4]), rtol=1e-12)
    np.testing.assert_allclose(sizes, [3.0, 1.0], rtol=0.02)


def test_ground_maps_slow_a_sheet_that_meets_them() -> None:
    """Rough ground below the front half."""
    plain = simulate(scene(Tanh(SLIP), SineWave()), periods=1, steps=16)
    ahead = Patches([(-5, 5, 0.0, 5, 3.0)], edge=0.1, fixed_to="ground")
    on_body = Patches([(-5, 5, 0.0, 5, 3.0)], edge=0.1)
    # the sheet hardly moves over the ground in a period: both maps do the same at first
    both = [
        simulate(scene(Mapped(Tanh(SLIP), patches), SineWave()), periods=1, steps=16).speed.mean
        for patches in (ahead, on_body)
    ]
    assert both[0] == pytest.approx(both[1], rel=0.15)
    assert abs(both[0] - plain.speed.mean) > 0.02 * plain.speed.mean


BAD = {
    "on ground": (
        Mapped(Coulomb(), Patches([(0, 1, 0, 1, 2.0)], 0.1, fixed_to="ground")),
        "fixed to the",
    ),
    "negative": (Mapped(Coulomb(), GivenMap(lambda x, y: y)), r"mu = -0.5 at x = .*must be > 0"),
    "period": (
        Mapped(Coulomb(), GivenMap(lambda x, y, t: 2 + np.sin(t) + 0 * x * y, kinetic=True)),
        "must be the same after the period of the wave, 1",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_maps_that_no_level_of_theory_takes(case: str) -> None:
    law, words = BAD[case]
    with pytest.raises(ValueError, match=words):
        crawl_speed(Sheet(), SineWave(), ALPHA, friction=law)


def test_bad_maps() -> None:
    for patch, words in (
        ((0, 1, 0, 1, -2), r"patches\[0\] = .*: mu must be > 0"),
        ((1, 0, 0, 1, 2), "must have x_min < x_max"),
        ((0, 1, 2), "must be x_min, x_max, y_min, y_max, mu"),
    ):
        with pytest.raises(ValueError, match=words):
            Patches([patch], 0.1)
    with pytest.raises(ValueError, match="edge = 0: must be > 0"):
        Patches([], 0.0)
    with pytest.raises(ValueError, match="kinetic = True: must be False"):
        GivenMap(lambda x, y, t: 1.0, fixed_to="ground", kinetic=True)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="must be a law without a map"):
        Mapped(Mapped(Coulomb(), REAR), REAR)
    sloped = Contact(friction=Mapped(Coulomb(), REAR), slope=0.2)
    with pytest.raises(ValueError, match="map of friction on a slope"):
        cycle_speed(Scene(Sheet(), SineWave(), 0.1, contact=sloped))


def _fails(x: object, y: object) -> float:
    raise KeyError("wood")


BAD_MAPS: dict[str, tuple[Any, str]] = {
    "raises": (_fails, r"must give mu > 0; KeyError: 'wood'"),
    "text": (lambda x, y: "a", r"must give mu > 0; mu = .*must be real numbers"),
    "not finite": (lambda x, y: np.nan * y, r"must give mu > 0; mu contains nan"),
    "shape": (
        lambda x, y: np.ones(3),
        r"gives mu of shape \(3,\), must be one that broadcasts .*\(2,\)",
    ),
    "more values": (lambda x, y: np.ones((2, 2)), r"gives mu of shape \(2, 2\), must be"),
}


@pytest.mark.parametrize("name", BAD_MAPS)
def test_a_function_that_is_no_map_is_refused(name: str) -> None:
    function, words = BAD_MAPS[name]
    given = GivenMap(function)
    with pytest.raises(ValueError, match=rf"map = GivenMap\(.*{words}"):
        given.values([0.0, 0.1], 0.2)
    with pytest.raises(ValueError, match="map = GivenMap"):
        crawl_speed(Sheet(), SineWave(), 0.1, friction=Mapped(Coulomb(), given), rtol=0.1)


def test_maps_refuse_what_they_are_not_made_of() -> None:
    bad: Any = "no"
    with pytest.raises(
        ValueError, match=r"function = 3: must be a function, \(x, y\), and t if kinetic"
    ):
        GivenMap(3)  # type: ignore[arg-type]
    with pytest.raises(
        ValueError, match=r"function has the signature \(x, y\): must be \(x, y, t\), as"
    ):
        GivenMap(lambda x, y: 1.0, kinetic=True)
    for function in (lambda x: 1.0, lambda x, y, t: 1.0):
        with pytest.raises(ValueError, match=r"function has the signature .*: must be \(x, y\)"):
            GivenMap(function)
    for name in ("kinetic", "mirrored"):
        with pytest.raises(ValueError, match=rf"{name} = 'no': must be True or False"):
            GivenMap(lambda x, y: 1.0, **{name: bad})
    for patches in (3, "abc", None):
        with pytest.raises(ValueError, match=r"patches = .*must be a list of \(x_min, x_max"):
            Patches(patches, 0.1)  # type: ignore[arg-type]
    for odd in ((0, 1, 0, 1), (0, 1, 0, 1, [2]), 0):
        with pytest.raises(ValueError, match=r"patches\[0\]"):
            Patches([odd], 0.1)  # type: ignore[list-item]
