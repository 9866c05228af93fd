"""The Airy-stress series of a rectangular sheet (eqs 10, 14, 15 and appendix A.1 of the seed paper)."""

import math
import time
from collections.abc import Callable, Mapping
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
from linear_theory.deformation.airy.system import Family, Pair
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
        even = self._solve(1, loads.even_load)
        odd = self._solve(-1, self._odd_load)
        self._cases = Cases(sheet, wave.orders, tail, even, odd)
        self.seconds = time.perf_counter() - start

    def _settings(self) -> Mapping[str, Any]:
        form = "printed" if self._printed else "corrected"
        return {"modes": self.modes, "tail": self.tail, "form": form}

    def amplitudes(self, t: ArrayLike) -> AiryAmplitudes:
        """A, B, C, D at the times t in the paper's normalisation, per unit alpha."""
        even, odd = self.wave.factors(t)
        cases = self._cases
        b, d = cases.odd.amplitudes
        if self.tail:  # the paper expands the whole sine: put the stress-free line back
            line = self._line()
            slopes = loads.end_slopes(cases.orders)
            b, d = b + line.amplitudes[0] * slopes, d + line.amplitudes[1] * slopes
        a, c = cases.even.amplitudes
        families = *cases.even.families, *cases.odd.families
        signed = [f.signs[:, None] * p for f, p in zip(families, (a, c, b, d), strict=True)]
        a, c, b, d = (
            np.tensordot(p, q, 1) for p, q in zip(signed, (even, even, odd, odd), strict=True)
        )
        return AiryAmplitudes(a, b, c, d)

    def tail_constants(self, t: ArrayLike) -> tuple[Array, Array]:
        """K of A_m ~ (-1)^m K/m, C_r ~ -(-1)^r K/r and K' of B_m ~ (-1)^m K'/m, each (*t.shape).

        D_s ~ -2 (-1)^((s-1)/2) K'/s. In the paper's normalisation; 0 without tails.
        """
        even, odd = self.wave.factors(t)
        cases = self._cases
        constant = cases.odd.constant
        if self.tail:
            constant = constant + self._line().constant * loads.end_slopes(cases.orders)
        return np.tensordot(cases.even.constant, even, 1), np.tensordot(constant, odd, 1)

    @one_blas_thread
    def stress(self, x: ArrayLike, y: ArrayLike, t: ArrayLike) -> Array:
        """(xx, yy, xy) of the stress, (3, ...), units of Young's modulus; independent of nu."""
        x, y, t = self._checked(x, y, t)
        return combine(self._amplitudes(t), self._cases.stresses(x, y))

    @cached_property
    @one_blas_thread
    def error(self) -> float:
        """Estimated relative L2 error of the displacement over the sheet at the worst phase."""
        cases = self._cases
        even, odd = self._error_phases()
        even_load, odd_load = (
            load(pair.families[1].extended(), cases.orders)
            for pair, load in ((cases.even, loads.even_load), (cases.odd, self._odd_load))
        )
        missing = missing_mean_square(cases.even, even_load, even)
        missing += missing_mean_square(cases.odd, odd_load, odd)
        mean = np.full((1, even.shape[1]), self.wave.mean)
        size = cases.mean_squares(np.concatenate([even, odd, mean]))
        return _SAFETY[self.tail] * float(np.sqrt(np.max(missing / size))) + _ROUNDOFF

    def _error_phases(self) -> tuple[Array, Array]:
        """Factors of the cosines and of the sines at phases among which the worst will be."""
        count = self.wave.harmonics.size
        if count > 1 or self.wave.mean:
            return self.wave.factors(phases(self.wave.period, min(16 * count, 128)))
        # one harmonic: the error relative to u is largest where one of the two cases is alone
        return np.array([[1.0, 0.0]]), np.array([[0.0, 1.0]])

    def _solve(self, parity: int, load: Callable[[Family, NDArray[np.int64]], Array]) -> Pair:
        families = system.families(self.sheet, self.modes, parity)
        right = load(families[1], self.wave.orders)
        return system.solve(families, right, self.tail, self._printed)

    def _line(self) -> Pair:
        """The stress-free growth y/L as a sum of terms."""
        return self._solve(-1, lambda across, _: loads.line_load(across))

    def _odd_load(self, across: Family, orders: NDArray[np.int64]) -> Array:
        return loads.odd_load(across, orders, without_line=self.tail)

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
