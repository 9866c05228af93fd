"""The cost tables: what is judged by what, powers, counts, the tables and the figure made from them."""

import math
from dataclasses import replace

import numpy as np
import pytest

from figures.draw import cost as cost_draw
from figures.measure.cost import cases as cost_cases
from figures.measure.cost import command as cost
from figures.measure.cost import effects as cost_effects
from figures.measure.cost import fields as cost_fields
from figures.measure.cost import growth as cost_growth
from figures.measure.cost import speeds as cost_speeds
from figures.measure.cost import tables as cost_table
from figures.measure.cost.peers import peer as peers
from figures.measure.cost.tables import Order, Point
from figures.measure.meters import calls, held_memory, machine, timed
from linear_theory import Sheet, airy_series, ritz_field


@pytest.fixture(scope="module")
def fields():
    return cost_fields.Fields()


@pytest.fixture(scope="module")
def linear():
    return cost_speeds.LinearSpeeds(1e-3)


@pytest.fixture(scope="module")
def nonlinear():
    return cost_speeds.NonlinearSpeeds((2, 4), 1e-2)


def find(cases, level, knob, value):
    return next(c for c in cases if (c.level, c.knob, c.value) == (level, knob, value))


def error_of(case):
    return case.judge(case.solve())


def points_of(panel, level, knob, values, errors, seconds):
    return [
        Point(panel, level, knob, float(v), e, 2 * e, 0.0, 3, s, 0.5 * s, 1.25 * s)
        for v, e, s in zip(values, errors, seconds, strict=True)
    ]


class Clock:
    """Readings so that calls take the given seconds."""

    def __init__(self, *seconds):
        self.readings = iter(np.concatenate([[0.0, s] for s in seconds]))

    def __call__(self):
        return float(next(self.readings))


def test_a_time_is_the_median_of_the_repeats_after_the_first():
    found = timed(lambda: "answer", patience=0.1, clock=Clock(9e-1, 0.25, 0.5, 0.125))
    assert found.result == "answer"
    assert (found.median, found.fastest, found.slowest, found.repeats) == (0.25, 0.125, 0.5, 3)


def test_long_calls_are_repeated_once_and_all_count():
    found = timed(lambda: None, clock=Clock(8.0, 4.0))
    assert (found.median, found.repeats) == (6.0, 2)


def test_short_calls_are_repeated_until_patience_or_number_ends():
    assert timed(lambda: None, 1.0, Clock(*[0.25] * 9)).repeats == 3
    assert timed(lambda: None, 1e9, Clock(*[0.25] * 30)).repeats == 15


def test_calls_are_counted_by_function():
    def once():
        return None

    def twice():
        once()
        once()

    assert calls(lambda: [twice() for _ in range(3)], {"a": once, "b": twice, "c": find}) == {
        "a": 6,
        "b": 3,
        "c": 0,
    }


def test_memory_is_what_is_held_and_not_what_was_used():
    def build():
        return np.ones(2_000_000).sum() + np.zeros(1_000_000)

    array, held = held_memory(build)
    assert held == pytest.approx(array.nbytes / 1e6, rel=0.01)  # the rest: objects of Python


def test_machine_is_told_in_one_line_without_paths():
    assert "numpy" in machine()
    assert not set("\n/\\") & set(machine())


@pytest.mark.parametrize(("knob", "sign"), [("modes", 1), ("rtol", -1)])
def test_powers_of_exact_data_are_exact_up_to_the_plateau(knob, sign):
    work = 2.0 ** np.arange(1, 7)
    errors = np.maximum(work**-3.0, 2.0**-12)
    found = cost_table.order(points_of("field", "x", knob, work**sign, errors, 5 * work**1.5))
    assert found.points == 4
    assert found.error_order == pytest.approx(3, rel=1e-12)
    assert found.time_exponent == pytest.approx(1.5, rel=1e-12)
    assert found.efficiency == pytest.approx(2, rel=1e-12)
    assert found.plateau == 2.0**-12


def test_errors_that_never_stop_falling_have_no_plateau():
    work = np.array([1.0, 2.0, 4.0])
    curve = points_of("field", "x", "modes", work, work**-2, work)
    assert math.isnan(cost_table.order(curve).plateau)
    flat = cost_table.order(points_of("field", "x", "modes", work, [0.3, 0.3, 0.3], work))
    assert flat.points == 1
    assert math.isnan(flat.error_order)
    assert flat.plateau == 0.3


def test_curves_run_from_coarse_to_fine():
    points = points_of("field", "x", "rtol", [1e-6, 1e-2, 1e-4], [1, 1, 1], [1, 1, 1])
    (curve,) = cost_table.curves(points)
    assert [p.value for p in curve] == [1e-2, 1e-4, 1e-6]


def test_the_cheapest_are_those_that_nothing_beats():
    points = points_of("field", "x", "k", range(5), [1, 0.1, 0.5, 0.01, 0.01], [1, 2, 3, 4, 5])
    assert [p.value for p in cost_table.cheapest(points)] == [0, 1, 3]


def test_tables_are_read_as_they_were_written(tmp_path):
    points = points_of("field", "a, b", "modes", [10, 20], [1e-3, 1.25e-4], [0.5, 1.5])
    points[0] = replace(points[0], model_claimed=math.nan)
    path = cost_table.write(points, tmp_path / "t.csv", "words")
    assert path.read_text().splitlines()[0] == f"# made by: {cost_table.COMMAND}; words"
    again = cost_table.read(path, Point)
    assert again[1] == points[1]
    assert str(again[0]) == str(points[0])  # nan is not equal to itself
    names = path.read_text().splitlines()[1].split(",")
    assert names.index("seconds") > names.index("error")  # what the machine decides stands last


def test_absent_tables_are_reported_with_their_command(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"python -m figures\.measure\.cost"):
        cost_table.read(tmp_path / "t.csv", Point)


SETTINGS = [
    (cost_cases.PLAIN, "modes", 10, cost_cases.RITZ),
    (cost_cases.TAIL, "modes", 10, cost_cases.RITZ),
    (cost_cases.RITZ, "degree", 13, cost_cases.TAIL),
    (cost_cases.P2, "L/size", 4, cost_cases.TAIL),
    (cost_cases.P4, "L/size", 2, cost_cases.TAIL),
]


@pytest.mark.parametrize(("level", "knob", "value", "reference"), SETTINGS)
def test_fields_are_judged_by_another_method(fields, monkeypatch, level, knob, value, reference):
    """The error is true (the references agree to 1e-10), the claim honest, and only the reference of
    the other method enters."""
    case = find(fields.cases(), level, knob, value)
    field = case.solve()
    error, claimed, _ = case.judge(field)
    assert 0 < error < claimed < 1
    own = ({cost_cases.RITZ, cost_cases.TAIL} - {reference}).pop()
    monkeypatch.setitem(fields._exact, own, np.full_like(fields._exact[own], np.nan))
    assert case.judge(field).error == error
    monkeypatch.setitem(fields._exact, reference, 2 * fields._exact[reference])
    assert case.judge(field).error == pytest.approx(0.5, abs=0.02)


def test_references_of_the_field_agree(fields):
    assert 0 < fields.disagreement() < 1e-10


def test_the_strip_is_the_limit_of_a_narrow_sheet():
    sheet, step = Sheet(width=0.01), 1e-5
    x, y, t = 0.004, np.linspace(-0.3, 0.3, 7), 0.15
    exact = ritz_field(sheet, cost_cases.WAVE, degree=(5, 41)).displacement(x, y, t)
    found = cost_fields.strip_displacement(x, y, t)
    # of relative order (W/L)^2 and, for the small u_x, W times the curvature of the wave
    np.testing.assert_allclose(found[1], exact[1], atol=1e-4)
    np.testing.assert_allclose(found[0], exact[0], atol=1e-5)
    ahead, behind = (cost_fields.strip_displacement(x, y + s, t)[1] for s in (step, -step))
    growth = cost_cases.WAVE.value(x, y, t)
    np.testing.assert_allclose((ahead - behind) / (2 * step), growth, atol=1e-8)  # step**2 k**2/6


def test_a_peer_is_judged_up_to_rigid_motions(fields, monkeypatch):
    """A peer that is the series itself, moved and turned, has no error; another wave has."""
    field = airy_series(cost_cases.SHEET, cost_cases.WAVE, rtol=1e-9)

    def displacements(solution, x, y):
        parts = np.stack([solution.displacement(x, y, t) for t in (0.0, 0.25)])
        return parts + 0.3 * np.stack([-y, x]) + np.array([0.1, -0.2])[:, None, None]

    peer = peers.Peer("same", (4,), lambda *_: field, displacements)
    monkeypatch.setattr(peers, "installed", lambda: [peer])
    case = find(fields.cases(), "same", "cells along", 4)
    assert case.judge(field).error < 1e-8  # the tolerance of the series, with room
    backwards = replace(peer, displacements=lambda *a: displacements(*a)[::-1])
    monkeypatch.setattr(peers, "installed", lambda: [backwards])
    assert error_of(find(fields.cases(), "same", "cells along", 4)).error > 0.5


def test_absent_peers_are_left_out_with_a_line(monkeypatch, capsys):
    monkeypatch.setattr(peers, "find_spec", lambda name: None)
    assert peers.installed() == []
    assert capsys.readouterr().out == "peers not installed, left out: ngsolve, sfepy\n"


def test_linear_speeds_are_judged_by_another_method(linear):
    for level, reference in ((cost_cases.TAIL, cost_cases.RITZ), (cost_cases.RITZ, cost_cases.TAIL)):
        case = find(linear.cases(), level, "rtol", 1e-2)
        found = case.solve()
        assert case.judge(found).error == abs(found.mean / linear.exact[reference] - 1)
        assert 0 < case.judge(found).error < case.judge(found).claimed
    assert linear.disagreement() < 1e-4


def test_cheap_levels_of_the_linear_speed_end_at_their_models(linear):
    line = error_of(find(linear.cases(), cost_cases.LINE, "points", 1)).error
    strip = error_of(find(linear.cases(), cost_cases.STRIP, "points", 1)).error
    assert line == pytest.approx(1 - 1 / 1.88, abs=0.02)  # V = 1.91 alpha^2 as alpha -> 0, F1
    assert 0.02 < strip < 0.06  # 2 alpha^2 instead


def test_nonlinear_levels_end_at_their_models(nonlinear):
    cases = list(nonlinear.cases())

    def judged(level, knob="rtol", value=1e-2):
        return error_of(find(cases, level, knob, value))

    assert judged(cost_cases.LINE, "points", 1).error == pytest.approx(0.34, abs=0.01)
    airy, ritz = (judged(level).error for level in (cost_cases.TAIL, cost_cases.RITZ))
    assert airy == pytest.approx(0.16, abs=0.01)  # (c) of the nonlinear sheet is 14 % below it
    assert airy == pytest.approx(ritz, abs=1e-3)  # the model decides, not the method
    assert judged(cost_cases.SECOND).error < 0.5 * airy
    stepped = judged(cost_cases.STEPPER, "steps", 32)
    assert 0 < stepped.error < stepped.claimed + nonlinear.disagreement() < 0.05


def test_growth_rows_grow(monkeypatch):
    monkeypatch.setattr(cost_growth, "CELLS", {cost_cases.P2: (8, 12, 16, 20)})
    monkeypatch.setattr(cost_growth, "SHELLS", {"shell BFS": (1, 2, 3), "shell Argyris": (1, 2, 3)})
    cases = list(cost_growth.cases())
    for name in {(c.level, c.knob) for c in cases}:
        values = [c.value for c in cases if (c.level, c.knob) == name]
        assert values == sorted(set(values))
        assert len(values) >= cost_growth.QUICK
    p2 = find(cases, cost_cases.P2, "unknowns", 562)
    assert math.isnan(cost_cases.measured(p2, 0.0).error)


def test_unknowns_of_elements_are_those_of_their_matrix():
    for level in (cost_cases.P2, cost_cases.P4):
        field = cost_cases.elements(level, 4)()
        assert cost_growth._unknowns(lambda field=field: field) == field._solution.shape[1]


@pytest.fixture
def small(monkeypatch):
    monkeypatch.setattr(cost_effects, "CELLS", (2, 4))
    monkeypatch.setattr(cost_effects, "SHAPES", 3)


@pytest.mark.parametrize("scene", ["planar", "planar with friction", "inertia"])
def test_effects_that_are_not_named_are_not_evaluated(small, scene):
    effects = cost_effects.SCENES[scene]
    found = cost_effects.Named(scene, effects, 8).evaluations()
    assert set(found) == set(cost_effects.WATCHED)
    # weight does no work on level ground in the plane
    named = {type(e).__name__.lower() for e in effects} - ({"gravity"} if len(effects) < 5 else set())
    kinds = {kind.__name__.lower() for kind in cost_effects.KINDS}
    assert {kind for kind in kinds if found[kind] > 0} == named
    assert found["membrane"] == pytest.approx(found["gradients"], rel=1e-12)
    assert found["gradients"] > found["hessians"] >= found["factors"] > 0


def test_a_planar_scene_holds_less_than_a_shell(small):
    flat = cost_effects.Named("planar", cost_effects.SCENES["planar"], 8).row(0.0)
    assert (flat.components, flat.derivative, flat.effects) == (2, 1, "Membrane")
    assert 0 < flat.hessian_mb < flat.memory_mb
    assert flat.iterations >= 1
    assert flat.fastest <= flat.step_seconds <= flat.slowest
    shell = cost_effects.Named("bending", cost_effects.SCENES["bending"], 8)
    (potential, _, blocks), memory = held_memory(shell.evaluated)
    assert potential.discretisation.size * 2 == flat.unknowns * 3
    assert cost_effects.highest_derivative(shell.effects) == 2
    assert memory > flat.memory_mb
    # 6 pairs of components instead of 3, the same shapes
    assert sum(b.values.nbytes for b in blocks) / 1e6 == pytest.approx(2 * flat.hessian_mb)


SOME = [
    *points_of("field", cost_cases.TAIL, "modes", [5, 10, 20], [5e-4, 3e-5, 2e-6], [4e-4, 5e-4, 6e-4]),
    *points_of("field", "NGSolve P4", "cells along", [2, 4], [2e-2, 1e-3], [0.02, 0.03]),
    *points_of("linear speed", cost_cases.LINE, "points", [1], [0.47], [3e-5]),
    *points_of("nonlinear speed", cost_cases.STEPPER, "steps", [16, 32], [2e-2, 6e-3], [0.3, 0.5]),
    *points_of("nonlinear speed", cost_cases.RITZ, "rtol", [1e-2, 1e-3], [0.16, 0.16], [0.02, 0.05]),
    *points_of("nonlinear speed", cost_cases.SECOND, "rtol", [1e-2], [0.05], [0.08]),
    cost._reference("field", 1e-11),
]


def test_the_figure_shows_the_table_and_names_the_plateaus():
    axes = cost_draw.draw(SOME).axes
    drawn = {tuple(xy) for line in axes[0].lines for xy in line.get_xydata()}
    for point in SOME[:5]:
        assert (point.seconds, point.error) in drawn
        assert (point.seconds, point.claimed) in drawn
    words = [[text.get_text() for text in panel.texts] for panel in axes]
    assert words == [[], ["1D, closed form 47 %"], ["models:\nsmall strain 16 %\nsecond order 5 %"]]


def test_same_table_same_bytes(tmp_path):
    first, second = (
        cost_draw.style.save(cost_draw.draw(SOME), "cost", tmp_path / name, ("png",))[0]
        for name in ("first", "second")
    )
    assert first.read_bytes() == second.read_bytes()


def test_a_short_run_from_the_command_line(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(peers, "find_spec", lambda name: None)
    folder = str(tmp_path)
    cost.main(["--quick", "--panels", "a", "--data", folder])
    assert "references" in capsys.readouterr().out
    cost_draw.main(["--data", folder, "--out", folder, "--formats", "png"])
    assert {p.name for p in tmp_path.iterdir()} == {"cost.csv", "cost_orders.csv", "cost.png"}
    points = cost_table.read(tmp_path / "cost.csv", Point)
    assert all(0 < p.error < 1 for p in points)
    assert all(p.fastest <= p.seconds <= p.slowest for p in points if p.level != cost_table.REFERENCE)
    assert all(p.error < p.claimed for p in points if p.claimed == p.claimed)
    found = cost_table.read(tmp_path / "cost_orders.csv", Order)
    plain = next(o for o in found if o.level == cost_cases.PLAIN)
    assert plain.error_order == pytest.approx(2, abs=0.15)  # plain truncation: M^-2


def test_unknown_panels_are_refused(capsys):
    with pytest.raises(SystemExit):
        cost.main(["--panels", "ax"])
    assert "must be some of abcge" in capsys.readouterr().err
