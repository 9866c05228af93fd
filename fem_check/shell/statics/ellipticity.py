"""Material stability of a planar shape against short waves, which a finite mesh may not resolve.

The stretching energy is that of a St Venant-Kirchhoff material in the grown metric, which softens under
strong compression. A shape of the continuous sheet is a minimum only if waves shorter than all other
lengths (and than the elements, which do not resolve them) cost energy:

Inside, all acoustic tensors Q(n) must be positive definite (Legendre and Hadamard). With the principal
stretches l_1, l_2 of the grown sheet, in units of K, S_1 = (l_1^2 - 1 + nu (l_2^2 - 1))/2 and
G = (1 - nu)/2, that is

    q_11 = S_1 + l_1^2 > 0,   q_12 = S_2 + G l_1^2 > 0,   and the same with 1 and 2 exchanged,
    sqrt(q_11 q_22) + sqrt(q_12 q_21) > (nu + G) l_1 l_2

On a free edge, wrinkles that decay into the sheet must cost energy (Agmon; M. A. Biot, Appl. Sci. Res.
A 12:168, 1963, for rubber): the surface impedance (A. Mielke and Y. B. Fu, Math. Mech. Solids 9, 2004)
must be positive definite. No force acts across the edge, so that the stretch l along it determines
that across it, m^2 = 1 - nu (l^2 - 1), and the determinant of the impedance is positive as long as

    m (3 l^2 - 1) > (1 - l^2) sqrt(l^2 - (1 - nu^2) (1 - l^2)/2)

which fails at l = 0.639 for nu = 1/2, before a bar reaches its largest force, at l = 0.577.
"""

from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.region import Region
from fem_check.shell.kinematics.rest_state import RestState

Array = NDArray[np.float64]
RestOf = Callable[[Region], RestState]


class Reserve(NamedTuple):
    """Stability margin at the least stable point of a shape; negative if unstable.

    value: on an edge the stretch along it minus its limit, inside see `acoustic_reserve`. place (2,):
    parameters of the point. words: the stretch and its limit, in words.
    """

    value: float
    place: Array
    words: str


@cache
def edge_limit(poisson: float) -> float:
    """Stretch along a free edge below which it is unstable to short wrinkles.

    Smallest, 0.627, for nu = 0.1; 0.639 for 1/2 and 0.707 for -1.
    """

    def impedance(stretch: float) -> float:
        square = stretch**2
        across = np.sqrt(1 + poisson * (1 - square))
        along = max(square - (1 - poisson**2) * (1 - square) / 2, 0.0)
        return float(across * (3 * square - 1) - (1 - square) * np.sqrt(along))

    return float(brentq(impedance, 0.6, 1.0, xtol=1e-14))  # for nu = 0, 0.577 is a second root


def acoustic_reserve(smaller: ArrayLike, larger: ArrayLike, poisson: float) -> Array:
    """Smallest margin in the conditions for the interior, in units of K = E h/(1 - nu^2).

    smaller, larger: principal stretches, broadcast. (1 - nu)/2 for an undeformed sheet.
    """
    low, high = np.asarray(smaller, float), np.asarray(larger, float)
    shear = (1 - poisson) / 2
    strain = (low**2 - 1) / 2, (high**2 - 1) / 2
    stress = strain[0] + poisson * strain[1], strain[1] + poisson * strain[0]
    along = stress[0] + low**2, stress[1] + high**2
    across = stress[1] + shear * low**2, stress[0] + shear * high**2
    roots = [np.sqrt(np.maximum(a * b, 0)) for a, b in (along, across)]
    mixed = roots[0] + roots[1] - (poisson + shear) * low * high
    return np.minimum.reduce([*along, *across, mixed])


def principal_stretches(state: PointState) -> tuple[Array, Array]:
    """Smaller and larger, (points,) each: roots of the eigenvalues of abar^-1 a."""
    a11, a22, a12 = state.metric
    r11, r22, r12 = state.rest.abar
    determinant = r11 * r22 - r12**2
    mean = (a11 * r22 + a22 * r11 - 2 * a12 * r12) / (2 * determinant)
    product = (a11 * a22 - a12**2) / determinant
    larger = mean + np.sqrt(np.maximum(mean**2 - product, 0))
    return np.sqrt(product / larger), np.sqrt(larger)


class Ellipticity:
    """The stability conditions at the points of a planar sheet with free edges."""

    def __init__(self, discretisation: Discretisation, poisson: float) -> None:
        self.poisson, self.interior = poisson, discretisation.interior
        self.edge = discretisation.edge(lambda xi: np.ones(xi.shape[1], bool))

    def reserve(self, u: Array, rest: RestOf) -> Reserve:
        """Margin at the edge, or in the interior if that is unstable and the edge is not.

        u (size,): unknowns. rest: the rest state at the points of a region.
        """
        edge = self._on_edge(u, rest(self.edge))
        inside = self._inside(u, rest(self.interior))
        return inside if inside.value <= 0 < edge.value else edge

    def _on_edge(self, u: Array, rest: RestState) -> Reserve:
        state, (first, second) = PointState(self.edge, u, (1, 2), rest), self._tangents
        weights = np.stack([first**2, second**2, 2 * first * second])
        stretch = np.sqrt((weights * state.metric).sum(0) / (weights * rest.abar).sum(0))
        limit, worst = edge_limit(self.poisson), int(stretch.argmin())
        words = f"its edge is compressed to {stretch[worst]:.4f}, wrinkling starts at {limit:.4f}"
        return Reserve(float(stretch[worst] - limit), _place(self.edge, worst), words)

    def _inside(self, u: Array, rest: RestState) -> Reserve:
        small, large = principal_stretches(PointState(self.interior, u, (1, 2), rest))
        values = acoustic_reserve(small, large, self.poisson)
        worst = int(values.argmin())
        words = (
            f"with principal stretches {small[worst]:.3f} and {large[worst]:.3f} "
            "its acoustic tensor is not positive definite"
        )
        return Reserve(float(values[worst]), _place(self.interior, worst), words)

    @property
    def _tangents(self) -> Array:
        assert self.edge.tangents is not None
        return self.edge.tangents.reshape(2, -1)


def _place(region: Region, point: int) -> Array:
    return np.asarray(region.parameters.reshape(2, -1)[:, point])
