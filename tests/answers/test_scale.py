"""V T/L does not depend on the unit of length or time, at any level.

A unit that is a power of two changes no digit of a number, so that every comparison inside a solver
comes out the same and all results must be equal bit by bit: an absolute tolerance anywhere shows. Other
units round the input, and results may differ by what that does.
"""

import math
from collections.abc import Callable
from functools import cache

import numpy as np
import pytest
import skfem

from fem_check import (
    Bending,
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
from fem_check.shell.cycle.shapes import cycle_of_shapes
from fem_check.shell.cycle.speed import other_mesh
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.places import distinct
from linear_theory import (
    CrawlSpeed,
    Directional,
    FieldWave,
    FrictionLaw,
    Mapped,
    Patches,
    Sheet,
    SineWave,
    Tanh,
    Viscous,
    crawl_speed,
    field_speed,
    friction_field,
    line_balance,
    line_cycle_speed,
    line_speed_tanh,
    rigid_path,
    ritz_field,
)

# --- problems in units of length and time ----------------------------------------------------------


def sheet(length: float, thickness: float = 0.03) -> Sheet:
    return Sheet(length, 0.5 * length, 0.5, thickness * length)


def lopsided(length: float, time: float) -> FieldWave:
    """Turns the sheet."""

    def value(x, y, t):
        return (1 + 2 * x / length) * np.sin(2 * np.pi * (y / length - t / time))

    return FieldWave(value, time)


def standing(length: float, time: float) -> FieldWave:
    """Grows and fades in place while a wave runs: no symmetry left."""

    def value(x, y, t):
        bump = np.exp(-((((y / length) - 0.1) / 0.3) ** 2))
        wave = 0.5 * np.sin(2 * np.pi * (y / length - t / time))
        return bump * np.sin(2 * np.pi * t / time) + wave + 0 * x

    return FieldWave(value, time)


def numbers(speed: CrawlSpeed, length: float, time: float) -> np.ndarray:
    """V_y, V_x, Omega L and the error of V_y, in L/T."""
    rigid = np.zeros(3) if speed.rigid_mean is None else speed.rigid_mean
    return np.array([speed.mean, rigid[0], rigid[2] * length, speed.error]) * (time / length)


def crawl(order: int, turning: bool, **law: object) -> Callable[[float, float], np.ndarray]:
    def solve(length: float, time: float) -> np.ndarray:
        wave = lopsided(length, time) if turning else SineWave(1, time)
        slip = {"slip_speed": 0.01 * length / time} if law else {}
        speed = crawl_speed(sheet(length), wave, 0.1, rtol=5e-2, order=order, **law, **slip)
        return numbers(speed, length, time)

    return solve


def under(law: Callable[[float, float], FrictionLaw]) -> Callable[[float, float], np.ndarray]:
    """The crawl of a lopsided wave under a law that is made for a unit of length and one of time."""

    def solve(length: float, time: float) -> np.ndarray:
        wave, own = lopsided(length, time), law(length, time)
        return numbers(crawl_speed(sheet(length), wave, 0.1, friction=own, rtol=5e-2), length, time)

    return solve


def patched(length: float, time: float) -> FrictionLaw:
    """Half as much friction on a patch, whose edges are lengths."""
    patch = (*(length * np.array([-0.1, 0.2, -0.3, 0.1])), 0.5)
    return Mapped(Tanh(0.05 * length / time), Patches([patch], edge=0.1 * length))


def scales(length: float, time: float) -> FrictionLaw:
    """Rough against the wave, with a slip speed."""
    return Directional(0.5, 1.5, form=Tanh(0.02 * length / time))


def outline(length: float, time: float) -> np.ndarray:
    shape = Outline(length * np.array([[-0.25, -0.5], [0.25, -0.5], [0, 0.5], [-0.25, 0.5]]))
    field = plane_stress_field(shape, SineWave(1, time), size=0.3 * length)
    return numbers(field_speed(field, 0.1, rtol=5e-2), length, time)


def friction(length: float, time: float) -> np.ndarray:
    field = ritz_field(sheet(length), lopsided(length, time), rtol=1e-2)
    found = friction_field(field, 0.1, np.array([0.1, -0.1]) * length, 0.0, 0.3 * time)
    return np.concatenate([found.force.ravel(), found.slip.ravel() * (time / length), [0.0]])


def path(length: float, time: float) -> np.ndarray:
    speed = crawl_speed(sheet(length), lopsided(length, time), 0.25, rtol=5e-2)
    found = rigid_path(speed, periods=3)
    error = max(found.step_error / length, found.turn_error)
    return np.array([*found.step / length, found.turn, error])


def line(length: float, time: float) -> np.ndarray:
    speed = line_balance(standing(length, time), 0.1, rtol=1e-2, length=length)
    return numbers(speed, length, time)


def predicted(level: str, wave: Callable[..., FieldWave] | None = None) -> Callable[..., np.ndarray]:
    def solve(length: float, time: float) -> np.ndarray:
        given = SineWave(1, time) if wave is None else wave(length, time)
        found = predict(sheet(length), given, 0.1, rtol=0.1, level=level)
        return numbers(found.speed, length, time)

    return solve


def cycle(
    turning: bool = False, mesh: bool = False, **options: object
) -> Callable[[float, float], np.ndarray]:
    def solve(length: float, time: float) -> np.ndarray:
        wave = lopsided(length, time) if turning else SineWave(1, time)
        grid = {"mesh": triangles(length)} if mesh else {"cells": (2, 3)}
        effects = [Membrane(Material(0.03 * length, 0.5))]
        scene = Scene(sheet(length), wave, 0.1, effects=effects, **grid)
        return numbers(cycle_speed(scene, rtol=0.1, **options), length, time)

    return solve


def on_slope(law: Callable[[float], FrictionLaw]) -> Callable[[float, float], np.ndarray]:
    """Under a law of a slip speed."""

    def solve(length: float, time: float) -> np.ndarray:
        effects = [
            Membrane(Material(0.03 * length, 0.5)),
            Gravity(3e-6, "current", incline=0.3),
            Friction(1.0, law=law(0.01 * length / time)),
        ]
        scene = Scene(sheet(length), SineWave(1, time), 0.1, effects=effects, cells=(1, 2))
        return numbers(cycle_speed(scene, rtol=0.1), length, time)

    return solve


def triangles(length: float) -> skfem.MeshTri:
    grid = skfem.MeshTri.init_tensor(np.linspace(-0.25, 0.25, 2), np.linspace(-0.5, 0.5, 3))
    return skfem.MeshTri(grid.p * length, grid.t)


def lying(length: float, time: float, **grid: object) -> Scene:
    """Bent on the ground."""
    material = Material(0.03 * length, 0.5)
    ground = [Gravity(2.5e-4), Ground(0.5 / length**2)]
    effects = [Membrane(material), Bending(material), *ground]
    return Scene(sheet(length), SineWave(1, time), 0.02, 2 / length, effects, **grid)


def on_ground(length: float, time: float) -> np.ndarray:
    return numbers(cycle_speed(lying(length, time, cells=(1, 2)), rtol=0.3), length, time)


def positions(scene: Scene) -> np.ndarray:
    """Of the vertices through a cycle, over the length of the sheet; no error is known."""
    shapes = cycle_of_shapes(scene, 4)
    corners = shapes.discretisation.points(shapes.discretisation.mesh.p)
    places = [corners.position(state, (0,)).ravel() for state in shapes.states]
    return np.append(np.concatenate(places) / scene.sheet.length, 0.0)


def on_ground_triangles(length: float, time: float) -> np.ndarray:
    return positions(lying(length, time, mesh=triangles(length)))


def buckling(length: float, time: float) -> np.ndarray:
    """A thin sheet that leaves the plane, to a side that its lowest mode says."""
    material = Material(0.01 * length, 0.5)
    effects = [Membrane(material), Bending(material)]
    wave, curved = SineWave(1, time), 0.5 / length
    return positions(Scene(sheet(length, 0.01), wave, 0.05, curved, effects=effects, cells=(2, 4)))


def stepped(kind: str) -> Callable[[float, float], np.ndarray]:
    """A few steps: planar, with inertia, or bent on ground that damps."""

    def solve(length: float, time: float) -> np.ndarray:
        material, slip = Material(0.03 * length, 0.5), 5e-3 * length / time
        effects = [Membrane(material), Gravity(3e-6), Friction(1.0, slip)]
        alpha, bending = 0.1, 0.0
        if kind == "inertia":
            effects += [Inertia(1e-3 * (time / length) ** 2, material)]
        if kind == "bending":
            ground = Ground(0.5 / length**2, 0.01 * time / length)
            effects = [effects[0], Bending(material), Gravity(2.5e-4), ground, Friction(1.0, 4 * slip)]
            alpha, bending = 0.05, 0.5 / length
        scene = Scene(sheet(length), SineWave(1, time), alpha, bending, effects, cells=(1, 2))
        return numbers(simulate(scene, 1, steps=6, ramp=0.25).speed, length, time)

    return solve


PROBLEMS = {
    "crawl": crawl(1, False),
    "crawl, tanh": crawl(1, False, friction="tanh"),
    "crawl, second order": crawl(2, False),
    "crawl, turning": crawl(1, True),
    "crawl, turning, tanh": crawl(1, True, friction="tanh"),
    "crawl, turning, second order": crawl(2, True),
    "crawl, viscous": under(lambda length, time: Viscous(length / time)),
    "crawl, directional": under(scales),
    "crawl, patches": under(patched),
    "outline": outline,
    "friction": friction,
    "path": path,
    "line": line,
    "predict, auto": predicted("auto"),
    "predict, strip": predicted("strip"),
    "predict, strip, standing": predicted("strip", standing),
    "predict, first order": predicted("first order"),
    "predict, second order": predicted("second order"),
    "predict, cycle": predicted("cycle"),
    "cycle": cycle(),
    "cycle, turning": cycle(turning=True),
    "cycle, triangles": cycle(mesh=True, load="material"),
    "cycle on a slope": on_slope(Tanh),
    "cycle on a slope, viscous": on_slope(Viscous),
    "cycle on ground": on_ground,
    "shapes on ground, triangles": on_ground_triangles,
    "shapes, buckling": buckling,
    "stepped": stepped("planar"),
    "stepped, inertia": stepped("inertia"),
    "stepped, bending": stepped("bending"),
}


@cache
def in_units_of_one(name: str) -> np.ndarray:
    return PROBLEMS[name](1.0, 1.0)


@pytest.mark.parametrize("name", PROBLEMS)
@pytest.mark.parametrize(("length", "time"), [(2.0**-30, 2.0**20), (2.0**90, 2.0**-70)])
def test_a_unit_that_is_a_power_of_two_changes_no_digit(name, length, time):
    assert np.array_equal(PROBLEMS[name](length, time), in_units_of_one(name))


ROUNDING = {
    # minimisations stop where a correction is below 1e-8 of the sheet, and V is 0.02 L/T
    "stepped": 1e-5,
    "stepped, inertia": 1e-5,
    "stepped, bending": 1e-5,
}
TIES = {"cycle, turning", "path"}
"""The wave is alike half a period later, and rounding tells which of two equal errors is larger."""


@pytest.mark.parametrize("name", PROBLEMS)
def test_any_unit_changes_roundoff_only(name):
    found, here = PROBLEMS[name](1e-9, 1e-6), in_units_of_one(name)
    change = abs(found[:-1] - here[:-1]).max()  # the error, last, is an estimate
    if name in TIES:
        assert change <= 0.01 * here[-1]
    else:
        assert change <= ROUNDING.get(name, 1e-9) * abs(here[:-1]).max()


@pytest.mark.parametrize(
    ("length", "time"), [(1e-6, 1.0), (1e-3, 1e6), (1e3, 1e-6), (1e6, 1.0), (1e9, 1e6)]
)
@pytest.mark.parametrize("name", ["crawl", "crawl, turning", "outline", "line", "predict, strip"])
def test_quick_answers_in_all_units(name, length, time):
    here = in_units_of_one(name)
    assert PROBLEMS[name](length, time)[:-1] == pytest.approx(here[:-1], rel=1e-9, abs=1e-11)


# --- the length of a line ---------------------------------------------------------------------------


def running(length: float) -> FieldWave:
    """One wave on that length."""
    return FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y / length - t)) + 0 * x, 1.0)


def test_a_strip_is_as_long_as_its_sheet():
    exact = 0.5 * float(line_cycle_speed(0.1, body="strip"))
    found = predict(Sheet(0.5, 0.05), running(0.5), 0.1, level="strip").speed
    assert found.error <= 1e-2 * exact
    assert abs(found.mean - exact) <= found.error
    assert predict(Sheet(0.5, 0.05), SineWave(), 0.1, level="strip").mean == pytest.approx(
        exact, rel=1e-12
    )


@pytest.mark.parametrize("count", [1, 2, 3])
def test_a_wave_in_millimetres_on_longer_bodies(count):
    exact = 20 * float(line_cycle_speed(0.2, growth_law="linear"))  # mm/s, whatever the count
    found = line_balance(running(20.0), 0.2, rtol=1e-2, length=20.0 * count)
    assert found.converged
    assert abs(found.mean - exact) <= found.error
    profile = line_balance(SineWave(count), 0.2, length=20.0 * count)
    assert profile.mean == pytest.approx(exact, rel=1e-12)
    assert profile.second_order == pytest.approx(20.0, rel=1e-12)  # alpha^2 L/(nT)


def test_slip_speeds_and_tolerances_are_in_the_unit_of_the_length():
    slip = 0.3  # mm/s
    exact = 20 * float(line_speed_tanh(0.25, slip_speed=slip / 20))
    found = line_balance(running(20.0), 0.25, friction="tanh", slip_speed=slip, atol=5e-3, length=20.0)
    assert abs(found.mean - exact) <= found.error <= 5e-3
    assert found.converged
    profile = line_balance(SineWave(), 0.25, friction="tanh", slip_speed=slip, length=20.0)
    assert profile.mean == pytest.approx(exact, rel=1e-10)
    assert found.slip_ratio == pytest.approx(profile.slip_ratio, rel=1e-3)
    assert "tanh(v/0.3)" in profile.model


# --- what counts as the same ------------------------------------------------------------------------


def test_materials_of_thin_sheets_are_told_apart():
    thin = Sheet(1e-6, 5e-7, 0.0, thickness=3e-9)
    for thickness in (9e-9, 3.1e-9):
        with pytest.raises(ValueError, match=r"thickness = .*must be 3e-09"):
            Scene(thin, SineWave(), 0.1, effects=[Membrane(Material(thickness, 0.0))])
    rounded = Material(3e-9 * (1 + 1e-15), 0.1 + 0.2 - 0.3)
    assert Scene(thin, SineWave(), 0.1, effects=[Membrane(rounded)]).planar


@pytest.mark.parametrize("size", [1e-12, 1.0, 1e12])
def test_places_are_the_same_by_a_share_of_their_extent(size):
    edge = 1 / 2**13  # its 13 decimals end in 5: rounding to 12 splits what differs by roundoff
    values = size * np.array([1.0, edge, 0.0, math.nextafter(edge, 1), math.nextafter(edge, 0), 1e-8])
    lines, which = distinct(values)
    assert which.tolist() == [3, 2, 0, 2, 2, 1]
    assert lines == pytest.approx(size * np.array([0.0, 1e-8, edge, 1.0]), rel=1e-15)


@pytest.mark.parametrize("size", [1e-12, 3e-9, 1.0, 1e9])
def test_a_coarser_grid_is_found_at_any_size(size):
    grid = skfem.MeshQuad.init_tensor(
        size * np.linspace(-0.25, 0.25, 5), size * np.linspace(-0.5, 0.5, 9)
    )
    coarse, gain = other_mesh(grid)
    assert (coarse.nelements, gain) == (2 * 4, 3.0)
    assert np.ptp(coarse.p, axis=1) == pytest.approx([0.5 * size, size], rel=1e-12)


@pytest.mark.parametrize("size", [1e-9, 1e-3, 1.0, 1e9, 2.0**30])
@pytest.mark.parametrize("kind", ["rectangles", "triangles"])
def test_elements_with_slopes_contain_quadratics_at_any_size(kind, size):
    """x^2 + 2 x y over the size, from the values and derivatives at the vertices."""
    mesh, element = triangles(size), skfem.ElementTriArgyris()
    if kind == "rectangles":
        mesh = skfem.MeshQuad.init_tensor(*(size * np.linspace(-s, s, 4) for s in (0.25, 0.5)))
        element = skfem.ElementQuadBFS()
    sheet = Discretisation(mesh, element)

    def jets(x, y):
        zero = np.zeros((3, x.size))
        rows = ((x + 2 * y) * x, 2 * (x + y), 2 * x, 2 + 0 * x, 0 * x, 2 + 0 * x)
        return np.stack([zero + row / size for row in rows])

    region = sheet.interior
    found = region.displacement(sheet.interpolate(jets), tuple(range(6)))
    exact = jets(*region.parameters.reshape(2, -1))
    units = size ** np.array([1, 0, 0, -1, -1, -1])
    assert (abs(found - exact).max((1, 2)) / units).max() < 1e-11
