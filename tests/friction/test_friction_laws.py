"""Laws of friction: potential, force, tangent, difference; and that they are an open set."""

import ast
import itertools
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

import mpmath
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.optimize import minimize

from fem_check import Friction, Gravity, Material, Membrane, Scene, cycle_speed, simulate
from fem_check.shell.cycle.balance import CycleBalance
from fem_check.shell.cycle.shapes import cycle_of_shapes
from fem_check.shell.model import ShellModel
from linear_theory import (
    Contact,
    Coulomb,
    FieldWave,
    FrictionLaw,
    Sheet,
    SineWave,
    Tanh,
    TravellingWave,
    Viscous,
    crawl_speed,
    line_balance,
)
from linear_theory.common.pairs import PAIRS, pairs_among, product

Array = NDArray[np.float64]

EPS = np.finfo(float).eps
RNG = np.random.default_rng(3)


@dataclass(frozen=True)
class ElliptTanh(FrictionLaw):
    """phi(A v), phi the potential of Tanh(slip_speed), A = diag(across, along) turned by `angle`."""

    slip_speed: float
    across: float = 1.0
    along: float = 1.0
    angle: float = 0.0
    name: ClassVar[str] = "elliptic tanh"

    @property
    def width(self) -> float:
        return self.slip_speed / max(self.across, self.along)

    @property
    def even(self) -> bool:
        return self.angle == 0

    def potential(self, v: Array) -> Array:
        return self._law.potential(self._stretched(v))

    def force(self, v: Array) -> Array:
        return self._stretched(self._law.force(self._stretched(v)))

    def tangent(self, v: Array) -> Array:
        full = whole(self._law.tangent(self._stretched(v)), len(v))
        a = self._matrix(len(v))
        return np.stack([*np.einsum("ac,ab...,bd->cd...", a, full, a)[PAIRS[len(v)]]])

    def force_difference(self, v: Array, change: Array, step: float) -> Array:
        moved = self._law.force_difference(self._stretched(v), self._stretched(change), step)
        return self._stretched(moved)

    def scaled(self, factor: float) -> "ElliptTanh":
        return replace(self, slip_speed=self.slip_speed / factor)

    def speed_at(self, share: float) -> float:
        return self.slip_speed / self.along * np.arctanh(share / self.along)

    @property
    def _law(self) -> Tanh:
        return Tanh(self.slip_speed)

    def _stretched(self, v: Array) -> Array:
        return np.einsum("cd,d...->c...", self._matrix(len(v)), v)

    def _matrix(self, components: int) -> Array:
        """Symmetric; heights count as they are."""
        if components == 1:
            return np.array([[self.along]])
        c, s = np.cos(self.angle), np.sin(self.angle)
        turn, found = np.array([[c, -s], [s, c]]), np.eye(components)
        found[:2, :2] = turn @ np.diag([self.across, self.along]) @ turn.T
        return found


LAWS = {
    "coulomb": Coulomb(),
    "tanh": Tanh(0.4),
    "narrow tanh": Tanh(1e-2),
    "wide tanh": Tanh(1e3),
    "viscous": Viscous(2.0),
    "elliptic": ElliptTanh(0.4, 0.7, 2.0),
    "turned": ElliptTanh(0.4, 0.7, 2.0, angle=0.5),
}
COMPONENTS = (1, 2, 3)
every = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)
spaces = pytest.mark.parametrize("components", COMPONENTS)


def whole(tangent: Array, components: int) -> Array:
    """(components, components, ...) from its pairs."""
    full = np.empty((components, components, *tangent.shape[1:]))
    first, second = PAIRS[components]
    full[first, second] = full[second, first] = tangent
    return full


def velocities(law: FrictionLaw, components: int, count: int = 40, seed: int = 0) -> Array:
    """Of all directions, 0.3 to 3 times the width of the law."""
    rng = np.random.default_rng(seed)
    v = rng.normal(size=(components, count))
    unit = law.width if law.regularised else 1.0
    return unit * v / np.linalg.norm(v, axis=0) * 10 ** rng.uniform(-0.5, 0.5, count)


@every
@spaces
def test_force_and_tangent_are_derivatives(law: FrictionLaw, components: int) -> None:
    """Central differences of several steps: their error falls like the square of the step."""
    v = velocities(law, components)
    away = np.random.default_rng(1).normal(size=v.shape)
    away *= np.linalg.norm(v, axis=0).min() / np.linalg.norm(away, axis=0)
    exact = (law.force(v) * away).sum(0), product(law.tangent(v), away)
    errors = []
    for step in (1e-1, 1e-2, 1e-3):
        for function, derivative in zip((law.potential, law.force), exact, strict=True):
            found = (function(v + step * away) - function(v - step * away)) / (2 * step)
            errors.append(abs(found - derivative).max() / (abs(derivative).max() or 1.0))
    for coarse, fine in zip(errors[:-2], errors[2:], strict=True):
        assert fine <= 0.02 * coarse + 1e-10
    assert max(errors[-2:]) < 1e-5


@every
@spaces
@pytest.mark.parametrize("step", [1.0, 1e-3, 1e-8, 1e-14, -1e-5])
def test_differences_do_not_cancel(law: FrictionLaw, components: int, step: float) -> None:
    """Against 200 digits, relative to the change times the largest stiffness on its way.

    Far from rest that falls like exp(-2 v/v0), whose rounding is that of 2 v/v0.
    """
    for size in (1e-6, 1e-2, 1.0, 10.0):
        v = size * velocities(law, components, 5, seed=2)
        change = size * velocities(law, components, 5, seed=3)
        if components > 1:
            change[:, 0] = 0.7 * v[:, 0]  # along the motion
        found = law.force_difference(v, change, step)
        for k in range(v.shape[1]):
            exact = exact_difference(law, v[:, k], change[:, k], step)
            way = v[:, k, None] + step * change[:, k, None] * np.linspace(0, 1, 21)
            stiffness = abs(whole(law.tangent(way), components)).sum(0).max()
            scale = np.linalg.norm(change[:, k]) * stiffness + np.linalg.norm(exact)
            assert abs(found[:, k] - exact).max() <= 20 * (1 + size) * EPS * scale


def exact_difference(law: FrictionLaw, v: Array, change: Array, step: float) -> Array:
    """By the formula of the force, term by term."""
    with mpmath.workdps(200):
        matrix = law._matrix(len(v)) if isinstance(law, ElliptTanh) else np.eye(len(v))
        a = mpmath.matrix(matrix.tolist())
        before, way = (a * mpmath.matrix(w.tolist()) for w in (v, change))
        size = law.speed if isinstance(law, Viscous) else getattr(law, "slip_speed", None)

        def force(w: mpmath.matrix) -> mpmath.matrix:
            r = mpmath.norm(w)
            if isinstance(law, Viscous):
                return w / size
            return w / r * (1 if size is None else mpmath.tanh(r / size))

        moved = (force(before + mpmath.mpf(step) * way) - force(before)) / mpmath.mpf(step)
        return np.array([float(x) for x in a * moved])


def test_differences_through_rest() -> None:
    law, v = Tanh(0.3), np.array([[0.2, 0.0], [-0.1, 0.0]])
    change = np.array([[-0.2, 0.4], [0.1, 0.3]])  # to rest, and from it
    found = law.force_difference(v, change, 1.0)
    np.testing.assert_allclose(found, law.force(v + change) - law.force(v), rtol=1e-15)
    assert not law.force_difference(0 * v, 0 * v, 1e-3).any()


@every
@spaces
def test_at_rest(law: FrictionLaw, components: int) -> None:
    rest = np.zeros((components, 3))
    assert not law.potential(rest).any()
    assert not law.force(rest).any()
    assert np.all(np.isfinite(law.tangent(rest)))
    if law.width > 0:
        v = 1e-9 * min(law.width, 1.0) * np.ones((components, 3))
        np.testing.assert_allclose(law.force(v), product(law.tangent(rest), v), rtol=1e-12)


@every
@spaces
def test_potentials_are_convex(law: FrictionLaw, components: int) -> None:
    for size in (1e-3, 1.0, 1e3):
        v, w = (size * velocities(law, components, 200, seed) for seed in (4, 5))
        stiffness = np.linalg.eigvalsh(np.moveaxis(whole(law.tangent(v), components), -1, 0))
        assert np.all(stiffness.min(1) >= -20 * EPS * stiffness.max(1))
        share = np.random.default_rng(6).uniform(size=v.shape[1])
        between = law.potential(share * v + (1 - share) * w)
        ends = share * law.potential(v) + (1 - share) * law.potential(w)
        assert np.all(between <= ends * (1 + 4 * EPS))
        rises = ((law.force(v) - law.force(w)) * (v - w)).sum(0)
        assert np.all(rises >= -4 * EPS * np.linalg.norm(v - w, axis=0))


@every
@spaces
@pytest.mark.parametrize("factor", [0.25, 3.0])
def test_laws_in_other_units_of_speed(law: FrictionLaw, components: int, factor: float) -> None:
    v, scaled = velocities(law, components), law.scaled(factor)
    for function, power in ((law.force, 0), (law.potential, 1), (law.tangent, -1)):
        found = getattr(scaled, function.__name__)(v / factor) * factor**power
        np.testing.assert_allclose(found, function(v), rtol=1e-13, atol=1e-13 * abs(function(v)).max())
    assert scaled.width == law.width / factor
    assert scaled.speed_at(0.3) == pytest.approx(law.speed_at(0.3) / factor)


@pytest.mark.parametrize("name", ["tanh", "wide tanh", "viscous", "elliptic"])
def test_the_force_at_speed_at_is_that_share(name: str) -> None:
    law = LAWS[name]
    speed = np.array([[0.0], [law.speed_at(0.3)]])
    np.testing.assert_allclose(law.force(speed)[1], 0.3, rtol=1e-13)


@every
@spaces
def test_even_laws_have_mirrored_and_opposite_forces(law: FrictionLaw, components: int) -> None:
    v = velocities(law, components)
    np.testing.assert_array_equal(law.force(-v), -law.force(v))
    mirror = np.array([-1.0, 1.0, 1.0])[:components, None]
    same = np.allclose(law.force(mirror * v), mirror * law.force(v), rtol=1e-13, atol=0)
    assert same == (law.even or components == 1)


@pytest.mark.parametrize("name", ["coulomb", "tanh", "viscous"])
@pytest.mark.parametrize("components", [2, 3])
def test_isotropic_laws_turn_with_the_velocity(name: str, components: int) -> None:
    law = LAWS[name]
    v, turn = velocities(law, components), np.linalg.qr(RNG.normal(size=(components, components)))[0]
    np.testing.assert_allclose(law.potential(turn @ v), law.potential(v), rtol=1e-13)
    np.testing.assert_allclose(law.force(turn @ v), turn @ law.force(v), atol=1e-13)
    full, turned = (whole(law.tangent(w), components) for w in (v, turn @ v))
    expected = np.einsum("ac,cdk,bd->abk", turn, full, turn)
    np.testing.assert_allclose(turned, expected, atol=1e-13 * abs(full).max())


@every
@pytest.mark.parametrize("kept", [slice(None), slice(1, 2), slice(1)])
def test_a_response_is_the_law_at_what_is_kept(law: FrictionLaw, kept: slice) -> None:
    v, change = velocities(law, 2), velocities(law, 2, seed=7)
    met, pairs = law.at(v, kept), pairs_among(2, kept)
    np.testing.assert_array_equal(met.force, law.force(v)[kept])
    np.testing.assert_array_equal(met.tangent, law.tangent(v)[pairs])
    after, difference = met.moved(change, 1e-3)
    np.testing.assert_array_equal(after.force, law.force(v + 1e-3 * change)[kept])
    np.testing.assert_allclose(
        difference, law.force_difference(v, change, 1e-3)[kept], rtol=1e-13, atol=1e-15
    )


def test_limits_of_tanh_are_coulomb_and_viscous() -> None:
    v = velocities(Coulomb(), 3)
    dry, viscous = Tanh(1e-9), Tanh(1e9)
    for function in ("potential", "force", "tangent"):
        limit = getattr(Coulomb(), function)(v)
        np.testing.assert_allclose(getattr(dry, function)(v), limit, rtol=1e-7)
        limit = getattr(Viscous(1e9), function)(v)
        np.testing.assert_allclose(getattr(viscous, function)(v), limit, rtol=1e-12, atol=1e-24)


def test_tanh_at_small_and_huge_speeds() -> None:
    """Full relative accuracy everywhere, no overflow."""
    s = np.array([0.0, 1e-140, 1e-12, 1e-5, 1e-3, 0.3, 1.0, 5.0, 300.0, 1e3, 1e300])
    for slip in (1.0, 1e-3, 1e-5):
        law, v = Tanh(slip), slip * s[None]
        with mpmath.workdps(400):
            arguments = [mpmath.mpf(float(x)) / mpmath.mpf(slip) for x in v[0]]
            near = arguments[:-1]
            potential = [slip * float(mpmath.log(mpmath.cosh(x))) for x in near]
            force = [float(mpmath.tanh(x)) for x in near]
            slope = [float(mpmath.sech(x) ** 2) / slip for x in near]
        np.testing.assert_allclose(law.potential(v)[:-1], potential, rtol=4 * EPS)
        np.testing.assert_allclose(law.force(v)[0, :-1], force, rtol=4 * EPS)
        np.testing.assert_allclose(law.tangent(v)[0, :-1], slope, rtol=1e-12)
        assert law.potential(v)[-1] == v[0, -1]
        assert law.force(v)[0, -1] == 1
        assert law.tangent(v)[0, -1] == 0
    for slip in (5e-324, 1e-310, 1e308):
        law = Tanh(slip)
        for function in (law.potential, law.force, law.tangent):
            assert np.all(np.isfinite(function(np.array([[1e-30, 0.1, 1e5], [0.0, 0.3, 1e9]]))))


# --- in the shell -----------------------------------------------------------------------------------


def test_the_effect_takes_a_slip_speed_or_a_law() -> None:
    plain, named = Friction(0.5, 0.01), Friction(coefficient=0.5, slip_speed=0.01)
    assert plain == named == Friction(0.5, law=Tanh(0.01))
    assert plain.law == Tanh(0.01)
    assert plain.slip_speed == 0.01
    assert Friction(0.5, law=Viscous()).law == Friction(0.5, law="viscous").law == Viscous()
    assert repr(plain) == "Friction(coefficient=0.5, law=Tanh(slip_speed=0.01))"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "slip_speed = None: must be > 0 for law = 'tanh'"),
        ({"slip_speed": -1.0}, "slip_speed = -1"),
        ({"slip_speed": 0.1, "law": Tanh(0.1)}, r"slip_speed = 0\.1: must be None beside Tanh"),
        ({"law": Coulomb()}, r"law = Coulomb\(\): must have a derivative at rest.*use Tanh"),
        ({"law": "coulomb"}, r"law = Coulomb\(\): must have a derivative at rest"),
        ({"law": "dry"}, r"law = Coulomb\(\): must have a derivative at rest"),  # as files say
        ({"law": "rubber"}, "law = 'rubber': must be one of"),
        ({"law": 0.1}, "law = 0.1: must be one of"),
    ],
)
def test_what_the_effect_refuses(arguments: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Friction(1.0, **arguments)


MATERIAL = Material(0.03, 0.5)
WEAK = 3e-6
"""Weight per area for which friction does not change the shape."""


def scene(wave: object = None, effects: tuple = (), **options: object) -> Scene:
    shape = (Membrane(MATERIAL), *effects)
    return Scene(Sheet(), wave or SineWave(), 0.1, effects=shape, cells=(2, 4), **options)


def stepped(law: FrictionLaw, wave: object = None, steps: int = 32, weight: float = WEAK) -> float:
    effects = (Gravity(weight, "current"), Friction(1.0, law=law))
    return simulate(scene(wave, effects), periods=1, steps=steps).speed.mean


@pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
def test_viscous_friction_in_the_shell_is_that_of_the_cycle() -> None:
    """The distance to dry friction is not stated for it."""
    effects = (Gravity(WEAK, "current"), Friction(1.0, law=Viscous(0.1)))
    pulse = TravellingWave([1.0, 0.5], [0.0, 0.0])
    few, many = (simulate(scene(pulse, effects), periods=1, steps=n) for n in (32, 64))
    cycle = cycle_speed(scene(pulse), friction="viscous", rtol=1e-2)
    assert (4 * many.speed.mean - few.speed.mean) / 3 == pytest.approx(cycle.mean, rel=2e-3)
    assert few.regime == "viscous"
    assert np.isnan(few.errors.slip_speed)
    assert np.isnan(few.speed.model_error)


@pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
def test_viscous_friction_on_a_slope_knows_its_speed() -> None:
    """tan(incline)/mu of the speed at which it is mu N, in any unit of time."""
    contact, wave = Contact(friction=Viscous(0.02), slope=0.3), SineWave(period=1.0)
    found = cycle_speed(scene(wave, contact=contact), rtol=1e-2)
    level = cycle_speed(scene(wave), friction="viscous", rtol=1e-2)
    assert found.mean == pytest.approx(level.mean - 0.3 * 0.02, rel=1e-6)
    slow = Contact(friction=Viscous(0.02 / 7), slope=0.3)
    again = cycle_speed(scene(SineWave(period=7.0), contact=slow), rtol=1e-2)
    assert 7 * again.mean == pytest.approx(found.mean, rel=1e-9)


# --- an open set ------------------------------------------------------------------------------------

SLIP = 0.05
OBLIQUE = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y + 0.5 * x - t)), 1.0)


def cycled(law: FrictionLaw, wave: object = None, rtol: float = 1e-2) -> object:
    return cycle_speed(scene(wave, contact=Contact(friction=law)), rtol=rtol)


@pytest.mark.parametrize("wave", [None, OBLIQUE], ids=["along", "oblique"])
@pytest.mark.parametrize("stretch", [1.0, 2.0])
def test_a_law_of_ones_own_that_is_tanh_gives_its_speeds(wave: object, stretch: float) -> None:
    """Stretched alike in all directions it is tanh of another slip speed; mu does not count."""
    own, known = ElliptTanh(SLIP, stretch, stretch), Tanh(SLIP / stretch)
    assert cycled(own, wave).mean == pytest.approx(cycled(known, wave).mean, rel=1e-12)
    for order in (1, 2):
        speeds = [
            crawl_speed(Sheet(), wave or SineWave(), 0.1, friction=law, order=order, rtol=1e-2).mean
            for law in (own, known)
        ]
        assert speeds[0] == pytest.approx(speeds[1], rel=1e-11)
    if stretch == 1:
        assert stepped(own, wave) == pytest.approx(stepped(known, wave), rel=1e-10)


@pytest.mark.parametrize(
    ("law", "rtol"),
    [
        (ElliptTanh(SLIP, 1.0, 3.0), 2e-3),
        (ElliptTanh(SLIP, 1.0, 0.5), 2e-3),
        (
            ElliptTanh(SLIP, 3.0, 1.0, angle=0.5),
            1e-2,
        ),  # it turns, in a cycle with its axes
    ],
)
def test_cycle_and_stepper_agree_under_a_law_of_ones_own(law: FrictionLaw, rtol: float) -> None:
    few, many = (stepped(law, steps=n) for n in (32, 64))
    cycle, plain = cycled(law), cycled(Tanh(SLIP))
    assert abs(cycle.mean - plain.mean) > 0.03 * abs(plain.mean)
    assert cycle.mean == pytest.approx((4 * many - few) / 3, rel=rtol)  # steps are of second order


def test_theory_and_cycle_agree_on_where_a_law_without_symmetry_leads() -> None:
    """The mirror symmetric sheet crawls aside, the same way, and by as much as errors allow."""
    law, alpha = ElliptTanh(0.005, 3.0, 1.0, angle=0.5), 0.02
    shell = Scene(Sheet(), SineWave(), alpha, effects=[Membrane(MATERIAL)], cells=(2, 4))
    cycle = cycle_speed(shell, friction=law, rtol=1e-2)
    theory = crawl_speed(Sheet(), SineWave(), alpha, friction=law, order=2, rtol=1e-2)
    assert abs(cycle.rigid_mean[0]) > 0.1 * abs(cycle.rigid_mean[1])
    off = abs(theory.rigid_mean - cycle.rigid_mean)[:2]
    assert np.all(off <= (theory.rigid_error + cycle.rigid_error)[:2])
    assert np.all(off < 0.02 * abs(cycle.rigid_mean[:2]))
    assert np.isnan(theory.model_error)


@pytest.mark.parametrize("stretch", [0.5, 2.0])
def test_of_a_motion_along_y_alone_a_stretch_is_a_slip_speed(stretch: float) -> None:
    """A strip that is so narrow that it hardly moves sideways."""
    narrow, law = Sheet(width=0.01), ElliptTanh(SLIP, 1.0, stretch)
    found = [
        crawl_speed(narrow, SineWave(), 0.1, friction=f, rtol=1e-4).mean
        for f in (law, Tanh(SLIP / stretch), Tanh(SLIP))
    ]
    assert found[0] == pytest.approx(found[1], rel=3e-3)
    assert abs(found[0] - found[2]) > 0.05 * abs(found[2])


@pytest.mark.parametrize(
    "law",
    [Tanh(0.1), ElliptTanh(0.1, 1.0, 3.0), ElliptTanh(0.1, 0.4, 1.5, angle=0.6)],
    ids=["tanh", "elliptic", "turned"],
)
@pytest.mark.parametrize("t", [0.06, 0.31])
def test_the_balance_is_where_the_potential_is_least(law: FrictionLaw, t: float) -> None:
    """A literal second implementation: a sum over Gauss points, least by a general optimiser."""
    shapes = cycle_of_shapes(ShellModel(scene()), 16)
    balance = CycleBalance.of(shapes, Contact(friction=law), 1e-4)
    found = balance.balance(np.array([t])).leading[0, 0]
    fine = replace(balance, order=14, mirrored=False)
    motion = fine._motion.at(np.array([t]))
    weights = np.multiply.outer(*[np.polynomial.legendre.leggauss(14)[1]] * 2)
    load, (x, y), v = motion.area[0] * weights, motion.position[:, 0], motion.velocity[:, 0]
    x, y = x - motion.centre[0], y - motion.centre[1]

    def dissipation(q: Array) -> float:
        return float((load * law.potential(v + np.stack([q[0] - q[2] * y, q[1] + q[2] * x]))).sum())

    start = minimize(dissipation, np.zeros(3), method="BFGS", options={"gtol": 1e-9})
    least = minimize(dissipation, start.x, method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 0})
    np.testing.assert_allclose(found, least.x, atol=2e-6 * abs(v).max())
    if law.even:
        assert not found[[0, 2]].any()
    else:
        assert abs(found[[0, 2]]).min() > 1e-2 * abs(found[1])


def test_bodies_on_a_line_refuse_laws_without_a_name() -> None:
    for wave, length in ((SineWave(), None), (OBLIQUE, 1.0)):
        with pytest.raises(ValueError, match=r"friction = ElliptTanh\(.*must be one of Coulomb, Tanh"):
            line_balance(wave, 0.1, friction=ElliptTanh(0.1), length=length)


# --- one implementation -----------------------------------------------------------------------------

ROOT = Path(__file__).parents[2]

HYPERBOLIC = ("tanh", "cosh", "sinh", "arctanh", "logaddexp")

SPECIAL = {
    "linear_theory/deformation/airy/system.py": "Airy functions of the series",
    "linear_theory/deformation/airy/family.py": "Airy functions of the series",
    "linear_theory/deformation/airy/special.py": "coth of the series",
    "linear_theory/line/closed_form.py": "the balance of tanh and a sine in closed form",
    "fem_check/excitable/starts.py": "the smooth step of a start",
    "linear_theory/friction/maps.py": "the soft edges of patches",
    "linear_theory/line/finite.py": "the quadrature with double exponential weights",
}
"""Files that may use hyperbolic functions for other ends than the law of friction."""


def called(tree: ast.AST) -> list[str]:
    """Names of the functions that are called, without those in docstrings."""
    calls = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
    return [getattr(name, "attr", getattr(name, "id", "")) for name in calls]


def log_cosh(tree: ast.AST) -> bool:
    """Whether it is log(1 + exp(...))."""
    arguments = isinstance(tree, ast.Call) and called(tree)
    return bool(arguments) and arguments[0] in ("log", "log1p") and "exp" in arguments[1:]


def test_the_law_of_friction_is_written_once() -> None:
    used = {}
    for top in ("linear_theory", "fem_check"):
        for path in sorted((ROOT / top).rglob("*.py")):
            tree = ast.parse(path.read_text())
            names = sorted(name for name in called(tree) if name in HYPERBOLIC)
            names += ["log cosh"] * sum(map(log_cosh, ast.walk(tree)))
            if names:
                used[path.relative_to(ROOT).as_posix()] = names
    assert used.pop("linear_theory/friction/laws.py") == ["sinh", "tanh"]
    assert set(used) == set(SPECIAL)


def test_pairs_are_those_of_a_symmetric_tensor() -> None:
    for n in COMPONENTS:
        every_pair = itertools.combinations_with_replacement(range(n), 2)
        assert list(zip(*PAIRS[n], strict=True)) == list(every_pair)
        full = RNG.normal(size=(n, n))
        full = full + full.T
        v = RNG.normal(size=(n, 1))
        np.testing.assert_allclose(product(full[PAIRS[n]][:, None], v), full @ v, rtol=1e-14)
