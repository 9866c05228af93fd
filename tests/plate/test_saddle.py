"""The saddle of V over growth and curvature: its tables, its page, its figure, its lower face."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from fem_check import simulate
from figures.draw.saddle import figure
from figures.draw.saddle import page as saddle_page
from figures.measure import saddle
from figures.measure.plate import saddle_range
from linear_theory import Sheet, SineWave, Viscous, second_order
from tests.plate.reference_lower_face import added, grid

ROWS, ALONG = saddle.TABLE.read(), saddle_range.TABLE.read()


def test_the_page_is_that_of_the_tables() -> None:
    assert saddle_page.PAGE.read_text(encoding="utf-8") == saddle_page.made()


@pytest.mark.parametrize(
    ("part", "way", "share"),
    [
        ("aa", "cycle", 1e-2),
        ("aa", "stepper", 1e-2),
        ("ab", "cycle", 1e-2),
        ("ab", "stepper", 1e-2),
        ("bb", "cycle", 1e-2),
        ("bb", "stepper", 1e-2),
    ],
)
def test_the_theory_is_that_of_shapes_and_of_steps(part: str, way: str, share: float) -> None:
    assert saddle_page.distance(ROWS, way, part) < share


def test_v_ab_is_negative_everywhere_as_the_page_says() -> None:
    assert all(r.theory_ab < -r.error_ab and r.stepper_ab < 0 for r in ROWS)


def test_rows_are_what_is_computed() -> None:
    first = saddle_range.ray(ALONG, "paper", "tanh", -1)[0]
    found = saddle_range.row(saddle_range.place_of(first))
    assert found.cycle == pytest.approx(first.cycle, rel=1e-4)
    assert found.form == pytest.approx(first.form, rel=1e-4)


def test_both_grounds_are_whole_under_the_law_that_is_drawn() -> None:
    drawn = {(ground, figure.LAW) for ground in saddle_range.GROUNDS}
    assert drawn <= set(saddle_range.complete(ALONG))


@pytest.mark.parametrize("ground", saddle_range.GROUNDS)
@pytest.mark.parametrize("way", [1, -1])
def test_along_a_ray_the_form_is_left_with_the_square_of_beta(ground: str, way: int) -> None:
    """V is even under (alpha, beta) -> -(alpha, beta), so that the next order is two higher."""
    one, two = saddle_range.ray(ALONG, ground, figure.LAW, way)[1:4:2]
    off, far = (abs(r.cycle / r.form - 1) for r in (one, two))
    assert off < 0.02
    assert far / off == pytest.approx((two.beta / one.beta) ** 2, rel=0.4)


def test_cycles_and_steps_agree_beyond_lift_off() -> None:
    run = [r for r in ALONG if not math.isnan(r.stepper)]
    assert any(r.beta > 3 * r.lift_off for r in run)
    for r in run:
        assert abs(r.stepper - r.cycle) <= r.cycle_error + 5e-3 * abs(r.cycle), r


def test_range_of_a_made_up_ray() -> None:
    """V = form (1 - beta^2/4), so that form/V - 1 = share at beta = 2 sqrt(share/(1 + share))."""
    beta = np.linspace(0.05, 1.0, 20)
    rows = [
        replace(
            ALONG[0], way=way, beta=float(b), form=-way, cycle=-way * (1 - b**2 / 4 * (2 - way) / 3)
        )
        for way in (1, -1)
        for b in beta
    ]
    found = saddle_range.within(rows, ALONG[0].ground, ALONG[0].law, 0.1)
    assert found == pytest.approx(2 * math.sqrt(0.1 / 1.1), rel=1e-3)
    # never left within the table
    assert saddle_range.within(rows, ALONG[0].ground, ALONG[0].law, 0.9) == math.inf
    with pytest.raises(ValueError, match=r"no moss, tanh in the table; `python -m figures.measure"):
        saddle_range.within(rows, "moss", "tanh", 0.1)


def test_the_lower_face_slips_and_pushes_as_shapes_of_the_shell_do() -> None:
    """From the shapes of the nonlinear shell: the normal of its mid-surface, the force k z^2 on it."""
    place, couplings, steps = saddle.PLACES["paper"], (0.01, 0.1), 24
    sheet = place.sheet
    x, y, weights = (a.ravel() for a in np.broadcast_arrays(*grid(sheet.width, sheet.length)))
    near = [(0, 0), (1e-5, 0), (-1e-5, 0), (0, 1e-5), (0, -1e-5)]
    points = np.concatenate([np.array([x + a, y + b]) for a, b in near], axis=1)
    frequency = np.fft.fftfreq(steps, 1 / steps)
    frequency[steps // 2] = 0

    def pushed(alpha: float, beta: float) -> float:
        scene = saddle.scene(place, SineWave(), Viscous(), alpha, beta)
        run = simulate(scene, 1, steps=steps, mesh_error=False)
        times = run.stored_times[-steps - 1 : -1]
        places = np.array([run.positions(t, points, rtol=None) for t in times]).reshape(steps, 3, 5, -1)
        tangents = places[:, :, 1] - places[:, :, 2], places[:, :, 3] - places[:, :, 4]
        normal = np.cross(*tangents, axis=1)
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        offset = np.fft.fft(-sheet.thickness / 2 * normal[:, 1], axis=0)
        slip = np.fft.ifft(2j * np.pi * frequency[:, None] * offset, axis=0).real
        depth = -np.minimum(places[:, 2, 0], 0)
        grown = np.exp(2 * alpha * np.sin(2 * np.pi * (y - times[:, None])))
        load = depth**2 * grown * weights
        return -float(np.mean((load * slip).sum(1) / load.sum(1)))

    alpha, beta = couplings
    one, other = pushed(alpha, beta), pushed(alpha, -beta)
    mixed, bent = added(saddle.scene(place, SineWave(), Viscous(), alpha, 0.0))
    assert mixed == pytest.approx((one - other) / (2 * alpha * beta), rel=1e-2)
    assert bent == pytest.approx((one + other) / (2 * beta**2), rel=2e-2)


def test_limit_of_a_strip_without_stiffness() -> None:
    """1D, nu = 0, viscous: V_ab = -<p v> and int s w v = -D int c v'' as D -> 0, v' = c_t.

    For c = sin 2 pi (y - t) that is -2 pi^2 D/(rho g); edge layers of length l leave a part of order l.
    """
    weight, found = 1e-4, []
    sheet = Sheet(width=0.01, poisson=0.0, thickness=0.02)
    rigidity = sheet.thickness**3 / 12
    for stiffness in (1e4, 1e6):
        place = saddle.Place(sheet, weight, stiffness, (1, 8))
        asked = saddle.scene(place, SineWave(), Viscous(), 0.01, 0.0)
        mixed = second_order(asked, rtol=5e-3).coefficients.alpha_beta.value
        layer = (rigidity / (2 * math.sqrt(stiffness * weight))) ** 0.25
        found.append((layer, mixed / (-2 * math.pi**2 * rigidity / weight)))
    (wide, one), (narrow, other) = found
    assert other + (other - one) * narrow / (wide - narrow) == pytest.approx(1, abs=5e-3)


def test_the_figure_writes_what_it_shows(tmp_path: Path) -> None:
    paths = figure.write(tmp_path, ["png"])
    assert [p.name for p in paths] == ["saddle.png", "saddle.json"]
    fig = figure.draw(ROWS, ALONG)
    axes = fig.axes
    _, speeds, _ = axes
    drawn = {(round(x, 9), y) for line in speeds.lines for x, y in zip(*line.get_data(), strict=True)}
    ray = saddle_range.ray(ALONG, "stiff ground", "tanh", 1)
    assert all(any(x == round(r.beta, 9) and y == r.cycle for x, y in drawn) for r in ray)
    with pytest.raises(ValueError, match=r"no moss, sine, tanh in the table"):
        figure.form_of(ROWS, "moss")
