"""Errors stated for random bending gaits hold against much finer runs."""

from pathlib import Path

import numpy as np

from figures.measure import gaits, gaits_checked
from figures.measure.gaits_checked import TABLE

ROWS = TABLE.read()


def test_no_stated_error_is_wrong() -> None:
    assert len(ROWS) >= 30
    for row in ROWS:
        assert np.isnan(row.finer) == (row.holds == -1) == bool(row.said)
        if row.holds >= 0:
            assert row.holds == int(abs(row.finer - row.speed) <= row.error)
        assert row.holds != 0, row


def test_the_gaits_are_those_of_their_numbers() -> None:
    for row in ROWS:
        chosen = gaits.gait(row.number)
        rounded = (float(f"{value:.{gaits.DIGITS}g}") for value in (chosen.alpha, chosen.kappa))
        assert (row.alpha, row.kappa) == tuple(rounded)
        names = ("wave", "ground", "friction", "inertia")
        assert all(getattr(row, name) == getattr(chosen, name) for name in names)


def test_gaits_that_do_not_cross_are_checked_first() -> None:
    row = gaits.Row(**vars(gaits.gait(0)), outcome="stated", said="", **gaits.NOTHING)
    known = {"speed": 0.1, "error": 0.01, "crossed": 0.0}
    rows = [
        gaits.Row(**{**vars(row), **known, "number": 10, "crossed": 0.2}),
        gaits.Row(**{**vars(row), **known, "number": 20}),
        gaits.Row(**{**vars(row), **known, "number": 30, "speed": 1e-9}),
        gaits.Row(**{**vars(row), **known, "number": 40, "error": np.inf}),
        gaits.Row(**{**vars(row), **known, "number": 51}),
    ]
    assert [r.number for r in gaits_checked.chosen(rows, 10)] == [20, 10]


def test_the_page_has_the_counts_of_the_tables() -> None:
    page = Path(__file__).parents[2] / "docs" / "howto" / "bending.md"
    said = " ".join(page.read_text(encoding="utf-8").split())
    rows = gaits.TABLE.read()
    stopped = sum(row.outcome == "stopped" for row in rows)
    assert f"Of {len(rows)} gaits" in said
    assert f"{len(rows) - stopped} end with a speed and {stopped} stop with the reason" in said
    seconds = [row.seconds for row in rows]
    assert f"in {np.mean(seconds):.0f} s on average and {max(seconds):.0f} s at most" in said
    crossed, snapped = (sum(getattr(r, name) > 0 for r in rows) for name in ("crossed", "snapped"))
    assert f"{crossed} pass through themselves and {snapped} jump" in said
    assert f"{sum(row.outcome == 'converged' for row in rows)} meet 10 %" in said
    moved = [r for r in rows if abs(r.speed) > gaits_checked.NOTHING]  # NaN is not
    small, large = (
        np.median([r.error / abs(r.speed) for r in moved if (abs(r.kappa) <= 5) is gentle])
        for gentle in (True, False)
    )
    assert f"the error is {100 * small:.0f} % of V or less in half of them" in said
    assert large > 1
    assert f"of {len(ROWS)} no speed moved by more than its error" in said
