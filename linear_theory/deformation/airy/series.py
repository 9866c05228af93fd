"""The Airy-stress series of a rectangular sheet (eqs 10, 14, 15 and appendix A.1 of the paper)."""

import math
import time
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from linear_theory.common import validation
from linear_theory.common.errors import NotConvergedError
from linear_theory.common.shown import Shown
from linear_theory.common.threads import one_blas_thread
from linear_theory.deformation.airy import loads, system
from linear_theory.deformation.airy.cases import Cases
from linear_theory.deformation.airy.error import missing_mean_square
from linear_theory.deformation.airy.family import families
from linear_theory.deformation.airy.system import Solution
from linear_theory.deformation.field import LinearField, combine
from linear_theory.sheet import hooke
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave import arguments
from linear_theory.wave.phases import phases
from linear_theory.wave.protocol import Wave
from linear_theory.wave.sampled import drive
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

FORMS = ("corrected", "printed")
MOST_COUPLINGS = 10_000_000  # entries of one coupling matrix, 80 MB
# the modes just beyond the last are not all that is missing: measured over aspect ratios 1:100 to
# 100:1, nu = -0.9 to 0.5 and 1 to 50 waves, the bare estimate is 0.7 to 3 times the true error with
# tails and 0.4 to 0.6 times without
_SAFETY = {True: 2.5, False: 4.0}
_ROUNDOFF = 1e-13


class _Amplitudes(NamedTuple):
    A: Array
    B: Array
    C: Array
    D: Array


class AiryAmplitudes(Shown, _Amplitudes):
    """A_m, B_m, C_r (m, r = 1, 2, ...) and D_s (s = 1, 3, ...) of eq. 15, each (modes, *t.shape)."""


@one_blas_thread
def airy_series(
    sheet: Sheet,
    wave: Wave,
    rtol: float = 1e-6,
    modes: int | None = None,
    tail: bool = True,
    form: str = "corrected",
) -> "AirySeries":
    """Small-strain deformation of a rectangular sheet by a wave c(y, t), per unit alpha.

    wave: a `TravellingWave`, or one whose drive is a series (see `protocol.Drive`).
    rtol: relative L2 error of the displacement at the worst phase, from which the numbers of modes
    along both sides follow; modes: use this many of each family instead (20 in the paper), whatever
    the error. tail: sum the slowly decaying tails of the amplitudes; tail=False is the paper's plain
    truncation. form: "printed" keeps the printed A- and B-equations, which leave traction on the
    edges (plain truncation, width = length/2 only).

    Raises ValueError for bad input and NotConvergedError, with the best field, if rtol asks for more
    modes than fit in memory.

    >>> import numpy as np
    >>> from linear_theory import Sheet, SineWave, airy_series, ritz_field
    >>> series = airy_series(Sheet(), SineWave(), rtol=1e-4)
    >>> reference = ritz_field(Sheet(), SineWave(), rtol=1e-8)
    >>> u, exact = (field.displacement(0.1, [-0.3, 0.1, 0.4], t=0.3) for field in (series, reference))
    >>> print(np.linalg.norm(u - exact) <= series.error * np.linalg.norm(exact), series.error <= 1e-4)
    True True
    """
    printed = validation.choice("form", form, FORMS) == "printed"
    rtol = validation.tolerance(rtol)
    sheet = arguments.sheet(sheet)
    series = drive(arguments.wave(wave), sheet).series
    if series is None:
        shown = validation.shown(wave)
        raise ValueError(f"wave = {shown}: must be a TravellingWave; ritz_field takes any c(x, y, t)")
    if printed and not math.isclose(sheet.width, sheet.length / 2):
        raise ValueError(f"width = {sheet.width:g}: must be length/2 for form='printed'")
    tail = tail and not printed
    if modes is None:
        return _with_enough_modes(sheet, series, rtol, tail, printed)
    modes, lowest = validation.integer("modes", modes, 1), int(series.orders[-1])
    if not lowest <= modes <= math.isqrt(MOST_COUPLINGS):
        limit = math.isqrt(MOST_COUPLINGS)
        raise ValueError(f"modes = {modes}: must be in [{lowest}, {limit}] for this wave")
    return AirySeries(sheet, series, (modes, modes), tail, printed)


def balanced_modes(sheet: Sheet, wave: TravellingWave, cutoff: float) -> tuple[int, int]:
    """Numbers of modes along x and along y up to the wave number 2 pi cutoff/min(W, L).

    Equal wave numbers in both directions make the errors of the two families equal. The wave's own
    highest harmonic is always within.
    """
    shorter = min(sheet.width, sheet.length)
    along = max(cutoff * sheet.length / shorter, 1.25 * wave.orders[-1] + 2)
    across = max(along * sheet.width / sheet.length, 3)
    return math.ceil(across), math.ceil(max(along, across * sheet.length / sheet.width))


def first_cutoff(sheet: Sheet, wave: TravellingWave, rtol: float, tail: bool) -> float:
    """Cutoff of `balanced_modes` that is likely to meet rtol.

    From the measured errors, up to 0.16 cutoff^-4 (with tails) and 0.2 cutoff^-2 (without) of one wave
    on a sheet at least twice as long as wide; shorter waves need more, like their number^(2/3).
    """
    crowding = 2 * float(wave.orders[-1]) * min(sheet.width, sheet.length) / sheet.length
    needed = (0.16 / rtol) ** (1 / 4) if tail else (0.2 / rtol) ** (1 / 2)
    return float(max(2.0, needed * max(1.0, crowding) ** (2 / 3)))


def _with_enough_modes(
    sheet: Sheet, wave: TravellingWave, rtol: float, tail: bool, printed: bool
) -> "AirySeries":
    """Raise the number of modes until the error estimate meets rtol."""
    start = time.perf_counter()
    order = 4.0 if tail else 2.0  # of the error in 1/cutoff
    cutoff, best = first_cutoff(sheet, wave, rtol, tail), None
    while True:
        modes = balanced_modes(sheet, wave, cutoff)
        if math.prod(modes) > MOST_COUPLINGS:
            best = best or _largest(sheet, wave, cutoff, tail, printed)
            raise NotConvergedError(f"rtol = {rtol:g}: would need {modes} modes or more", best)
        best = AirySeries(sheet, wave, modes, tail, printed)
        if best.error <= rtol:
            best.seconds = time.perf_counter() - start
            return best
        cutoff *= min(max(1.1 * (best.error / rtol) ** (1 / order), 1.2), 4.0)


def _largest(
    sheet: Sheet, wave: TravellingWave, cutoff: float, tail: bool, printed: bool
) -> "AirySeries | None":
    """The series of the most modes that fit; None if not even the wave's own do."""
    while cutoff > 1:
        cutoff *= 0.8
        modes = balanced_modes(sheet, wave, cutoff)
        if math.prod(modes) <= MOST_COUPLINGS:
            return AirySeries(sheet, wave, modes, tail, printed)
    return None


class AirySeries(LinearField):
    """Deformation of a sheet by a travelling wave as an Airy series; made by `airy_series`.

    The basis is one field for cos(2 pi r y/L) and one for sin(2 pi r y/L) of every harmonic r of the
    wave, and the uniform dilation by the mean of c. modes: terms kept along x (families A, B) and
    along y (C, D); tail: whether their tails are summed.

    >>> from linear_theory import Sheet, SineWave, airy_series
    >>> series = airy_series(Sheet(), SineWave(), rtol=1e-8)
    >>> print(series.displacement(x=0.1, y=0.2, t=0.3).round(5))  # L per unit alpha
    [-0.06152 -0.11559]
    """

    mirrored = True
    wave: TravellingWave

    def __init__(
        self, sheet: Sheet, wave: TravellingWave, modes: tuple[int, int], tail: bool, printed: bool
    ) -> None:
        start = time.perf_counter()
        self.sheet, self.wave, self.modes, self.tail = sheet, wave, modes, tail
        self._printed = printed
        along_x, along_y = families(sheet, modes)
        load = loads.wave_load(along_y, wave.orders, without_line=tail)
        solution = system.solve((along_x, along_y), load, tail, printed)
        self._cases = Cases(sheet, wave.orders, tail, solution)
        self.seconds = time.perf_counter() - start

    def _settings(self) -> Mapping[str, Any]:
        form = "printed" if self._printed else "corrected"
        return {"modes": self.modes, "tail": self.tail, "form": form}

    def amplitudes(self, t: ArrayLike) -> AiryAmplitudes:
        """A, B, C, D at the times t in the paper's normalisation, per unit alpha."""
        solution = self._of_whole_sines()
        (a, b), (c, d) = (
            family.signs[..., None] * barred
            for family, barred in zip(solution.families, solution.amplitudes, strict=True)
        )
        even, odd = self.wave.factors(t)
        pairs = (a, even), (b, odd), (c, even), (d, odd)
        return AiryAmplitudes(*(np.tensordot(unit, factor, 1) for unit, factor in pairs))

    def tail_constants(self, t: ArrayLike) -> tuple[Array, Array]:
        """K of A_m ~ (-1)^m K/m, C_r ~ -(-1)^r K/r and K' of B_m ~ (-1)^m K'/m, each (*t.shape).

        D_s ~ -2 (-1)^((s-1)/2) K'/s. In the paper's normalisation; 0 without tails.
        """
        (k_even, k_odd), (even, odd) = self._of_whole_sines().constant, self.wave.factors(t)
        return np.tensordot(k_even, even, 1), np.tensordot(k_odd, odd, 1)

    def _of_whole_sines(self) -> Solution:
        """For sines with their stress-free line, as the paper expands them."""
        solution, slopes = self._cases.solution, loads.end_slopes(self._cases.orders)
        if not self.tail:
            return solution
        line = system.solve(solution.families, loads.line_load(solution.families[1]), tail=True)
        a_b, c_d = (
            barred + unit * slopes
            for barred, unit in zip(solution.amplitudes, line.amplitudes, strict=True)
        )
        return replace(
            solution, amplitudes=(a_b, c_d), constant=solution.constant + line.constant * slopes
        )

    @one_blas_thread
    def stress(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """(xx, yy, xy) of the stress, (3, ...), units of Young's modulus; independent of nu."""
        x, y, t = self._checked(x, y, t)
        return combine(self._amplitudes(t), self._cases.stresses(x, y))

    @cached_property
    @one_blas_thread
    def error(self) -> float:
        """Estimated relative L2 error of the displacement over the sheet at the worst phase."""
        solution, factors = self._cases.solution, self._error_phases()
        missing = missing_mean_square(solution, factors)
        size = self._cases.mean_squares(factors, self.wave.mean)
        return _SAFETY[self.tail] * float(np.sqrt(np.max(missing / size))) + _ROUNDOFF

    def _error_phases(self) -> Array:
        """Factors of cosines and sines at phases among which the worst will be, (2, K, phases)."""
        count = self.wave.harmonics.size
        if count > 1 or self.wave.mean:
            return np.stack(self.wave.factors(phases(self.wave.period, min(16 * count, 128))))
        # one harmonic: the error relative to u is largest where one of the two cases is alone
        return np.array([[[1.0, 0.0]], [[0.0, 1.0]]])

    def _amplitudes(self, t: Array) -> Array:
        return np.concatenate([*self.wave.factors(t), np.full((1, *t.shape), self.wave.mean)])

    def _amplitude_rates(self, t: Array) -> Array:
        return np.concatenate([*self.wave.factor_rates(t), np.zeros((1, *t.shape))])

    def _displacements(self, x: Array, y: Array) -> Array:
        return self._cases.displacements(x, y)

    def _strains(self, x: Array, y: Array) -> Array:
        growth = self._cases.growths(np.broadcast_arrays(x, y)[1])
        stresses = np.moveaxis(self._cases.stresses(x, y), 1, 0)
        return np.moveaxis(hooke.strain(stresses, growth, self.sheet.poisson), 0, 1)
