"""Limits of the speed of a sheet: of the load, of the work, and of slip speeds near those of floats."""

import numpy as np
import pytest

from linear_theory import FieldWave, Sheet, SineWave, TravellingWave, crawl_speed, ritz_field
from linear_theory.balance.crawl import Crawl
from linear_theory.friction.laws import Tanh

PAPER = Sheet()
SINE = SineWave()
OBLIQUE_SINE = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (x + y - t)), 1.0)
PULSE = TravellingWave(np.array([0.5, 0.3, 0.1]), np.array([0.2, 0.1, 0.3]))


def test_limit_of_the_load_is_printed_so_that_it_is_true():
    for sign in (1, -1):
        with pytest.raises(ValueError, match="area element") as refusal:
            crawl_speed(PAPER, SINE, sign * 0.9, rtol=1e-2)
        limit = float(str(refusal.value).split()[-1])
        assert crawl_speed(PAPER, SINE, limit, rtol=1e-2).mean > 0
        with pytest.raises(ValueError, match="area element"):
            crawl_speed(PAPER, SINE, limit + sign * 2e-4, rtol=1e-2)


@pytest.mark.parametrize("most", [100, 30_000])
def test_work_is_bounded_and_what_it_misses_is_flagged(monkeypatch, most):
    """30000: 100 or so times of the first cells."""
    exact = crawl_speed(PAPER, PULSE, 0.1, rtol=1e-4)
    spent, balance = [], Crawl.balance

    def counted(self, times, known=None):
        spent.append(self.work * times.size)
        return balance(self, times, known)

    monkeypatch.setattr("linear_theory.balance.crawl.MOST_WORK", most)
    monkeypatch.setattr(Crawl, "balance", counted)
    speed = crawl_speed(PAPER, PULSE, 0.1, rtol=1e-4)
    assert sum(spent[1:]) <= 2 * most  # cells and times: all but the first look
    assert not speed.converged
    assert 1e-4 * abs(exact.mean) < speed.error
    assert abs(speed.mean - exact.mean) <= speed.error + exact.error


def test_a_field_solved_for_at_each_time_counts_as_work():
    travelling, general = ritz_field(PAPER, SINE, degree=9), ritz_field(PAPER, OBLIQUE_SINE, degree=9)
    assert travelling.numbers == 0
    assert general.numbers == 2 * 10 * 10


def test_slip_speeds_of_any_size_make_finite_forces():
    speeds = np.array([1e-30, 0.1, 1e5])
    for slip in (5e-324, 1e-320, 1e-110, 1e308):
        law = Tanh(slip)
        forces, tangents = law.force(np.diag(speeds)), law.tangent(np.diag(speeds))
        share = np.tanh(np.minimum(speeds / max(slip, 1e-300), 50))
        np.testing.assert_allclose(forces, np.diag(share))
        np.testing.assert_allclose(tangents[[3, 0, 0], [0, 1, 2]], share / speeds)  # across
        np.testing.assert_allclose(tangents[[0, 3, 5], [0, 1, 2]], 0 if slip < 1e-30 else 1 / slip)
