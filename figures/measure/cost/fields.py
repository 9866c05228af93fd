"""Panel (a): the displacement field of the paper's sheet.

Errors are relative L2 errors over the sheet at the worst of some phases, against a solution by another
method: Ritz for the series, the series with tails for Ritz and finite elements. What is timed is one
solution, set-up included, for all phases; evaluating it and estimating its error are not.
"""

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from figures.measure.cost.cases import (
    P2,
    P4,
    PLAIN,
    RITZ,
    SHEET,
    STRIP,
    TAIL,
    WAVE,
    Case,
    Judged,
    elements,
)
from figures.measure.cost.peers import peer
from linear_theory import airy_series, ritz_field
from linear_theory.common.quadrature import gauss_legendre
from linear_theory.deformation.field import LinearField

Array = NDArray[np.float64]

PANEL = "field"

PHASES = 8
"""Times in a period at which the displacement is compared."""

POINTS = (40, 80)
"""Gauss points across and along the sheet at which it is compared."""

SERIES_RTOL, RITZ_DEGREE = 1e-10, 101
"""Of the references: the series with tails, and Ritz. They agree to 3e-11."""

PLAIN_MODES = (5, 10, 20, 40, 80, 160, 320)
TAIL_MODES = (2, 5, 10, 20, 40, 80, 160)
DEGREES = (5, 9, 13, 21, 31, 51)
CELLS = {P2: (4, 8, 16, 32), P4: (2, 4, 8, 16)}
"""L over the longest side of the triangles."""
TOLERANCES = (1e-3, 1e-5, 1e-7, 1e-9)


class Fields:
    """All ways to the displacement, and the references that they are judged by."""

    def __init__(self) -> None:
        nodes = [gauss_legendre(n) for n in POINTS]
        self.x = SHEET.width / 2 * nodes[0][0][:, None]
        self.y = SHEET.length / 2 * nodes[1][0][None, :]
        self.times = WAVE.period * np.arange(PHASES) / PHASES
        self._weights = np.multiply.outer(nodes[0][1], nodes[1][1])
        self._exact = {
            RITZ: self._at(ritz_field(SHEET, WAVE, degree=RITZ_DEGREE)),
            TAIL: self._at(airy_series(SHEET, WAVE, rtol=SERIES_RTOL)),
        }

    def cases(self) -> Iterator[Case]:
        """All that is compared, peers where they are installed."""
        yield Case(PANEL, STRIP, "points", 1, partial(strip_displacement, 0.1, 0.2, 0.3), self._strip)
        series = partial(airy_series, SHEET, WAVE)
        for modes in PLAIN_MODES:
            solve = partial(series, modes=modes, tail=False)
            yield self._case(PLAIN, "modes", modes, solve, RITZ, quick=modes < 100)
        for modes in TAIL_MODES:
            yield self._case(TAIL, "modes", modes, partial(series, modes=modes), RITZ)
        for degree in DEGREES:
            polynomials = partial(ritz_field, SHEET, WAVE, degree=degree)
            yield self._case(RITZ, "degree", degree, polynomials, TAIL)
        for rtol in TOLERANCES:
            yield self._case(TAIL, "rtol", rtol, partial(series, rtol=rtol), RITZ)
            yield self._case(RITZ, "rtol", rtol, partial(ritz_field, SHEET, WAVE, rtol=rtol), TAIL)
        for level, counts in CELLS.items():
            for n in counts:
                yield self._case(level, "L/size", n, elements(level, n), TAIL, quick=n <= 8)
        yield from self._peers()

    def disagreement(self) -> float:
        """Of the two references: below it, errors mean nothing."""
        return self._distance(self._exact[RITZ], TAIL)

    def error(self, field: LinearField, reference: str) -> float:
        """Of a field against the reference of that name."""
        return self._distance(self._at(field), reference)

    def _case(
        self,
        level: str,
        knob: str,
        value: float,
        solve: Callable[[], LinearField],
        reference: str,
        quick: bool = True,
    ) -> Case:
        def judge(field: LinearField) -> Judged:
            return Judged(self.error(field, reference), field.error)

        return Case(PANEL, level, knob, value, solve, judge, quick)

    def _strip(self, _: Any) -> Judged:
        values = np.stack(strip_displacement(self.x[..., None], self.y[..., None], self.times))
        return Judged(self._distance(values, TAIL))

    def _peers(self) -> Iterator[Case]:
        """Finite elements of other codes, of which two load cases are put together."""
        amplitudes = np.stack([np.cos(2 * np.pi * self.times), np.sin(2 * np.pi * self.times)])
        for code in peer.installed():
            for n in code.cells:

                def judge(result: Any, code: peer.Peer = code) -> Judged:
                    parts = code.displacements(result, *np.broadcast_arrays(self.x, self.y))
                    values = np.tensordot(self._settled(parts), amplitudes, (0, 0))
                    return Judged(self._distance(values, TAIL))

                solve = partial(code.solve, SHEET, peer.PARTS, n)
                yield Case(PANEL, code.name, "cells along", n, solve, judge, quick=n <= 8)

    def _at(self, field: LinearField) -> Array:
        return field.displacement(self.x[..., None], self.y[..., None], self.times)

    def _distance(self, values: Array, reference: str) -> float:
        exact = self._exact[reference]
        return float(np.max(self._norms(values - exact) / self._norms(exact)))

    def _norms(self, values: Array) -> Array:
        """L2 norm over the sheet at each phase."""
        return np.asarray(np.sqrt(np.einsum("cxyt,xy->t", values**2, self._weights)))

    def _settled(self, parts: Array) -> Array:
        """Displacements (cases, 2, across, along) without their mean and mean rotation.

        Rotation by least squares, which differs from the mean of the curl only by what a field without
        either has of it: the references are treated alike, as theirs is 0 by symmetry in x.
        """
        x, y = np.broadcast_arrays(self.x, self.y)
        weights = self._weights / self._weights.sum()
        parts = parts - np.einsum("jcxy,xy->jc", parts, weights)[..., None, None]
        turned = np.einsum("jxy,xy->j", parts[:, 1] * x - parts[:, 0] * y, weights)
        turned = turned / np.sum(weights * (x**2 + y**2))
        return parts - np.multiply.outer(turned, np.stack([-y, x]))


def strip_displacement(x: Any, y: Any, t: Any) -> tuple[Array, Array]:
    """Displacement of a narrow strip, strain c in both directions, per unit alpha: W -> 0 of eq. 10.

    u_y = int c dy without its mean, u_x = x c; SHEET and WAVE, points and times broadcast.
    """
    k = 2 * np.pi * WAVE.count / SHEET.length
    phase = k * np.asarray(y) - 2 * np.pi / WAVE.period * np.asarray(t)
    return np.asarray(x * np.sin(phase)), np.asarray(-np.cos(phase) / k + 0 * x)
