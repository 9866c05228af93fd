"""The examples run as they stand, print their answers, draw one figure, and their numbers are right.

Each number is compared with one that was found by another way than the script's: a closed form, another
level, another discretisation, a table measured by steps in time, or an exact symmetry.
"""

import runpy
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from fem_check import Friction, Material, Membrane, Scene, cycle_speed, plane_stress_field
from fem_check import simulate as stepped
from figures.common import style
from figures.measure import turning
from linear_theory import Sheet, SineWave, crawl_speed, field_speed

FOLDER = Path(style.__file__).parents[1] / "examples"
SCRIPTS = {path.stem: path for path in sorted(FOLDER.glob("*.py")) if path.stem != "__init__"}
STRETCHING = Membrane(Material(0.03, 0.5))
MOST = 50
"""Times as long as a speed of second order by the same core; they take 2 to 20."""

Names = dict[str, Any]


def median_speed(stretch: NDArray[np.float64]) -> float:
    """V of a body on a line of equidistant phases: median of the stretch by itself, less its mean.

    Its weight and its velocity against the wave are both the stretch: half of the weight is faster.
    """
    order = np.sort(stretch)
    below = np.cumsum(order)
    return float(order[np.searchsorted(below, below[-1] / 2)] - stretch.mean())


PHASES = 2 * np.pi * (np.arange(400_000) + 0.5) / 400_000
SPACING = 1e-5
"""Between neighbouring samples of a stretch."""


def check_first_speed(names: Names) -> None:
    """Other elements, twice as many and of another kind, to a third of the tolerance."""
    sheet = names["sheet"]
    effects = (Membrane(Material(sheet.thickness, sheet.poisson)),)
    scene = Scene(sheet, names["wave"], names["alpha"], effects=effects, cells=(4, 10))
    other = cycle_speed(scene, rtol=3e-3)
    assert names["found"].mean == pytest.approx(other.mean, abs=names["found"].error + other.error)


def check_own_wave(names: Names) -> None:
    """1.5330 of the sine (from 12 x 24 elements), and the nonlinear sheet at small alpha."""
    sine, _, part = names["found"][:3]
    assert sine.second == pytest.approx(1.5330, abs=sine.second_error)
    alpha = 0.05
    scene = Scene(Sheet(), names["partly_reflected"](0.4), alpha, effects=(STRETCHING,))
    other = cycle_speed(scene, rtol=1e-2)
    # the next term is of order alpha^4, as V(-alpha) = V(alpha); its coefficient is about V_2
    rest = alpha**2 * part.second
    assert part.second == pytest.approx(
        other.mean / alpha**2, abs=part.second_error + other.error / alpha**2 + rest
    )


def check_bilayer_inchworm(names: Names) -> None:
    """Steps in time under weak friction; the flat sheet in the plane under its grown weight."""
    flat, bent = names["flat"], names["bent"]
    planar = Scene(names["sheet"], SineWave(), names["alpha"], effects=(STRETCHING,))
    level = cycle_speed(planar, "grown")
    assert flat.mean == pytest.approx(level.mean, abs=flat.error + level.error)
    effects = (*names["effects"], Friction(0.02, slip_speed=2e-3))
    scene = Scene(names["sheet"], SineWave(), names["alpha"], names["curvature"], effects, cells=(2, 8))
    other = stepped(scene, periods=1, rtol=0.03).speed
    # friction of 0.02 x 2.5e-4 x L/(E h) = 2e-4 is 1 % of the growth; the slip speed, 2 % of the speeds
    assert bent.mean == pytest.approx(other.mean, abs=bent.error + other.error + 0.02 * abs(bent.mean))


def check_turning_sheet(names: Names) -> None:
    """Turn and distance per period of the sheet stepped in time, after 20 periods."""
    (row,) = (r for r in turning.TABLE.read() if (r.wave, r.period) == ("unequal", 20))
    path = names["path"]
    error = row.heading_error + 20 * path.turn_error
    assert 20 * path.turn == pytest.approx(row.heading, abs=error)
    place = path.position[:, np.searchsorted(path.times, path.times[0] + 20 - 1e-9)]
    chord = np.linalg.norm(place)
    assert chord == pytest.approx(np.hypot(row.x, row.y), abs=2 * (row.error + 0.01 * chord))


def check_trapezoid(names: Names) -> None:
    """The Airy series; run backwards and mirrored; and the nonlinear sheet, to order alpha."""
    speeds, alpha = names["speeds"], names["alpha"]
    series = crawl_speed(Sheet(), names["wave"], alpha, rtol=1e-3)
    plain, front, rear = speeds.values()
    assert plain.mean == pytest.approx(series.mean, abs=plain.error + series.error)
    assert front.mean == pytest.approx(rear.mean, abs=front.error + rear.error)
    scene = Scene(Sheet(width=0.7), names["wave"], alpha, effects=(STRETCHING,))
    scene = scene.but(mesh=names["outlines"]["narrow front"].mesh(0.3))
    other = cycle_speed(scene, rtol=1e-2)
    assert front.mean == pytest.approx(other.mean, abs=alpha * abs(other.mean))


def check_bumpy_floor(names: Names) -> None:
    """The planar sheet under its grown weight; bumps on a finer mesh in finer steps."""
    flat, low = names["runs"][0].speed, names["runs"][1].speed
    planar = Scene(Sheet(), SineWave(), 0.1, effects=(STRETCHING,))
    level = cycle_speed(planar, "grown", "tanh", slip_speed=0.02)
    assert flat.mean == pytest.approx(level.mean, abs=flat.error + level.error)
    scene = names["on_bumps"](names["heights"][1]).but(cells=(3, 12))
    fine = stepped(scene, periods=2, rtol=0.03).speed
    assert low.mean == pytest.approx(fine.mean, abs=low.error + fine.error)


def check_cost_of_accuracy(names: Names) -> None:
    """Finite elements; no claim below the true error or above the tolerance."""
    reference = names["reference"]
    field = plane_stress_field(names["sheet"], names["wave"], size=0.12)
    elements = field_speed(field, names["alpha"], rtol=1e-3)
    assert reference.mean == pytest.approx(elements.mean, abs=reference.error + elements.error)
    for rtol, speed in zip(names["tolerances"], names["found"], strict=True):
        assert abs(speed.mean - reference.mean) <= speed.error + reference.error
        assert speed.error <= rtol * speed.mean


def check_against_the_paper(names: Names) -> None:
    """The median of a stretch 1 + alpha sin; 1.5330 of the sheet (from 12 x 24 elements)."""
    exact = median_speed(1 + 0.2 * np.sin(PHASES))
    assert names["line"][4] == pytest.approx(exact, abs=SPACING)
    assert names["printed"][4] < 0 < exact
    leading = names["leading"]
    assert leading.second == pytest.approx(1.5330, abs=leading.second_error)


def check_own_effect(names: Names) -> None:
    """Fibres that do not stretch leave a body on a line of stretch s, s² = (1 + ν) exp(2 alpha c) - ν.

    That is the minimum of Koiter's energy of a strip held at its width, free along.
    """
    stretch = np.sqrt(1.5 * np.exp(0.4 * np.sin(PHASES)) - 0.5)
    stiffest, next_to = names["found"][-1], names["found"][-2]
    # what is left to the limit falls in proportion to the stiffness, 100 times from one to the other
    rest = abs(stiffest.mean - next_to.mean) / 50
    exact = median_speed(stretch)
    assert stiffest.mean == pytest.approx(exact, abs=stiffest.error + rest + SPACING)
    plain = cycle_speed(names["sheet"], rtol=1e-2)
    assert abs(names["found"][0].mean - plain.mean) < 0.1 * abs(stiffest.mean - plain.mean)


CHECKS: dict[str, Callable[[Names], None]] = {
    name.removeprefix("check_"): check
    for name, check in list(globals().items())
    if name.startswith("check_")
}


def test_there_are_eight_or_more_and_each_has_its_check() -> None:
    assert len(SCRIPTS) >= 8
    assert SCRIPTS.keys() == CHECKS.keys()


@pytest.mark.parametrize("name", SCRIPTS)
def test_a_script_is_short_and_begins_with_its_question(name: str) -> None:
    lines = SCRIPTS[name].read_text().splitlines()
    assert len(lines) < 60
    assert lines[0].startswith('"""')
    assert lines[0].endswith("?")
    assert sum(line.startswith("# %% ") for line in lines) >= 2


@pytest.mark.parametrize("name", SCRIPTS)
def test_it_runs_prints_draws_and_is_right(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(style, "OUT", tmp_path)
    start = time.process_time()
    names = runpy.run_path(str(SCRIPTS[name]), run_name="__main__")
    example, start = time.process_time() - start, time.process_time()
    crawl_speed(Sheet(), SineWave(), 0.1, order=2)
    assert example < MOST * (time.process_time() - start)
    printed = capsys.readouterr().out
    picture = tmp_path / f"example_{name}.png"
    assert picture.stat().st_size > 10_000
    assert "±" in printed
    assert "L" in printed or "mm/s" in printed
    assert printed.splitlines()[-1] == str(picture)
    CHECKS[name](names)
