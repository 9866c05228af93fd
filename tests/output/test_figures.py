"""Figures 3 and 7: what they compute, that the files hold what is drawn, the same bytes every time."""

import csv
import itertools
import json

import numpy as np
import pytest

from figures.draw import fig7
from figures.draw.fig3 import data as fig3_data
from figures.draw.fig3 import figure as fig3
from figures.draw.fig3 import panels as fig3_panels
from figures.draw.fig3 import speeds as fig3_speed
from figures.draw.fig3.speeds import LABELS
from figures.measure import nonlinear
from linear_theory import (
    Sheet,
    SineWave,
    airy_series,
    crawl_speed,
    field_speed,
    line_speed,
    ritz_field,
)

COARSE = {
    "THEORY_POINTS": 5,
    "SLIP_POINTS": 4,
    "FEM_ALPHAS": (0.13, fig3_data.ALPHA_SHOWN),
    "GRID": (21, 41),
    "FEM_SIZE": 0.25,
}


def small_fig3() -> fig3_data.Fig3Data:
    """Figure 3 at few couplings, on coarse triangles."""
    with pytest.MonkeyPatch.context() as patch:
        for name, value in COARSE.items():
            patch.setattr(fig3_data, name, value)
        return fig3_data.compute(rtol=1e-3)


@pytest.fixture(scope="module")
def speeds():
    return small_fig3()


@pytest.fixture(scope="module")
def drawn(speeds):
    return fig3_panels.draw(speeds)


@pytest.fixture(scope="module")
def amplitudes():
    return fig7.compute(rtol=1e-7)


def series_of(data: fig3_data.Fig3Data, label: str) -> fig3_speed.Series:
    return next(series for series in (*data.series, *data.slips) if series.label == label)


def rows_of(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def at_alpha_shown(series: fig3_speed.Series) -> tuple[float, float]:
    place = np.flatnonzero(series.alpha == fig3_data.ALPHA_SHOWN)[0]
    return series.speed[place], series.error[place]


def test_series_and_elements_give_one_speed_within_their_claims(speeds):
    (airy, airy_error), (fem, fem_error) = (
        at_alpha_shown(series_of(speeds, LABELS[name])) for name in ("first", "elements")
    )
    assert abs(airy - fem) <= airy_error + fem_error
    assert airy_error + fem_error < 0.02 * airy


def test_speeds_have_the_signs_and_the_limits_of_the_theory(speeds):
    line, printed = (series_of(speeds, LABELS[name]) for name in ("line", "printed"))
    np.testing.assert_array_equal(line.speed, line_speed(line.alpha))
    assert np.all(line.speed[1:] > 0)
    assert np.all(printed.speed[1:] < 0)
    assert speeds.coefficients["line"][0] == pytest.approx(1, abs=1e-9)
    assert speeds.coefficients["first"][0] == pytest.approx(1.91, abs=0.01)  # 2 of a narrow strip
    assert speeds.coefficients["second"][0] == pytest.approx(1.5331, abs=2e-3)
    assert max(s.alpha.max() for s in speeds.series) < speeds.largest_alpha


def test_second_order_is_the_tangent_of_the_nonlinear_sheet(speeds):
    second, sheet = (series_of(speeds, LABELS[name]) for name in ("second", "sheet"))
    np.testing.assert_allclose(second.speed / second.alpha**2, speeds.coefficients["second"][0])
    found = crawl_speed(Sheet(), SineWave(), fig3_data.ALPHA_SHOWN, order=2, rtol=1e-3)
    speed, error = at_alpha_shown(second)
    assert speed == pytest.approx(found.mean, abs=error + found.error)
    lag = 1 - sheet.speed / (speeds.coefficients["second"][0] * sheet.alpha**2)
    assert abs(lag[0]) < 2e-3  # at alpha = 0.02, within the errors of both
    # alpha^2, slightly less at the larger alpha: from 0.2 to 0.4
    doubled = lag[sheet.alpha == 0.4] / lag[sheet.alpha == 0.2]
    assert 3 < doubled.item() < 4


def symbols_of(axes, label: str):
    """Points and ends of the error bars, (n, 2) and (n, 2, 2), of drawn symbols."""
    drawn = next(c for c in axes.containers if c.get_label() == label)
    return drawn.lines[0].get_xydata(), np.array(drawn.lines[2][0].get_segments())


@pytest.mark.parametrize(
    ("panel", "label", "body", "friction", "power"),
    [
        *((panel, LABELS["sheet"], "sheet", "coulomb", p) for panel, p in ((-3, 0), (-2, 2))),
        *((panel, LABELS["bar"], "bar", "coulomb", p) for panel, p in ((-3, 0), (-2, 2))),
        *((-1, f"{name}, nonlinear sheet", "sheet", name, 2) for name in fig3_speed.REGIMES),
    ],
)
def test_nonlinear_symbols_and_their_bars_are_those_of_the_table(
    drawn, panel, label, body, friction, power
):
    rows = [r for r in nonlinear.TABLE.read() if (r.body, r.friction) == (body, friction)]
    alpha, speed, error = np.array([(r.alpha, r.speed, r.error) for r in rows]).T
    points, bars = symbols_of(drawn.axes[panel], label)
    np.testing.assert_array_equal(points[:, 0], alpha)
    np.testing.assert_allclose(points[:, 1] * alpha**power, speed, rtol=1e-14)
    half = np.ptp(bars[:, :, 1], axis=1) / 2 * alpha**power
    np.testing.assert_allclose(half, error, rtol=1e-6, atol=1e-15)
    assert np.all(error < 1e-3 * speed)


def test_the_table_of_nonlinear_speeds_is_what_its_command_makes():
    alpha = fig3_data.ALPHA_SHOWN
    for friction in ("coulomb", "mixed"):
        again = nonlinear.sheet_speed(alpha, friction, nonlinear.RTOL)
        kept = next(
            s
            for s in nonlinear.TABLE.read()
            if (s.body, s.friction, s.alpha) == ("sheet", friction, alpha)
        )
        assert again.speed == pytest.approx(kept.speed, abs=again.error + kept.error)


def test_an_absent_or_incomplete_table_is_reported_with_its_command(tmp_path):
    path = tmp_path / "nonlinear.csv"
    with pytest.raises(FileNotFoundError, match=r"python -m figures\.measure\.nonlinear"):
        nonlinear.TABLE.read(path)
    nonlinear.TABLE.write([s for s in nonlinear.TABLE.read() if s.body == "sheet"], path)
    with pytest.raises(ValueError, match=r"no coulomb bar.*python -m figures\.measure\.nonlinear"):
        fig3_speed.nonlinear_speeds(nonlinear.TABLE.read(path))


def test_speed_over_alpha_squared_approaches_its_limits(speeds):
    dry, mixed, viscous = (series_of(speeds, f"{name}, theory") for name in fig3_speed.REGIMES)
    ratios = [s.speed / s.alpha**2 for s in (dry, mixed, viscous)]
    assert ratios[0][0] == pytest.approx(speeds.coefficients["first"][0], rel=1e-3)  # Coulomb
    for fast, slow in itertools.pairwise(ratios):
        assert np.all(fast > slow)
    assert ratios[2][0] / ratios[0][0] == pytest.approx(0.535, abs=0.005)  # about half
    linear = field_speed(airy_series(Sheet(), SineWave()), 0.2, "current", "viscous").mean / 0.2**2
    np.testing.assert_allclose(ratios[2], linear, rtol=1e-3)  # 100 alpha L/T is viscous, at all alpha


def test_a_nonlinear_sheet_has_the_limit_of_linear_theory_only_if_viscous(speeds):
    lag = {}
    for name in fig3_speed.REGIMES:
        linear, sheet = (series_of(speeds, f"{name}, {m}") for m in ("theory", "nonlinear sheet"))
        ratios = [s.speed[0] / s.alpha[0] ** 2 for s in (linear, sheet)]
        lag[name] = 1 - ratios[1] / ratios[0]
    assert lag["dry"] == pytest.approx(0.2, abs=0.01)
    assert lag["mixed"] == pytest.approx(0.093, abs=0.01)
    assert abs(lag["viscous"]) < 5e-4


def test_largest_alpha_is_where_the_area_of_another_solution_vanishes(speeds):
    sheet, wave = Sheet(), SineWave()
    field = ritz_field(sheet, wave, rtol=1e-5)
    y = np.linspace(-sheet.length / 2, sheet.length / 2, 201)
    times = np.linspace(0, wave.period, 48, endpoint=False)
    dilation = field.strain(sheet.width / 2, y[:, None], times)[:2].sum(0)
    assert speeds.largest_alpha == pytest.approx(-1 / dilation.min(), rel=1e-3)


def test_friction_of_both_solutions_points_the_same_way(speeds):
    top, bottom = speeds.snapshots
    size = np.hypot(*top.force)
    assert np.hypot(*(top.force - bottom.force)).max() < 0.02 * size.max()
    np.testing.assert_allclose(top.force[0], -top.force[0, ::-1], atol=1e-6)  # mirror images in x
    assert size.max() > 1.2 > 0.8 > size.min() > 0  # more weight where the sheet has grown


def test_figure_3_writes_what_it_shows(speeds, drawn, tmp_path):
    paths = fig3.write(speeds, tmp_path, ["png"])
    assert sorted(p.name for p in paths) == [
        "fig3.json", "fig3.png", "fig3_friction.csv", "fig3_speed.csv",
    ]  # fmt: skip
    shown = json.loads((tmp_path / "fig3.json").read_text())["speeds_at_alpha_shown"]
    rows = rows_of(tmp_path / "fig3_speed.csv")
    assert len(rows) == sum(series.alpha.size for series in (*speeds.series, *speeds.slips))
    upper, middle, lower = drawn.axes[-3:]
    labels = [set(axes.get_legend_handles_labels()[1]) for axes in (upper, middle)]
    assert labels[0] == {s.label for s in speeds.series} == set(shown) == set(LABELS.values())
    assert labels[0] - labels[1] == {LABELS["printed"]}
    for axes, label, power in (
        (upper, LABELS["elements"], 0),
        (upper, LABELS["sheet"], 0),
        (middle, LABELS["elements"], 2),
        (lower, "mixed, nonlinear sheet", 2),
    ):
        chosen = [(float(r["alpha"]), float(r["speed"])) for r in rows if r["series"] == label]
        alpha, speed = np.array(chosen).T
        points = symbols_of(axes, label)[0]
        np.testing.assert_allclose(points, np.stack([alpha, speed / alpha**power], 1), rtol=1e-8)
    limits = json.loads((tmp_path / "fig3.json").read_text())["speed_over_alpha_squared_as_alpha_to_0"]
    for name, (value, _) in speeds.coefficients.items():
        assert limits[LABELS[name]]["value"] == pytest.approx(value, rel=1e-8)
    for series in speeds.series:
        assert shown[series.label]["speed"] == pytest.approx(at_alpha_shown(series)[0], rel=1e-8)
    arrows = rows_of(tmp_path / "fig3_friction.csv")
    assert len(arrows) == 2 * np.prod(fig3_data.ARROWS)


def test_figure_3_tells_the_numbers_of_each_slip_speed(speeds, tmp_path):
    fig3.write(speeds, tmp_path, ["png"])
    regimes = json.loads((tmp_path / "fig3.json").read_text())["slip_regimes"]
    assert set(regimes) == set(fig3_speed.REGIMES)
    for series in speeds.slips:
        regime = regimes[series.friction]
        assert regime["slip_speed_over_alpha"] == nonlinear.SLIPS[series.friction]
        model = regime["linear theory" if series.kind == "theory" else "nonlinear sheet"]
        speed, error = at_alpha_shown(series)
        assert model["at_alpha_shown"] == pytest.approx({"speed": speed, "error": error}, rel=1e-8)
        ratio = series.speed[0] / series.alpha[0] ** 2
        limit = model["speed_over_alpha_squared_at_smallest_alpha"]
        assert limit["value"] == pytest.approx(ratio, rel=1e-8)


def test_figure_7_draws_numbers_that_differ_as_they_should(amplitudes):
    for family in amplitudes.amplitudes:
        plain, printed, converged = family.plain, family.printed, family.converged
        assert abs(plain / converged - 1)[:3].max() < 0.02  # plain: right at first, then too small
        assert np.all(abs(plain[10:]) < abs(converged[10:]))
        assert abs(printed / plain - 1).max() > 0.5
        np.testing.assert_allclose(converged[-3:], family.tail[-3:], rtol=0.02)


def test_tail_constants_are_those_of_many_modes(amplitudes):
    many = airy_series(Sheet(), SineWave(), modes=400)
    for name, constant in fig7.tail_constants(many).items():
        assert amplitudes.constants[name] == pytest.approx(constant, rel=1e-4)


def test_figure_7_writes_what_it_shows(amplitudes, tmp_path):
    fig7.write(amplitudes, tmp_path, ["png"])
    shown = json.loads((tmp_path / "fig7.json").read_text())
    rows = rows_of(tmp_path / "fig7.csv")
    assert len(rows) == fig7.MODES * len(fig7.FAMILIES)
    for axes, family in zip(fig7.draw(amplitudes).axes, amplitudes.amplitudes, strict=True):
        name = family.family.name
        columns = ("tail_law", *fig7.LOOKS)  # in the order of drawing
        for line, column in zip(axes.lines, columns, strict=True):
            signed = np.array(shown["families"][name][column])
            np.testing.assert_allclose(line.get_ydata(), abs(signed), rtol=1e-8)
        for column in columns:
            written = [float(row[column]) for row in rows if row["family"] == name]
            np.testing.assert_allclose(written, shown["families"][name][column], rtol=1e-8)


def test_same_input_same_bytes(speeds, amplitudes, tmp_path):
    for once, again, module, formats in (
        (speeds, small_fig3(), fig3, ["png"]),
        (amplitudes, fig7.compute(rtol=1e-7), fig7, ["png", "pdf"]),
    ):
        first = module.write(once, tmp_path / "first", formats)
        second = module.write(again, tmp_path / "second", formats)
        for one, two in zip(first, second, strict=True):
            assert one.read_bytes() == two.read_bytes(), one.name


@pytest.mark.parametrize("module", [fig3, fig7])
def test_unknown_options_are_refused(module, capsys):
    for arguments in (["--formats", "jpeg"], ["--rtol", "fast"]):
        with pytest.raises(SystemExit):
            module.main(arguments)
    assert "invalid choice: 'jpeg'" in capsys.readouterr().err


def test_fig7_from_the_command_line(tmp_path, capsys):
    fig7.main(["--out", str(tmp_path), "--rtol", "1e-6", "--formats", "png"])
    assert capsys.readouterr().out.split() == [
        str(tmp_path / name) for name in ("fig7.png", "fig7.csv", "fig7.json")
    ]
