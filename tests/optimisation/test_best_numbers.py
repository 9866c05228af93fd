"""Best numbers by gradient against plain scans and closed forms; rows of the tables made again."""

import json

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from fem_check import solve
from figures.common.records import Table
from figures.draw.optimise import best_waves, page
from figures.measure.optimise import buys, couplings, line, scan
from figures.measure.optimise.one_arc import best_of_one_arc, wave_of_one_arc
from linear_theory.line.best.dry import dry_bound, size_of
from linear_theory.line.best.viscous import viscous_speed


@pytest.mark.parametrize("table", [line.TABLE, scan.TABLE, buys.TABLE], ids=lambda t: t.path.stem)
def test_tables_are_kept_as_their_command_writes_them(table: Table, tmp_path):
    again = table.write(table.read(), tmp_path / "again.csv")
    assert again.read_bytes() == table.path.read_bytes()


def test_waves_of_many_harmonics_stay_between_the_linear_program_and_the_bound():
    """The optimiser loses the margin of |c| between phases, half a percent."""
    rows = line.TABLE.read()
    assert [row.harmonics for row in rows] == list(line.HARMONICS)
    for row in rows:
        assert row.bound == pytest.approx(dry_bound(row.harmonics), abs=1e-5)
        assert 0.994 * row.reached < row.best < row.reached <= row.most < row.bound
    wave = wave_of_one_arc(5)
    assert size_of(wave) == pytest.approx(1, abs=1e-3)
    c = wave.profile(2 * np.pi * np.arange(20000) / 20000)
    assert np.median(c) - c.mean() == pytest.approx(best_of_one_arc(5).reached, abs=1e-4)


def test_searches_and_scans_agree_within_the_grid_and_their_errors():
    """Of the whole table; the search is better but for errors, and closer than a place of the grid."""
    rows = scan.TABLE.read()
    assert [row.question for row in rows] == scan.asked()
    for row in rows:
        found, scanned, spacing = (
            np.array(text.split(), float) for text in (row.found, row.scanned, row.spacing)
        )
        assert np.all(abs(found - scanned) <= 1.001 * spacing), row.question
        assert row.value >= row.scan_value - row.error - row.scan_error, row.question
        assert row.value <= 1.03 * row.scan_value, row.question


def test_the_best_number_of_waves_of_a_strip_is_that_of_the_closed_form():
    """Sines of any wavelength in a 1D body under viscous friction: an own search by exact kernels.

    The strip is 0.05 L wide and alpha = 0.1: a few percent of the place, 1 % of V.
    """
    phase = 2 * np.pi * (np.arange(800) + 0.5) / 800

    def slowness(count):
        return -4 * np.pi * viscous_speed(np.cos(count * phase), np.sin(count * phase))[0]

    exact = minimize_scalar(slowness, bounds=(0.3, 1.5), method="bounded", options={"xatol": 1e-6})
    question = scan.QUESTIONS["waves, viscous strip"]
    found = scan.searched(question, 1)[0]
    (count,) = question.numbers(found.point)
    assert count == pytest.approx(exact.x, rel=0.01)
    assert found.value / 0.1**2 == pytest.approx(-exact.fun, rel=0.01)
    (row,) = (row for row in scan.TABLE.read() if row.question == "waves, viscous strip")
    assert row.value == pytest.approx(found.value, abs=row.error + found.found.error)


def test_the_best_width_again():
    """The pulse against the wave: a coarse scan brackets the place of the table."""
    question = scan.QUESTIONS["width, pulse, against the wave"]
    (row,) = (row for row in scan.TABLE.read() if row.question == "width, pulse, against the wave")
    widths = (0.3, float(row.found), 0.55)
    found = [solve(question.at([width]), "first order", 1e-3).speed for width in widths]
    values = [-speed.mean for speed in found]
    assert values[1] > max(values[0], values[2])
    assert values[1] == pytest.approx(row.value, abs=row.error + found[1].error)


def test_the_best_couplings_of_a_bent_sheet_are_those_of_the_quadratic_form():
    """V = V_aa alpha^2 + V_ab alpha beta is lowest at alpha = -V_ab beta/(2 V_aa), beta at its bound.

    V_aa = 1.02798, V_ab = -0.103941 on the paper's ground are those of cycles of nonlinear shapes
    (figures/data/saddle.csv), 0.05 % from those of the theory.
    """
    (row,) = (row for row in scan.TABLE.read() if row.question == couplings.QUESTION)
    alpha, beta = (float(word) for word in row.found.split())
    aa, ab = 1.02798, -0.103941
    assert beta == pytest.approx(0.4, rel=1e-3)
    assert alpha == pytest.approx(-ab * beta / (2 * aa), rel=0.01)
    assert row.value == pytest.approx(ab**2 * beta**2 / (4 * aa), rel=0.01)
    again = couplings.speed_at(alpha, beta)
    assert -again.mean == pytest.approx(row.value, abs=row.error + again.error)


def test_a_row_of_what_optimisation_buys_is_made_again():
    """Its wave has the size that it says, and its speeds by the closed form and the nonlinear sheet."""
    (row,) = (
        row
        for row in buys.TABLE.read()
        if buys.place_of(row) == buys.Place("wide", "largest", 2, "first order")
    )
    assert 0.99 < size_of(row.wave) < 1.001
    scene = buys.scene(row.sheet, row.wave)
    strip = solve(scene, "strip").mean
    cycle = solve(scene, "cycle", 1e-2).speed
    assert strip == pytest.approx(row.strip, rel=1e-4)
    assert abs(cycle.mean - row.cycle) <= cycle.error + row.cycle_error


def test_the_page_is_that_of_the_tables():
    rows = buys.TABLE.read()
    assert page.page(rows, scan.TABLE.read()) == page.PAGE.read_text(encoding="utf-8")
    assert {row.sheet for row in rows} == set(buys.SHEETS)
    best = buys.Place("paper", "largest", 2, "first order")
    (row,) = (row for row in rows if buys.place_of(row) == best)
    (sine,) = (one for one in rows if one.sheet == "paper" and one.level == buys.GIVEN)
    value, error = page.gain(rows, row)
    assert value == row.cycle / sine.cycle
    assert error > 0
    with pytest.raises(ValueError, match="no sine on 'paper' in the table"):
        page.page([row], [])


def test_figure_of_the_best_waves(tmp_path):
    paths = best_waves.write(line.TABLE.read(), tmp_path, ("pdf",))
    assert [path.name for path in paths] == ["best_waves.pdf", "best_waves.json"]
    shown = json.loads(paths[-1].read_text())
    assert shown["viscous"]["wavelength"] == pytest.approx(shown["viscous"]["gain"])
    assert shown["dry"]["40"]["bound"] == pytest.approx(20 / 21, abs=1e-5)
