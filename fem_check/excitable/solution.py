"""The solution of the equation on a body, from its start on: a wave that need not repeat."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.excitable.coupled.drive import REFUSAL, FeedbackDrive
from fem_check.excitable.cycles import Cycles, cycles_of
from fem_check.excitable.drives import CycleWave, ExcitationDrive
from fem_check.excitable.kinetics import Equation
from fem_check.excitable.methods import Adaptive, Method
from fem_check.excitable.record import Record, kept_times
from fem_check.excitable.space import Body, Space
from fem_check.excitable.system import System
from fem_check.mesh.outline import Outline
from linear_theory.common import validation
from linear_theory.common.errors import NotConvergedError
from linear_theory.common.shown import Shown, number, with_error
from linear_theory.common.threads import one_blas_thread
from linear_theory.identity import content_key
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.places import Places, among, on_sheet

Array = NDArray[np.float64]

FIRST_SIZE, SMALLEST_RTOL = 2.0, 1e-8
"""Size of the first elements in diffusion lengths."""

FINER = 5
"""Halvings of the elements, at most."""

SHARE = 0.3
"""Of the difference to twice the element size and a coarser integration, that counts as the error. For
third order it is a seventh, so that the first halvings are not trusted too early."""

MOST_NUMBERS = 40_000_000
"""Values of c kept, about 2 GB with their derivatives."""

LONGEST = 1e4
"""Largest `until`, in units of time of the equation, whose pulses take tens of them: some minutes."""

CHECKS = 64
"""Points, beside the nodes, at which two solutions are compared."""


class Pair(NamedTuple):
    """A solution and a coarser one; difference (T,): largest one at each kept time, of c.

    size: of the elements of the fine one.
    """

    fine: Record
    coarse: Record
    difference: Array
    size: float


@dataclass(frozen=True, eq=False)
class Solution(Shown):
    """A solution from time 0 to `until`, found when it is first asked for: see `Excitation`."""

    equation: Equation
    body: Body
    until: float
    rtol: float = 1e-3
    method: Method | None = None

    def __post_init__(self) -> None:
        validation.instance("equation", self.equation, Equation)
        if not isinstance(self.body, Sheet | Outline):
            raise ValueError(f"body = {validation.shown(self.body)}: must be a Sheet or an Outline")
        object.__setattr__(self, "until", time_of("until", self.until))
        if not SMALLEST_RTOL <= validation.real("rtol", self.rtol) < 1:
            raise ValueError(f"rtol = {self.rtol:g}: must be in [{SMALLEST_RTOL:g}, 1)")
        method = Adaptive() if self.method is None else self.method
        validation.instance("method", method, Method)  # type: ignore[type-abstract]
        object.__setattr__(self, "method", method)

    @cached_property
    @one_blas_thread
    def _pair(self) -> Pair:
        """The solution and a coarser one, refined until their difference meets rtol."""
        if self.equation.acts_back:
            raise ValueError(REFUSAL)
        size = FIRST_SIZE * self.equation.diffusion_length
        found = self._solved_pair(size)
        for _ in range(FINER):
            if SHARE * found.difference.max() <= self.rtol * abs(found.fine.c).max():
                break
            size /= 2
            found = self._solved_pair(size)
        return found

    @cached_property
    def alone(self) -> Self:
        """The solution without the feedback of a strain, from which one with it starts."""
        if not self.equation.acts_back:
            return self
        return replace(self, equation=self.equation.but(feedback=None))

    @property
    def _fine(self) -> Record:
        """The solution at the nodes."""
        return self._pair.fine

    @cached_property
    def error(self) -> Array:
        """Estimated error of c up to each kept time, absolute, (T,)."""
        return SHARE * np.maximum.accumulate(self._pair.difference)

    @property
    def times(self) -> Array:
        """Kept times, (T,)."""
        return self._fine.times

    @property
    def converged(self) -> bool:
        """Whether the error meets rtol."""
        return bool(self.error[-1] <= self.rtol * self.size)

    @property
    def size(self) -> float:
        """Largest |c|."""
        return float(abs(self._fine.c).max())

    @property
    def smallest(self) -> float:
        """Smallest c."""
        return float(self._fine.c.min())

    @property
    def largest(self) -> float:
        """Largest c."""
        return float(self._fine.c.max())

    @cached_property
    def cycles(self) -> Cycles:
        """Period, amplitude, phase gradient and drift of each cycle."""
        return cycles_of(self._fine, self.body)

    @property
    def repeats(self) -> bool:
        """Whether the last two cycles differ by no more than the error of c, or rtol."""
        drift = self.cycles.drift
        return bool(drift.size > 1 and drift[-1] <= max(self.rtol * self.size, 2 * self.error[-1]))

    @property
    def period(self) -> float:
        """Duration of the last cycle, without feedback; `until` where there is none."""
        cycles = self.alone.cycles
        return float(cycles.period[-1]) if cycles.count else self.until

    @property
    def known(self) -> float:
        """Time for which c is known, from 0 on."""
        return self.until

    def value(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """c; x, y, t broadcast, 0 <= t <= until. The body is known: `length` has no effect."""
        return self._fine.value(x, y, t)

    def rate(self, x: ArrayLike, y: ArrayLike, t: ArrayLike, length: float = 1.0) -> Array:
        """dc/dt likewise."""
        return self._fine.rate(x, y, t)

    def on(self, sheet: Sheet, places: Places | None = None) -> ExcitationDrive | FeedbackDrive:
        """The wave on a body within that rectangle, which must be the one that it was solved on."""
        if self.equation.acts_back:
            return FeedbackDrive(self, sheet, places)
        return ExcitationDrive(self, sheet, places)

    def check_repeats(self) -> None:
        """Raise ValueError unless the last two cycles are alike."""
        if not self.repeats:
            raise ValueError(
                f"wave: {self.cycles.in_words(False, self.body.length)}; a mean over one period has no "
                "meaning: take `speeds` for a speed of each cycle, or solution.periodic() for the orbit"
            )

    def check_until(self, end: float) -> None:
        """Raise ValueError unless c is known up to that time."""
        if end <= self.until * (1 + 1e-9):
            return
        if not self.alone.cycles.count:
            raise ValueError(
                f"until = {self.until:g}: must be longer (at most {LONGEST:g}), c has no whole cycle "
                "by then"
            )
        raise ValueError(
            f"until = {self.until:g}: must be >= {end:.6g}, up to which the wave must be known, with "
            f"periods of {self.period:.4g}"
        )

    def cycle(self, k: int) -> CycleWave:
        """The wave of cycle k (0, 1, ..., or -1 for the last) alone, from t = 0 to its duration."""
        count = self.cycles.count
        if not -count <= validation.integer("k", k) < count:
            raise ValueError(f"k = {k}: must be one of the {count} cycles, {-count} to {count - 1}")
        return CycleWave(self, float(self.cycles.start[k]), float(self.cycles.period[k]), k % count)

    def identified_by(self) -> object:
        """What its content key is made of."""
        return self._contents()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Solution):
            return NotImplemented
        return self is other or content_key(self) == content_key(other)

    def __hash__(self) -> int:
        return hash((self.equation, self.until))

    def __getstate__(self) -> dict[str, Any]:
        """Without what was found: a copy solves again."""
        return {name: getattr(self, name) for name in self._contents()}

    def _contents(self) -> Mapping[str, Any]:
        names = ("equation", "body", "until", "rtol", "method")
        return {name: getattr(self, name) for name in names}

    def _title(self) -> str:
        if self.equation.acts_back:
            return f"{type(self).__name__}: solved together with a sheet, which acts back on it"
        if "_pair" not in self.__dict__:
            return f"{type(self).__name__}: not solved yet"
        return f"{type(self).__name__}: {self.cycles.in_words(self.repeats, self.body.length)}"

    def _rows(self) -> Mapping[str, Any]:
        rows = dict(self._contents())
        if "_pair" in self.__dict__:
            met = "" if self.converged else ", rtol NOT met"
            rows["c"] = f"{number(self.smallest)} ... {with_error(self.largest, self.error[-1])}{met}"
            rows["cycles"] = self.cycles
        return rows

    def _solved_pair(self, size: float) -> Pair:
        assert self.method is not None
        fine = self._solved(size, self.method)
        coarse = self._solved(2 * size, self.method.coarser())
        return Pair(fine, coarse, difference(fine, coarse), size)

    def _solved(self, size: float, method: Method) -> Record:
        system = System(self.equation, self.body, self._space(size))
        times = kept_times(self.until)
        if times.size * system.space.size > MOST_NUMBERS:
            raise NotConvergedError(
                f"the excitable wave needs {times.size} times and {system.space.size} nodes, must be "
                f"<= {MOST_NUMBERS} numbers; ask for a shorter time `until` or a larger rtol",
                best=None,
            )
        return Record(system, times, method.states(system, times, system.first, self.rtol))

    def _space(self, size: float) -> Space:
        return Space.on(self.body, size, self.equation.start.depends_on_x)


def time_of(name: str, value: object) -> float:
    """A time until which a wave is solved: > 0 and within reach."""
    found = validation.positive(name, value)
    if found > LONGEST:
        raise ValueError(f"{name} = {found:g}: must be in (0, {LONGEST:g}], in units of the equation")
    return found


def difference(fine: Record, coarse: Record) -> Array:
    """Largest difference of c at each kept time: at nodes of both and at points between, (T,)."""
    xs, ys = zip(_points(fine), fine.space.nodes, coarse.space.nodes, strict=True)
    x, y = np.concatenate(xs), np.concatenate(ys)
    largest = np.zeros(fine.times.size)
    one, other = fine.space.weights(x, y), coarse.space.weights(x, y)
    for i in range(fine.times.size):
        apart = _at(fine.c[i], *one) - _at(coarse.c[i], *other)
        largest[i] = abs(apart).max()
    return largest


def _points(record: Record) -> Places:
    body, space = record.system.body, record.space
    if isinstance(body, Sheet):
        x, y = on_sheet(body)
        return x[:CHECKS], y[:CHECKS]
    x, y = among(*space.mesh.p[:, space.mesh.t].mean(1))
    return x[:CHECKS], y[:CHECKS]


def _at(values: Array, nodes: NDArray[np.int64], shares: Array) -> Array:
    return np.asarray(np.einsum("kn,kn->n", shares, values[nodes]))
