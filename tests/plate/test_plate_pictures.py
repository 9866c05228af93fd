"""What a plate on its ground looks like: its shape, load and slip beside those of nonlinear shapes."""

from pathlib import Path

import matplotlib
import numpy as np
import pytest

from fem_check import cycle_speed
from fem_check.output.panels import SUNK
from fem_check.runs import netcdf, recorded
from figures.measure import saddle
from linear_theory import FrictionLaw, OnLowerFace, Scene, SineWave, Tanh, crawl_speed

matplotlib.use("Agg")

PAPER = saddle.PLACES["paper"]
POINTS = np.stack([v.ravel() for v in np.meshgrid([-0.24, 0.0, 0.2], np.linspace(-0.49, 0.49, 15))])


def scene(law: FrictionLaw, alpha: float = 1e-3, beta: float = -0.05) -> Scene:
    return saddle.scene(PAPER, SineWave(), law, alpha, beta)


@pytest.mark.parametrize("law", [Tanh(0.3), OnLowerFace(Tanh(0.3))], ids=["middle", "lower face"])
def test_shape_load_and_slip_are_those_of_a_nonlinear_shape(law: FrictionLaw) -> None:
    asked, t = scene(law), 0.1
    plate = crawl_speed(asked, order=2, rtol=1e-2).deformation
    shapes = cycle_speed(asked.but(cells=(6, 12)), rtol=1e-2).deformation
    assert plate is not None
    assert shapes is not None
    places, known = (one.places(POINTS, np.array([t]))[:, 0] for one in (plate, shapes))
    flat = np.abs(known[:2] - POINTS).max()
    np.testing.assert_allclose(places[:2], known[:2], atol=0.02 * flat)
    np.testing.assert_allclose(places[2], known[2], atol=0.02 * np.ptp(known[2]))
    touch, right = plate.contact(POINTS, t), shapes.contact(POINTS, t)
    np.testing.assert_allclose(touch.load, right.load, atol=0.02 * np.abs(right.load - 1).max())
    size = np.abs(right.velocity).max()
    np.testing.assert_allclose(touch.velocity, right.velocity, atol=0.01 * size)


@pytest.mark.filterwarnings("ignore::linear_theory.ViscousRegimeWarning")
def test_a_sheet_that_bends_alone_slips_with_the_square_of_the_curvature() -> None:
    asked, t = scene(Tanh(0.3), 1.0, -0.2).but(alpha=0.0), 0.1
    plate = crawl_speed(asked, order=2, rtol=1e-2).deformation
    shapes = cycle_speed(asked.but(cells=(6, 12)), rtol=1e-2).deformation
    assert plate is not None
    assert shapes is not None
    touch, right = plate.contact(POINTS, t), shapes.contact(POINTS, t)
    size = np.abs(right.velocity).max()
    np.testing.assert_allclose(touch.velocity, right.velocity, atol=0.05 * size)


def test_a_run_keeps_its_pressure_and_draws_the_sheet_bent(tmp_path: Path) -> None:
    asked = scene(Tanh(0.3))
    found = crawl_speed(asked, order=2, rtol=1e-2)
    netcdf.write(recorded(found, asked), found, tmp_path / "motion.nc")
    kept = netcdf.read(tmp_path / "motion.nc")
    assert found.deformation is not None
    load = found.deformation.contact(kept.points, 0.25).load
    np.testing.assert_allclose(kept.pressure(kept.points, 0.25), load, rtol=1e-5)
    for moving in (found, kept):
        drawn = moving.plot("pressure", phase=0.25)
        image = drawn.collections[0]
        np.testing.assert_allclose(image.get_clim(), (load.min(), load.max()), rtol=1e-3)
    side = kept.plot("side", phase=0.25)
    heights = kept.at(kept.points, 0.25).place[2]
    assert SUNK * np.ptp(heights) < -heights.max()  # so deep that the ground at 0 is left out
    low, high = side.get_ylim()
    assert low < heights.min() < heights.max() < high < 0
    assert "$z$ = 0" in side.get_title(loc="left")
    matplotlib.pyplot.close("all")


def test_a_flat_sheet_has_no_pressure_to_draw() -> None:
    with pytest.raises(ValueError, match=r"what = 'pressure': the sheet lies in the plane"):
        crawl_speed(scene(Tanh(0.3)).sheet, SineWave(), 0.01, rtol=0.1).plot("pressure")
