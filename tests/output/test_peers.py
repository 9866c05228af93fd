"""The table of other codes is complete, its exact values are right, and its page and figure follow."""

import math

import numpy as np
import pytest

from figures.draw.peers import figure, page
from figures.measure.cost.cases import P4, RITZ, TAIL
from figures.measure.cost.fields import Fields
from figures.measure.peers import command, field, ours, problems
from figures.measure.peers.command import TABLE
from figures.measure.peers.problems import BLOCK, OURS, STRIP, Case


def test_every_run_is_in_the_table_and_its_error_is_that_of_its_value() -> None:
    rows = TABLE.read()
    wanted = [(c.problem, c.code, c.knob) for c in problems.cases()]
    assert [(r.problem, r.code, r.knob) for r in rows] == wanted
    for row in rows:
        if math.isnan(row.value):
            assert row.remark != "none"
            continue
        assert row.error == pytest.approx(abs(row.value / row.exact - 1), abs=2e-3)
        assert row.seconds > 0


def test_exact_values_by_other_means() -> None:
    """The block by small explicit steps, the strip by the trial of the shell for its curvature."""
    place, speed, dt = 0.0, problems.SPEED, 1e-5
    while speed > 0:
        speed -= dt * 9.81 * (0.5 * math.cos(0.2) - math.sin(0.2))
        place += dt * speed
    assert problems.exact(BLOCK) == pytest.approx(place, rel=1e-4)
    assert problems.exact(STRIP) == pytest.approx(0.0045 * 9, rel=1e-12)  # 0.0045 at kappa = 1
    assert problems.young() * problems.THICKNESS**3 / 12 == pytest.approx(problems.bending())
    # B/(q L^3) of the paper's sheet: h = 0.03, q = 2.5e-4
    assert pytest.approx(0.03**3 / 12 / 2.5e-4) == problems.BENDING


def test_ours_is_as_the_table_says() -> None:
    kept = {(r.problem, r.code, r.knob): r for r in TABLE.read()}
    for case in (Case(BLOCK, OURS, 2, 1, steps=32), Case(STRIP, OURS, 8, 1, steps=4)):
        row = command.measured(case)
        assert row.value == pytest.approx(kept[case.problem, case.code, case.knob].value, rel=1e-3)
        assert row.error < 5e-3
    assert ours.SLIP * math.atanh(math.tan(0.2) / 0.5) == pytest.approx(
        kept[BLOCK, OURS, "256 steps"].drift, rel=1e-2
    )


def test_mesh_of_the_strip_is_an_arc_of_the_right_area() -> None:
    case = Case(STRIP, "any", 64, 2)
    points, triangles = problems.strip(case, 3.0)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    assert area.sum() == pytest.approx(0.04, rel=1e-3)
    centre = np.array([0, 1 / 3])
    assert np.hypot(*(points[:, [0, 2]] - centre).T) == pytest.approx(1 / 3, rel=1e-12)
    assert (np.cross(b - a, c - a)[:, 2] > 0).all()


def test_page_and_figure_are_made_from_the_table() -> None:
    rows, solved = TABLE.read(), field.TABLE.read()
    assert page.PAGE.read_text(encoding="utf-8") == page.page(rows, solved)
    panels = figure.draw(rows, solved).axes
    drawn = sum(len(line.get_xdata()) for axes in panels for line in axes.lines)
    known = [r for r in rows if not math.isnan(r.error)]
    assert drawn == len(known) + len(solved)
    for axes, shown in ((panels[0], known), (panels[-1], solved)):
        (left, right), (low, high) = axes.get_xlim(), axes.get_ylim()
        assert all(low < r.error < high and left < r.seconds < right for r in shown)


def test_displacements_of_this_package_are_as_the_table_says() -> None:
    """Errors do not depend on the machine; other codes converge to what this one finds."""
    rows = field.TABLE.read()
    kept = {(r.code, r.value): r.error for r in rows}
    fields = Fields()
    for case in field.cases(fields):
        if (case.level, int(case.value)) in ((TAIL, 20), (RITZ, 9), (P4, 4)):
            error = case.judge(case.solve()).error
            assert error == pytest.approx(kept[f"sheetcrawl, {case.level}", int(case.value)], rel=0.05)
    for code in {r.code for r in rows} - {f"sheetcrawl, {level}" for level in field.OURS}:
        errors = [r.error for r in rows if r.code == code]
        assert errors[-1] < min(1e-4, errors[0] / 30)


def test_without_the_environment_it_says_how_to_make_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(command, "PEERS", command.ROOT / "build" / "nothing" / "python")
    with pytest.raises(SystemExit, match="`make peers` makes it"):
        command.main([])
