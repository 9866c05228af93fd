"""Paths: exact circles, literal composition, symmetries, honest errors, limits of small growth."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from linear_theory import CrawlSpeed, SineWave, crawl_speed, rigid_path
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.path import Path
from tests.turning.path_cases import (
    PAPER,
    SQUARE,
    TAU,
    Array,
    Growth,
    constant,
    made_up,
    oblique,
    swinging,
    theory,
    unequal,
    unequal_pulse,
)


def literal(rigid: Callable[[Array], Array], periods: int, steps: int) -> Array:
    """x, y, heading after every period, by the midpoint rule: second order in 1/steps."""
    x = y = angle = 0.0
    found = []
    for t in (np.arange(periods * steps) + 0.5) / steps:
        v_x, v_y, omega = rigid(np.array(t % 1)) / steps
        middle = angle + omega / 2
        x += v_x * np.cos(middle) - v_y * np.sin(middle)
        y += v_x * np.sin(middle) + v_y * np.cos(middle)
        angle += omega
        found.append((x, y, angle))
    return np.array(found)[steps - 1 :: steps]


def test_constant_velocities_make_a_circle() -> None:
    """z = v (exp(i Omega t) - 1)/(i Omega): radius v/Omega, and v along it."""
    path = rigid_path(made_up(constant, period=2.0), periods=7, samples=5)
    z = (0.3 + 0.4j) * (np.exp(1.7j * path.times) - 1) / 1.7j
    # turned by 3.4 in a period, cut in 24: the quartics leave (3.4/24)^6, the cubics (3.4/24)^4/384
    np.testing.assert_allclose(path.position, [z.real, z.imag], atol=3e-6)
    np.testing.assert_allclose(path.heading, 1.7 * path.times, atol=1e-12)
    np.testing.assert_allclose(path.times, np.arange(36) * 0.4, atol=1e-12)
    assert path.radius == pytest.approx(0.5 / 1.7, rel=1e-6)
    assert path.speed == pytest.approx(0.5, rel=1e-6)
    assert path.turn == pytest.approx(3.4, abs=1e-12)
    # d as the chord of that circle
    assert np.linalg.norm(path.step) == pytest.approx(2 * path.radius * np.sin(1.7), rel=1e-9)


@pytest.mark.parametrize("turns", [0.0, 1e-9, 1e-3, TAU, -2.5 * TAU])
def test_periods_are_composed_exactly(turns: float) -> None:
    """Against one pose after another, with any turn: none, next to none, whole and half circles."""
    path = rigid_path(
        made_up(lambda t: np.stack([0 * t, 0.1 + 0.2 * np.sin(TAU * t), turns + 0 * t]), panels=12),
        40,
        1,
    )
    z, heading = 0j, 0.0
    for k in range(41):
        # roundoff of 40 sums; the angle of whole circles is 1e-15 of 40 * 2.5 TAU
        assert complex(*path.position[:, k]) == pytest.approx(z, abs=1e-12)
        assert path.heading[k] == pytest.approx(heading, abs=1e-12)
        z += complex(*path.step) * np.exp(1j * heading)
        heading += path.turn


def test_a_literal_composition_agrees() -> None:
    coarse, fine = (literal(swinging, 5, steps) for steps in (200, 400))
    expected = fine + (fine - coarse) / 3
    path = rigid_path(made_up(swinging, panels=12), 5, 3)
    ends = np.vstack([path.position, path.heading])[:, 3::3].T
    # Richardson leaves 5 (TAU/400)^4 = 3e-7, quartics on 48 steps about as much
    np.testing.assert_allclose(ends, expected, atol=3e-6)


def test_the_quadrature_in_time_is_of_sixth_order() -> None:
    exact = rigid_path(made_up(swinging, panels=96))
    errors = []
    for panels in (6, 12):
        path = rigid_path(made_up(swinging, panels=panels))
        errors.append(np.linalg.norm(path.step - exact.step))
        assert errors[-1] <= path.step_error
        assert abs(path.turn - exact.turn) <= path.turn_error + 1e-14
    assert errors[0] / errors[1] > 0.8 * 2**6


def test_mirrored_motions_go_straight() -> None:
    speed = crawl_speed(PAPER, SineWave(), 0.1, rtol=1e-3)
    path = rigid_path(speed, periods=1000, samples=2)
    assert speed.rigid is None
    assert path.is_straight
    assert path.turn == path.turn_error == 0
    assert path.radius == path.radius_error == np.inf
    np.testing.assert_array_equal(path.position[0], 0)
    np.testing.assert_array_equal(path.heading, 0)
    np.testing.assert_allclose(path.position[1, ::2], np.arange(1001) * speed.mean, rtol=1e-12)
    np.testing.assert_allclose(path.position_error[::2], np.arange(1001) * speed.error, rtol=0.2)
    assert path.speed == pytest.approx(speed.mean, rel=1e-12)
    assert path.times[0] == speed.times[0]


def test_poses_seen_from_one_of_them() -> None:
    path = rigid_path(made_up(swinging), periods=4, samples=1)
    seen = path.seen_from(2)
    np.testing.assert_allclose(seen.position[:, 2], 0, atol=1e-15)
    np.testing.assert_allclose(seen.position[:, 3:], path.position[:, 1:3], atol=1e-14)
    np.testing.assert_allclose(seen.heading[2:], path.heading[:3], atol=1e-14)


HONEST = [
    (unequal, PAPER, 0.1, (1e-2, 1e-3)),
    (unequal, PAPER, 0.02, (1e-2,)),
    (unequal_pulse, PAPER, 0.1, (1e-2,)),
    (oblique(45), PAPER, 0.1, (1e-2,)),
    (oblique(90), SQUARE, 0.1, (1e-2, 1e-3)),
]
"""Wave, sheet, alpha, tolerances."""


@pytest.mark.parametrize(("growth", "sheet", "alpha", "tolerances"), HONEST)
def test_errors_are_honest(
    growth: Growth, sheet: Sheet, alpha: float, tolerances: tuple[float, ...]
) -> None:
    """Also where V_y is 0; and after so many periods as make a circle."""
    exact = theory(growth, sheet, alpha, 0.3 * min(tolerances), 500)
    for rtol in tolerances:
        path = theory(growth, sheet, alpha, rtol, 500)
        off = np.linalg.norm(path.position - exact.position, axis=0)
        assert np.all(off <= path.position_error + exact.position_error)
        turned = abs(path.heading - exact.heading)
        assert np.all(turned <= path.heading_error + exact.heading_error)
        # an estimate that says nothing is honest, too; turning within a period may add to the mean's
        assert path.step_error <= 1.5 * rtol * np.linalg.norm(path.step)


def turned(speed: CrawlSpeed, **parts: np.ndarray) -> CrawlSpeed:
    """With another mean or error of its rigid motion."""
    return replace(speed, turning=replace(speed.turning, **parts))


def test_an_error_of_the_speed_adds_up_over_the_periods() -> None:
    """All three velocities off by their errors; on the way and round two circles."""
    error, turn_error = 1e-5, 3e-5

    def steady(v: float, omega: float) -> CrawlSpeed:
        return made_up(lambda t: np.stack([0.1 + v + 0 * t, 0.1 + v + 0 * t, 0.05 + omega + 0 * t]))

    stated = np.array([error, error, turn_error])
    path = rigid_path(turned(steady(0, 0), error=stated), 250, 1)
    other = rigid_path(steady(error, turn_error), 250, 1)
    off = np.linalg.norm(path.position - other.position, axis=0)
    np.testing.assert_allclose(other.heading - path.heading, path.heading_error, rtol=1e-6, atol=1e-12)
    assert np.all(off[1:] < path.position_error[1:])
    # at most twice too large while the path is about straight, and of the largest distance later
    assert np.all(path.position_error[1:20] < 2 * off[1:20])
    assert path.position_error[-1] < 3 * off.max()


def test_means_are_those_of_the_speed() -> None:
    """They are better known than the values at the times, of which a part has exactly no mean."""
    turning = made_up(lambda t: np.stack([0 * t, 0 * t, np.sin(TAU * t)]))
    path = rigid_path(turned(turning, mean=np.array([0.0, 0.0, 0.3])))
    assert path.turn == pytest.approx(0.3, abs=1e-14)
    aside = made_up(lambda t: np.stack([0.1 + np.sin(TAU * t), 0.2 + 0 * t, 0 * t]))
    path = rigid_path(turned(aside, mean=np.array([0.3, 0.4, 0.0])))
    np.testing.assert_allclose(path.step, [0.3, 0.4], atol=1e-14)


def test_errors_within_the_period_are_honest() -> None:
    """Few times: what is stated beyond the error of a whole period covers them."""
    rough, exact = (rigid_path(made_up(swinging, panels=n), samples=50) for n in (3, 96))
    off = np.linalg.norm(rough.position - exact.position, axis=0)
    turned = abs(rough.heading - exact.heading)
    assert np.all(off[1:] <= rough.position_error[1:] - rough.step_error)
    assert np.all(turned[1:] <= rough.heading_error[1:] - rough.turn_error)
    assert turned.max() > 1e-5


def test_error_of_the_radius_is_honest() -> None:
    exact, rough = theory(unequal), theory(unequal, rtol=1e-2)
    assert abs(rough.radius - exact.radius) <= rough.radius_error + exact.radius_error
    assert rough.radius_error < 0.1 * rough.radius


def assert_image(path: Path, other: Path, mirror: tuple[float, float, float]) -> None:
    """One step is the image of the other, within the errors, which are small."""
    image = np.array([*other.step, other.turn]) * mirror
    off = abs(np.array([*path.step, path.turn]) - image)
    assert np.all(off[:2] <= path.step_error + other.step_error)
    assert off[2] <= path.turn_error + other.turn_error
    assert path.step_error < 0.02 * np.linalg.norm(path.step)


@pytest.mark.parametrize("growth", [unequal, oblique(30), unequal_pulse])
def test_images_of_a_wave_make_images_of_the_path(growth: Growth) -> None:
    """Turned by half a circle, mirrored in x and mirrored in y; a mirror turns the heading round."""
    path, rough = theory(growth, rtol=1e-2), {"rtol": 1e-2}
    assert_image(theory(lambda x, y, t: growth(-x, -y, t), **rough), path, (-1, -1, 1))
    assert_image(theory(lambda x, y, t: growth(-x, y, t), **rough), path, (-1, 1, -1))
    assert_image(theory(lambda x, y, t: growth(x, -y, t), **rough), path, (1, -1, -1))


def test_a_square_does_not_know_x_from_y() -> None:
    up, right = theory(oblique(0), SQUARE), theory(oblique(90), SQUARE)
    np.testing.assert_allclose(right.step, up.step[::-1], atol=up.step_error + right.step_error)
    assert max(up.step_error, right.step_error) < 1e-3 * up.step[1]  # rtol
    assert up.is_straight
    assert right.is_straight
    straight = crawl_speed(SQUARE, SineWave(), 0.1, rtol=1e-3)
    assert up.step[1] == pytest.approx(straight.mean, abs=up.step_error + straight.error)


def test_a_wave_along_the_diagonal_of_a_square_moves_it_along_the_diagonal() -> None:
    path = theory(oblique(45), SQUARE)
    assert path.step[0] == pytest.approx(path.step[1], abs=path.step_error)
    assert path.step_error < 2e-3 * path.speed
    assert path.is_straight
    assert path.turn_error < 1e-3 * path.speed


def test_an_oblique_wave_drives_a_long_sheet_along_itself() -> None:
    """Point symmetry forbids to turn. Most of the way is along y, at 45 degrees to the wave."""
    path = theory(oblique(45))
    assert path.is_straight
    assert path.radius == np.inf
    assert 0 < path.step[0] < 0.05 * path.step[1]


def test_an_unequal_wave_turns_the_sheet_to_its_weaker_side() -> None:
    """Speed grows with the square of the amplitude: the strong right side overtakes the left one.

    The turn is less than that of two strips which crawl on their own, d(V)/dx T = 4 V/L T here.
    """
    path = theory(unequal)
    assert path.turn > 20 * path.turn_error
    assert path.turn < 4 * path.step[1]
    closed = theory(unequal, periods=round(TAU / path.turn))
    assert closed.position[:, : closed.times.size // 2][0, 1:].max() < 0  # to the left at first
    # at the end of the circle it is back at its start to half a step
    assert np.linalg.norm(closed.position[:, -1]) < 0.6 * np.linalg.norm(path.step)
    centre = path.radius * np.array([-1.0, 0.0])
    distances = np.linalg.norm(closed.position - centre[:, None], axis=0)
    # the first step is along y up to the angle of the body frame, of order alpha
    np.testing.assert_allclose(distances, path.radius, rtol=0.01)


def test_small_growth_turns_by_alpha_squared() -> None:
    turns = [theory(unequal, alpha=a).turn / a**2 for a in (0.02, 0.04)]
    # the next terms are of relative order alpha^2 for waves with c(t + T/2) = -c(t)
    np.testing.assert_allclose(turns[0], turns[1], rtol=0.01)


def test_small_growth_by_pulses_turns_by_alpha() -> None:
    turns = [theory(unequal_pulse, alpha=a, rtol=1e-2).turn / a for a in (0.01, 0.02, 0.04)]
    assert abs(turns[0]) > 0.01
    # linear in alpha from there on
    assert turns[2] - turns[1] == pytest.approx(2 * (turns[1] - turns[0]), rel=0.15)
    assert abs(turns[1] - turns[0]) < 0.1 * abs(turns[0])


def test_bad_input() -> None:
    speed = made_up(constant)
    for name, options in (
        ("periods = 0", {"periods": 0}),
        ("periods = 1.5", {"periods": 1.5}),
        ("samples = -1", {"samples": -1}),
    ):
        with pytest.raises(ValueError, match=name):
            rigid_path(speed, **options)
    with pytest.raises(ValueError, match="must be a CrawlSpeed"):
        rigid_path(0.1)
    with pytest.raises(ValueError, match=r"speed.times has 1 times"):
        rigid_path(crawl_speed(PAPER, SineWave(), 0.0))
    warped = replace(speed, times=speed.times**2)
    with pytest.raises(ValueError, match="equal, positive steps"):
        rigid_path(warped)
