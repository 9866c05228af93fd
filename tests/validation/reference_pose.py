"""The piezo robot's pose by collocation: a heavy elastica in pieces of different natural curvature.

Half of it, from the middle: B (theta' - kappa)' = Q cos(theta), Q' = r - q, z' = sin(theta), with
r = k z^2 where z < 0. Two pieces, kappa_1 up to a tenth of the length and kappa_2 beyond, each mapped
to [0, 1]: bending moment, slope, force and height are continuous between them.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_bvp

Array = NDArray[np.float64]

JOINT, HALF = 0.1, 0.5


def heights(inner: float, outer: float, ratio: float, ground: float) -> tuple[float, float]:
    """Height of the middle and of the end above the lowest point, for the length 1.

    inner, outer: natural curvatures; ratio: B/q; ground: k/q.
    """
    lengths, depth = np.array([JOINT, HALF - JOINT]), 1 / np.sqrt(ground)

    def pieces(
        stiffness: float, curved: float, guess: Array, place: Array, tolerance: float = 1e-2
    ) -> tuple[Array, Array]:
        def rates(_: Array, state: Array) -> Array:
            out = []
            for k, length in enumerate(lengths):
                angle, moment, force, height = state[4 * k : 4 * k + 4]
                natural = curved * (inner, outer)[k]
                reaction = stiffness * np.minimum(height, 0) ** 2
                slope = (moment / ratio + natural, force * np.cos(angle), reaction - 1, np.sin(angle))
                out += [length * s for s in slope]
            return np.array(out)

        def ends(a: Array, b: Array) -> Array:
            return np.array([a[0], a[2], *(a[4:8] - b[0:4]), b[5], b[6]])

        found = solve_bvp(rates, ends, place, guess, tol=tolerance, max_nodes=60000)
        assert found.success, found.message
        return found.x, found.y

    place = np.linspace(0, 1, 201)
    guess = np.zeros((8, place.size))
    guess[[3, 7]] = -1 / np.sqrt(ground / 4096)
    for share in (0.3, 0.6, 1.0):  # first the curvature on a soft ground
        place, guess = pieces(ground / 4096, share, guess, place)
    for soft, tolerance in ((256, 1e-2), (16, 1e-2), (1, 1e-5)):
        place, guess = pieces(ground / soft, 1.0, guess, place, tolerance)
    lowest = min(guess[3].min(), guess[7].min())
    assert -20 * depth < lowest < 0
    return float(guess[3, 0] - lowest), float(guess[7, -1] - lowest)
