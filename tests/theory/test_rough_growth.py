"""Growth that jumps or has ridges: what Gauss points miss is in the error, or a refusal follows."""

import numpy as np
import pytest

from linear_theory import FieldWave, NotConvergedError, Sheet, TravellingWave, crawl_speed
from linear_theory.deformation.ritz import field as ritz
from linear_theory.deformation.ritz import ritz_field
from tests.theory.test_ritz import coefficient_distance, distance


def front(x, y, t):
    """Growth +1 and -1 that jumps, along y."""
    return np.where(np.sin(2 * np.pi * (y - t)) > 0, 1.0, -1.0) + 0 * x


def still(x, y, t):
    """A rate that saves time where velocities do not matter."""
    return 0.0 * (x + y + t)


@pytest.mark.parametrize("degree", [(7, 67), (11, 137)])
def test_error_estimate_is_honest_where_growth_jumps(degree):
    """Gauss points see a front within their distance only, whatever the polynomials."""
    k = np.arange(1, 102)
    # exact moments; harmonics beyond, displacements ~ 1/k^2, make (3 * 101**3)**-0.5 = 6e-4 together
    series = TravellingWave(np.zeros(101), np.where(k % 2, 4 / (np.pi * k), 0.0))
    reference = ritz_field(Sheet(), series, degree=(15, 341))
    field = ritz_field(Sheet(), FieldWave(front, 1.0, still), degree=degree)
    true = distance(field, reference)
    assert 0.02 < true <= field.error  # measured 0.051, 0.026
    assert field.error < 5 * true


@pytest.mark.parametrize(
    "shape",
    [
        lambda x, y, t: np.sign(np.sin(2 * np.pi * (x + y - t))),
        lambda x, y, t: abs(np.sin(np.pi * (x + y - t))),
        lambda x, y, t: 1.0 * (np.hypot(x - 0.1 * np.cos(2 * np.pi * t), y) < 0.15),
        lambda x, y, t: np.tanh(20 * np.sin(2 * np.pi * (y - t))) + 0 * x,
    ],
)
@pytest.mark.parametrize("degree", [(7, 13), (15, 31)])
def test_points_too_few_for_the_growth_are_in_the_error(monkeypatch, shape, degree):
    """By the same polynomials with moments from many points."""
    wave = FieldWave(shape, 1.0, still)
    field = ritz_field(Sheet(), wave, degree=degree)

    def many(self):
        across, along = (d + 1 for d in self.degree)
        return self._moments_by((301, 401), self._cases.growths)[:, :across, :along]

    monkeypatch.setattr(ritz.RitzField, "_moments", many)
    true = coefficient_distance(field, ritz_field(Sheet(), wave, degree=degree))
    assert true <= field.aliased <= 5 * true  # what 401 points miss is 1/10 of it
    assert field.aliased <= field.error


def test_a_jump_is_refused_after_few_attempts(monkeypatch):
    monkeypatch.setattr(ritz, "MOST_NUMBERS", 200_000)
    solvers, original = [], ritz.RitzSolver
    monkeypatch.setattr(ritz, "RitzSolver", lambda *a: solvers.append(a[1]) or original(*a))
    with pytest.raises(NotConvergedError, match=r"rtol = 0\.01: requires degrees") as caught:
        ritz_field(Sheet(), FieldWave(front, 1.0, still), rtol=1e-2)
    assert caught.value.best.degree == solvers[-1]
    assert caught.value.best.error > 1e-2
    # a front needs degrees like 1/rtol: both double, or all but (they are odd)
    assert np.all(np.array(solvers[1:]) >= 1.9 * np.array(solvers[:-1]))


@pytest.mark.parametrize("rtol", [1e-3, 1e-6, 1e-11])
def test_smooth_growth_costs_no_more_degrees(monkeypatch, rtol):
    wave = FieldWave(lambda x, y, t: np.exp(x) * np.sin(2 * np.pi * (y - t) + 3 * x * y), 1.0)
    field = ritz_field(Sheet(1, 0.1, 0.3), wave, rtol=rtol)
    assert field.aliased < 1e-3 * rtol
    monkeypatch.setattr(ritz.RitzField, "_aliased", property(lambda self: self._polynomials[:, :0]))
    assert ritz_field(Sheet(1, 0.1, 0.3), wave, rtol=rtol).degree == field.degree


def test_growth_that_jumps_is_refused(monkeypatch):
    monkeypatch.setattr("linear_theory.deformation.ritz.field.MOST_NUMBERS", 100_000)
    wave = FieldWave(lambda x, y, t: np.sign(np.sin(2 * np.pi * (y - t))) + 0 * x, 1.0)
    with pytest.raises(NotConvergedError, match="requires degrees"):
        crawl_speed(Sheet(), wave, 0.1)
