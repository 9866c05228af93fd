"""Sheets and strips on the ground."""

import warnings
from collections.abc import Sequence

import numpy as np

from fem_check import simulate
from figures.validation.comparison import (
    SCENES,
    ByRefinement,
    Closed,
    Comparison,
    Confirmed,
    Number,
    Source,
)
from figures.validation.problems.gait import centimetres_per_period
from figures.validation.problems.piezo import numbers, pose_heights, single
from figures.validation.problems.strips import end_forces, free_lengths, greenhill, rises
from figures.validation.sources import ZHENG
from linear_theory import FieldWave, Scene, Sheet
from linear_theory.common.errors import ViscousRegimeWarning
from linear_theory.deformation.plate import Foundation, plate_field

HEAVY = Source(
    "First integral of the heavy elastica; its equation: C. Y. Wang, Int. J. Mech. Sci. 28:549 (1986)",
    Confirmed.DERIVED,
    "by an own collocation solution, too; Wang's review was not read",
)


def hetenyi(length: float) -> tuple[float]:
    """Deflection of the end over kappa (B/s)^(1/2) of a strip on an elastic foundation."""
    thickness, weight, stiffness = 0.03, 2.5e-4, 5e3
    bending = thickness**3 / 12
    uniform = FieldWave(lambda x, y, t: np.cos(2 * np.pi * t) + 0 * x + 0 * y, period=1.0)
    sheet = Sheet(length=length, width=0.002, poisson=0.0, thickness=thickness)
    field = plate_field(sheet, uniform, Foundation(bending, weight, stiffness), rtol=1e-6)
    # W/12^(1/2) off the middle line is the mean over the width of the strip, bent both ways
    end = field.deflection(sheet.width / 12**0.5, np.array([length / 2]), 0.5)

    foundation = 2 * np.sqrt(weight * stiffness)
    return (float(end[0] / np.sqrt(bending / foundation)),)


def incline(steps: int) -> Sequence[float]:
    """V over the slip speed of the block in the scene file."""
    scene = Scene.from_toml(SCENES / "block_on_incline.toml")
    slip = 1e-3

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ViscousRegimeWarning)
        return [simulate(scene, periods=2, steps=steps).speed.mean / slip]


SIMULATED = (
    "here V is a distance per period of 1 s, without inertia. The simulator of zhiwuz/sfers itself "
    "(five hinges, PyBullet 3.2.7, time step 8.3e-6 s) makes, at a period of 1 s, 0.025 cm in one "
    "with this friction, in this direction, and 0.07 cm in the other one with its own friction, 2.5; "
    "at 5 to 15 Hz, where inertia acts, its single periods scatter from -8 to 5 cm/s, and 1 cm/s lies "
    "among them"
)

COMPARISONS = (
    Comparison(
        "heavy elastica on a table: height",
        "a strip with natural curvature kappa_0 lies by its weight, ends lifted: B kappa_0^2/(2 q)",
        HEAVY,
        (
            Number("tip height, kappa_0 = 1", 0.0045, 5e-6),
            Number("tip height, kappa_0 = 4", 0.0720, 5e-5),
        ),
        ByRefinement(
            rises,
            {"stiffness": 8e6, "elements": 40},
            {"stiffness": 5e5, "elements": 20},
            {"curvatures": (1.0, 4.0)},
        ),
    ),
    Comparison(
        "heavy elastica on a table: length",
        "its length off the ground, (2 B kappa_0/q)^(1/2) for small slopes",
        HEAVY,
        (
            Number(
                "kappa_0 = 1",
                0.018**0.5,
                1e-15,
            ),
            Number(
                "kappa_0 = 4",
                0.072**0.5,
                1e-15,
                why="the formula is of small slopes; at slopes of 2/3 the exact length is 1.2 % larger "
                "by collocation, too",
            ),
        ),
        ByRefinement(
            free_lengths,
            {"softest": 8e6, "elements": 100},
            {"softest": 5e5, "elements": 40},
            {"curvatures": (1.0, 4.0)},
        ),
    ),
    Comparison(
        "heavy elastica on a table: force",
        "the point force where the ground lets go, over q times the length off the ground",
        HEAVY,
        (Number("force/(q l), kappa_0 = 4", 1.0, 1e-15),),
        ByRefinement(
            end_forces,
            {"stiffness": 1.28e8, "elements": 80},
            {"stiffness": 5e5, "elements": 40},
            {"curvatures": (4.0,)},
        ),
    ),
    Comparison(
        "heavy elastica, a wide sheet",
        "the same with D and (1 + nu) kappa_0 in place of B and kappa_0, nu = 0.3",
        HEAVY,
        tuple(
            Number(f"tip height, kappa_0 = {k:g}", 2.25e-6 / 0.91 * (1.3 * k) ** 2 / 5e-4, 1e-15)
            for k in (1.0, 3.0)
        ),
        ByRefinement(
            rises,
            {"stiffness": 8e6, "elements": 40},
            {"stiffness": 5e5, "elements": 20},
            {"curvatures": (1.0, 3.0), "poisson": 0.3, "wide": True},
        ),
    ),
    Comparison(
        "beam on an elastic foundation",
        "half-infinite beam, moment B kappa at its end: 2 lambda^2 B kappa/s = kappa (B/s)^(1/2)",
        Source(
            "M. Hetenyi, Beams on Elastic Foundation, University of Michigan Press (1946)",
            Confirmed.DERIVED,
        ),
        (Number("deflection of the end over kappa (B/s)^(1/2)", 1.0, 1e-15),),
        ByRefinement(hetenyi, {"length": 1.0}, {"length": 0.6}),
    ),
    Comparison(
        "column under its own weight",
        "weight at which a column that is clamped at its foot buckles",
        Source(
            "A. G. Greenhill, Proc. Camb. Phil. Soc. 4:65 (1881)",
            Confirmed.DERIVED,
            "Bessel zero 1.8663",
        ),
        (Number("q L^3/B = (9/4) 1.8663^2", 7.837347, 5e-7),),
        ByRefinement(greenhill, {"elements": 16}, {"elements": 6}),
    ),
    Comparison(
        "block on an incline",
        "tan(incline) = 0.3 mu, tanh law: V = -v0 artanh(tan(incline)/mu)",
        Source("Closed form of the balance", Confirmed.DERIVED),
        (Number("V/v0", -float(np.arctanh(0.3)), 1e-9),),
        ByRefinement(incline, {"steps": 40}, {"steps": 20}),
        scene="block_on_incline.toml",
    ),
    Comparison(
        "piezo foil: numbers",
        "five actuators on a steel foil: the laminate as a plate",
        Source(ZHENG, Confirmed.READ),
        (
            Number("bending stiffness per width, N m", 0.252, 5e-4),
            Number("weight, Pa", 23.5, 0.05),
            Number("curvature, 1/cm per V", 3.63e-5, 5e-8),
            Number("B/(q L^3)", 0.0856, 5e-5),
            Number("kappa L, 520 V", 0.94, 5e-3),
            Number("kappa L, 1500 V", -2.72, 5e-3),
            Number("one as cantilever, Hz", 18.1, 0.05),
            Number("its tip at 1500 V, cm", 2.72, 5e-3),
        ),
        Closed(numbers),
    ),
    Comparison(
        "piezo foil: pose",
        "the robot at 520, 520, -1500, 520, 520 V on a ground into which it sinks 0.01 mm, no friction",
        Source(
            "An own collocation solution of the heavy elastica with the voltages of zhiwuz/sfers",
            Confirmed.DERIVED,
            "the papers show their shapes in figures, without numbers",
        ),
        (
            Number("height of the middle, cm", 1.753159, 1e-5),
            Number("height of the ends, cm", 0.693188, 1e-5),
        ),
        ByRefinement(
            pose_heights,
            {"elements": 80},
            {"elements": 40},
            {"stiffness": 0.5},
        ),
    ),
    Comparison(
        "piezo foil: inchworm gait",
        "the five voltages switched in quarters of the period as in zhiwuz/sfers, without inertia, "
        "at a period of 1 s",
        Source(
            ZHENG,
            Confirmed.READ,
            "speed about 1 cm/s; friction coefficient 0.3 here, 2.5 there",
        ),
        (Number("V, cm/s", 1.0, 0.5, why=SIMULATED),),
        ByRefinement(
            centimetres_per_period,
            {"steps": 96, "cells": 40},
            {"steps": 48, "cells": 20},
        ),
        scene="piezo_inchworm.toml",
        slow=True,
    ),
    Comparison(
        "piezo foil: one actuator",
        "one actuator as a cantilever, of the shell",
        Source(ZHENG, Confirmed.READ),
        (
            Number("lowest frequency, Hz", 18.1, 0.05),
            Number(
                "tip at 1500 V, cm",
                2.72,
                5e-3,
                why="there kappa L^2/2, of small slopes; the tip of an arc of a circle is at "
                "(1 - cos(kappa L))/kappa = 2.66 cm",
            ),
        ),
        ByRefinement(single, {"elements": 12}, {"elements": 6}),
    ),
)
