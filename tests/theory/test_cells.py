"""Graded cells, grids of cells, time grids and the vectorised Newton methods."""

import numpy as np
import pytest

from linear_theory import Sheet
from linear_theory.balance.newton import damped_newton, guarded_newton
from linear_theory.balance.time_grid import first_grid
from linear_theory.common.errors import NotConvergedError
from linear_theory.motion.cells import gauss, graded
from linear_theory.motion.motion import CellGrid


def turning_integral(halvings, order=8, centre=0.3):
    """Integral of x^2/|(x, y)| over a square that is off the singular point by `centre`."""
    rule = gauss(order)
    x, y = np.meshgrid(rule.points + centre, rule.points + centre / 3, indexing="ij")

    def roughness(values, owners):
        w = values[:, :, ::3, ::3]
        mean = w.mean(axis=(-2, -1), keepdims=True)
        rough = (mean**2).sum(0)[:, 0, 0] < 2.25 * ((w - mean) ** 2).sum(0).max(axis=(-2, -1))
        across = abs(values[0, :, -1, 0] - values[0, :, 0, 0])
        return rough, np.where(across > abs(values[1, :, 0, -1] - values[1, :, 0, 0]), 0, 1)

    cells = graded(np.stack([x, y])[:, None], np.zeros(1, int), roughness, halvings)
    x, y = cells.values
    return float(cells.integrals((x * x / np.hypot(x, y))[None])[0, 0])


def test_graded_cells_converge_geometrically():
    exact = turning_integral(60)
    errors = [abs(turning_integral(n) - exact) for n in (8, 16, 24)]
    # the integrand is of order r: error ~ (area of the last cell)^(3/2) = 2^(-3/2 halvings)
    rates = np.log2(np.array(errors[:-1]) / errors[1:]) / 8
    assert np.all(rates > 1.2)
    assert errors[-1] < 1e-9


def test_a_plain_grid_stalls_where_graded_cells_do_not():
    exact = turning_integral(60)
    assert abs(turning_integral(0) - exact) > 1e-5
    assert abs(turning_integral(30) - exact) < 1e-10


def test_halving_keeps_polynomials_and_areas():
    rule = gauss(4)
    x, y = np.meshgrid(rule.points, rule.points, indexing="ij")
    values = np.stack([x**3 * y**2 + x, np.ones_like(x)])[:, None]

    def always(values, owners):
        return np.ones(owners.size, bool), np.arange(owners.size) % 2

    cells = graded(values, np.zeros(1, int), always, 5)
    assert cells.owners.size == 32
    assert cells.shares.sum() == pytest.approx(1)
    total = cells.integrals(cells.values**2)[:, 0]
    # int (x^3 y^2 + x)^2 = 4 (1/35 + 2/15 + 1/3); degree 6 is exact with 4 points
    assert total == pytest.approx([4 * (1 / 35 + 2 / 15 + 1 / 3), 4], rel=1e-13)


@pytest.mark.parametrize("half", [False, True])
@pytest.mark.parametrize("size", [(1.0, 0.5), (1.0, 0.01), (0.02, 1.0), (3.0, 3.0)])
@pytest.mark.parametrize("waves", [1, 7, 50])
def test_graded_grids_cover_the_sheet(half, size, waves):
    sheet = Sheet(*size)
    grid = CellGrid.graded(sheet, waves, 4.0, half)
    x, y, area = grid.points(3)
    weights = np.multiply.outer(gauss(3).weights, gauss(3).weights)
    assert (area * weights).sum() == pytest.approx(sheet.area / (2 if half else 1))
    assert np.all(np.diff(grid.x_edges) > 0)
    assert np.all(np.diff(grid.y_edges) > 0)
    assert max(np.diff(grid.y_edges)) <= sheet.length / (4 * waves) * (1 + 1e-9)
    assert x.min() > (0 if half else -sheet.width / 2)
    assert y.max() < sheet.length / 2
    # the number of columns grows with the logarithm of the aspect ratio only
    assert len(grid.x_edges) < 24


def test_time_grid_is_exact_for_polynomials_of_degree_five():
    grid = first_grid(0.5, 2.0, 2)
    mean, _ = grid.mean(grid.times**5)
    assert mean == pytest.approx((2.0**6 - 0.5**6) / 6 / 1.5, rel=1e-14)


@pytest.mark.parametrize("kink", [0.377, 0.51, 0.9])
def test_time_grid_closes_in_on_a_kink(kink):
    def function(t):
        return np.cos(3 * t) + abs(t - kink)

    exact = np.sin(3) / 3 + (kink**2 + (1 - kink) ** 2) / 2
    grid = first_grid(0.0, 1.0, 3)
    for _ in range(40):
        mean, error = grid.mean(function(grid.times))
        assert abs(mean - exact) <= error
        if error < 1e-7:
            break
        times, (grid, new) = grid.times, grid.refined(function(grid.times), 1e-7)
        np.testing.assert_array_equal(grid.times[~new], times)
    assert error < 1e-7
    assert grid.times.size < 250  # equal steps would need 3000


def test_guarded_newton_finds_smooth_steep_and_jumping_zeros():
    places = np.array([0.3, -0.2, 0.7, 0.0])

    def function(x, which):
        d = x - places[which]
        kinds = [
            lambda d: (d + d**3, 1 + 3 * d**2),
            lambda d: (np.arctan(1e6 * d), 1e6 / (1 + (1e6 * d) ** 2)),
            lambda d: (np.sign(d) + 0.1 * d, np.full_like(d, 0.1)),
            lambda d: (d**3, 3 * d**2),
        ]
        value, slope = np.empty_like(d), np.empty_like(d)
        for i, j in enumerate(which):
            value[i], slope[i] = (v[0] for v in kinds[j](d[i : i + 1]))
        return value, slope

    found = guarded_newton(function, np.full(4, 0.9), np.full(4, -1.0), np.full(4, 1.0), 1e-12)
    # the triple zero is found to the cube root of what its Newton steps of 2/3 leave
    np.testing.assert_allclose(found, places, atol=1e-11)


def test_damped_newton_minimises_a_narrow_valley():
    centre = np.array([[0.3, -0.4, 0.1], [0.0, 0.2, 0.5]])

    def function(x, which):
        d = x - centre[which]
        root = np.sqrt(1e-4 + d**2)  # gradients that saturate: full Newton steps overshoot
        hessian = np.einsum("ni,ij->nij", 1e-4 / root**3, np.eye(3))
        return d / root, hessian

    found = damped_newton(function, np.zeros((2, 3)) + 0.01, 1e-12)
    np.testing.assert_allclose(found, centre, atol=1e-10)


def test_newton_methods_say_when_they_fail():
    with pytest.raises(NotConvergedError, match="not finite") as error:
        guarded_newton(
            lambda x, which: (np.full(x.size, np.nan), np.ones(x.size)),
            np.zeros(1), -np.ones(1), np.ones(1), 0.0,
        )  # fmt: skip
    assert error.value.best.shape == (1,)
