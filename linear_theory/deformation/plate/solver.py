"""Least energy of a plate on springs over polynomial deflections, one solve per parity.

    minimise  1/2 int D [(1 - nu) K : K + nu (tr K)^2] + s w^2 dx dy,     K = grad grad w + c I,

per unit curvature coupling, rest curvature -c I (eqs 1b and 4). The free edges, on which the bending
moment and Kirchhoff's shear vanish (both contain c), are natural conditions of this energy. As the
ground moves with the rigid motions, there is a unique minimum.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown
from linear_theory.deformation.plate.basis import Basis, twice_integrated
from linear_theory.deformation.plate.foundation import Foundation
from linear_theory.deformation.ritz.solver import PARITIES
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]
Pair = tuple[int, int]


class PlateSolver(Shown):
    """Deflections of one sheet on its ground for any growth; factors once per parity, on demand.

    degree: highest degrees (across, along).
    """

    def __init__(self, sheet: Sheet, foundation: Foundation, degree: Pair) -> None:
        self.sheet, self.foundation, self.degree = sheet, foundation, degree
        self.bases = tuple(twice_integrated(d + 1) for d in degree)
        self._factors: dict[Pair, Array] = {}

    def _contents(self) -> Mapping[str, Any]:
        return {"sheet": self.sheet, "foundation": self.foundation, "degree": self.degree}

    def solve(self, moments: Array) -> Array:
        """Legendre coefficients of w for growths given by their Legendre moments.

        moments: (cases, degrees x, degrees y), integrals of c p_i p_j over [-1, 1]^2; those beyond
        `degree` do no work. Returns (cases, degree x + 1, degree y + 1), length^2: w per unit beta.
        """
        return self.solve_work(self._load(moments[:, : self.degree[0] + 1, : self.degree[1] + 1]))

    def solve_work(self, load: Array) -> Array:
        """The same for virtual work on the test functions, (cases, degree x + 1, degree y + 1)."""
        from scipy.linalg import solve_triangular  # here: scipy takes long to import

        across, along = self.bases
        solution = np.zeros_like(load)
        for px, py in PARITIES:
            part = load[:, px::2, py::2]
            if not part.any():
                continue
            lower = self._factor((px, py))
            half = solve_triangular(lower, part.reshape(len(part), -1).T, lower=True)
            found = solve_triangular(lower, half, lower=True, trans=1)
            solution[:, px::2, py::2] = found.T.reshape(part.shape)
        return np.asarray(across.values @ solution @ along.values.T)

    def _load(self, moments: Array) -> Array:
        """Virtual work -D (1 + nu) int c (v_xx + v_yy) per test function."""
        bent = -self.foundation.rigidity * (1 + self.sheet.poisson) * moments
        return self.against_curvatures(np.stack([bent, bent, np.zeros_like(bent)]))

    def against_curvatures(self, moments: Array) -> Array:
        """Virtual work int (A_xx v_xx + A_yy v_yy + 2 A_xy v_xy) per test function.

        moments: of A (xx, yy, xy), (3, ..., degree x + 1, degree y + 1), as for `solve`.
        """
        (half_x, half_y), (across, along) = self._halves, self.bases
        xx = across.curvatures.T @ moments[0] @ along.values * (half_y / half_x)
        yy = across.values.T @ moments[1] @ along.curvatures * (half_x / half_y)
        return np.asarray(xx + yy + 2 * (across.slopes.T @ moments[2] @ along.slopes))

    def against_slopes(self, moments: Array) -> Array:
        """Virtual work int (A_x v_x + A_y v_y); moments: of A, (2, ..., degree x + 1, degree y + 1)."""
        (half_x, half_y), (across, along) = self._halves, self.bases
        x = across.slopes.T @ moments[0] @ along.values * half_y
        return np.asarray(x + across.values.T @ moments[1] @ along.slopes * half_x)

    def against_values(self, moments: Array) -> Array:
        """Virtual work int A v; moments: of A, (..., degree x + 1, degree y + 1)."""
        (half_x, half_y), (across, along) = self._halves, self.bases
        return np.asarray(across.values.T @ moments @ along.values * (half_x * half_y))

    @property
    def _halves(self) -> tuple[float, float]:
        return self.sheet.width / 2, self.sheet.length / 2

    def _factor(self, parity: Pair) -> Array:
        """Cholesky factor of the energy of deflections of one parity, lower."""
        from scipy.linalg import cholesky

        if parity not in self._factors:
            self._factors[parity] = cholesky(self._matrix(parity), lower=True, overwrite_a=True)
        return self._factors[parity]

    def _matrix(self, parity: Pair) -> Array:
        """D [w_xx v_xx + w_yy v_yy + nu (w_xx v_yy + w_yy v_xx) + 2 (1 - nu) w_xy v_xy] + s w v."""
        (half_x, half_y), nu = self._halves, self.sheet.poisson
        x, y = (_Products(b, p) for b, p in zip(self.bases, parity, strict=True))
        mixed = np.kron(x.mixed, y.mixed.T)
        bent = np.kron(x.curvatures, y.values) * (half_y / half_x**3)
        bent += np.kron(x.values, y.curvatures) * (half_x / half_y**3)
        bent += (nu * (mixed + mixed.T) + 2 * (1 - nu) * np.kron(x.slopes, y.slopes)) / (
            half_x * half_y
        )
        pressed = np.kron(x.values, y.values) * (half_x * half_y)
        return np.asarray(self.foundation.rigidity * bent + self.foundation.spring * pressed)


class _Products:
    """Integrals of products of two psi of one parity, or of their derivatives."""

    def __init__(self, basis: Basis, parity: int) -> None:
        values, slopes, curvatures = (table[:, parity::2] for table in basis)
        self.values, self.slopes = values.T @ values, slopes.T @ slopes
        self.curvatures, self.mixed = curvatures.T @ curvatures, curvatures.T @ values
