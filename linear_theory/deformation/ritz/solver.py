"""Least elastic energy of a growing sheet over polynomial displacements, one banded solve per parity.

    minimise  1/2 int (eps(u) - c I) : C : (eps(u) - c I) dx dy,     C of plane stress, E = 1,

with u_x, u_y = sum over i, j of coefficients times phi_i(2x/W) phi_j(2y/L), phi of `legendre`. Growth
of one parity in x and in y makes displacements of one parity, so that there are four separate
problems. In each, neighbours only are coupled: the Cholesky factor costs N_x N_y min(N_x, N_y)^2.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common.shown import Shown
from linear_theory.deformation.ritz import legendre
from linear_theory.deformation.ritz.legendre import Diagonals
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]
Pair = tuple[int, int]

PARITIES = ((0, 0), (0, 1), (1, 0), (1, 1))
"""Of growths, across and along; a motion that is mirrored in x has the first two only."""


def matrix_size(degree: Pair) -> int:
    """Numbers in the band matrix of one parity, for degrees (across, along)."""
    shorter, longer = sorted((d + 1) // 2 for d in degree)
    return (2 * shorter + 4) * 2 * shorter * longer


class _Block:
    """The energy of the displacements that a load of one parity in x and in y makes."""

    def __init__(self, sheet: Sheet, counts: Pair, parity: Pair) -> None:
        from scipy.linalg import cholesky_banded  # here: scipy takes long to import

        self.counts, self.parity = counts, parity
        self.across_fast = counts[0] < counts[1]
        band = 2 * min(counts) + 3
        self.matrix = np.zeros((band + 1, 2 * counts[0] * counts[1]))
        self._assemble(sheet)
        if parity != (0, 0):  # a rigid motion is left: pin it, a balanced load will not notice
            self.matrix[0, 0 if parity == (1, 0) else 1] += self.matrix[0].max()
        self.factor = cholesky_banded(self.matrix, overwrite_ab=True, lower=True, check_finite=False)

    def _assemble(self, sheet: Sheet) -> None:
        """Plane stress: c11 (xx xx + yy yy) + c12 (xx yy + yy xx) + c33 (2 xy)(2 xy)."""
        nu, slant = sheet.poisson, sheet.length / sheet.width
        c11, c33 = 1 / (1 - nu**2), 0.5 / (1 + nu)
        (nx, ny), (px, py) = self.counts, self.parity
        ux, uy, vx, vy = 1 - px, py, px, 1 - py
        mass, stiffness, mixed = legendre.mass, legendre.stiffness, legendre.mixed
        self._add(0, 0, c11 * slant, stiffness(nx, ux), mass(ny, uy))
        self._add(0, 0, c33 / slant, mass(nx, ux), stiffness(ny, uy))
        self._add(1, 1, c11 / slant, mass(nx, vx), stiffness(ny, vy))
        self._add(1, 1, c33 * slant, stiffness(nx, vx), mass(ny, vy))
        self._add(0, 1, nu * c11, mixed(nx, ux), legendre.transposed(mixed(ny, vy)))
        self._add(0, 1, c33, legendre.transposed(mixed(nx, vx)), mixed(ny, uy))

    def _add(self, row: int, column: int, factor: float, across: Diagonals, along: Diagonals) -> None:
        """Add factor * (across x along) to the lower band, for two components (0: x, 1: y)."""
        outer, inner = (along, across) if self.across_fast else (across, along)
        stride = min(self.counts)
        for i, a in outer.items():
            for j, b in inner.items():
                below = i * stride + j
                offset = 2 * below + column - row
                entries = np.multiply.outer(factor * a, b).ravel()
                if offset >= 0:
                    self.matrix[offset, row::2] += entries
                elif row != column:  # the mirror image of an entry on the other side
                    self.matrix[-offset, column::2][:below] += entries[-below:]

    def solve(self, load: Array) -> Array:
        """Coefficients for loads, both (cases, 2, *counts)."""
        from scipy.linalg import cho_solve_banded

        order = (0, 3, 2, 1) if self.across_fast else (0, 2, 3, 1)
        right = load.transpose(order)
        solution = cho_solve_banded(
            (self.factor, True), right.reshape(len(load), -1).T, check_finite=False
        )
        return np.asarray(solution.T.reshape(right.shape).transpose(np.argsort(order)))


class RitzSolver(Shown):
    """Displacement polynomials on one sheet for any growth; factors once per parity, on demand.

    degree: highest degrees (across, along), both odd.
    """

    def __init__(self, sheet: Sheet, degree: Pair) -> None:
        self.sheet, self.degree = sheet, degree
        self.counts = ((degree[0] + 1) // 2, (degree[1] + 1) // 2)
        self._blocks: dict[Pair, _Block] = {}

    def _contents(self) -> Mapping[str, Any]:
        return {"sheet": self.sheet, "degree": self.degree}

    def solve(self, moments: Array) -> Array:
        """Coefficients of phi_i(x) phi_j(y) for growths given by their Legendre moments.

        moments: (cases, degrees x, degrees y), integrals of c p_i p_j over [-1, 1]^2; those beyond
        `degree` do no work.
        Returns (cases, 2, degree x + 1, degree y + 1), length; no mean, no mean rotation.
        """
        moments = moments[:, : self.degree[0] + 1, : self.degree[1] + 1]
        load = self._load(moments)
        solution = np.zeros_like(load)
        for parity in PARITIES:
            cases = np.flatnonzero(np.any(moments[:, parity[0] :: 2, parity[1] :: 2], axis=(1, 2)))
            if cases.size:
                solution[cases] += self._solve_parity(load[cases], parity)
        return self._without_rigid_motion(solution)

    def solve_stress(self, moments: Array, mirrored: bool) -> Array:
        """Coefficients for a stress P that does the virtual work int P_kj dv_k/dx_j.

        moments: (cases, 2, 2, degree x + 1, degree y + 1), integrals of P_kj p_i p_j over [-1, 1]^2, of
        a P without net force or torque; mirrored: P_xx and P_yy are even and P_xy and P_yx odd in x.
        Returns (cases, 2, degree x + 1, degree y + 1), length; no mean, no mean rotation.
        """
        values, slopes = legendre.against_values, legendre.against_slopes
        along = values(slopes(moments[:, :, 0], 2), 3) * (self.sheet.length / 2)
        across = slopes(values(moments[:, :, 1], 2), 3) * (self.sheet.width / 2)
        return self.solve_work(along + across, mirrored)

    def solve_work(self, load: Array, mirrored: bool) -> Array:
        """Coefficients for the virtual work `load` on each test function, length^2 per stress.

        load: (cases, 2, degree x + 1, degree y + 1), of no net force or torque; mirrored, and what is
        returned: as for `solve_stress`.
        """
        solution = np.zeros_like(load)
        for parity in PARITIES[:2] if mirrored else PARITIES:
            solution += self._solve_parity(load, parity)
        return self._without_rigid_motion(solution)

    def _load(self, moments: Array) -> Array:
        """Virtual work of the growth: int c tr(C I)/2 div(v), per test function."""
        modulus = 1 / (1 - self.sheet.poisson)
        half_x, half_y = modulus * self.sheet.width / 2, modulus * self.sheet.length / 2
        x = half_y * legendre.against_values(legendre.against_slopes(moments, 1), 2)
        y = half_x * legendre.against_values(legendre.against_slopes(moments, 2), 1)
        return np.stack([x, y], 1)

    def _solve_parity(self, load: Array, parity: Pair) -> Array:
        """The part of the solution that growth of one parity makes."""
        if parity not in self._blocks:
            self._blocks[parity] = _Block(self.sheet, self.counts, parity)
        px, py = parity
        solution = np.zeros_like(load)
        part = np.stack([load[:, 0, 1 - px :: 2, py::2], load[:, 1, px::2, 1 - py :: 2]], 1)
        x, y = self._blocks[parity].solve(part).transpose(1, 0, 2, 3)
        solution[:, 0, 1 - px :: 2, py::2] = x
        solution[:, 1, px::2, 1 - py :: 2] = y
        return solution

    def _without_rigid_motion(self, solution: Array) -> Array:
        """Take out the mean displacement and the mean of (du_y/dx - du_x/dy)/2, exactly."""
        mean = legendre.values(np.eye(3), 0)[0]  # of phi_0, phi_1, phi_2
        half_x, half_y = self.sheet.width / 2, self.sheet.length / 2
        slope_x, slope_y = solution[:, 1, 1, :3] @ mean, solution[:, 0, :3, 1] @ mean
        rotation = (slope_x / half_x - slope_y / half_y) / 2
        solution[:, 0, 0, 1] += rotation * half_y
        solution[:, 1, 1, 0] -= rotation * half_x
        solution[:, :, 0, 0] -= np.einsum("kcij,i,j->kc", solution[:, :, :3, :3], mean, mean)
        return solution
