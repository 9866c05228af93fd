"""Scenes and results, made once, that show themselves in the tests of this folder."""

import tempfile
from functools import cache
from pathlib import Path

import numpy as np

import fem_check
import linear_theory
from fem_check.shell.cycle.shapes import cycle_of_shapes
from fem_check.shell.model import ShellModel

SHEET, SINE = linear_theory.Sheet(), linear_theory.SineWave()
MATERIAL = fem_check.Material(thickness=0.03, poisson=0.5)
MEMBRANE = fem_check.Membrane(MATERIAL)


def lopsided(x, y, t):
    """Growth that turns the sheet."""
    return (1 + 2 * x) * np.sin(2 * np.pi * (y - t))


@cache
def trajectory():
    effects = [MEMBRANE, fem_check.Gravity(3e-6), fem_check.Friction(1.0, slip_speed=0.005)]
    scene = fem_check.Scene(SHEET, SINE, alpha=0.1, effects=effects, cells=(1, 2))
    return fem_check.simulate(scene, periods=1, rtol=0.1)


def full_scene():
    """With every effect that a scene can name."""
    effects = [
        MEMBRANE,
        fem_check.Bending(MATERIAL),
        fem_check.Gravity(2.5e-4),
        fem_check.Ground(0.5, height=fem_check.Terrain(lambda x, y: 0.01 * np.cos(6 * x))),
        fem_check.Friction(0.7, slip_speed=0.01),
        fem_check.Inertia(1.0, MATERIAL),
        fem_check.DeadLoad((0.0, 0.0, 1e-9)),
    ]
    return fem_check.Scene(SHEET, SINE, alpha=0.1, curvature_coupling=10, effects=effects, cells=(2, 4))


@cache
def sunk():
    """Of one motion thrice, as if its ground gave no more."""
    contact = [fem_check.Gravity(2.5e-4), fem_check.Ground(0.5), fem_check.Friction(1.0, 0.001)]
    effects = [MEMBRANE, fem_check.Bending(MATERIAL), *contact]
    scene = fem_check.Scene(SHEET, SINE, alpha=0.02, effects=effects, cells=(1, 2))
    motion = fem_check.simulate(scene, periods=1, rtol=0.5)
    return fem_check.RigidGround((motion,) * 3, 0.1, 1.0)


def many_harmonics():
    return linear_theory.TravellingWave(np.linspace(1, 0.1, 40), np.zeros(40))


@cache
def turning():
    wave = linear_theory.FieldWave(lopsided, period=1.0)
    return linear_theory.crawl_speed(SHEET, wave, alpha=0.25, rtol=5e-2)


@cache
def speed():
    return linear_theory.crawl_speed(SHEET, SINE, alpha=0.25, rtol=1e-2)


def measured():
    y, t = np.linspace(-0.5, 0.5, 12), np.arange(10) / 10
    c = np.sin(2 * np.pi * (y[:, None] - t)) + 0.1 * np.cos(40 * y[:, None] * t)
    return linear_theory.SampledWave(y, t, c, period=1.0)


@cache
def field(kind):
    if kind == "AirySeries":
        return linear_theory.airy_series(SHEET, SINE, rtol=1e-3)
    if kind == "RitzField":
        return linear_theory.ritz_field(SHEET, SINE, rtol=1e-3)
    if kind == "PlaneStressField":
        return fem_check.plane_stress_field(SHEET, SINE, degree=2)
    return linear_theory.deformation.second.field.second_order_field(SHEET, SINE, rtol=1e-2)


def planar(**arguments):
    return fem_check.Scene(SHEET, SINE, alpha=0.1, effects=[MEMBRANE], **arguments)


@cache
def shapes():
    return cycle_of_shapes(planar(cells=(1, 2)), 8)


@cache
def swept():
    scene = linear_theory.Scene(SHEET, SINE, alpha=0.1)
    path = Path(tempfile.mkdtemp()) / "speeds.sqlite"
    return fem_check.sweep(
        scene, {"growth.alpha": [0.1, 0.2]}, path, level="strip", rtol=0.1, workers=1
    )


@cache
def optimum():
    scene = linear_theory.Scene(SHEET, SINE, alpha=0.1)
    return fem_check.optimise(
        scene,
        {"growth.alpha": (0.1, 0.2)},
        level="strip",
        starts=1,
        constraints={"power": fem_check.Bound(at_most=0.07)},
        robust=fem_check.Robust({"friction.law": ["dry", "viscous"]}),
    )


PARTS_OF_OPTIMUM = ("Certificate", "Check", "Limited", "Regime", "Scale", "Speed", "Start")


def part_of_optimum(name):
    found = optimum()
    parts = (found.certificate, found.check, found.objective, found.starts[0], found.scale)
    parts += (found.limits[0], found.regimes[0])
    return next(part for part in parts if type(part).__name__ == name)


def potential():
    model = ShellModel(planar(cells=(1, 2)))
    return model.potential(model.rest(0.1))


@cache
def excited():
    """A wave of two cycles."""
    found = fem_check.excitable_preset("nu = -0.1").on(SHEET, 150.0, 5e-2)
    assert found.cycles.count == 2
    return found


def excited_scene():
    return linear_theory.Scene(SHEET, excited(), alpha=0.1)


@cache
def excited_orbit():
    orbit = excited().periodic()
    assert orbit.uniform
    return orbit


def fed_back():
    """A wave that the strain acts back on."""
    equation = fem_check.excitable_preset("printed").but(feedback=fem_check.StrainFeedback(0.1))
    return equation.on(SHEET, 40.0, 0.1)


def scene_of_gradient():
    """Dry friction of a sine."""
    return linear_theory.Scene(SHEET, SINE, alpha=0.25)


def patches():
    return linear_theory.Patches([(-0.3, 0.3, -0.5, 0.0, 2.0)], edge=0.02)
