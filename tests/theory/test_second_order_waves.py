"""Second order in alpha for waves that depend on x: V_x, V_y, Omega against the nonlinear sheet."""

import numpy as np
import pytest
import skfem

from fem_check.shell.cycle.balance import CycleBalance
from fem_check.shell.cycle.shapes import cycle_of_shapes
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.material import Material
from linear_theory import FieldWave, Sheet, SineWave, TravellingWave, crawl_speed, second_order
from linear_theory.balance.crawl import Resolution
from linear_theory.deformation.load_cases import mixed_norms
from linear_theory.deformation.ritz import ritz_field
from linear_theory.deformation.second.field import SecondOrderField, second_order_field
from linear_theory.friction.contact import Contact
from linear_theory.friction.laws import Coulomb, Viscous
from linear_theory.growth.growth import Growth
from linear_theory.scene.scene import Scene
from linear_theory.speed.expansion import TINY_ALPHA, Coefficients

SHEET, K = Sheet(width=0.5, poisson=0.3), 2 * np.pi
SINE = SineWave()
PULSE = TravellingWave(np.array([0.5, 0.3]), np.array([0.2, 0.1]))


def oblique(x, y, t, slant=0.5):
    """A sine whose crests are not across the sheet."""
    return np.sin(K * (y + slant * x - t))


def oblique_rate(x, y, t):
    return -K * np.cos(K * (y + 0.5 * x - t))


def unequal(x, y, t, side=1.0):
    """A pulse that is stronger on one side."""
    return (1 + side * x) * np.sin(K * (y - t)) + 0.3 * np.cos(2 * K * (y - t))


WAVES = {"oblique": FieldWave(oblique, 1.0, oblique_rate), "unequal": FieldWave(unequal, 1.0)}


def theory(wave, load, law, times, area="grown"):
    """q_0 and q_1 at times, (2, times, 3)."""
    field = second_order_field(SHEET, wave, Growth(1.0, energy_area=area), rtol=1e-4)
    fine = Resolution(density=4.0, order=7, halvings=26, tolerance=1e-5)
    motion = Coefficients(field, TINY_ALPHA, Contact(load, law), fine).balance(times)
    return np.stack([motion.leading, motion.remainder])


def nonlinear(wave, load, law, times, alpha, area="grown"):
    """Odd and even parts in alpha of the balanced motion of nonlinear shapes, likewise."""
    found = []
    for signed in (alpha, -alpha):
        scene = Scene(
            sheet=SHEET,
            wave=wave,
            alpha=signed,
            effects=(Membrane(Material(SHEET.thickness, SHEET.poisson)),),
            growth_law="exp",
            area=area,
            cells=(4, 6),
            element=skfem.ElementQuadBFS(),
        )
        balance = CycleBalance.of(cycle_of_shapes(scene, 16), Contact(load, law), 1e-4)
        found.append(balance.balance(times).leading[0])
    return np.stack([(found[0] - found[1]) / (2 * alpha), (found[0] + found[1]) / (2 * alpha**2)])


@pytest.mark.parametrize("name", WAVES)
@pytest.mark.parametrize("area", ["grown", "undeformed"])
def test_viscous_motion_is_that_of_the_nonlinear_sheet_at_every_time(name, area):
    """Smooth in alpha: both orders of all three components, the frame and the displaced arms."""
    times, law = np.array([0.03, 0.11, 0.2, 0.37]), Viscous()
    expected = nonlinear(WAVES[name], "current", law, times, 0.01, area)
    found = theory(WAVES[name], "current", law, times, area)
    # 4 x 6 cells; alpha^2 of the next order
    np.testing.assert_allclose(found, expected, rtol=2e-3, atol=1e-3)


@pytest.mark.parametrize("name", WAVES)
def test_dry_motion_is_that_of_the_nonlinear_sheet(name):
    times, law = np.array([0.03, 0.2, 0.37]), Coulomb()
    expected = nonlinear(WAVES[name], "grown", law, times, 0.01)
    found = theory(WAVES[name], "grown", law, times)
    # largest differences 6e-4 and 2.3e-3; 4e-5 and 1e-4 with 8 x 12 elements and alpha = 0.003
    np.testing.assert_allclose(found[0], expected[0], rtol=1e-3, atol=5e-4)
    np.testing.assert_allclose(found[1], expected[1], rtol=1e-3, atol=2e-3)


@pytest.mark.parametrize("wave", [SINE, PULSE])
def test_general_and_harmonic_solution_are_the_same(wave):
    """A wave c(y, t) given as a function: u_2 of every time apart, no harmonics, no mirror symmetry."""
    harmonic, general = (
        second_order_field(SHEET, w, rtol=1e-5) for w in (wave, FieldWave(wave.value, 1.0, wave.rate))
    )
    x, y, t = np.array([[0.1], [-0.24]]), np.array([0.3, -0.5, 0.2]), 0.27
    for name in ("second_displacement", "second_velocity", "velocity", "strain"):
        one, other = (getattr(f, name)(x, y, t) for f in (harmonic, general))
        # degrees differ; both are right to some 1e-5 in the mean, strains at an edge to ten times that
        np.testing.assert_allclose(one, other, atol=3e-4 * abs(one).max())


def test_general_wave_along_y_has_the_same_coefficients():
    for wave in (SINE, PULSE):
        one, other = (second_order(SHEET, w, rtol=2e-2) for w in (wave, FieldWave(wave.value, 1.0)))
        assert other.second == pytest.approx(one.second, abs=one.second_error + other.second_error)
        assert other.first == pytest.approx(one.first, abs=one.first_error + other.first_error)
        assert one.rigid_second[[0, 2]].tolist() == one.rigid_second_error[[0, 2]].tolist() == [0, 0]
        assert np.all(abs(other.rigid_second[[0, 2]]) <= other.rigid_second_error[[0, 2]])
        assert np.all(abs(other.rigid_first[[0, 2]]) <= other.rigid_first_error[[0, 2]] + 1e-15)


def test_second_velocity_is_the_rate_of_the_second_displacement():
    field, step = second_order_field(SHEET, WAVES["oblique"]), 1e-3
    ahead, behind = (field.second_displacement(0.1, 0.2, 0.3 + s) for s in (step, -step))
    # step^2/6 of the third derivative, (4 pi)^3 at most
    np.testing.assert_allclose(
        field.second_velocity(0.1, 0.2, 0.3), (ahead - behind) / (2 * step), atol=4e-4
    )


def test_mirror_images():
    """x -> -x turns V_x and Omega round, y -> -y turns V_y and Omega round."""
    images = {
        (1, 1): lambda x, y, t: unequal(x, y, t) + 0.3 * oblique(x, y, t),
        (-1, 1): lambda x, y, t: unequal(-x, y, t) + 0.3 * oblique(-x, y, t),
        (1, -1): lambda x, y, t: unequal(x, -y, t) + 0.3 * oblique(x, -y, t),
    }
    found = {k: second_order(SHEET, FieldWave(f, 1.0), rtol=1e-2) for k, f in images.items()}
    one = found[1, 1]
    assert np.all(abs(one.rigid_second) > 10 * one.rigid_second_error)  # nothing is 0 by symmetry
    for (x, y), other in found.items():
        signs = np.array([x, y, x * y])
        for name in ("rigid_first", "rigid_second"):
            error = getattr(one, f"{name}_error") + getattr(other, f"{name}_error")
            difference = abs(getattr(other, name) - signs * getattr(one, name))
            assert np.all(difference <= error + 1e-12)


@pytest.mark.parametrize("name", WAVES)
def test_errors_of_all_components_are_honest(name):
    exact = second_order(SHEET, WAVES[name], rtol=2e-3)
    found = second_order(SHEET, WAVES[name], rtol=2e-2)
    for order in ("rigid_first", "rigid_second"):
        error = getattr(found, f"{order}_error") + getattr(exact, f"{order}_error")
        assert np.all(abs(getattr(found, order) - getattr(exact, order)) <= error + 1e-12)
    assert found.second_error <= 2e-2 * abs(found.second)
    assert (found.first, found.second) == (found.rigid_first[1], found.rigid_second[1])


def test_speed_of_order_two_has_all_components():
    alpha, both = 0.1, second_order(SHEET, WAVES["unequal"], rtol=1e-2)
    speed = crawl_speed(SHEET, WAVES["unequal"], alpha, order=2, rtol=1e-2)
    assert speed.rigid.shape == (3, speed.times.size)
    np.testing.assert_array_equal(speed.rigid[1], speed.velocity)
    assert speed.mean == pytest.approx(both.first * alpha + both.second * alpha**2, rel=1e-12)
    closed = np.append(speed.times, speed.times[0] + 1)
    means = np.trapezoid(np.concatenate([speed.rigid, speed.rigid[:, :1]], 1), closed)
    expected = alpha * both.rigid_first + alpha**2 * both.rigid_second
    np.testing.assert_allclose(means, expected, atol=5e-3 * abs(expected).max())  # trapezoids
    np.testing.assert_allclose(speed.rigid_mean, expected, rtol=1e-12)
    errors = alpha * both.rigid_first_error + alpha**2 * both.rigid_second_error
    np.testing.assert_allclose(speed.rigid_error, errors, rtol=1e-12)
    mirrored = crawl_speed(SHEET, SINE, alpha, order=2, rtol=1e-2)
    assert mirrored.rigid is mirrored.rigid_mean is mirrored.rigid_error is None


def test_a_square_crawls_along_x_as_along_y():
    """Times are chosen by all components: the error is that of the wave along y, and within rtol."""
    square, rtol = Sheet(width=1.0), 5e-3
    exact = second_order(square, SINE, rtol=1e-3)
    found = second_order(square, FieldWave(lambda x, y, t: np.sin(K * (x - t)), 1.0), rtol=rtol)
    off = abs(found.rigid_second - [exact.second, 0, 0])
    assert np.all(off <= found.rigid_second_error + exact.second_error)
    assert found.rigid_second_error[0] <= rtol * exact.second


def test_both_orders_of_theory_have_the_same_first_order():
    one = crawl_speed(SHEET, WAVES["unequal"], 1e-5, rtol=1e-3, order=1)
    two = crawl_speed(SHEET, WAVES["unequal"], 1e-5, rtol=1e-3, order=2)
    for t in (0.1, 0.3):
        values = [[np.interp(t, s.times, v) for v in s.rigid] for s in (one, two)]
        # 1e-5 of order alpha^2, and linear interpolation between times
        np.testing.assert_allclose(values[1], values[0], atol=2e-2 * np.abs(values[0]).max())


def test_a_wave_that_changes_sign_is_seen():
    assert WAVES["oblique"].on(SHEET).changes_sign
    assert SINE.on(SHEET).changes_sign
    assert not WAVES["unequal"].on(SHEET).changes_sign
    shifted = FieldWave(lambda x, y, t: oblique(x, y, t) + 1e-6, 1.0)
    assert not shifted.on(SHEET).changes_sign


def test_slip_speed_of_coefficients_is_per_unit_alpha():
    """What stays fixed in the limit is slip speed over alpha; a speed is asked for at one alpha."""
    alpha, slip = -0.2, 0.04
    options = {"friction": "tanh", "rtol": 1e-2}
    speed = crawl_speed(SHEET, PULSE, alpha, slip_speed=slip, order=2, **options)
    found = second_order(SHEET, PULSE, slip_speed=slip / abs(alpha), **options)
    assert (speed.first_order, speed.second_order) == (found.first, found.second)
    other = second_order(SHEET, PULSE, slip_speed=slip, **options)
    assert abs(other.second - found.second) > 10 * (other.second_error + found.second_error)


@pytest.mark.parametrize(
    ("alpha", "law", "bound"), [(-1.2, "linear", "not within -1"), (0.4, "metric", "not within -0.5")]
)
def test_growth_by_which_lengths_vanish(alpha, law, bound):
    with pytest.raises(ValueError, match=bound):
        crawl_speed(SHEET, WAVES["unequal"], alpha, order=2, growth_law=law, rtol=1e-1)


@pytest.mark.parametrize(
    "shape",
    [
        lambda x, y, t: abs(np.sin(np.pi * (y + x - t))),
        lambda x, y, t: np.sign(np.sin(2 * np.pi * (x + y - t))),
    ],
)
def test_points_too_few_for_the_source_are_in_the_error_of_second_order(monkeypatch, shape):
    """u_2 of the same polynomials, its source by many points."""
    wave = FieldWave(shape, 1.0)
    first = ritz_field(SHEET, wave, degree=(9, 21))
    found = SecondOrderField(first)
    monkeypatch.setattr("linear_theory.deformation.second.source.EXTRA_POINTS", 200)
    fine = SecondOrderField(first)
    rates = found._times.rates(found._times.phases)
    size, missed = (
        mixed_norms(p, rates) for p in (found._polynomials, found._polynomials - fine._polynomials)
    )
    true = float((missed / size).max())
    assert 0.05 < true <= found.second_aliased <= 5 * true
    assert found.second_aliased <= found.second_error
