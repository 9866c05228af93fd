"""The validation page: its table is complete and fresh, its verdicts follow, its numbers come again."""

import math
import re
from dataclasses import replace
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipe, ellipeinc, ellipk, ellipkinc, i0

from fem_check.command.program import main
from fem_check.files import SceneFile, read
from figures.draw.validation import figure as validation_figure
from figures.measure import naghdi, validation
from figures.validation import comparison as comparison_module
from figures.validation import crawlers, plates, scene_files, shells
from figures.validation import page as validation_page
from figures.validation.catalogue import COMPARISONS, SUBJECTS
from figures.validation.comparison import SCENES, ByRefinement, Confirmed, agree
from figures.validation.problems import piezo
from tests.shell.test_shell_tables import koiter_circle
from tests.validation.reference_pose import heights

ROWS = {(row.comparison, row.number): row for row in validation.TABLE.read()}
CHEAP = [name for name, comparison in COMPARISONS.items() if not comparison.slow]


def test_the_table_is_complete_and_fresh() -> None:
    assert set(ROWS) == set(validation.keys())
    assert [key for key, row in ROWS.items() if not validation.fresh(row)] == []
    for (name, k), row in ROWS.items():
        number = COMPARISONS[name].numbers[k]
        assert row.there == pytest.approx(number.value, rel=1e-9)
        rounded = 1e-9 * abs(row.here)  # digits of the table
        assert row.agrees == agree(number.value, number.accuracy + rounded, row.here, row.error)
        assert math.isfinite(row.here)
        assert math.isfinite(row.error)
        assert row.seconds >= 0


def test_the_page_is_that_of_the_table() -> None:
    rows = validation.TABLE.read()
    assert validation_page.PAGE.read_text(encoding="utf-8") == validation_page.page(rows)


def test_the_figure_is_that_of_the_table() -> None:
    """As many marks of each kind as the page says, each outside of its bar where numbers differ."""
    text = validation_page.PAGE.read_text(encoding="utf-8")
    told = re.search(r"(\d+) agree\s+within errors, (\d+) differ(?:, of which (\d+) are)?", text)
    assert told is not None
    agree_, differ, unexplained = (int(number or 0) for number in told.groups())
    drawn = [
        line
        for part in validation_figure.columns(validation_figure.lines(list(ROWS.values())))
        for line in part
    ]
    verdicts = [line.verdict for line in drawn]
    assert verdicts.count(validation_figure.AGREES) == agree_
    assert verdicts.count(validation_figure.DIFFERS) == differ - unexplained
    assert verdicts.count(validation_figure.OPEN) == unexplained
    for line in drawn:
        if line.verdict not in ("", validation_figure.AGREES):
            assert line.apart > line.allowed
    assert [line.label for line in drawn if line.label in COMPARISONS] == list(COMPARISONS)


def test_a_number_that_differs_has_words() -> None:
    for (name, k), row in ROWS.items():
        if not row.agrees:
            assert COMPARISONS[name].numbers[k].why, (name, k)
            assert "differs by" in validation_page.verdict(row)
    row = next(iter(ROWS.values()))
    assert validation_page.verdict(replace(row, agrees=1)) == "agrees within errors"


def test_errors_are_small_enough_to_tell_something() -> None:
    """A number agrees within errors for its closeness, not for a wide error."""
    for key, row in ROWS.items():
        if row.there and row.agrees:
            assert row.error + row.accuracy < 0.04 * abs(row.there), key


def test_names_are_unique_and_sources_named() -> None:
    assert len(COMPARISONS) == sum(len(group) for group in SUBJECTS.values())
    for comparison in COMPARISONS.values():
        assert len(comparison.source.text) > 10
        assert isinstance(comparison.source.confirmed, Confirmed)


@pytest.mark.parametrize("name", CHEAP)
def test_numbers_come_again(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """The cheap form differs from the table by both errors at most, and reads the scene files named."""
    files: set[str] = set()

    def reading(path: Path) -> SceneFile:
        files.add(path.name)
        return read(path)

    monkeypatch.setattr(scene_files, "read", reading)
    found = COMPARISONS[name].calculation.cheap()
    assert files == set(COMPARISONS[name].scenes)
    assert len(found) == len(COMPARISONS[name].numbers)
    for k, cheap in enumerate(found):
        row = ROWS[name, k]
        # the error may be just this difference; slender beams magnify rounding 1e8 times, by processor
        allowed = (cheap.error + row.error) * (1 + 1e-6) + 2e-8 * abs(row.here)
        assert abs(cheap.value - row.here) <= allowed


def test_a_change_of_inputs_makes_a_row_stale() -> None:
    comparison = COMPARISONS["Cook's membrane"]
    finer = replace(comparison.calculation, fine={"n": 64})
    assert isinstance(finer, ByRefinement)
    assert replace(comparison, calculation=finer).identity != comparison.identity
    other = (replace(comparison.numbers[0], value=24.0),)
    assert replace(comparison, numbers=other).identity != comparison.identity


def test_another_scene_makes_a_row_stale(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    named = COMPARISONS["viscous sine of any strain"]
    before = named.identity
    text = named.files[0].read_text()
    monkeypatch.setattr(comparison_module, "SCENES", tmp_path)
    for alpha, same in ((0.25, True), (0.26, False)):
        (tmp_path / named.scenes[0]).write_text(text.replace("alpha = 0.25", f"alpha = {alpha}"))
        assert (named.identity == before) is same


def test_one_comparison_by_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "some.csv"
    for _ in range(2):  # the second time nothing is left to fill in, and all the same it is printed
        validation.main(["--only", "piezo foil: numbers", "--out", str(out)])
        assert len(validation.TABLE.read(out)) == 8
        assert "weight, Pa: there 23.5 +- 0.05, here 23.541364 +- " in capsys.readouterr().out
    with pytest.raises(SystemExit, match="must be one of"):
        validation.main(["--only", "nothing", "--out", str(out)])


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_scene_files_are_used_and_checked(path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert path.name in {s for comparison in COMPARISONS.values() for s in comparison.scenes}
    with pytest.raises(SystemExit) as ended:
        main(["check", str(path)])
    assert ended.value.code in (0, None)
    assert "next" in capsys.readouterr().out


def test_published_numbers_by_other_means() -> None:
    """Those that are marked as derived, from formulas of their own."""
    sine = COMPARISONS["viscous sine of any strain"].numbers[0]
    assert sine.value == pytest.approx(i0(0.5) / i0(0.25) - i0(0.25), abs=sine.accuracy)
    zero = mp.findroot(lambda x: mp.besselj(-mp.mpf(1) / 3, x), 1.87)
    column = COMPARISONS["column under its own weight"].numbers[0]
    assert column.value == pytest.approx(float(9 * zero**2 / 4), abs=column.accuracy)
    a, b, v0 = 0.6, 0.4, 0.01
    sliding = COMPARISONS["block that slides, with inertia"]
    path = solve_ivp(
        lambda t, u: (-u[1], a - b * np.tanh(u[1] / v0)),
        (0, 2.5),
        (0, 0),
        rtol=1e-9,
        atol=1e-12,
        t_eval=(0.5, 1.5, 2.5),
    ).y[0]
    assert np.diff(path) == pytest.approx([n.value for n in sliding.numbers], abs=1e-7)
    s, area = np.linspace(-1, 1, 2001), 0.1 * 16 / 15
    y = 0.1 * s - 0.8 + 1.6 * 0.5
    assert np.trapezoid(crawlers.pulse(y, 0.5), y) == pytest.approx(area, rel=1e-4)


@pytest.mark.parametrize(("aspect", "value"), plates.SUPPORTED.items())
def test_supported_plates_by_navier(aspect: float, value: float) -> None:
    m = np.arange(1, 200, 2)[:, None]
    n = m.T
    signs = np.sin(m * np.pi / 2) * np.sin(n * np.pi / 2)
    series = 16 / np.pi**6 * (signs / (m * n * (m**2 + (n / aspect) ** 2) ** 2)).sum()
    assert series == pytest.approx(value, abs=5e-6)


def elastica(ratio: float) -> tuple[float, float]:
    """w/L and u/L of the tip.

    P L^2/B = (K(m) - F(phi, m))^2, sin(phi) = (2 m)^(-1/2), m = (1 + sin(theta_0))/2.
    """

    def turned(angle: float) -> tuple[float, float]:
        m = (1 + math.sin(angle)) / 2
        return m, math.asin(1 / math.sqrt(2 * m))

    low, high = 1e-9, math.pi / 2 - 1e-9
    for _ in range(100):
        angle = (low + high) / 2
        m, phi = turned(angle)
        low, high = (angle, high) if (ellipk(m) - ellipkinc(phi, m)) ** 2 < ratio else (low, angle)
    root = math.sqrt(ratio)
    w = 1 - 2 * (ellipe(m) - ellipeinc(phi, m)) / root
    u = 1 - math.sqrt(2 * math.sin(angle)) / root
    return w, u


@pytest.mark.parametrize("ratio", shells.RATIOS)
def test_mattiasson_by_elliptic_integrals(ratio: float) -> None:
    index = 2 * shells.RATIOS.index(ratio)
    assert elastica(ratio) == pytest.approx(shells.MATTIASSON[index : index + 2], abs=6e-6)


def test_end_shear_is_that_of_the_elastica() -> None:
    """P L^2/B = 4 at the full load, L = 10: what the words for Sze's table say."""
    w, u = elastica(4.0)
    assert (10 * w, 10 * u) == pytest.approx((6.6996, 3.2894), abs=5e-4)
    for k, exact in ((6, 10 * u), (7, 10 * w)):
        row = ROWS["cantilever under end shear", k]
        assert abs(row.here - exact) <= row.error + 1e-4


def test_end_moment_is_that_of_the_energy() -> None:
    """A circle that stretches a little, exact for the energy of eq. 1: what the words for it say."""
    for k in range(8):
        row = ROWS["cantilever under end moment", k]
        assert abs(row.here - koiter_circle(0.25 * (k // 2 + 1))[k % 2]) <= 2 * row.error + 1e-5


def test_the_pose_of_the_piezo_robot_by_collocation() -> None:
    thickness, modulus = piezo.as_strip()
    weight = piezo.FOIL.areal_density * piezo.GRAVITY / modulus
    per_volt = piezo.FOIL.curvature * piezo.LENGTH
    inner, outer = (per_volt * v for v in piezo.VOLTAGES[2:4])
    found = heights(inner, outer, thickness**3 / 12 / weight, 0.5 / weight)
    for height, number in zip(found, COMPARISONS["piezo foil: pose"].numbers, strict=True):
        assert 100 * piezo.LENGTH * height == pytest.approx(number.value, abs=3e-5)


def test_a_shell_that_hardly_shears_is_the_one_here() -> None:
    """Naghdi's shell by another code, stiff in shear, has the deflections of the table; with its own
    stiffness it has those of Elmer, which shears, too."""
    assert {(r.problem, r.cells, r.shear, r.share) for r in naghdi.TABLE.read()} >= set(naghdi.keys())
    for k, share in enumerate((0.1, 0.25)):
        row, stiff = (
            ROWS["pinched semi-cylinder", k],
            naghdi.known("semi-cylinder", share, naghdi.STIFF),
        )
        sheared = naghdi.known("semi-cylinder", share)
        assert abs(stiff.first - row.here) < row.error + abs(sheared.first - row.here) / 5
    stiff, sheared = (naghdi.known("hemisphere", 0.05, shear) for shear in (naghdi.STIFF, 1.0))
    for k, (one, other) in enumerate([(stiff.first, sheared.first), (stiff.second, sheared.second)]):
        row = ROWS["pinched hemisphere", k]
        assert abs(one - row.here) < row.error / 3
        assert 0.001 < other / one - 1 < 0.002  # 0.13 %, as Elmer at a hundredth of the load
