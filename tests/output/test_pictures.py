"""What `.plot()` draws: the numbers of the result, against the slip, where the sheet is."""

import pickle
import re
import subprocess
import sys

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.quiver import Quiver
from matplotlib.text import Text

from fem_check import (
    Friction,
    Gravity,
    Ground,
    Inertia,
    Material,
    Membrane,
    Outline,
    Scene,
    cycle_speed,
    plane_stress_field,
    predict,
    simulate,
)
from fem_check.output import Units
from fem_check.output.crawling import Crawling
from fem_check.output.geometry import edges, inside, middle_line, refined
from fem_check.output.pictures import moving_of, panels
from fem_check.output.simulated import Simulated
from fem_check.output.tint import tint_of
from fem_check.shell.cycle.shapes import cycle_of_shapes
from fem_check.shell.effects.koiter import Bending
from linear_theory import (
    FieldWave,
    Sheet,
    SineWave,
    TravellingWave,
    airy_series,
    crawl_speed,
    field_speed,
    friction_field,
    line_balance,
    rigid_path,
)

SHEET, WAVE, ALPHA = Sheet(), SineWave(), 0.2
MATERIAL = Material(0.03, 0.5)
LOPSIDED = FieldWave(lambda x, y, t: (1 + 2 * x) * np.sin(2 * np.pi * (y - t)), period=1.0)


@pytest.fixture(autouse=True)
def _agg():
    """Without a display, and without figures left open."""
    before = mpl.get_backend()
    mpl.use("agg")
    yield
    from matplotlib import pyplot

    pyplot.close("all")
    mpl.use(before)


@pytest.fixture(scope="module")
def theory():
    return crawl_speed(SHEET, WAVE, ALPHA, rtol=1e-3)


@pytest.fixture(scope="module")
def cycle():
    scene = Scene(SHEET, LOPSIDED, ALPHA, effects=[Membrane(MATERIAL)], cells=(2, 4))
    return cycle_speed(scene, rtol=1e-2)


@pytest.fixture(scope="module")
def run():
    effects = [Membrane(MATERIAL), Gravity(3e-6), Friction(1.0, slip_speed=0.005)]
    return simulate(Scene(SHEET, WAVE, 0.15, effects=effects, cells=(1, 2)), periods=1, rtol=0.1)


def axes():
    return Figure().subplots()


def test_the_curve_is_the_velocity_of_the_result_in_its_units(theory):
    ax = theory.plot("speed", ax=axes(), units=Units("mm", "s", 40.0, 8.0))
    curve, mean = ax.lines[:2]
    t, v = curve.get_data()
    order = np.argsort(theory.times % 1)
    np.testing.assert_allclose(t[1:-1], 8 * (theory.times % 1)[order])
    np.testing.assert_allclose(v[1:-1], 5 * theory.velocity[order])  # 40 mm / 8 s
    np.testing.assert_allclose(mean.get_ydata(), 5 * theory.mean)
    low, high = ax.collections[0].get_datalim(ax.transData).intervaly
    half = 5 * (theory.error + theory.model_error)
    np.testing.assert_allclose([low, high], 5 * theory.mean + np.array([-half, half]))
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("time $t$ (s)", "$V(t)$ (mm/s)")
    assert ax.get_xlim() == (0, 8)


def test_the_sheet_is_drawn_where_it_is(theory):
    """By the series, found to more digits; y runs to the right on the page and x downwards."""
    ax = theory.plot("sheet", ax=axes(), phase=0.3)
    drawn = np.concatenate(ax.collections[1].get_segments())
    field = airy_series(SHEET, WAVE, rtol=1e-7)
    for x, y in ((0.25, 0.5), (-0.25, 0.5), (0.25, -0.5), (0.25, 0.0)):
        corner = np.array([x, y]) + ALPHA * field.displacement(x, y, 0.3)
        assert np.abs(drawn - corner[::-1]).sum(1).min() < 1e-3 * ALPHA
    assert ax.yaxis_inverted()
    image = ax.collections[0]
    assert image.get_clim() == pytest.approx((-20, 20), rel=1e-2)  # alpha c in per cent


def test_a_colour_bar_fits_beside_axes_of_the_caller(theory):
    """Its label, too, within the old place of its axes, which may be drawn into again."""
    left, right = Figure(figsize=(9, 4), layout="none").subplots(1, 2)
    edge = right.get_position().x0
    for ax in (left, right):
        theory.plot("friction", ax=ax)
    fig = left.figure
    fig.draw_without_rendering()  # which places them
    width = left.get_position().width
    for ax, end in ((left, edge), (right, 1.0)):
        assert ax.child_axes[0].get_tightbbox().x1 < end * fig.bbox.width
    left.clear()
    theory.plot("friction", ax=left)
    fig.draw_without_rendering()
    assert left.get_position().width == width


def test_arrows_are_friction_against_the_slip(theory):
    ax = theory.plot("sheet", ax=axes(), phase=0.3)
    (arrows,) = (a for a in ax.collections if isinstance(a, Quiver))
    moving = moving_of(theory)
    tails = inside(*moving.covering(), 5, 11)  # as many as a rectangle of 1 : 2 gets
    field = airy_series(SHEET, WAVE, rtol=1e-6)
    exact = friction_field(field, ALPHA, *tails, 0.3)
    assert np.all(arrows.U * exact.slip[1] + arrows.V * exact.slip[0] < 0)
    # the velocity of the body is interpolated between the times of the speed
    off = moving.friction(tails, 0.3) - exact.force
    assert np.sqrt(np.mean(off**2)) < 0.02
    # and drawn along the force, the longest nearly as long as the tails are apart: 1/11
    across = arrows.U * exact.force[0] - arrows.V * exact.force[1]
    sizes = np.hypot(arrows.U, arrows.V), np.hypot(*exact.force)
    assert np.abs(across / (sizes[0] * sizes[1])).max() < 0.1
    assert 0.5 / 11 < sizes[0].max() <= 1 / 11


def _total(moving, phase):
    """Sum of friction over the sheet as a share of the sum of its sizes."""
    points = inside(*moving.covering(), 30, 60)
    force = moving.friction(points, phase)
    return np.hypot(*force.sum(1)) / np.hypot(*force).sum()


def test_friction_is_in_balance(theory, cycle, run):
    """That is what gave the speeds; 1800 points see the points at rest to a per cent or so."""
    outline = Outline.trapezoid(0.6, 0.4, 1.0)
    fem = field_speed(plane_stress_field(outline, WAVE, size=0.2), ALPHA, rtol=1e-2)
    for moving in map(moving_of, (theory, cycle, fem, run)):
        for phase in (0.1, 0.6):
            assert _total(moving, phase) < 0.02


def test_a_cycle_is_drawn_in_the_shape_that_it_has():
    """Against a static shape, its mean place taken off: it does not turn under a wave along y."""
    scene = Scene(SHEET, WAVE, ALPHA, effects=[Membrane(MATERIAL)], cells=(2, 4))
    speed = cycle_speed(scene, rtol=1e-2)
    moving = moving_of(speed)
    points = np.array([[0.25, -0.2, 0.0], [0.5, 0.1, -0.5]])
    shapes = cycle_of_shapes(scene, 16)
    sheet, state = shapes.discretisation, shapes.states[4]
    place = sheet.points(points).position(state, (0,))[0]
    mean = sheet.interior.position(state, (0,))[0] @ sheet.interior.measure / SHEET.area
    np.testing.assert_allclose(moving.at(points, 0.25).place, place - mean[:, None], atol=1e-6)
    assert moving.at(points, 0.25).growth == pytest.approx(ALPHA * WAVE.value(*points, 0.25))


def test_a_trajectory_is_drawn_at_its_positions(run):
    moving = moving_of(run)
    points = np.array([[0.25, -0.2], [0.5, 0.1]])
    frame = moving.at(points, 0.5)
    assert frame.time == pytest.approx(run.start + 0.5)
    np.testing.assert_allclose(frame.place, run.positions(frame.time, points, rtol=None), rtol=1e-12)
    ax = run.plot("speed", ax=axes())
    t, v = ax.lines[0].get_data()
    np.testing.assert_allclose(v[-run.speed.velocity.size :], run.speed.velocity)
    np.testing.assert_allclose(t[-run.speed.times.size :], run.speed.times)
    way = run.plot("path", ax=axes()).lines[0].get_data()
    np.testing.assert_allclose([d[-1] for d in way], run.centre[::-1, -1])
    with pytest.raises(ValueError, match=r"phase = 3: must be within the periods that were kept"):
        run.plot("sheet", ax=axes(), phase=3)


def test_a_sheet_that_turns_is_carried_along_its_path(cycle):
    path = rigid_path(cycle, 20, samples=4)
    moving = Crawling(cycle)
    points = np.array([[0.25, -0.25], [0.5, -0.5]])
    frames = moving.frames(points, 20, 4)
    still = moving.at(points, (path.times[2] % 1)).place
    frame = frames[4 * 13 + 2]
    z = (still[0] + 1j * still[1]) * np.exp(1j * path.heading[54]) + path.position[:, 54] @ [1, 1j]
    np.testing.assert_allclose(frame.place, [z.real, z.imag], atol=1e-9)
    drawn = cycle.plot("path", ax=axes(), periods=20).lines[0].get_data()
    np.testing.assert_allclose([d[-1] for d in drawn], path.position[::-1, -1], atol=1e-9)


def test_a_sheet_in_space_is_drawn_on_its_ground_from_the_side():
    height = lambda x, y: 0.01 * np.cos(2 * np.pi * y) + 0 * x  # noqa: E731
    effects = [
        Membrane(MATERIAL),
        Bending(MATERIAL),
        Gravity(1e-5),
        Ground(0.05, damping=1e-3, height=height),
        Friction(1.0, slip_speed=0.02),
    ]
    scene = Scene(SHEET, WAVE, 0.05, effects=effects, cells=(1, 2))
    run = simulate(scene, periods=1, steps=8)
    ax = run.plot("side", ax=axes(), phase=1)
    y, z = ax.lines[0].get_data()
    np.testing.assert_allclose(z, 0.01 * np.cos(2 * np.pi * y), atol=1e-12)
    drawn = np.concatenate(ax.collections[1].get_segments())
    np.testing.assert_allclose(drawn[:, 1].max(), run.positions(run.times[-1])[2].max(), atol=2e-3)
    labels = [a.get_ylabel()[:3] for a in run.plot()]
    assert labels == ["$V(", "$x$", "$x$", "$x$", "$z$", "tim", "tim", "tim", "wor", "$x$"]
    some = inside(*Simulated(run).covering(), 4, 8)
    force, pressure = Simulated(run).friction(some, 1.0), Simulated(run).pressure(some, 1.0)
    assert np.all(np.hypot(*force) <= pressure)  # tanh is below 1
    assert 0 <= pressure.min() < 1 < pressure.max()
    assert np.hypot(*force).max() > 0


def test_a_sheet_that_only_bends_is_coloured_by_the_wave():
    effects = [Membrane(MATERIAL), Bending(MATERIAL), Gravity(2.5e-4), Ground(0.5)]
    scene = Scene(SHEET, WAVE, 0.0, curvature_coupling=0.5, effects=effects, cells=(2, 4))
    moving = Crawling(cycle_speed(scene, rtol=0.2))
    points, _ = moving.covering()
    shown = tint_of(moving, points)
    frame = moving.at(points, 0.3)
    assert (shown.axis, shown.most) == ("wave $c$", pytest.approx(1.0, abs=2e-2))
    np.testing.assert_array_equal(shown.at(frame), WAVE.value(*points, 0.3))
    grows = Crawling(crawl_speed(SHEET, WAVE, 0.2, rtol=1e-2))
    frame, shown = grows.at(points, 0.3), tint_of(grows, points)
    assert shown.axis == r"growth $\alpha c$ (%)"
    np.testing.assert_allclose(shown.at(frame), 20 * WAVE.value(*points, 0.3), atol=1e-12)


def test_outline_of_a_sheet_with_a_hole_is_both_loops():
    """Each has the length of its polygon, by hand."""
    hole = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]
    corners = [[-0.25, -0.5], [0.25, -0.5], [0.25, 0.5], [-0.25, 0.5]]
    field = plane_stress_field(Outline(corners, holes=[hole]), WAVE, size=0.3, degree=2)
    points, triangles = field.covering()
    ends = points[:, edges(triangles)]
    length = np.hypot(*(ends[:, :, 1] - ends[:, :, 0])).sum()
    assert length == pytest.approx(3.0 + 0.8)
    assert not np.any(np.abs(inside(points, triangles, 20, 40)).max(0) < 0.1)


def test_all_panels_of_a_prediction_at_any_level():
    for level in ("strip", "second order"):
        found = predict(SHEET, WAVE, 0.1, rtol=0.2, level=level)
        _, sheet, _, _, _, path = found.plot(phase=0.25)
        assert sheet.collections
        assert path.lines[0].get_data()[0][-1] == pytest.approx(10 * found.mean)
        path.figure.canvas.draw()


def test_a_body_on_a_line_has_a_speed_and_a_path():
    speed = line_balance(TravellingWave(cosine=[1.0, 0.5], sine=[0.0, 0.0], period=2.0), 0.1)
    assert len(speed.plot()) == 2
    assert speed.plot("path", ax=axes()).lines[0].get_data()[0][-1] == pytest.approx(
        20 * speed.mean, rel=1e-6
    )
    with pytest.raises(ValueError, match=r"what = 'sheet': .* has no shape to draw"):
        speed.plot("sheet")


def test_a_sheet_at_rest_is_drawn():
    axes_ = crawl_speed(SHEET, WAVE, 0.0).plot()
    axes_[0].figure.canvas.draw()
    assert "sheet at rest" in axes_[1].get_title(loc="left")


def test_a_pickled_speed_is_numbers_only(theory):
    again = pickle.loads(pickle.dumps(theory))
    assert again.deformation is None
    assert theory.deformation is not None
    assert len(pickle.dumps(theory)) < 50_000
    with pytest.raises(ValueError, match="has no shape to draw"):
        again.plot("sheet")


def _image(ax):
    """Values, and the positions of the pixels, (rows,) and (columns,)."""
    (image,) = ax.images
    values = image.get_array()
    left, right, low, high = image.get_extent()
    rows, columns = values.shape
    y = low + (high - low) * (np.arange(rows) + 0.5) / rows
    return np.asarray(values), y, left + (right - left) * (np.arange(columns) + 0.5) / columns


@pytest.mark.parametrize("count", [1, -2])
def test_ridges_of_a_kymograph_are_straight_and_as_steep_as_the_wave_is_fast(count):
    """The crest of a sine moves by a wavelength a period: found by its zeros and a straight line."""
    sheet, period = Sheet(length=3.0, width=1.0), 2.0
    speed = crawl_speed(sheet, SineWave(count=count, period=period), 0.1, rtol=1e-2)
    values, times, y = _image(speed.plot("kymograph", ax=axes(), units=Units("mm", "s")))
    assert times[0] == pytest.approx(0)
    assert times[-1] == pytest.approx(2 * period)  # two periods
    phase = np.unwrap(np.angle(values @ np.exp(-2j * np.pi * abs(count) * y / 3.0)))
    slope, offset = np.polyfit(times, phase, 1)
    np.testing.assert_allclose(phase, slope * times + offset, atol=1e-2)
    wavelength = 3.0 / abs(count)
    assert -slope * wavelength / (2 * np.pi) == pytest.approx(
        np.sign(count) * wavelength / period, rel=1e-3
    )


def test_a_kymograph_of_displacement_is_that_of_the_theory(theory):
    values, times, y = _image(theory.plot("displacement", ax=axes(), periods=1))
    field = airy_series(SHEET, WAVE, rtol=1e-7)
    exact = ALPHA * field.displacement(0.0, y, times[:, None])[1]
    np.testing.assert_allclose(values, exact, atol=2e-3 * ALPHA)
    wave, _, _ = _image(theory.plot("kymograph", ax=axes(), periods=1))
    np.testing.assert_allclose(wave, WAVE.value(0, y, times[:, None]), atol=1e-12)


def test_a_kymograph_does_not_see_how_a_sheet_turns(cycle):
    """Displacements are those within the sheet: the same in each period, although it turns."""
    values, _, _ = _image(cycle.plot("displacement", ax=axes(), periods=3))
    np.testing.assert_allclose(values[:48], values[96:144], atol=1e-9)
    assert np.abs(values.mean()) < 1e-3


def test_a_kymograph_leaves_out_holes():
    hole = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]]
    corners = [[-0.25, -0.5], [0.25, -0.5], [0.25, 0.5], [-0.25, 0.5]]
    field = plane_stress_field(Outline(corners, holes=[hole]), WAVE, size=0.3, degree=2)
    values, _, y = _image(field_speed(field, 0.05, rtol=5e-2).plot("kymograph", ax=axes()))
    np.testing.assert_array_equal(np.isnan(values[3].astype(float)), np.abs(y) < 0.1)


def test_refined_triangles_are_quarters():
    points = np.array([[0.0, 1.0, 1.0, 0.0], [0.0, 0.0, 2.0, 2.0]])
    finer, cells = refined(points, np.array([[0, 1, 2], [0, 2, 3]]))
    assert finer.shape == (2, 9)  # 4 corners, 5 middles of edges, one of them shared
    sides = finer[:, cells[:, 1:]] - finer[:, cells[:, :1]]
    areas = sides[0, :, 0] * sides[1, :, 1] - sides[0, :, 1] * sides[1, :, 0]
    np.testing.assert_allclose(areas / 2, 2 / 8)


def test_a_line_beside_a_slot_is_found():
    """Where the middle is open, the nearest line that is mostly in the sheet."""
    left = np.array([[0, 0.35, 0.35, 0], [0, 0, 1, 1.0]])
    points = np.concatenate([left, left + np.array([[0.65], [0.0]])], axis=1)
    triangles = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
    line, found = middle_line(points, triangles, 10)
    assert found.size == 10
    assert abs(line[0, 0] - 0.5) == pytest.approx(0.2)


def test_balance_of_power_is_that_of_the_run_and_closes(run):
    ax = run.plot("power", ax=axes())
    drawn = {line.get_label(): line.get_data() for line in ax.lines}
    counted = run.times >= run.start - 1e-9
    unit = 10.0 ** int(re.search(r"10\^\{(-?\d+)\}", ax.get_ylabel()).group(1))
    for label, name in (("work of growth", "growth"), ("friction", "friction"), ("elastic", "elastic")):
        values = getattr(run.power, name)[counted]
        np.testing.assert_allclose(drawn[label][1] * unit, values - values[0], atol=1e-6 * unit)
        np.testing.assert_allclose(drawn[label][0], run.times[counted])
    assert {"ground", "kinetic", "damping"}.isdisjoint(drawn)  # the scene has none
    parts = {label: y for label, (_, y) in drawn.items()}
    total = sum(y for label, y in parts.items() if label != "work of growth")
    np.testing.assert_allclose(parts["work of growth"], total, atol=1e-9)
    assert parts["friction"][-1] > 0


def test_the_residual_of_the_balance_falls_with_the_step(run):
    """Growth does what friction dissipates and the sheet stores, but for the error of the steps."""
    left = []
    for steps in (32, 128):
        works = moving_of(simulate(run.scene, periods=1, steps=steps)).energies.works
        left.append(np.abs(works["residual"]).max() / works["friction"][-1])
    assert left[1] < 0.03
    assert left[1] < 0.4 * left[0]


def test_the_friction_panel_shows_the_friction_field(theory):
    ax = theory.plot("friction", ax=axes(), phase=0.3)
    image = ax.collections[0]
    points, _ = refined(*refined(*moving_of(theory).covering()))
    exact = friction_field(airy_series(SHEET, WAVE, rtol=1e-6), ALPHA, *points, 0.3).force[1]
    off = np.asarray(image.get_array()).ravel() - exact
    assert np.sqrt(np.mean(off**2)) < 0.03
    assert image.norm.vmin == -image.norm.vmax


def test_a_picture_of_one_panel_has_one_style(theory):
    """Its bar and its title as well, whatever the user's own is, and the width of a column."""
    with mpl.rc_context({"font.size": 20, "axes.titlesize": 30}):
        fig = theory.plot("kymograph").figure
    fig.canvas.draw()
    sizes = {text.get_fontsize() for text in fig.findobj(Text) if text.get_text()}
    assert sizes <= {7.0, 8.0}
    assert fig.get_figwidth() * 2.54 == pytest.approx(8.5)


def test_panels_that_a_result_lacks_are_refused_with_those_that_it_has(theory, run):
    for result, what, why in (
        (theory, "power", "only a motion stepped in time"),
        (theory, "height", "the sheet lies in the plane"),
        (run, "height", "the sheet lies in the plane"),
        (line_balance(WAVE, 0.1), "kymograph", "has no shape to draw"),
        (line_balance(WAVE, 0.1), "friction", "have no friction field"),
    ):
        has = ", ".join(panels(moving_of(result)))
        with pytest.raises(ValueError, match=rf"what = '{what}': .*{why}.*; must be one of {has}$"):
            result.plot(what)
    effects = [Membrane(MATERIAL), Inertia(1e-3, MATERIAL)]
    still = simulate(Scene(SHEET, WAVE, 0.05, effects=effects, cells=(1, 2)), 1, steps=16)
    with pytest.raises(ValueError, match="a scene without friction"):
        still.plot("friction")


def test_bad_arguments_are_named(theory):
    with pytest.raises(ValueError, match=r"what = 'shape': must be"):
        theory.plot("shape")
    with pytest.raises(ValueError, match=r"what = 'side': the sheet lies in the plane; must be one of"):
        theory.plot("side")
    with pytest.raises(ValueError, match=r"what = None: must be one of speed, sheet, .* if ax"):
        theory.plot(ax=axes())
    with pytest.raises((TypeError, ValueError), match=r"^ax"):
        theory.plot("speed", ax=3)
    with pytest.raises((TypeError, ValueError), match=r"^units"):
        theory.plot("speed", units="mm")
    with pytest.raises(ValueError, match=r"periods = 0"):
        theory.plot("path", periods=0)
    with pytest.raises(ValueError, match=r"length_factor"):
        Units("mm", "s", length_factor=0)


def test_the_import_alone_loads_numpy_and_no_other_large_package():
    code = (
        "import sys, linear_theory;"
        "large = {'scipy', 'sympy', 'mpmath', 'matplotlib', 'skfem', 'pandas'};"
        "sys.exit(' '.join(large & set(sys.modules)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_who_only_computes_loads_no_matplotlib():
    code = (
        "import sys; from linear_theory import Sheet, SineWave, crawl_speed;"
        "crawl_speed(Sheet(), SineWave(), 0.1, rtol=1e-2);"
        "sys.exit(' '.join({'matplotlib', 'fem_check', 'skfem'} & set(sys.modules)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
