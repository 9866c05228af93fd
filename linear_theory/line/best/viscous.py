"""The best wave of given mean square on viscous ground, in an infinite body and in a finite one.

A wave at one frequency, c = A(S) cos wt + B(S) sin wt = Re[C(S) exp(-iwt)] with C = A + iB, 0 <= S <=
1, moves a body under viscous friction, loaded per current length, with the mean speed

    V = -(w alpha^2/2) int A K B dS + O(alpha^3),   K B = int [sgn(S - S') - (S - S')] B(S') dS',

(lengths in L): of the weight 1 + alpha c the part alpha c drags on the velocity alpha int_0^S c_t, less
its mean. The kernel is antisymmetric, so V is largest, for a given mean square
E = int (A^2 + B^2)/2 dS, where C is the eigenfunction of i K with the largest eigenvalue:

    V <= w alpha^2 E/theta,   tan(theta/2) = -theta/6,    theta = 4.9113,
    C = exp(i theta S) + (exp(i theta) - 1)/(i theta),

found from (K C)' = 2 C - int C and the value of K C at an end. In words: a travelling wave of the
wavelength 2 pi L/theta = 1.279 L, longer than the body, together with a breathing of the whole body at
0.258 of its amplitude. V = 1.2793 alpha^2 E L/T, where the sine of one wave on the body has
alpha^2 E L/T.

An infinite body with a given wavelength has no ends: then K is a convolution, its eigenfunctions are
sines, and of all waves of a given energy the sine that travels is the best, V = alpha^2 E
(wavelength/T) [Agostinelli, Alouges and DeSimone, Front. Robot. AI 5, 99, 2018, peristalsis as the best
gait of a periodic body; Santhosh and Serra, Phys. Rev. E 106, 024610, 2022, arXiv 2206.03976: the best
active stress of a given energy is a travelling wave]. The further eigenvalues of the finite body have
theta/2 -> pi (n - 1/2): a wave of n lengths gains the share 1/(2n) by its ends, and the infinite body
is the limit of many waves. A higher frequency always helps at a given mean square of c; at a given mean
square of c_t it never does, as V goes with 1/w then.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.wave.given import FieldWave

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ViscousBest(Value):
    """A wave for which V is stationary among those of one frequency and one mean square.

    theta: its phase from end to end, radians; breathing: amplitude of the uniform part over that of the
    travelling part; gain: V over alpha^2 <c^2> L/T, 1 for the sine of one wave.
    """

    theta: float
    breathing: float
    gain: float

    def wave(self, mean_square: float, length: float = 1.0, period: float = 1.0) -> FieldWave:
        """c(x, y, t) on a body of that length: c has that mean square. Raises ValueError unless > 0."""
        size = validation.positive("mean_square", mean_square)
        validation.positive("length", length)
        rate = 2 * math.pi / validation.positive("period", period)
        theta, breathing = self.theta, self.breathing
        # mean of |exp(i theta y) + b|^2/2, of which the mixed part has the mean sin(theta/2)/(theta/2)
        square = (1 + 2 * breathing * breathing + breathing**2) / 2
        amplitude = math.sqrt(size / square)

        def c(x: Array, y: Array, t: Array) -> Array:
            travelling = np.cos(theta * y / length - rate * t)
            return np.asarray(amplitude * (travelling + breathing * np.cos(rate * t)) + 0 * x)

        return FieldWave(c, period=period)


def best_viscous(number: int = 1) -> ViscousBest:
    """The best wave of a finite body for number = 1, the further ones for 2, 3, ... (about that many
    waves on the body). Raises ValueError for numbers below 1.

    >>> from linear_theory.line.best.viscous import best_viscous
    >>> best = best_viscous()
    >>> print(f"theta {best.theta:.4f}, breathing {best.breathing:.4f}, gain {best.gain:.4f}")
    theta 4.9113, breathing 0.2579, gain 1.2793
    """
    number = validation.integer("number", number, 1)
    low, high = math.pi * (number - 0.5), math.pi * number
    # sin x + x cos x/3 = 0 is tan x = -x/3 without its poles
    half = float(brentq(lambda x: math.sin(x) + x * math.cos(x) / 3, low, high, xtol=1e-15))
    return ViscousBest(2 * half, math.sin(half) / half, math.pi / half)


def viscous_speed(a: ArrayLike, b: ArrayLike) -> tuple[float, Array, Array]:
    """V over w alpha^2 of c = a cos wt + b sin wt, and its gradients, for values at midpoints of cells.

    a, b: (cells,) values of growth at S = (j + 1/2)/cells; the kernel is exact for growth that is
    constant on every cell. Gradients: with respect to these values. Raises ValueError for other shapes.

    >>> import numpy as np
    >>> from linear_theory.line.best.viscous import viscous_speed
    >>> phase = 2 * np.pi * (np.arange(400) + 0.5) / 400
    >>> speed, by_a, by_b = viscous_speed(np.cos(phase), np.sin(phase))  # <c^2> = 1/2
    >>> print(f"V = {2 * np.pi * speed:.4f} alpha^2 L/T")
    V = 0.5000 alpha^2 L/T
    """
    one, other = validation.real_array("a", a), validation.real_array("b", b)
    if one.ndim != 1 or one.shape != other.shape or not one.size:
        raise ValueError(
            f"a, b have shapes {one.shape}, {other.shape}: must be (cells,), both the same"
        )
    of_b, of_a = _kernel(other), _kernel(one)
    return -float(one @ of_b) / (2 * one.size), -of_b / (2 * one.size), of_a / (2 * one.size)


def _kernel(values: Array) -> Array:
    """Means of K over every cell, of growth that is constant on each."""
    count = values.size
    place = (np.arange(count) + 0.5) / count
    below = np.cumsum(values) - values / 2
    total = values.sum()
    return np.asarray((2 * below - total - place * total + place @ values) / count)
