"""The table of random questions is complete and understates nothing; the page is that of the tables."""

from tests.robust import reliability_page
from tests.robust.trials import settings, table

ROWS = table.TABLE.read()


def test_the_table_has_every_trial_once():
    assert sorted((row.family, row.number) for row in ROWS) == sorted(table.wanted())
    answered = [row for row in ROWS if row.family in reliability_page.ENTRANCES and not row.refused]
    assert len(answered) >= 2000


def test_no_stated_error_is_below_the_true_one():
    assert [row for row in ROWS if row.ratio > 1] == []


def test_no_setting_changes_a_bit():
    rows = settings.TABLE.read()
    assert [row.setting for row in rows] == list(settings.SETTINGS)
    assert [(row.asked, row.different) for row in rows] == [(len(settings.QUESTIONS), 0)] * len(rows)


def test_trials_could_fail():
    """True errors are not 0, and within a factor of ten of the stated ones in some trial of each."""
    for family in reliability_page.ENTRANCES:
        shares = [row.ratio for row in ROWS if row.family == family and not row.refused]
        assert sum(share > 0 for share in shares) > len(shares) / 2
        assert max(shares) > 0.03


def test_the_page_is_that_of_the_tables():
    assert reliability_page.PAGE.read_text(encoding="utf-8") == reliability_page.page(ROWS)
