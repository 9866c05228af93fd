"""Measured errors and times of every level of the theory, with ratios; nothing is asserted.

    python -m figures.bench      (or `make bench`, which also asks for one thread)

Errors are relative L2 errors of the displacement at the worst phase, against a solution by another
method: Ritz for the Airy series, the series for Ritz and finite elements. Times are medians.
"""

import io
import os
import platform
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from fem_check.plane_stress import plane_stress_field
from linear_theory import Sheet, SineWave, airy_series, crawl_speed, line_speed, ritz_field
from linear_theory.field import LinearField

Array = NDArray[np.float64]

TOLERANCES = (1e-3, 1e-5, 1e-7, 1e-9)

QUOTED = {
    "NGSolve": (0.9, 4.5, 19.0, 92.0),
    "numpy Ritz": (0.7, 1.0, 8.6, 105.0),
    "FEniCSx": (3.0, 14.0, 36.0, 283.0),
    "scikit-fem": (11.0, 83.0, 325.0, 3800.0),
}
"""Milliseconds of one solve for TOLERANCES: quoted, from another run on another machine."""

PHASES = 8
"""Times in a period at which the displacement is compared."""

POINTS = (40, 80)
"""Gauss points across and along the sheet at which it is compared."""

LINE_ALPHAS = 1_000_000
SPEED_ALPHA = 0.25
PATIENCE = 0.4
"""Seconds for the repeats of one measurement, of which there are at least three."""


@dataclass(frozen=True)
class Level:
    """One way to the displacement: how to solve, and by what to judge the error."""

    method: str
    setting: str
    solve: Callable[[], LinearField]
    reference: str


def levels(sheet: Sheet, wave: SineWave) -> Iterator[Level]:
    """All that is compared."""
    series, elements = partial(airy_series, sheet, wave), partial(plane_stress_field, sheet, wave)
    for rtol in TOLERANCES:
        yield Level("Airy, tails", f"rtol {rtol:g}", partial(series, rtol=rtol), "ritz")
    for modes in (10, 20, 40, 160):
        yield Level("Airy, tails", f"{modes} modes", partial(series, modes=modes), "ritz")
    for modes in (20, 80, 320):
        yield Level("Airy, plain", f"{modes} modes", partial(series, modes=modes, tail=False), "ritz")
    for rtol in TOLERANCES:
        yield Level("Ritz", f"rtol {rtol:g}", partial(ritz_field, sheet, wave, rtol=rtol), "airy")
    for degree, cells in ((2, (8, 16, 32)), (4, (4, 8, 16))):
        for n in cells:
            solve = partial(elements, degree=degree, size=sheet.length / n)
            yield Level(f"FEM, P{degree}", f"size L/{n}", solve, "airy")


class Judge:
    """Relative L2 errors of a displacement at the worst phase, against solutions by two methods."""

    def __init__(self, sheet: Sheet, wave: SineWave) -> None:
        nodes = [np.polynomial.legendre.leggauss(n) for n in POINTS]
        self._x = sheet.width / 2 * nodes[0][0][:, None, None]
        self._y = sheet.length / 2 * nodes[1][0][:, None]
        self._t = wave.period * np.arange(PHASES) / PHASES
        self._weights = np.multiply.outer(nodes[0][1], nodes[1][1])
        self.references = {
            "ritz": ritz_field(sheet, wave, degree=101),
            "airy": airy_series(sheet, wave, modes=400),
        }
        self._values = {name: self._at(field) for name, field in self.references.items()}

    def error(self, field: LinearField, reference: str) -> float:
        """Of `field` against the reference of that name."""
        exact = self._values[reference]
        return float(np.max(self._norms(self._at(field) - exact) / self._norms(exact)))

    def disagreement(self) -> float:
        """Of the two references: below it, errors mean nothing."""
        return self.error(self.references["airy"], "ritz")

    def _at(self, field: LinearField) -> Array:
        return field.displacement(self._x, self._y, self._t)

    def _norms(self, values: Array) -> Array:
        """L2 norm over the sheet at each phase."""
        return np.asarray(np.sqrt(np.einsum("cxyt,xy->t", values**2, self._weights)))


def median_seconds(call: Callable[[], object], patience: float = PATIENCE) -> float:
    """Median time of at least three calls, after one that is not counted."""
    call()
    found: list[float] = []
    while len(found) < 3 or (sum(found) < patience and len(found) < 101):
        start = time.perf_counter()
        call()
        found.append(time.perf_counter() - start)
    return float(np.median(found))


def best_quoted(error: float) -> float:
    """Milliseconds that the best of the quoted codes needs for an error, interpolated in logarithms."""
    best = np.min(list(QUOTED.values()), axis=0)
    at = np.interp(-np.log(error), -np.log(TOLERANCES), np.log(best))
    return float(np.exp(at))


def print_displacements(sheet: Sheet, wave: SineWave) -> None:
    """Error against time of one solve, and how many times faster than the best quoted code."""
    judge = Judge(sheet, wave)
    print(
        f"Displacement, one solve (set-up and solution); references agree to {judge.disagreement():.1e}"
    )
    print(f"{'method':<14}{'setting':<14}{'error':>10}{'claimed':>10}{'ms':>10}{'quoted/ms':>11}")
    for level in levels(sheet, wave):
        field = level.solve()
        error = judge.error(field, level.reference)
        ms = 1e3 * median_seconds(level.solve)
        ratio = best_quoted(error) / ms
        print(
            f"{level.method:<14}{level.setting:<14}{error:10.1e}{field.error:10.1e}{ms:10.2f}{ratio:11.2f}"
        )
    print("\nquoted/ms: time of the best quoted code at the same error over the time measured here")
    print("(beyond the ends of the table below: at its end). Rows with rtol include the search for the")
    print("resolution and the estimate of the error ('claimed'); the others only the solution.")
    print("Quoted, not measured here (another run, another machine), ms for one solve:")
    print(f"{'error':<14}" + "".join(f"{tolerance:>10.0e}" for tolerance in TOLERANCES))
    for name, times in QUOTED.items():
        print(f"{name:<14}" + "".join(f"{ms:>10.1f}" for ms in times))


def print_speeds(sheet: Sheet, wave: SineWave) -> None:
    """Times of the speeds, and of their levels against each other."""
    print("\nSpeed")
    alphas = np.linspace(-0.99, 0.99, LINE_ALPHAS)
    line = median_seconds(lambda: line_speed(alphas))
    print(
        f"1D closed form, {LINE_ALPHAS:,} alphas: {line:.3f} s, {1e9 * line / LINE_ALPHAS:.0f} ns each"
    )
    for rtol in (1e-3, 1e-6):
        found = crawl_speed(sheet, wave, SPEED_ALPHA, rtol=rtol)
        seconds = median_seconds(partial(crawl_speed, sheet, wave, SPEED_ALPHA, rtol=rtol))
        times_line = seconds / line * LINE_ALPHAS
        print(
            f"2D crawl_speed, alpha = {SPEED_ALPHA:g}, rtol {rtol:g}: {1e3 * seconds:.0f} ms, "
            f"V = {found.mean:.8f} +- {found.error:.1e} L/T, {times_line:.1e} times one alpha in 1D"
        )


def print_process() -> None:
    """Import time and peak memory, each in a process of its own."""
    timed = "import time; t = time.perf_counter(); import linear_theory; print(time.perf_counter() - t)"
    seconds = min(float(_output(timed)) for _ in range(3))
    print(f"\nimport linear_theory: {seconds:.2f} s (best of 3)")
    memory = (
        "import resource; from linear_theory import Sheet, SineWave, crawl_speed; "
        f"crawl_speed(Sheet(), SineWave(), {SPEED_ALPHA}, rtol=1e-6); "
        "print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
    )
    unit = 1 if sys.platform == "darwin" else 1024  # bytes there, kilobytes elsewhere
    print(f"peak memory of crawl_speed at rtol 1e-6: {int(_output(memory)) * unit / 1e6:.0f} MB")


def _output(code: str) -> str:
    """What a fresh interpreter prints."""
    run = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    return run.stdout


def print_machine() -> None:
    """What the times belong to."""
    threads = os.environ.get("OMP_NUM_THREADS", "as many as the BLAS likes (OMP_NUM_THREADS not set)")
    print(f"{platform.platform()}, {platform.machine()}, {os.cpu_count()} processors")
    print(f"Python {platform.python_version()}, numpy {np.__version__}, threads: {threads}\n")


def main() -> None:
    """Print all tables."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(line_buffering=True)  # rows show as they come, in a log as well
    sheet, wave = Sheet(), SineWave()
    print_machine()
    print_displacements(sheet, wave)
    print_speeds(sheet, wave)
    print_process()


if __name__ == "__main__":
    main()
