"""Errors stated for random bending gaits hold against much finer runs."""

import numpy as np

from figures.measure import gaits, gaits_checked
from figures.measure.gaits_checked import TABLE

ROWS = TABLE.read()


def test_no_stated_error_is_wrong() -> None:
    assert len(ROWS) >= 5
    for row in ROWS:
        assert np.isnan(row.finer) == (row.holds == -1) == bool(row.said)
        if row.holds >= 0:
            assert row.holds == int(abs(row.finer - row.speed) <= row.error)
        assert row.holds != 0, row


def test_the_gaits_are_those_of_their_numbers() -> None:
    for row in ROWS:
        chosen = gaits.gait(row.number)
        assert all(getattr(row, name) == value for name, value in vars(chosen).items())


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
