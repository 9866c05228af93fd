"""The plate on its ground, and the speed to second order in (alpha, beta)."""

import math

import numpy as np
import pytest
import skfem
from skfem.helpers import dd, trace

from fem_check import (
    Bending,
    Friction,
    Gravity,
    Ground,
    Inertia,
    Material,
    Membrane,
    cycle_speed,
    simulate,
)
from linear_theory import (
    FieldWave,
    Scene,
    Sheet,
    SineWave,
    Tanh,
    Viscous,
    crawl_speed,
    pulse_wave,
    second_order,
)
from linear_theory.deformation.plate import Foundation, plate_field
from linear_theory.deformation.plate.basis import derivative, twice_integrated
from linear_theory.deformation.plate.stretching import StretchField

SHEET, SINE = Sheet(), SineWave()
MATERIAL = Material(SHEET.thickness, SHEET.poisson)


def ground(sheet=SHEET, weight=2.5e-4, stiffness=0.5):
    rigidity = sheet.thickness**3 / (12 * (1 - sheet.poisson**2))
    return Foundation(rigidity, weight, stiffness)


def scene(alpha, beta, law=None, sheet=SHEET, wave=SINE, stiffness=0.5, weight=2.5e-4, **more):
    material = Material(sheet.thickness, sheet.poisson)
    law = Tanh(0.3 * abs(alpha)) if law is None else law
    effects = [Membrane(material), Bending(material), Gravity(weight), Ground(stiffness)]
    effects.append(Friction(1e-3, law=law))
    return Scene(sheet, wave, alpha, beta, effects, **more)


# ---- the plate


def test_basis_and_derivatives_are_those_of_legendre_polynomials():
    basis, size = twice_integrated(9), np.sqrt(np.arange(9) + 0.5)
    by_hand = np.polynomial.legendre.legder(np.diag(size), axis=0) / size[:-1, None]
    assert np.allclose(derivative(9)[:-1], by_hand)
    for one, other in ((basis.values, basis.slopes), (basis.slopes, basis.curvatures)):
        assert np.allclose(derivative(9) @ one, other)


@pytest.mark.parametrize("stiffness", [0.05, 50.0])
def test_deflection_equals_that_of_argyris_elements(stiffness):
    # Argyris elements (scikit-fem) on the same weak form, written again.
    sheet, at = Sheet(width=0.5, poisson=0.3), 0.13
    base = ground(sheet, stiffness=stiffness)
    field = plate_field(sheet, SINE, base, rtol=1e-5)
    x, y = np.linspace(-0.25, 0.25, 9), np.linspace(-0.5, 0.5, 17)
    basis = skfem.Basis(skfem.MeshTri.init_tensor(x, y), skfem.ElementTriArgyris(), intorder=9)
    nu = sheet.poisson

    @skfem.BilinearForm
    def energy(w, v, _):
        bent = sum(dd(w)[i][j] * dd(v)[i][j] for i in (0, 1) for j in (0, 1))
        both = (1 - nu) * bent + nu * trace(dd(w)) * trace(dd(v))
        return base.rigidity * both + base.spring * w * v

    @skfem.LinearForm
    def growth(v, at_):
        c = np.sin(2 * np.pi * (at_.x[1] - at))
        return -base.rigidity * (1 + nu) * c * trace(dd(v))

    solution = skfem.solve(energy.assemble(basis), growth.assemble(basis))
    values, places = np.asarray(basis.interpolate(solution)), np.asarray(basis.global_coordinates())
    ours = field.deflection(*places, at)
    distance = math.sqrt(np.mean((ours - values) ** 2) / np.mean(values**2))
    assert distance < 1e-4


def test_error_of_the_deflection_is_honest():
    rng = np.random.default_rng(4)
    for _ in range(4):
        sheet = Sheet(width=rng.uniform(0.15, 1.0), poisson=rng.uniform(0, 0.5), thickness=0.03)
        base = ground(sheet, stiffness=10 ** rng.uniform(-2, 2))
        wave = SineWave(count=int(rng.integers(1, 3)))
        field, exact = (plate_field(sheet, wave, base, rtol) for rtol in (1e-2, 1e-5))
        x, y = rng.uniform(-0.5, 0.5, (2, 200)) * np.array([[sheet.width], [sheet.length]])
        t = 0.3
        fault = field.deflection(x, y, t) - exact.deflection(x, y, t)
        size = np.sqrt(np.mean(exact.deflection(x, y, t) ** 2))
        assert np.sqrt(np.mean(fault**2)) <= field.error * size


def test_on_very_soft_ground_the_plate_has_its_free_shape():
    # uniform c bends a free plate into curvature -beta c, and the ground keeps its mean at rest
    uniform = FieldWave(lambda x, y, t: np.sin(2 * np.pi * t) + 0 * x + 0 * y, period=1.0)
    field = plate_field(SHEET, uniform, ground(stiffness=1e-12), rtol=1e-6)
    x, y = 0.1, np.array([-0.3, 0.0, 0.4])
    w = field.deflection(x, y, 0.25)
    free = -(x**2 + y**2) / 2 + (SHEET.width**2 + SHEET.length**2) / 24
    assert np.allclose(w, free, rtol=1e-3)


def test_on_stiff_ground_the_deflection_inside_is_the_local_one():
    # s w = -D (1 + nu) lap c, away from edges by many layers
    base = ground(stiffness=1e6)
    field = plate_field(SHEET, SINE, base, rtol=1e-3)
    y, t = np.array([-0.1, 0.05]), 0.1
    c = np.sin(2 * np.pi * (y - t))
    local = base.rigidity * (1 + SHEET.poisson) * (2 * np.pi) ** 2 * c
    local /= base.spring + base.rigidity * (2 * np.pi) ** 4
    assert np.allclose(field.deflection(0.0, y, t), local, rtol=1e-3)


def test_end_of_a_half_infinite_wide_plate():
    # D w'''' + s w = 0, w'' = -(1 + nu) c, w''' = 0 at the end: w(0) = (1 + nu) c l^2 with
    # l = (D/s)^(1/4) and w'' from w = A exp(-z) cos z, z = distance/(sqrt 2 l)
    uniform = FieldWave(lambda x, y, t: np.sin(2 * np.pi * t) + 0 * x + 0 * y, period=1.0)
    sheet = Sheet(width=3.0, poisson=0.3)
    base = ground(sheet, stiffness=5.0)
    field = plate_field(sheet, uniform, base, rtol=1e-5)
    z = np.array([0.0, 0.1, 0.2])
    scaled = z / (math.sqrt(2) * base.layer)
    exact = -1.3 * base.layer**2 * np.exp(-scaled) * (np.cos(scaled) - np.sin(scaled))
    assert np.allclose(field.deflection(0.0, 0.5 - z, 0.25), exact, rtol=0, atol=2e-2 * abs(exact[0]))


def test_a_bent_strip_shortens_by_its_slope_and_turns_its_moments():
    # 1D, nu = 0: N = h (u' + w'^2/2) and int N v' = D int M w' v'', so that u' + w'^2/2 =
    # -(h^2/12) (M w')', M = w'' + c; integrated over a part of the strip
    sheet = Sheet(width=0.01, poisson=0.0, thickness=0.02)
    plate = plate_field(sheet, SINE, ground(sheet), rtol=1e-5)
    stretch = StretchField(plate).measured()
    y, t = np.linspace(-0.4, 0.3, 2001), 0.1
    factors = stretch._times.factors(np.array([t]))
    u = np.tensordot(factors.T, stretch.displacements(np.zeros_like(y), y), 1)[0, 1]
    w = plate.deflection(np.zeros_like(y), y, t)
    slope = np.gradient(w, y, edge_order=2)
    moment = np.gradient(slope, y, edge_order=2) + np.sin(2 * np.pi * (y - t))
    turned = moment * slope * sheet.thickness**2 / 12
    shortened = -np.trapezoid(slope**2, y) / 2 - turned[-3] + turned[2]
    assert u[-1] - u[0] == pytest.approx(shortened, rel=1e-2)


# ---- the speed


@pytest.mark.parametrize("law", [Tanh(0.3), Viscous()], ids=["tanh", "viscous"])
@pytest.mark.parametrize("stiffness", [0.5])
def test_coefficients_equal_those_of_cycles_of_shapes(stiffness, law):
    alpha, beta = 0.005, 0.1 if stiffness < 1 else 0.04
    found = second_order(scene(alpha, 0.0, law.scaled(1 / alpha), stiffness=stiffness)).coefficients

    def speeds(share):
        a, b = share * alpha, share * beta
        own = law.scaled(1 / a)
        values = [
            cycle_speed(scene(a, s * b, own, stiffness=stiffness, cells=(4, 8)), rtol=1e-3).mean
            for s in (1, -1)
        ]
        return np.array([(values[0] - values[1]) / (2 * a * b), sum(values) / 2 / share**2])

    (mixed, even), (half_mixed, half_even) = speeds(1.0), speeds(0.5)
    assert found.alpha_beta.value == pytest.approx((4 * half_mixed - mixed) / 3, rel=1e-2)
    both = alpha**2 * found.alpha_alpha.value + beta**2 * found.beta_beta.value
    assert both == pytest.approx((4 * half_even - even) / 3, rel=5e-3)


def test_the_mixed_coefficient_is_that_of_the_stepper():
    alpha, beta = 0.01, 0.1
    found = second_order(scene(alpha, 0.0, Viscous())).coefficients.alpha_beta
    values = []
    for steps in (24, 48):
        one, other = (
            simulate(
                scene(alpha, s * beta, Viscous(), cells=(3, 6)), 1, steps=steps, mesh_error=False
            ).period_speeds[-1]
            for s in (1, -1)
        )
        values.append((one - other) / (2 * alpha * beta))
    assert found.value == pytest.approx((4 * values[1] - values[0]) / 3, rel=1e-2)


def test_speed_of_a_scene_is_its_quadratic_form():
    for wave in (SINE, pulse_wave(0.4)):
        asked = scene(0.02, 0.1, wave=wave)
        form = second_order(asked, rtol=1e-2).coefficients.at(0.02, 0.1)
        speed = crawl_speed(asked, order=2, rtol=1e-2)
        assert speed.mean == pytest.approx(form.value, abs=form.error + speed.error)
        assert math.isnan(speed.model_error) == (wave is not SINE)  # measured for sines alone


def test_errors_of_the_coefficients_are_honest():
    rng = np.random.default_rng(1)
    for _ in range(2):
        sheet = Sheet(width=rng.uniform(0.2, 1.0), poisson=rng.uniform(0, 0.5))
        asked = scene(0.01, 0.0, sheet=sheet, stiffness=10 ** rng.uniform(-1.5, 1.5))
        rough, fine = (second_order(asked, rtol=r).coefficients for r in (2e-2, 5e-4))
        for name in ("alpha_alpha", "alpha_beta", "beta_beta"):
            one, other = getattr(rough, name), getattr(fine, name)
            assert abs(one.value - other.value) <= one.error + other.error, name


def test_a_standing_wave_crawls_nowhere_by_bending():
    standing = FieldWave(lambda x, y, t: np.cos(2 * np.pi * y) * np.sin(2 * np.pi * t) + 0 * x, 1.0)
    found = crawl_speed(scene(0.0, 0.2, Viscous(), wave=standing), order=2, rtol=1e-2)
    assert abs(found.mean) <= found.error + 1e-12


def test_a_sine_that_only_bends_crawls_nowhere_at_second_order():
    # v_b has twice the frequency and no other: what it does is undone a quarter of a period later
    for law in (Tanh(1e-6), Viscous()):
        found = crawl_speed(scene(0.0, 0.1, law), order=2, rtol=1e-2)
        assert abs(found.mean) < 1e-9 * 0.1**2 * 1.8e-3


def test_bending_alone_moves_as_a_cycle_does_and_ignores_the_sign():
    law, beta = Tanh(5e-7), 0.05
    one, other = (crawl_speed(scene(0.0, b, law), order=2, rtol=1e-2) for b in (beta, -beta))
    assert np.allclose(one.velocity, other.velocity, rtol=0, atol=1e-9 * abs(one.velocity).max())
    cycle = cycle_speed(scene(0.0, beta, law, cells=(4, 8)), rtol=1e-1)
    found = np.interp(cycle.times, one.times, one.velocity, period=1.0)
    assert abs(found - cycle.velocity).max() < 0.1 * abs(cycle.velocity).max()


def test_growth_of_the_other_sign_is_the_same_half_a_period_later():
    one = crawl_speed(scene(0.02, 0.1), order=2, rtol=1e-3)
    other = crawl_speed(scene(-0.02, -0.1), order=2, rtol=1e-3)
    assert one.mean == pytest.approx(other.mean, rel=1e-6)


def test_beyond_lift_off_the_theory_refuses_with_the_limit():
    limit = plate_field(SHEET, SINE, ground()).lift_off()
    assert crawl_speed(scene(0.01, 0.99 * limit), order=2, rtol=1e-2).error < 1
    with pytest.raises(ValueError, match=rf"curvature_coupling = .*must be in .*{limit:.4g}"):
        crawl_speed(scene(0.01, 1.01 * limit), order=2)
    # the pressure of the linearised ground does vanish there, and nowhere before
    field = plate_field(SHEET, SINE, ground(), rtol=1e-5)
    x, y = np.linspace(-0.25, 0.25, 31)[:, None], np.linspace(-0.5, 0.5, 61)
    lowest = min(float((1 + limit * field.pressure(x, y, t)).min()) for t in np.linspace(0, 1, 65))
    assert abs(lowest) < 5e-3


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"extra": Inertia(1e-5, MATERIAL)}, "Inertia"),
        ({"ground": Ground(0.5, damping=0.1)}, "damping"),
        ({"ground": Ground(0.5, height=lambda x, y: 0.01 * np.sin(y))}, "height"),
        ({"ground": Ground(0.5, load="material")}, "Gravity has 'grown'"),
        ({"gravity": Gravity(2.5e-4, incline=0.1)}, "incline"),
    ],
)
def test_other_scenes_are_refused_by_name(change, words):
    parts = {"gravity": Gravity(2.5e-4), "ground": Ground(0.5), "extra": None} | change
    effects = [Membrane(MATERIAL), Bending(MATERIAL), *(e for e in parts.values() if e)]
    asked = Scene(SHEET, SINE, 0.1, 0.1, effects)
    for call in (lambda: crawl_speed(asked, order=2), lambda: second_order(asked)):
        with pytest.raises(ValueError, match=words):
            call()


@pytest.mark.parametrize("name", ["rigidity", "weight", "stiffness"])
def test_numbers_of_a_foundation_must_be_positive(name):
    numbers = {"rigidity": 1.0, "weight": 1.0, "stiffness": 1.0} | {name: -1.0}
    with pytest.raises(ValueError, match=f"{name} = -1: must be"):
        Foundation(**numbers)
