"""Friction on the lower face of a sheet that bends: theory, cycles of shapes and steps in time."""

import math

import numpy as np
import pytest
import sympy

from fem_check import (
    BackwardDifferences,
    Bending,
    Friction,
    Gravity,
    Ground,
    Inertia,
    Material,
    Membrane,
    Newmark,
    cycle_speed,
    simulate,
)
from figures.measure.plate import lower_face
from linear_theory import (
    Contact,
    Coulomb,
    Directional,
    FieldWave,
    OnLowerFace,
    Scene,
    Sheet,
    SineWave,
    Tanh,
    TravellingWave,
    Viscous,
    crawl_speed,
    second_order,
)
from linear_theory.deformation.plate.lower_face import LowerFace
from linear_theory.speed.plate.terms import PlateTerms
from tests.plate.reference_lower_face import added, grid, slope_rate

ROWS = lower_face.TABLE.read()
SHEET, SINE = Sheet(), SineWave()

TRAIN = TravellingWave(cosine=[1.0, 0.5], sine=[0.0, 0.2])
"""Not its own negative half a period later."""


def scene(alpha, beta, law, sheet=SHEET, wave=SINE, load="grown", more=(), **growth):
    """On the paper's ground; law: on the lower face, for speeds per unit |alpha|, or |beta| L/50."""
    material = Material(sheet.thickness, sheet.poisson)
    law = OnLowerFace(law).scaled(1 / (abs(alpha) or abs(beta) / 50))
    effects = [Membrane(material), Bending(material), Gravity(2.5e-4, load), Ground(0.5, load=load)]
    contact = {"contact": Contact("ground", law)} if law.width == 0 else {}
    effects += [] if contact else [Friction(1e-3, law=law)]
    return Scene(sheet, wave, alpha, beta, [*effects, *more], **growth, **contact)


# ---- the theory


def test_normal_of_a_deflected_sheet_to_second_order():
    """n_a = -beta w_a + alpha beta u_c,a w_c - ..., so that -(h/2) n slips with +(h/2) grad w_t."""
    size, (x, y) = sympy.symbols("size"), sympy.symbols("x y")
    u, v, w, second = (sympy.Function(name)(x, y) for name in ("u", "v", "w", "W"))
    place = sympy.Matrix([x + size * u, y + size * v, size * w + size**2 * second])
    director = place.diff(x).cross(place.diff(y))
    normal = director / sympy.sqrt(director.dot(director))
    for along, a in enumerate((x, y)):
        first, other = (normal[along].diff(size, k).subs(size, 0).doit() for k in (1, 2))
        assert sympy.simplify(first + w.diff(a)) == 0
        turned = u.diff(a) * w.diff(x) + v.diff(a) * w.diff(y)
        assert sympy.simplify(other / 2 - (turned - second.diff(a))) == 0


def test_slip_of_first_order_is_that_of_the_slope():
    asked = scene(0.1, 0.1, Viscous())
    terms = PlateTerms.of(asked, 1e-4)
    face = LowerFace(terms.plane, terms.plate)
    x, y, _ = grid(SHEET.width, SHEET.length, (3, 5))
    found = face.on(np.stack(np.broadcast_arrays(x, y)), np.array([0.1, 0.37])).first
    for k, t in enumerate((0.1, 0.37)):
        wanted = SHEET.thickness / 2 * slope_rate(terms.plate, x, y, t)
        assert found[1, k] == pytest.approx(wanted, abs=1e-5 * abs(wanted).max())


def test_viscous_coefficients_are_those_of_a_few_sums():
    asked = scene(0.01, 0.0, Viscous())
    lower, middle = (
        second_order(found, rtol=1e-4).coefficients
        for found in (asked, asked.but(effects=[*others(asked), Friction(1e-3, law=Viscous())]))
    )
    mixed, bent = added(asked)
    for part, more in (("alpha_beta", mixed), ("beta_beta", bent)):
        one, other = (getattr(form, part) for form in (lower, middle))
        assert abs(one.value - other.value - more) <= one.error + other.error
        assert one.value - other.value == pytest.approx(more, rel=2e-3)
    on_ray = crawl_speed(scene(0.01, 0.2, Viscous()), order=2, rtol=1e-4)
    form = lower.at(0.01, 0.2)
    assert abs(on_ray.mean - form.value) <= on_ray.error + form.error


def test_other_laws_have_no_quadratic_form():
    found = second_order(scene(0.01, 0.1, Tanh(0.3)), rtol=1e-2).coefficients
    assert math.isnan(found.alpha_beta.value)
    assert found.alpha_beta.error == math.inf
    assert found.alpha_alpha.value == pytest.approx(1.496, abs=0.02)


CASES = {
    "all areas undeformed": (
        *(0.005, -0.125, Tanh(0.3)),
        {"load": "material", "curvature": "undeformed", "area": "undeformed"},
    ),
    "direction": (0.001, 0.025, Directional(0.5, 1.5, form=Tanh(0.3)), {}),
    "two harmonics": (0.002, 0.03, Tanh(0.5), {"wave": TRAIN}),
    "bending without growth": (0.0, 0.05, Tanh(0.3), {}),
}


@pytest.mark.parametrize("name", CASES)
def test_theory_is_that_of_cycles(name):
    """At couplings so small that higher orders do not show; sines on two grounds are in the table."""
    alpha, beta, law, more = CASES[name]
    asked = scene(alpha, beta, law, **more)
    theory, cycle = crawl_speed(asked, order=2, rtol=1e-3), cycle_speed(asked, rtol=3e-3)
    assert theory.converged
    error = theory.error + cycle.error
    assert abs(theory.mean - cycle.mean) <= min(error, 0.01 * abs(cycle.mean))


def test_power_is_that_of_cycles():
    """Less than theory leaves out, which is some alpha of it."""
    for law in (Tanh(0.3), Viscous()):
        asked = scene(0.002, 0.1, law)
        theory, cycle = crawl_speed(asked, order=2, rtol=1e-2), cycle_speed(asked, rtol=5e-2)
        assert theory.power.value == pytest.approx(cycle.power.value, rel=1e-3)


def test_without_bending_both_faces_slip_alike():
    law = Tanh(0.3)
    lower = scene(0.01, 0.0, law)
    middle = lower.but(effects=[*others(lower), Friction(1e-3, law=law.scaled(100.0))])
    one, other = (crawl_speed(asked, order=2, rtol=1e-3) for asked in (lower, middle))
    assert one.mean == pytest.approx(other.mean, rel=1e-4)


def others(asked):
    return [effect for effect in asked.effects if effect.law is None]


def test_symmetries():
    """Half a period later c -> -c; seen along -y; a wave that goes nowhere and its reversal."""
    law, rtol = Tanh(0.3), 1e-3
    here = crawl_speed(scene(0.01, 0.2, law), order=2, rtol=rtol).mean
    later = crawl_speed(scene(-0.01, -0.2, law), order=2, rtol=rtol).mean
    back = crawl_speed(scene(0.01, 0.2, law, wave=SineWave(count=-1)), order=2, rtol=rtol).mean
    assert later == pytest.approx(here, rel=1e-3)
    assert back == pytest.approx(-here, rel=1e-3)
    standing = FieldWave(lambda x, y, t: np.sin(2 * np.pi * t) * np.sin(2 * np.pi * y) + 0 * x, 1.0)
    still = crawl_speed(scene(0.01, 0.2, law, wave=standing), order=2, rtol=1e-2)
    assert abs(still.mean) <= max(still.error, 1e-3 * abs(here))


@pytest.mark.parametrize("seed", range(4))
def test_error_is_honest(seed):
    rng = np.random.default_rng(seed)
    width, poisson, thickness = rng.uniform((0.2, 0, 0.02), (1, 0.5, 0.05))
    sheet = Sheet(width=width, poisson=poisson, thickness=thickness)
    law = [Tanh(0.3), Viscous(), Coulomb(), Tanh(0.05)][seed]
    asked = scene(0.01, rng.uniform(-0.15, 0.15), law, sheet)
    rough, fine = (crawl_speed(asked, order=2, rtol=rtol) for rtol in (3e-2, 1e-4))
    assert abs(rough.mean - fine.mean) <= rough.error + fine.error
    assert fine.error < rough.error


# ---- steps in time


def test_steps_are_as_cycles():
    """Newton finds each step; the power that friction takes is that of the cycle."""
    asked = scene(0.01, 0.15, Tanh(0.3))
    run, cycle = simulate(asked, 1, steps=64, mesh_error=False), cycle_speed(asked, rtol=1e-2)
    assert run.period_speeds[-1] == pytest.approx(cycle.mean, rel=1e-2)
    power = run.speed.power
    assert abs(power.value - cycle.power.value) <= power.error + cycle.power.error
    assert np.mean(run.table["iterations"][1:]) < 6


def test_inertia_by_backward_differences_alone():
    material = Material(SHEET.thickness, SHEET.poisson)
    asked = scene(0.01, 0.1, Tanh(0.3), more=[Inertia(1e-8, material)])
    with pytest.raises(ValueError, match=r"scheme = Newmark.*BackwardDifferences for friction"):
        simulate(asked, 1, steps=8, scheme=Newmark())
    run = simulate(asked, 1, steps=16, scheme=BackwardDifferences(), mesh_error=False)
    still = cycle_speed(scene(0.01, 0.1, Tanh(0.3)), rtol=1e-2)
    assert run.period_speeds[-1] == pytest.approx(still.mean, rel=0.1)


# ---- the table


def test_rows_of_the_table():
    """Theory, cycles and steps on both lines of two layers within 1 % of the sizes that cancel."""
    assert {lower_face.line_of(r) for r in ROWS} == set(lower_face.wanted())
    for r in ROWS:
        size = max(abs(r.lower), abs(r.middle))
        assert abs(r.cycle - r.lower) <= 0.01 * size, r
        assert math.isnan(r.stepper) == (r.law == "dry")
        assert r.law == "dry" or abs(r.stepper - r.lower) <= 0.01 * size, r


def test_a_row_is_what_is_computed():
    kept = next(r for r in ROWS if (r.ground, r.law, r.way) == ("paper", "viscous", 1))
    found = lower_face.theory_on(lower_face.line_of(kept))
    assert found.lower == pytest.approx(kept.lower, rel=1e-4)
    assert found.middle == pytest.approx(kept.middle, rel=1e-4)
