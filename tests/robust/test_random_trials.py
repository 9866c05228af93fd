"""The first of the random questions of every family, four threads at once, and symmetries of units."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from linear_theory import Sheet, SineWave, crawl_speed
from tests.robust.trials.families import FAMILIES, outcome

SEED = 2026
COUNTS = {
    "speed": 8,
    "line": 15,
    "direction": 3,
    "field": 6,
    "bent": 2,
    "outline": 1,
    "prediction": 2,
    "command": 20,
    "damaged": 20,
    "kept": 25,
}
"""So that all take some 20 s; thousands are in the table of `trials.table`, of the same seed."""


@pytest.mark.parametrize(
    ("family", "number"), [(family, i) for family, count in COUNTS.items() for i in range(count)]
)
def test_no_error_is_understated(family: str, number: int) -> None:
    found = outcome(family, SEED, number)
    assert found.ratio <= 1, found.words


@pytest.mark.parametrize("family", FAMILIES)
def test_trials_are_questions_that_can_fail(family: str) -> None:
    """Most are answered, and the errors compared are not 0."""
    if family in ("command", "damaged", "kept"):
        return
    found = [outcome(family, SEED, number) for number in range(min(COUNTS[family], 3))]
    assert sum(one.true > 0 for one in found) > len(found) / 2


def test_four_threads_at_once_find_what_one_finds() -> None:
    alphas = np.linspace(0.05, 0.2, 8)

    def ask(alpha: float) -> tuple[float, float]:
        found = crawl_speed(Sheet(), SineWave(), alpha, rtol=1e-2)
        return found.mean, found.error

    alone = [ask(alpha) for alpha in alphas]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(ask, alphas)) == alone
