"""Outlines with parameters: their gradients against differences, the best of them against scans."""

import numpy as np
import pytest

from fem_check.mesh.outline import Outline
from fem_check.outlines.best import best_outline
from fem_check.outlines.field import Cells, Setting
from fem_check.outlines.gradient import Problem as OutlineProblem
from fem_check.outlines.gradient import _Frozen, outline_gradient
from fem_check.outlines.shapes import LegendreShape, Trapezoid
from fem_check.plane_stress.field import plane_stress_field
from linear_theory import (
    Contact,
    Coulomb,
    Directional,
    FieldWave,
    GivenMap,
    Mapped,
    SineWave,
    Tanh,
    TravellingWave,
    field_speed,
)
from linear_theory.balance.crawl import Crawl, Resolution

PULSE = TravellingWave(np.array([1.0, 0.2]), np.array([0.0, 0.3]))
TRAPEZOID = Trapezoid(rear=0.6, front=0.35, length=1.1)
CURVED = LegendreShape(0.5, 1.0, [0.3, -0.2])
VISCOUS, TANH = Contact(friction="viscous"), Contact("grown", Tanh(0.02))
COARSE = Cells(1, 2)


def test_an_outline_is_its_polygon_and_its_mesh_covers_it():
    lens = LegendreShape(0.4, 1.2, [0.2, -0.3, 0.1])
    for shape in (lens, TRAPEZOID):
        mesh, outline = shape.mesh(2, 1), shape.outline()
        (a, b), (c, d) = (mesh.p[:, mesh.t[i]] - mesh.p[:, mesh.t[0]] for i in (1, 2))
        twice = abs(a * d - b * c)
        assert (twice > 0).all()
        assert twice.sum() / 2 == pytest.approx(outline.area, rel=1e-12)
        assert shape.area == pytest.approx(outline.area, rel=1e-12)
    assert lens.area == pytest.approx(0.4 * 1.2, rel=1e-12)
    same = Outline.trapezoid(0.6, 0.35, 1.1)
    assert TRAPEZOID.outline().area == pytest.approx(same.area, rel=1e-12)


@pytest.mark.parametrize("friction", ["viscous", "coulomb"])
def test_half_of_an_outline_moves_as_the_whole(friction):
    """The half that is balanced over a whole period, against all of it with three unknowns."""
    whole = plane_stress_field(TRAPEZOID.outline(), PULSE, size=0.2)
    other = field_speed(whole, 0.1, friction=friction, rtol=3e-3)
    contact = Contact(friction=friction)
    found = outline_gradient(TRAPEZOID, PULSE, 0.1, ["rear"], contact, rtol=3e-3, cells=COARSE).speed
    assert abs(found.mean - other.mean) <= found.error + other.error
    assert abs(found.mean - other.mean) <= 3e-3 * abs(other.mean)


def frozen(shape, wave, contact, times):
    """A crawl on a grid of cells that are not halved, and its exact motion."""
    problem = OutlineProblem.of(shape, wave, 0.15, contact, 0.4, COARSE)
    resolution = Resolution(4.0, 5, 0, 1e-12)
    crawl = Crawl(problem.field(), 0.15, problem.contact, resolution)
    return problem, crawl, crawl.balance(times)


@pytest.mark.parametrize(
    ("shape", "contact", "names"),
    [
        (TRAPEZOID, VISCOUS, ["rear", "front", "length"]),
        (CURVED, TANH, ["length", "coefficients.1"]),
    ],
    ids=["straight, viscous", "curved, tanh"],
)
def test_gradient_on_a_frozen_grid(shape, contact, names):
    """Against differences of motions of other outlines, each solved anew, by the same cells."""
    times = np.array([0.11, 0.37, 0.83])
    problem, crawl, motion = frozen(shape, PULSE, contact, times)
    pairs = [problem.beside(name) for name in names]
    found, flat = _Frozen(crawl, problem.setting, pairs).derivatives(times, motion)
    assert not flat
    for name, row in zip(names, found, strict=True):
        value, step, ends = shape.parameters[name], 3e-4, []
        for sign in (1, -1):
            other = frozen(shape.changed(name, value + sign * step), PULSE, contact, times)[2]
            ends.append((other.leading + 0.15 * other.remainder)[:, 1])
        slope = (ends[0] - ends[1]) / (2 * step)
        assert row == pytest.approx(slope, rel=1e-6, abs=1e-6 * abs(found).max())


def test_gradient_of_dry_friction_is_within_its_error_of_a_difference():
    """Cells and times of the two other speeds are their own."""
    shape, name, step = LegendreShape(0.5, 1.0, [0.2, -0.15, 0.1]), "coefficients.1", 1e-2
    options = {"over": [name], "contact": Contact(), "rtol": 2e-3}
    found = outline_gradient(shape, SineWave(), 0.2, **options)
    ends = [
        outline_gradient(shape.changed(name, -0.15 + k * step), SineWave(), 0.2, **options).speed.mean
        for k in (1, -1)
    ]
    slope = (ends[0] - ends[1]) / (2 * step)
    rounding = 2 * step**2 * found.speed.mean  # of the difference, and of its cells
    assert abs(found[name] - slope) <= found.errors[0] + rounding
    assert found.errors[0] + rounding <= 0.05 * abs(slope)


def test_best_trapezoid_is_the_top_of_a_scan():
    """Of trapezoids of one area and length. A sine turned about t and y is itself: V(-a) = V(a)."""
    contact, over = Contact(friction=Tanh(0.05)), {"coefficients.0": (-0.6, 0.6)}

    def at(a):
        shape = LegendreShape(0.5, 1.0, [a])
        return outline_gradient(shape, SineWave(), 0.1, list(over), contact, rtol=1e-2)

    start = LegendreShape(0.5, 1.0, [0.35])
    best = best_outline(start, SineWave(), 0.1, over, contact, rtol=1e-2)
    scan = {a: at(a) for a in (-0.35, 0.0)}
    turned = scan[-0.35].speed
    assert abs(turned.mean - best.start.value) <= turned.error + best.start.error
    assert abs(scan[0.0].values[0]) <= scan[0.0].errors[0]
    top = max(one.speed.mean for one in scan.values())
    assert best.converged, best
    assert best.speed.value >= top - best.speed.error
    assert abs(best.shape.coefficients[0]) <= 0.05
    assert best.gain > 1


def test_bad_input_is_refused_by_name():
    wave, contact = SineWave(), VISCOUS
    with pytest.raises(ValueError, match="alpha = 0"):
        outline_gradient(TRAPEZOID, wave, 0.0)
    with pytest.raises(ValueError, match="over = 'width'"):
        outline_gradient(TRAPEZOID, wave, 0.1, ["width"])
    with pytest.raises(ValueError, match="named twice"):
        outline_gradient(TRAPEZOID, wave, 0.1, ["rear", "rear"])
    with pytest.raises(ValueError, match="over = \\[\\]"):
        outline_gradient(TRAPEZOID, wave, 0.1, [])
    oblique = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (x + y - t)), 1.0)
    with pytest.raises(ValueError, match="not to depend on x"):
        outline_gradient(TRAPEZOID, oblique, 0.1)
    mapped = Mapped(Coulomb(), GivenMap(lambda x, y: 1 + y**2, mirrored=True))
    turned = Directional(0.5, 1.5, heading=0.3, form=Coulomb())
    for law in (mapped, turned):
        with pytest.raises(ValueError, match=r"contact = .*must be level"):
            outline_gradient(TRAPEZOID, wave, 0.1, contact=Contact(friction=law))
    with pytest.raises(ValueError, match="rear = -1"):
        Trapezoid(-1.0, 0.3, 1.0)
    with pytest.raises(ValueError, match=r"width = .* at y = .*must be >"):
        LegendreShape(0.5, 1.0, [1.2])
    for over, words in (
        ({}, "over"),
        ({"rear": (0.7, 0.8)}, "shape: rear"),
        ({"rear": (0.8, 0.3)}, "low < high"),
        ({"slope": (0, 1)}, "over = 'slope'"),
    ):
        with pytest.raises(ValueError, match=words):
            best_outline(TRAPEZOID, wave, 0.1, over, contact)
    with pytest.raises(ValueError, match="towards = 0"):
        best_outline(TRAPEZOID, wave, 0.1, {"rear": (0.3, 0.8)}, contact, towards=0)
    assert Setting(wave, 0.5, COARSE).field(TRAPEZOID).mirrored
