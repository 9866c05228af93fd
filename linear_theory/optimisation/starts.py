"""Points to start from: a Sobol sequence, scrambled by a seed, brought into the region."""

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.optimisation.problem import Region

Array = NDArray[np.float64]


def starts(region: Region, count: int, seed: int, given: Array | None = None) -> list[Array]:
    """That many points inside; the first is `given`, if there is one, brought inside.

    The same ones for the same seed. Raises ValueError for less than one start.

    >>> import numpy as np
    >>> from linear_theory.optimisation.problem import Region
    >>> from linear_theory.optimisation.starts import starts
    >>> square = Region(np.zeros(2), np.ones(2), centre=np.full(2, 0.5), spread=np.full(2, 0.5))
    >>> print(len(starts(square, 3, seed=1)), all(square.excess(p) <= 0 for p in starts(square, 3, 1)))
    3 True
    """
    from scipy.stats import qmc  # half a second, for those who need it

    count = validation.integer("starts", count, 1)
    drawn = count if given is None else count - 1
    found = [] if given is None else [region.towards_centre(given)]
    if drawn:
        sequence = qmc.Sobol(region.unknowns, seed=validation.integer("seed", seed, 0))
        shares = sequence.random_base2(max(drawn - 1, 0).bit_length())[:drawn]
        found += [
            region.towards_centre(np.clip(point, region.low, region.high))
            for point in region.centre + (2 * shares - 1) * region.spread
        ]
    return found
