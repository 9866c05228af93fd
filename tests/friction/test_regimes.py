"""Friction between dry and viscous: limits, what the regimes mean, who is warned, table and figure."""

import re
import warnings
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.stepping.simulation import simulate
from figures.draw import regimes
from figures.measure import regimes as regimes_table
from linear_theory import (
    CrawlSpeed,
    FieldWave,
    RitzField,
    Sheet,
    SineWave,
    TravellingWave,
    ViscousRegimeWarning,
    crawl_speed,
    field_speed,
    line_balance,
    line_speed,
    line_speed_viscous,
    ritz_field,
)
from linear_theory.friction.regime import DRY_RATIO, VISCOUS_RATIO, regime_of
from linear_theory.scene.scene import Scene
from tests.shell.shell_scenes import MATERIAL, planar

PAPER, SINE = Sheet(), SineWave()
PULSE = TravellingWave(np.array([0.5, 0.3]), np.array([0.2, 0.1]))
ALPHA = 0.1
VISCOUS_ON_PURPOSE = pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")


@pytest.fixture(scope="module")
def field() -> RitzField:
    return ritz_field(PAPER, SINE, rtol=1e-6)


@pytest.fixture(scope="module")
def pulse() -> RitzField:
    return ritz_field(PAPER, PULSE, rtol=1e-4)


def on_a_line(slip: float, alpha: float) -> float:
    """V/alpha^2 at a slip speed over alpha L/T; 1e-15 exact."""
    return line_balance(SINE, alpha, friction="tanh", slip_speed=slip * alpha).mean / alpha**2


@pytest.mark.parametrize("alpha", [0.1, 0.5])
def test_a_line_becomes_dry_with_the_square_of_the_slip_speed(alpha: float) -> None:
    """Laplace's method: V falls by (alpha L/T) s^2 (pi^2/24) W'/W, W(g) = (1 + alpha g)/sqrt(1 - g^2)
    at the level g = V/(alpha L/T), s = v0/(alpha L/T); what follows is of order s^4."""
    dry = float(line_speed(alpha))
    level = dry / alpha
    slope = level / (1 - level**2) + alpha / (1 + alpha * level)
    found = [(dry / alpha**2 - on_a_line(s, alpha)) / s**2 for s in (0.02, 0.04)]
    expected = np.pi**2 / 24 * slope / alpha
    # s^4 comes with the third derivative of W, 7 pi^4/960 of it, and W'''/W' is below 20 here
    np.testing.assert_allclose(found, expected, rtol=0.05)
    assert (4 * found[0] - found[1]) / 3 == pytest.approx(expected, rel=1e-3)


@VISCOUS_ON_PURPOSE
@pytest.mark.parametrize("alpha", [0.1, 0.5])
def test_a_line_becomes_viscous_with_the_inverse_square_of_the_slip_speed(alpha: float) -> None:
    """From tanh x = x - x^3/3: V/alpha^2 = 1/2 + (1/8 - alpha^2/12)/s^2 + O(s^-4)."""
    viscous = float(line_speed_viscous(alpha)) / alpha**2
    found = [(on_a_line(s, alpha) - viscous) * s**2 for s in (50.0, 100.0)]
    # the next term is a third and less of 1/s^2; differences of 1e-5 have 1e-10 left
    np.testing.assert_allclose(found, 1 / 8 - alpha**2 / 12, rtol=1e-3)


def sheet_speed(field: RitzField, slip: float, rtol: float = 1e-5) -> float:
    """V/alpha^2 of linear theory at a slip speed over alpha L/T, limits included."""
    law = {"friction": "viscous" if slip else "coulomb"}
    if 0 < slip < np.inf:
        law = {"friction": "tanh", "slip_speed": slip * ALPHA}
    return field_speed(field, ALPHA, rtol=rtol, **law).mean / ALPHA**2


def test_a_sheet_becomes_dry_with_the_cube_of_the_slip_speed(field: RitzField) -> None:
    """Around a point at rest tanh(|w|/v0) - 1 counts in an area v0^2, and its direction cancels but for
    a part in proportion to |w|: one order more than on a line, where points stand for areas."""
    dry, half, whole = (sheet_speed(field, s) for s in (0.0, 0.06, 0.12))
    assert half == pytest.approx(dry, rel=1e-3)
    # errors of 5e-6 in a difference of 7e-4, and the next order: some per cent of the ratio
    assert np.log2((dry - whole) / (dry - half)) == pytest.approx(3, abs=0.2)


@VISCOUS_ON_PURPOSE
def test_a_sheet_becomes_viscous_with_the_inverse_square_of_the_slip_speed(field: RitzField) -> None:
    viscous, double, once = (sheet_speed(field, s) for s in (np.inf, 40.0, 20.0))
    assert double == pytest.approx(viscous, rel=3e-4)
    # the next order is s^-4, 1e-3 of it; all three have the same cells and their errors cancel
    assert np.log2((once - viscous) / (double - viscous)) == pytest.approx(2, abs=0.02)


@VISCOUS_ON_PURPOSE
def test_order_two_joins_dry_and_viscous_friction() -> None:
    """Slip speeds at which the orders of approach, measured above, leave less than the tolerance."""
    for end, slip in (("coulomb", 0.02), ("viscous", 100.0)):
        limit = crawl_speed(PAPER, SINE, ALPHA, friction=end, order=2, rtol=1e-3)
        tanh = crawl_speed(
            PAPER, SINE, ALPHA, friction="tanh", slip_speed=slip * ALPHA, order=2, rtol=1e-3
        )
        assert abs(tanh.mean - limit.mean) <= tanh.error + limit.error
        assert tanh.error + limit.error <= 2e-3 * limit.mean


@pytest.mark.parametrize(
    ("ratio", "regime"),
    [
        (0.0, "dry"),
        (DRY_RATIO, "dry"),
        (1.001 * DRY_RATIO, "mixed"),
        (0.999 * VISCOUS_RATIO, "mixed"),
        (VISCOUS_RATIO, "viscous"),
        (np.inf, "viscous"),
        (np.nan, "none"),
    ],
)
def test_regimes_by_slip_ratio(ratio: float, regime: str) -> None:
    assert regime_of(ratio) == regime


def way(field: RitzField, alpha: float, ratio: float, rtol: float) -> float:
    """Share of the way from dry to viscous speed that has gone at a slip ratio."""
    dry, viscous = (field_speed(field, alpha, friction=f, rtol=rtol) for f in ("coulomb", "viscous"))
    slip = 2 * ratio * alpha
    for _ in range(3):  # the largest speed hardly depends on the slip speed
        tanh = field_speed(field, alpha, friction="tanh", slip_speed=slip, rtol=rtol)
        slip *= ratio / tanh.slip_ratio
    assert tanh.slip_ratio == pytest.approx(ratio, rel=1e-3)
    return (dry.mean - tanh.mean) / (dry.mean - viscous.mean)


@VISCOUS_ON_PURPOSE
@pytest.mark.parametrize(
    ("name", "rtol", "alpha", "dry", "viscous"),
    [
        ("field", 3e-5, 0.02, 0.0024, (0.90, 0.91)),
        ("field", 3e-5, 0.3, 0.0117, (0.90, 0.91)),
        ("pulse", 1e-3, 0.02, 0.040, (0.94, 0.96)),
        ("pulse", 1e-3, 0.3, 0.089, (0.95, 0.965)),
    ],
)
def test_thresholds_mean_what_they_say(
    name: str,
    rtol: float,
    alpha: float,
    dry: float,
    viscous: tuple[float, float],
    request: pytest.FixtureRequest,
) -> None:
    """Shares as the constants state them. An error of rtol in V is about twice as much of the way; the
    largest speed is that of points of quadrature, right to 2 %, and the share goes with its cube."""
    field = request.getfixturevalue(name)
    assert way(field, alpha, DRY_RATIO, rtol) == pytest.approx(dry, rel=0.08)
    assert viscous[0] <= way(field, alpha, VISCOUS_RATIO, rtol) <= viscous[1]


LEVELS: dict[str, Callable[..., CrawlSpeed]] = {
    "crawl_speed": lambda alpha, **law: crawl_speed(PAPER, SINE, alpha, rtol=1e-2, **law),
    "order 2": lambda alpha, **law: crawl_speed(PAPER, SINE, alpha, order=2, rtol=1e-2, **law),
    "field_speed": lambda alpha, **law: field_speed(
        ritz_field(PAPER, SINE, rtol=1e-2), alpha, rtol=1e-2, **law
    ),
    "line, travelling": lambda alpha, **law: line_balance(SINE, alpha, **law),
    "line, sampled": lambda alpha, **law: line_balance(
        FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y - t)) + 0 * x, 1.0),
        alpha,
        rtol=1e-2,
        length=1,
        **law,
    ),
    "cycle_speed": lambda alpha, **law: cycle_speed(
        Scene(PAPER, SINE, alpha, effects=(Membrane(MATERIAL),), cells=(2, 4)), rtol=2e-2, **law
    ),
}
"""The lambdas are the user's code: the warning is to point to them."""


def slipping(slip: float) -> dict[str, object]:
    return {"friction": "tanh", "slip_speed": slip * ALPHA}


@pytest.mark.parametrize("level", LEVELS.values(), ids=LEVELS)
def test_every_speed_has_its_regime(level: Callable[..., CrawlSpeed]) -> None:
    """No warning, which would be an error here: friction that is called viscous may be."""
    assert level(ALPHA).regime == "dry"
    assert level(ALPHA, friction="viscous").regime == "viscous"
    assert level(ALPHA, **slipping(0.04)).regime == "dry"
    assert level(ALPHA, **slipping(0.5)).regime == "mixed"


@pytest.mark.parametrize("level", LEVELS.values(), ids=LEVELS)
def test_tanh_that_acts_as_viscous_is_warned_of_once(level: Callable[..., CrawlSpeed]) -> None:
    with pytest.warns(ViscousRegimeWarning) as caught:
        found = level(ALPHA, **slipping(3.0))
    assert found.regime == "viscous"
    assert [w.filename for w in caught] == [__file__]
    numbers = re.findall(r"\d+(?:\.\d+)?(?:e-?\d+)?", str(caught[0].message))
    slip, ratio, fastest, dry = (float(n) for n in numbers)
    assert (slip, ratio) == pytest.approx((3 * ALPHA, found.slip_ratio), rel=5e-3)  # 3 digits
    assert fastest == pytest.approx(slip / ratio, rel=1e-2)
    # "about": between the laws and their quadratures the largest speed changes by some per cent
    assert level(ALPHA, friction="tanh", slip_speed=0.9 * dry).regime == "dry"
    assert level(ALPHA, friction="tanh", slip_speed=1.2 * dry).regime == "mixed"


@pytest.mark.parametrize("level", LEVELS.values(), ids=LEVELS)
def test_nothing_that_rests_is_warned_of(level: Callable[..., CrawlSpeed]) -> None:
    assert level(0.0, **slipping(3.0)).slip_ratio == np.inf
    still = level(0.0)
    assert (still.slip_ratio, still.regime, still.mean) == (0.0, "dry", 0.0)


def test_the_warning_begins_where_the_regime_does() -> None:
    with pytest.warns(ViscousRegimeWarning):
        found = crawl_speed(PAPER, SINE, ALPHA, rtol=1e-2, **slipping(3.0))
    fastest = 3 * ALPHA / found.slip_ratio
    options = {"rtol": 1e-2, "friction": "tanh"}
    # between both ends of the law the largest speed changes by 2 %
    below = crawl_speed(PAPER, SINE, ALPHA, slip_speed=0.97 * fastest, **options)
    assert 0.94 < below.slip_ratio < 1
    with pytest.warns(ViscousRegimeWarning):
        crawl_speed(PAPER, SINE, ALPHA, slip_speed=1.03 * fastest, **options)


def test_the_stepper_warns_once_and_has_the_same_meter() -> None:
    options = {"steps": 12, "periods": 1}
    with pytest.warns(ViscousRegimeWarning) as caught:
        viscous = simulate(planar(ALPHA, slip=0.5, cells=(2, 4)), mesh_error=True, **options)
    assert [w.filename for w in caught] == [__file__]
    assert viscous.regime == viscous.speed.regime == "viscous"
    for slip, regime in ((0.004, "dry"), (0.05, "mixed")):
        trajectory = simulate(planar(ALPHA, slip=slip, cells=(2, 4)), **options)
        assert trajectory.regime == trajectory.speed.regime == regime


def test_motion_without_friction_has_no_regime() -> None:
    effects = (Membrane(MATERIAL), Inertia(1e-4, MATERIAL))
    scene = Scene(PAPER, SINE, ALPHA, effects=effects, cells=(2, 4))
    assert simulate(scene, steps=8, periods=1).speed.regime == "none"


@pytest.fixture(scope="module")
def table() -> list[regimes_table.Row]:
    return regimes_table.TABLE.read()


@pytest.mark.parametrize("model", regimes_table.MODELS)
def test_speeds_fall_all_the_way_from_dry_to_viscous(
    table: list[regimes_table.Row], model: str
) -> None:
    rows = [r for r in table if r.model == model]
    slips, values, errors, ratios = np.array(
        [(r.slip, r.coefficient, r.error, r.slip_ratio) for r in rows]
    ).T
    assert np.all(np.diff(slips) > 0)
    assert np.all(np.diff(ratios) > 0)
    assert np.all(np.diff(values) <= errors[1:] + errors[:-1])
    assert values[0] > 1.4 * values[-1]


@pytest.mark.parametrize("model", regimes_table.MODELS)
def test_the_table_is_what_its_command_makes(table: list[regimes_table.Row], model: str) -> None:
    kept = next(r for r in table if (r.model, r.slip) == (model, 1.0))
    again = regimes_table.row(model, 1.0)
    # rounded to 7 digits; the largest speed is that of some points of quadrature, right to 1 %
    assert abs(again.coefficient - kept.coefficient) <= again.error + kept.error + 1e-6
    assert again.slip_ratio == pytest.approx(kept.slip_ratio, rel=0.02)


@pytest.mark.parametrize("slip", regimes_table.STEPPED)
def test_steps_and_static_shapes_agree_within_their_errors(
    table: list[regimes_table.Row], slip: float
) -> None:
    """Friction of 1e-4 of the stiffness changes the speed by as much."""
    rows = {r.model: r for r in table if r.slip == slip}
    stepped, static, theory = (rows[m] for m in ("stepped", "nonlinear", "second order"))
    assert abs(stepped.coefficient - static.coefficient) <= stepped.error + static.error
    assert stepped.error + static.error < 5e-3 * static.coefficient
    # what second order leaves out is alpha^2 of the speed, with a factor about 1
    assert abs(static.coefficient / theory.coefficient - 1) < 1.2 * regimes_table.ALPHA**2


def test_limits_of_the_table(table: list[regimes_table.Row]) -> None:
    alpha = regimes_table.ALPHA
    line = regimes.limits(table, "line")
    assert line["dry"] == pytest.approx(float(line_speed(alpha)) / alpha**2, rel=1e-6)  # 7 digits
    assert line["viscous"] == 0.5
    for model in ("line", "linear", "second order", "nonlinear"):
        found, ends = regimes.select(table, model), regimes.limits(table, model)
        assert found["coefficient"][0] == pytest.approx(ends["dry"], rel=2 * regimes_table.RTOL)
        assert found["coefficient"][-1] == pytest.approx(ends["viscous"], rel=2 * regimes_table.RTOL)


def test_what_the_figure_says_of_the_paper(table: list[regimes_table.Row]) -> None:
    """The numbers of its docstring, which are rounded."""
    dry, viscous = regimes.boundaries(table)
    assert (dry, viscous) == pytest.approx((0.093, 1.84), rel=0.01)
    assert 0.25 * dry == pytest.approx(0.023, rel=0.02)
    assert all(period / max(regimes.PAPER_ALPHAS) > viscous for period in regimes.PERIODS.values())
    ends = regimes.limits(table, "nonlinear")
    assert ends["viscous"] / ends["dry"] == pytest.approx(2 / 3, abs=0.01)


def test_the_period_of_the_waves_of_the_paper() -> None:
    """Eqs 12 with nu = -0.01, kappa = 1e-4, epsilon = 0.05 and no dependence on place."""

    def rates(_: float, state: np.ndarray) -> list[float]:
        c, w = state
        return [c * (1 - c) * (c + 0.01) - w, 0.05 * (c - 1e-4 * w)]

    found = solve_ivp(rates, (0, 600), [0.5, 0], method="LSODA", rtol=1e-8, atol=1e-10, max_step=1.0)
    c, times = found.y[0], found.t
    up = np.flatnonzero((c[:-1] < 0) & (c[1:] >= 0) & (times[1:] > 400))
    crossings = times[up] - c[up] * (times[up + 1] - times[up]) / (c[up + 1] - c[up])
    expected = regimes.PERIODS["$T=29.5\\,L/v_0$ (eqs 12)"]
    np.testing.assert_allclose(np.diff(crossings), expected, rtol=2e-3)  # 3 digits are shown
    assert abs(c[times > 400]).max() == pytest.approx(0.12, rel=0.05)


def test_the_figure_is_made_of_the_table_and_always_the_same(
    table: list[regimes_table.Row], tmp_path
) -> None:
    axes = regimes.draw(table).axes[0]
    labels = [t.get_text() for t in axes.get_legend().get_texts()]
    assert len(labels) == len({*regimes.LINES, *regimes.SYMBOLS})
    for container, model in zip(axes.containers, regimes.SYMBOLS, strict=True):
        found = regimes.select(table, model)
        expected = np.stack([found["slip"], found["coefficient"]], axis=1)
        np.testing.assert_array_equal(container.lines[0].get_xydata(), expected)
    once, again = ([p.read_bytes() for p in regimes.write(table, tmp_path / n, ("png",))] for n in "ab")
    assert once == again


def test_a_missing_table_is_reported_with_its_command(tmp_path) -> None:
    with pytest.raises(FileNotFoundError, match=r"python -m figures\.measure\.regimes"):
        regimes_table.TABLE.read(tmp_path / "none.csv")
    with pytest.raises(ValueError, match=r"no line.*python -m figures\.measure\.regimes"):
        regimes.select([], "line")


def test_written_rows_are_read_back(table: list[regimes_table.Row], tmp_path) -> None:
    again = regimes_table.TABLE.read(regimes_table.TABLE.write(table, tmp_path / "regimes.csv"))
    assert again == table


def test_the_table_is_made_without_warnings() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert regimes_table.row("linear", 10.0).slip_ratio > VISCOUS_RATIO
