"""The best wave of given size on dry ground: a supremum, and what N harmonics can reach of it.

For small strain V = (alpha/nT) (median c - mean c) L + O(alpha^2) (see `line.balance`). Of all waves
with |c| <= 1 the supremum of median c - mean c is 1, and none has it:

* Let m be a median: c >= m on a share of at least 1/2, c >= -1 elsewhere. Then mean c >= (m - 1)/2, and
  m - mean c <= (m + 1)/2 <= 1.
* c = 1 on a share 1/2 + d of the period and -1 on the rest has the median 1 and the mean 2 d: 1 - 2 d,
  which tends to 1 as d -> 0.
* Equality needs c = 1 on one half of the period and -1 on the other. Then every number in [-1, 1] is a
  median: the body sticks for a range of forces, and the regularised law selects V = 0. No wave has 1.

Under such a wave a little more than half of the body is fully stretched and stands still, as an anchor,
while the rest is short and slides at 2 alpha L/(nT): dry friction does not ask how fast.

With harmonics up to N, c is a trigonometric polynomial and the best value is a maximum, less than 1:

    median c - mean c <= K/(K + 1),   K = floor(N/2).

Proof. q = (c + 1)/2 is in [0, 1] and at least u = (m + 1)/2 on the closed set A = {c >= m}, of measure
1/2 or more: some arcs. The mean of q is its mean over the M + 1 points x + 2 pi j/(M + 1), for every M
>= N and every x. Take M odd, N or N + 1. The number of these points in A has the mean (M + 1)/2 or more
over x; and where one of them enters an arc as another leaves one, both ends count. So for some x at
least (M + 1)/2 + 1 points lie in A, mean q >= u (1/2 + 1/(M + 1)), and

    median c - mean c = 2 (u - mean q) <= 2 u (1/2 - 1/(M + 1)) <= 1 - 2/(M + 1) = K/(K + 1).

For N = 1, a sine, this is 0, the truth. It is the argument by which Selberg's polynomials are the best
majorants of an arc (H. L. Montgomery, Ten Lectures, AMS 1994, chapter 1). What is reached lies below
it: 0.4446, 0.638, 0.769, 0.867, 0.926 for N = 2, 5, 10, 20, 40 against 1/2, 2/3, 5/6, 10/11, 20/21.
"""

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

SUPREMUM = 1.0
"""Of (median c - mean c)/max |c|, and of nTV/(alpha L) as alpha -> 0."""


def dry_bound(harmonics: int) -> float:
    """Upper bound of (median c - mean c)/max |c| for waves of that many harmonics.

    Raises ValueError for less than one harmonic.

    >>> from linear_theory.line.best.dry import dry_bound
    >>> print(*(round(dry_bound(n), 3) for n in (1, 2, 5, 10, 20, 40)))
    0.0 0.5 0.667 0.833 0.909 0.952
    """
    half = validation.integer("harmonics", harmonics, 1) // 2
    return half / (half + 1)


def nearly_square(harmonics: int, excess: float) -> TravellingWave:
    """The wave that is 1 on a share 1/2 + excess and -1 elsewhere, smoothed so that |c| <= 1.

    The mean of partial sums up to that many harmonics (Fejer), which never leaves the range of the
    wave. excess: > 0 and below 1/2. Raises ValueError for others.

    >>> from linear_theory import line_balance
    >>> from linear_theory.line.best.dry import nearly_square
    >>> for harmonics, excess in ((10, 0.1), (1000, 0.01)):
    ...     found = line_balance(nearly_square(harmonics, excess), alpha=1e-6)
    ...     print(f"V = {found.mean / 1e-6:.2f} alpha L/T")
    V = 0.62 alpha L/T
    V = 0.96 alpha L/T
    """
    validation.integer("harmonics", harmonics, 1)
    share = 0.5 + validation.positive("excess", excess)
    if share >= 1:
        raise ValueError(f"excess = {excess:g}: must be < 0.5")
    k = np.arange(1, harmonics + 1)
    cosine = (1 - k / (harmonics + 1)) * 4 * np.sin(np.pi * k * share) / (np.pi * k)
    return TravellingWave(cosine, np.zeros(harmonics), mean=2 * share - 1)


def size_of(wave: TravellingWave) -> float:
    """max |c| over a period: the largest of equidistant values, and what may lie between them.

    A polynomial of degree N is nowhere larger than its largest of M equidistant values over cos(pi N/M)
    (Ehlich and Zeller, Math. Z. 86, 41, 1964), a fraction of 3e-5 more for the M = 400 N here.
    """
    points = 400 * wave.harmonics.size
    values = wave.profile(2 * np.pi / points * np.arange(points))
    return float(abs(values).max()) / float(np.cos(np.pi * wave.harmonics.size / points))
