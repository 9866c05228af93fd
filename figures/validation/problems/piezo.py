"""Five piezo actuators in a row on a steel foil (Zheng et al., arXiv:2202.13521, 2111.00944)."""

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.rest_state import tensor_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.material import Material
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.ramp import ramp
from figures.validation.problems.laminate import Laminate, Layer
from figures.validation.problems.plates import frequencies
from figures.validation.problems.sheets import at, displacement, koiter, shell
from figures.validation.problems.strips import HeavyStrip, Shape

Array = NDArray[np.float64]

STEEL = Layer(50.8e-6, 190e9 / (1 - 0.27**2), 8100.0)
EPOXY = Layer(10e-6, 1.489e9, 1070.0)
PER_VOLT = 370e-12 * (1 + 0.31) / 0.5e-3
"""Expansion of the piezo per volt: d33, blocked sideways, over the pitch of the electrodes."""

PIEZO = Layer(300e-6, 30e9 / (1 - 0.31**2), 6600.0, PER_VOLT)

FOIL = Laminate((STEEL, EPOXY, PIEZO))
"""SI units."""

GRAVITY = 9.8
ACTUATOR, COUNT, WIDTH = 0.1, 5, 0.02
VOLTAGES = (520.0, 520.0, -1500.0, 520.0, 520.0)
"""Of the gait's poses."""

LENGTH = ACTUATOR * COUNT


def numbers() -> tuple[float, ...]:
    """Stiffness N m, weight Pa, curvature 1/cm per V, B/(q L^3), kappa L at 520 V and -1500 V, lowest
    frequency of one actuator as a cantilever, Hz, of a beam; its tip, cm, at 1500 V, of small slopes.
    """
    weight = FOIL.areal_density * GRAVITY
    per_volt = FOIL.curvature
    frequency = 3.5160 * np.sqrt(FOIL.stiffness / FOIL.areal_density) / ACTUATOR**2 / (2 * np.pi)
    return (
        FOIL.stiffness,
        weight,
        per_volt / 100,
        FOIL.stiffness / (weight * LENGTH**3),
        per_volt * LENGTH * 520,
        -per_volt * LENGTH * 1500,
        float(frequency),
        per_volt * 1500 * ACTUATOR**2 / 2 * 100,
    )


def as_strip() -> tuple[float, float]:
    """Thickness and modulus of a homogeneous strip with the stiffness of the foil, in units of the
    length of the robot and Pa: 0.36 mm, of any thickness that is thin."""
    thickness = 0.36e-3
    return thickness / LENGTH, 12 * FOIL.stiffness / thickness**3


def single(elements: int) -> tuple[float, float]:
    """One actuator as a cantilever: lowest frequency, Hz, and tip, cm, at 1500 V without weight.

    The shell with nu = 0, lengths in those of the actuator, stiffness 1.
    """
    thickness = 0.36e-3 / ACTUATOR
    material = Material(thickness, 0.0)
    sheet = shell("bfs", (0, 1, elements), (-0.1, 0.1, 1))
    lowest = frequencies(sheet, Supports(sheet).clamp(at(0, 0)), material, 1)[0]
    unit = np.sqrt(FOIL.stiffness / (FOIL.areal_density * material.bending)) / ACTUATOR**2
    bent = FOIL.curvature * 1500 * ACTUATOR

    def problem(share: float) -> Potential:
        rest = tensor_state(sheet.interior, [1, 1, 0], [share * bent, 0, 0])
        return Potential(sheet, koiter(material), rest)

    minimiser = Minimiser(Supports(sheet).clamp(at(0, 0)))
    curled = ramp(minimiser, problem, sheet.zeros(), first=0.25)
    tip = displacement(sheet, curled.state, (1, 0))[2]
    return float(lowest * unit / (2 * np.pi)), float(tip * ACTUATOR * 100)


def pose(voltages: tuple[float, ...], elements: int, stiffness: float) -> Shape:
    """Half of the robot on level ground under symmetric voltages, without friction; in its lengths.

    stiffness: of the ground, in units of the strip's modulus over its length squared.
    """
    thickness, modulus = as_strip()
    weight = FOIL.areal_density * GRAVITY / modulus
    strip = HeavyStrip(0.5, WIDTH / LENGTH, thickness, weight, stiffness)
    half = np.array(voltages[COUNT // 2 :])

    def rest(along: Array) -> Array:
        index = np.minimum(((along + 0.5 / COUNT) * COUNT).astype(int), COUNT // 2)
        return np.asarray(FOIL.curvature * LENGTH * half[index])

    return strip.lying(rest, elements, first=0.1)


def pose_heights(elements: int, stiffness: float) -> tuple[float, float]:
    """Height of the middle and of the ends above the ground, cm, at `VOLTAGES`."""
    shape = pose(VOLTAGES, elements, stiffness)
    lowest = float(shape.height.min())

    middle, end = float(shape.height[0]), float(shape.height[-1])
    return 100 * LENGTH * (middle - lowest), 100 * LENGTH * (end - lowest)
