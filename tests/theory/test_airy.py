"""The Airy series: traction-free edges, invariants, convergence rates, honest errors, hard cases."""

import time

import numpy as np
import pytest

from linear_theory import Sheet, SineWave, TravellingWave
from linear_theory.common.errors import NotConvergedError
from linear_theory.deformation.airy import AirySeries, airy_series, balanced_modes
from tests.theory import reference_airy

PAPER = Sheet()
SINE = SineWave()
PULSE = TravellingWave(np.array([0.5, 0.3, 0.1]), np.array([0.2, 0.1, 0.3]), mean=0.4)
EVEN, ODD = 0.25, 0.0  # times at which a sine wave is purely even (-cos) and purely odd in y


def gauss_points(sheet, across=24, along=40):
    x, w_x = np.polynomial.legendre.leggauss(across)
    y, w_y = np.polynomial.legendre.leggauss(along)
    return x[:, None] * sheet.width / 2, y * sheet.length / 2, w_x[:, None] * w_y / 4


def norm(sheet, u, weights):
    return np.sqrt(np.sum(weights * u * u))


def relative_difference(sheet, field, reference, t, along=40):
    x, y, w = gauss_points(sheet, along=along)
    exact = reference.displacement(x, y, t)
    return norm(sheet, field.displacement(x, y, t) - exact, w) / norm(sheet, exact, w)


def test_amplitudes_equal_a_literal_solution_of_the_papers_systems():
    modes = 12
    field = airy_series(PAPER, SINE, modes=modes, tail=False)
    a, b, c, d = reference_airy.amplitudes(PAPER, modes, 1)
    even, odd = field.amplitudes(EVEN), field.amplitudes(ODD)  # factors -1 and +1
    for found, exact in ((-even.A, a), (-even.C, c), (odd.B, b), (odd.D, d)):
        # conditioning of the 24 x 24 systems is below 10
        np.testing.assert_allclose(found, exact, rtol=0, atol=1e-13)


def test_stress_equals_a_literal_sum_of_eq_15():
    field = airy_series(PAPER, SINE, modes=8, tail=False)
    amplitudes = field.amplitudes(EVEN)
    for x, y in ((0.0, 0.0), (0.1, -0.3), (0.25, 0.5), (-0.2, 0.49)):
        exact = -reference_airy.stress_xx_even(PAPER, -amplitudes.A, -amplitudes.C, 1, x, y)
        assert field.stress(x, y, EVEN)[0] == pytest.approx(exact, abs=1e-13)


def test_tail_constants_are_the_law_of_the_last_amplitudes():
    field = airy_series(PAPER, SINE, rtol=1e-9)
    even, odd = -field.tail_constants(EVEN)[0], field.tail_constants(ODD)[1]
    a, c = -field.amplitudes(EVEN).A, -field.amplitudes(EVEN).C
    b, d = field.amplitudes(ODD).B, field.amplitudes(ODD).D
    # the next term of the amplitudes is m^-2.74: 60^-1.74 of the first
    assert a[59] * 60 == pytest.approx(even, rel=1e-3)
    assert -c[59] * 60 == pytest.approx(even, rel=2e-3)
    assert b[59] * 60 == pytest.approx(odd, rel=1e-2)
    assert -d[60] * 121 / 2 == pytest.approx(odd, rel=1e-2)
    assert airy_series(PAPER, SINE, modes=9, tail=False).tail_constants(0.1) == (0.0, 0.0)


def test_amplitudes_with_tails_are_those_of_very_many_modes():
    few = airy_series(PAPER, SINE, modes=40).amplitudes(0.1)
    many = airy_series(PAPER, SINE, modes=1000, tail=False).amplitudes(0.1)
    for found, exact in zip(few, many, strict=True):
        # plain truncation of 1000 modes is right to about (40/1000)^2 of its error at 40, 5e-5
        np.testing.assert_allclose(found[:5], exact[:5], atol=3e-6)


@pytest.mark.parametrize("wave", [SINE, SineWave(-3), PULSE])
@pytest.mark.parametrize("width", [0.2, 0.5, 1.5])
def test_strain_is_the_symmetric_gradient_of_the_displacement(wave, width):
    sheet = Sheet(width=width, poisson=0.3)
    field = airy_series(sheet, wave, modes=20)
    x, y = width * np.array([0.11, -0.4, 0.49]), np.array([0.3, -0.47, 0.12])
    h, t = 1e-5, 0.17
    d_x = (field.displacement(x + h, y, t) - field.displacement(x - h, y, t)) / (2 * h)
    d_y = (field.displacement(x, y + h, t) - field.displacement(x, y - h, t)) / (2 * h)
    expected = np.stack([d_x[0], d_y[1], (d_x[1] + d_y[0]) / 2])
    # second-order differences: h^2 times third derivatives (up to 1e4 next to an edge), over 6
    np.testing.assert_allclose(field.strain(x, y, t), expected, atol=3e-7)


def test_velocity_is_the_time_derivative_of_the_displacement():
    field = airy_series(PAPER, PULSE, modes=15)
    h = 1e-5
    difference = (field.displacement(0.1, 0.2, 0.3 + h) - field.displacement(0.1, 0.2, 0.3 - h)) / (
        2 * h
    )
    np.testing.assert_allclose(field.velocity(0.1, 0.2, 0.3), difference, atol=1e-8)  # h^2 omega^3


@pytest.mark.parametrize("width", [0.1, 0.5, 1.0, 3.0])
@pytest.mark.parametrize("count", [1, 2, 5])
def test_edges_are_free_of_traction(width, count):
    sheet = Sheet(width=width)
    field = airy_series(sheet, SineWave(count), rtol=1e-8)
    x = np.linspace(-0.5, 0.5, 41)[1:-1] * width
    y = np.linspace(-0.5, 0.5, 41)[1:-1]
    for t in (EVEN, ODD, 0.4):
        sides = field.stress(np.array([[-width / 2], [width / 2]]), y, t)
        ends = field.stress(x[:, None], np.array([-0.5, 0.5]), t)
        # away from the corners; 1e-8 in displacement leaves about k_max times as much in stress
        assert abs(sides[0]).max() < 5e-5
        assert abs(ends[1]).max() < 5e-5
        assert abs(sides[2]).max() < 1e-12  # shear vanishes term by term
        assert abs(ends[2]).max() < 1e-12


def test_corners_are_finite_and_free():
    field = airy_series(PAPER, SINE, rtol=1e-9)
    corners = field.stress(np.array([-0.25, 0.25, 0.25]), np.array([-0.5, 0.5, -0.5]), 0.1)
    # the corner is where truncation shows most: stress ~ distance^1.74, distance ~ 1/k_max
    assert abs(corners).max() < 1e-3


@pytest.mark.parametrize("wave", [SINE, PULSE])
def test_cross_sections_carry_no_force_and_no_moment(wave):
    field = airy_series(PAPER, wave, rtol=1e-9)
    x, y, _ = gauss_points(PAPER, 60, 60)
    w = np.polynomial.legendre.leggauss(60)[1]
    across = field.stress(x, np.array([-0.3, 0.0, 0.22]), 0.1)
    along = field.stress(np.array([[-0.2], [0.1]]), y, 0.1)
    # quadrature of 60 points is exact to 1e-9 away from the edges' boundary layers
    assert abs(w @ across[1]).max() < 1e-8
    assert abs(along[0] @ w).max() < 1e-8
    assert abs(along[0] @ (w * y)).max() < 1e-8
    assert abs(w @ across[2]).max() < 1e-8


def test_stresses_do_not_depend_on_poissons_ratio():
    x, y, _ = gauss_points(PAPER, 5, 7)
    stresses = [
        airy_series(Sheet(poisson=nu), SINE, modes=20).stress(x, y, 0.1) for nu in (-0.9, 0.0, 0.5)
    ]
    np.testing.assert_array_equal(stresses[0], stresses[1])
    np.testing.assert_array_equal(stresses[0], stresses[2])


@pytest.mark.parametrize("wave", [SINE, PULSE])
def test_displacement_has_no_mean_and_no_rotation(wave):
    sheet = Sheet(width=0.8, poisson=0.4)
    field = airy_series(sheet, wave, rtol=1e-9)
    x, y, w = gauss_points(sheet, 40, 60)
    for t in (0.0, 0.13):
        u = field.displacement(x, y, t)
        # Gauss quadrature of the weak corner singularities, distance^2.74
        assert np.sum(w * u, axis=(1, 2)) == pytest.approx([0, 0], abs=1e-9)
        assert np.sum(w * (x * u[1] - y * u[0])) == pytest.approx(0, abs=1e-9)


def test_uniform_growth_dilates_without_stress():
    field = airy_series(PAPER, TravellingWave(np.zeros(1), np.zeros(1), mean=0.7), modes=3)
    x, y = np.array([0.1, -0.2]), np.array([0.4, 0.0])
    np.testing.assert_allclose(field.displacement(x, y, 0.2), 0.7 * np.stack([x, y]), atol=1e-15)
    assert abs(field.stress(x, y, 0.2)).max() == 0


@pytest.mark.parametrize("width", [1e-2, 1e-3])
def test_narrow_strip_grows_freely(width):
    field = airy_series(Sheet(width=width), SINE, rtol=1e-6)
    x, y, _ = gauss_points(Sheet(width=width), 5, 9)
    strain = field.strain(x, y, 0.1)
    growth = SINE.value(x, y, 0.1)
    # the stress that is left is (k W)^2/24 of the growth
    bound = (2 * np.pi * width) ** 2 / 12
    assert abs(strain[:2] - growth).max() < bound
    assert abs(strain[2]).max() < bound


def test_mirrored_wave_is_the_mirrored_field():
    forward, backward = (airy_series(PAPER, SineWave(n), modes=20) for n in (1, -1))
    x, y, _ = gauss_points(PAPER, 5, 7)
    u, v = forward.displacement(x, -y, 0.1), backward.displacement(x, y, 0.1)
    # sin(-ky - wt) is the wave mirrored in y
    np.testing.assert_allclose(v, np.stack([u[0], -u[1]]), atol=1e-14)


def test_rescaling_the_sheet_rescales_the_displacement():
    small, large = Sheet(1.0, 0.4, 0.3), Sheet(5.0, 2.0, 0.3)
    u = airy_series(small, SINE, modes=15).displacement(0.1, 0.2, 0.3)
    np.testing.assert_allclose(
        airy_series(large, SINE, modes=15).displacement(0.5, 1.0, 0.3), 5 * u, rtol=1e-13
    )


def error_at(cutoff, tail, t, sheet=PAPER):
    reference = AirySeries(sheet, SINE, balanced_modes(sheet, SINE, 100), True, False)
    field = AirySeries(sheet, SINE, balanced_modes(sheet, SINE, cutoff), tail, False)
    return relative_difference(sheet, field, reference, t)


@pytest.mark.parametrize("t", [EVEN, ODD])
def test_plain_truncation_converges_with_order_two(t):
    rate = np.log2(error_at(10, False, t) / error_at(40, False, t)) / 2
    assert 1.8 < rate < 2.2
    assert error_at(20, False, t) < 3e-4  # 2.4e-4 and 2.1e-4 measured


@pytest.mark.parametrize("t", [EVEN, ODD])
def test_tails_raise_the_order_to_four(t):
    # the error oscillates with log k (complex corner exponent): rate over a factor of eight
    rate = np.log2(error_at(5, True, t) / error_at(40, True, t)) / 3
    assert rate > 3
    assert error_at(20, True, t) < 4e-7  # 2.7e-7 and 2.8e-7 measured: plain needs 600 modes for that


HONEST = [
    (width, nu, count, cutoff, tail)
    for width, count in (
        (0.02, 1),
        (0.1, 3),
        (0.5, 1),
        (0.5, 5),
        (1.0, 2),
        (2.0, 1),
        (8.0, 1),
        (20.0, 3),
    )
    for nu in (-0.9, 0.5)
    for cutoff, tail in ((3, True), (9, True), (9, False))
]


@pytest.mark.parametrize(("width", "nu", "count", "cutoff", "tail"), HONEST)
def test_error_estimate_is_honest_and_not_wasteful(width, nu, count, cutoff, tail):
    sheet, wave = Sheet(width=width, poisson=nu), SineWave(count)
    modes = balanced_modes(sheet, wave, cutoff)
    reference = AirySeries(sheet, wave, (5 * modes[0] + 8, 5 * modes[1] + 8), True, False)
    field = AirySeries(sheet, wave, modes, tail, False)
    true = max(relative_difference(sheet, field, reference, t, 24 + 8 * count) for t in (EVEN, ODD))
    assert true <= field.error
    assert field.error < 30 * true + 1e-11


def test_rtol_is_met_over_a_range():
    reference = AirySeries(PAPER, PULSE, (160, 320), True, False)
    for rtol in (1e-2, 1e-4, 1e-6, 1e-8):
        field = airy_series(PAPER, PULSE, rtol=rtol)
        assert field.error <= rtol
        true = max(relative_difference(PAPER, field, reference, t) for t in (0.0, 0.2, 0.7))
        assert true <= rtol


def test_printed_equations_leave_traction_on_the_edges():
    x = np.linspace(-0.2, 0.2, 21)[:, None]
    worst = {
        form: abs(airy_series(PAPER, SINE, modes=20, tail=False, form=form).stress(x, 0.5, t)[1]).max()
        for form in ("corrected", "printed")
        for t in (EVEN,)
    }
    # growth is 1: traction of a tenth of it is no truncation error
    assert worst["corrected"] < 0.01
    assert worst["printed"] > 0.1


HARD = [
    (1.0, 0.01, 1, 2000),
    (0.01, 1.0, 1, 2000),
    (1.0, 0.5, 50, 60),
    (1.0, 0.01, 50, 300),
    (0.01, 1.0, 50, 60),
    (1.0, 0.5, 1, 2000),
]


@pytest.mark.parametrize(("length", "width", "count", "modes"), HARD)
def test_hard_cases_neither_overflow_nor_lose_digits(length, width, count, modes):
    sheet = Sheet(length, width)
    with np.errstate(over="raise", invalid="raise", divide="raise"):
        field = airy_series(sheet, SineWave(count), modes=modes)
        x = np.array([0, 0.3, 0.5, -0.5])[:, None] * width
        y = np.array([-0.5, 0.0, 0.25, 0.5]) * length
        values = field.displacement(x, y, 0.1), field.strain(x, y, 0.1), field.stress(x, y, 0.1)
    assert all(np.all(np.isfinite(v)) for v in values)
    assert np.isfinite(field.error)


@pytest.mark.parametrize("shape", [(1.0, 0.01), (0.01, 1.0)])
def test_extreme_aspect_ratios_reach_a_small_error(shape):
    field = airy_series(Sheet(*shape), SINE, rtol=1e-5)
    assert field.error <= 1e-5


def test_broadcasting_agrees_with_single_points():
    field = airy_series(PAPER, PULSE, modes=12)
    x, y = np.array([[-0.2], [0.1]]), np.array([0.3, -0.4, 0.1])
    t = np.array([0.1, 0.5])[:, None, None]
    everything = field.displacement(x, y, t)
    assert everything.shape == (2, 2, 2, 3)
    for k, i, j in np.ndindex(2, 2, 3):
        single = field.displacement(x[i, 0], y[j], t[k, 0, 0])
        np.testing.assert_allclose(everything[:, k, i, j], single, atol=1e-14)


def test_scattered_points_agree_with_a_grid():
    field = airy_series(PAPER, SINE, modes=15)
    rng = np.random.default_rng(1)
    x, y = rng.uniform(-0.25, 0.25, 300), rng.uniform(-0.5, 0.5, 300)
    scattered = field.stress(x, y, 0.2)
    single = np.stack([field.stress(x[i], y[i], 0.2) for i in range(0, 300, 37)], axis=-1)
    np.testing.assert_allclose(scattered[:, ::37], single, atol=1e-13)


def test_cost_is_reported():
    start = time.perf_counter()
    field = airy_series(PAPER, SINE, modes=20)
    assert 0 < field.seconds <= time.perf_counter() - start


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"modes": 0}, ["modes", "0", ">= 1"]),
        ({"modes": 2.5}, ["modes", "2.5", "integer"]),
        ({"modes": 10**6}, ["modes", "1000000"]),
        ({"rtol": 0}, ["rtol", "0"]),
        ({"rtol": 1e-18}, ["rtol", "1e-18"]),
        ({"form": "typed"}, ["form", "typed", "printed"]),
    ],
)
def test_bad_input(arguments, words):
    with pytest.raises(ValueError, match="must be") as error:
        airy_series(PAPER, SINE, **arguments)
    assert all(word in str(error.value) for word in words)


def test_printed_form_is_for_the_papers_shape_only():
    with pytest.raises(ValueError, match=r"width = 0\.6"):
        airy_series(Sheet(width=0.6), SINE, modes=5, form="printed")


def test_fewer_modes_than_the_wave_has_are_refused():
    with pytest.raises(ValueError, match=r"modes = 2.*\[3"):
        airy_series(PAPER, PULSE, modes=2)


@pytest.mark.parametrize(("x", "y"), [(0.3, 0.0), (0.0, -0.6), (np.nan, 0.0)])
def test_points_outside_the_sheet_are_refused(x, y):
    with pytest.raises(ValueError, match=r"must be (in|finite)"):
        airy_series(PAPER, SINE, modes=5).displacement(x, y, 0.0)


def test_a_tolerance_out_of_reach_keeps_the_best_field(monkeypatch):
    monkeypatch.setattr("linear_theory.deformation.airy.series.MOST_COUPLINGS", 5000)
    with pytest.raises(NotConvergedError, match="would need") as error:
        airy_series(PAPER, SINE, rtol=1e-12)
    assert 1e-12 < error.value.best.error < 1e-6


def test_error_finds_the_worst_phase_of_a_shifted_sine():
    shifted = TravellingWave(np.array([0.6]), np.array([0.8]))
    sheet = Sheet(width=20.0)
    assert airy_series(sheet, shifted, modes=40).error == pytest.approx(
        airy_series(sheet, SINE, modes=40).error, rel=1e-10
    )
