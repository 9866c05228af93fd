"""Size of rigid motions, and the time grid that is refined by several components."""

import numpy as np
import pytest

from linear_theory import Sheet
from linear_theory.balance.time_grid import first_grid
from linear_theory.common.tolerance import Tolerance
from linear_theory.motion.rigid import RigidNorm

SHEET = Sheet(length=3.0, width=0.7)
GYRATION = np.hypot(3.0, 0.7) / np.sqrt(12)  # of a rectangle
MOTION = np.array([0.3, -0.5, 1.7])


def test_size_is_the_root_mean_square_of_the_velocities():
    nodes, weights = np.polynomial.legendre.leggauss(3)  # exact for squares
    x, y = nodes[:, None] * SHEET.width / 2, nodes * SHEET.length / 2
    v = np.stack(np.broadcast_arrays(MOTION[0] - MOTION[2] * y, MOTION[1] + MOTION[2] * x))
    mean_square = np.einsum("cxy,x,y->", v**2, weights, weights) / 4
    assert RigidNorm(GYRATION, False).size(MOTION) == pytest.approx(np.sqrt(mean_square), rel=1e-14)


def test_of_mirrored_motions_the_speed_counts_alone():
    norm = RigidNorm(GYRATION, True)
    assert norm.size(MOTION) == 0.5
    assert norm.size([np.nan, -1e-200, np.inf]) == 1e-200  # no square that vanishes
    np.testing.assert_array_equal(norm.each(0.2), [0, 0.2, 0])
    np.testing.assert_array_equal(norm.speeds(np.outer(MOTION, [1, 2])), [[-0.5, -1.0]])


def test_a_speed_of_each_component():
    norm = RigidNorm(GYRATION, False)
    for unit in np.eye(3):
        assert norm.size(unit * norm.each(0.2)) == pytest.approx(0.2, rel=1e-14)


@pytest.mark.parametrize("mirrored", [False, True])
def test_tolerance_is_a_share_of_the_size_or_absolute(mirrored):
    norm = RigidNorm(GYRATION, mirrored)
    error = 1e-3 * MOTION
    assert norm.meets(MOTION, error, Tolerance(1.001e-3, 1e-9))
    assert not norm.meets(MOTION, error, Tolerance(0.999e-3, 1e-9))
    assert norm.meets(0 * MOTION, error, Tolerance(1e-3, 1.001 * norm.size(error)))
    # an error of a component that is small is not measured by that component
    assert norm.meets([0.0, 1.0, 0.0], norm.each(1e-3), Tolerance(1.8e-3, 1e-9))


def test_time_grid_closes_in_on_the_kinks_of_all_components():
    def function(t):
        return np.stack([abs(t - 0.377), 10 * abs(t - 0.81), 0 * t])

    kinks, sizes = np.array([0.377, 0.81]), np.array([1, 10])
    exact = np.append(sizes * (kinks**2 + (1 - kinks) ** 2) / 2, 0)
    grid = first_grid(0.0, 1.0, 3)
    while grid.error(function(grid.times)) > 1e-6:
        grid, _ = grid.refined(function(grid.times), 1e-6)
    means, errors = grid.means(function(grid.times))
    assert np.all(abs(means - exact) <= errors + 1e-15)
    assert np.linalg.norm(errors) <= grid.error(function(grid.times)) * (1 + 1e-12)
    assert grid.times.size < 250  # equal steps would need 3000
    for kink in kinks:
        assert np.diff(grid.times)[abs(grid.times[1:] - kink).argmin()] < 1e-3
