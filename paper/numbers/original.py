"""Numbers about what the original paper chose: ground, bilayer, reaction (F5 to F7)."""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

from linear_theory.growth.bilayer import bilayer
from paper.numbers.number import SHEET, Number, Numbers

Array = NDArray[np.float64]


def ground() -> Numbers:
    """How far the original sheet sinks into its ground (F5, F13), and how its bilayer bends (F7)."""
    weight, stiffness = 2.5e-4, 0.5
    depth = math.sqrt(weight / stiffness)
    couplings = bilayer(0.2, SHEET.thickness)
    stiffness_of_plate = SHEET.thickness**3 / (12 * (1 - SHEET.poisson**2))
    return {
        "ground.depth": Number(depth, "sqrt(rho g/k), rho g = 2.5e-4, k = 0.5"),
        "ground.depth_h": Number(depth / SHEET.thickness, "the same over h = 0.03"),
        "ground.bending_length": Number(
            (stiffness_of_plate / weight) ** (1 / 3), "(D/(rho g))^(1/3), in L"
        ),
        "ground.bilayer": Number(
            couplings.curvature / couplings.alpha, "beta/alpha, bilayer(0.2, 0.03)"
        ),
    }


def reaction() -> Numbers:
    """Eq. 12 with the printed values (F6): bulk oscillation, and waves on a line of length L."""
    threshold, decay, rate, length = -0.01, 1e-4, 0.05, 0.02

    def source(c: Array, w: Array) -> Array:
        return np.stack([c * (1 - c) * (c - threshold) - w, rate * (c - decay * w)])

    bulk = solve_ivp(
        lambda t, z: source(*z), (0, 4000), [0.2, 0.0], rtol=1e-8, atol=1e-10, max_step=0.5
    )
    late = bulk.t > 3000
    c, t = bulk.y[0, late], bulk.t[late]
    rises = t[1:][(c[:-1] <= 0) & (c[1:] > 0)]
    y = np.linspace(0, 1, 101)  # the layer of width 0.02 is of the order of two steps

    def along(_: float, z: Array) -> Array:
        c, w = z.reshape(2, -1)
        ends = np.concatenate([[c[1]], c, [c[-2]]])  # no flux
        out = source(c, w)
        out[0] += length**2 * np.diff(ends, 2) / (y[1] - y[0]) ** 2
        return out.ravel()

    start, times = np.concatenate([y**2 / (1 + y**2), 0 * y]), np.arange(0.0, 3001.0)
    waves = solve_ivp(along, (0, 3000), start, "BDF", times, rtol=1e-5, atol=1e-8).y[: y.size]
    origin = "eq. 12 on a line, 101 points, from c = y^2/(1 + y^2), 0 <= y <= 1"
    return {
        "reaction.amplitude": Number(float(c.max()), "eq. 12 without diffusion, c after t = 3000"),
        "reaction.period": Number(float(np.diff(rises).mean()), "of the same"),
        "reaction.later": Number(float(waves[:, 100:].max()), f"{origin}, largest c after t = 100"),
        "reaction.spread": Number(
            float(np.ptp(waves[:, 2900:], axis=0).max()),
            f"{origin}, spread after t = 2900",
        ),
    }
