"""Measured errors, times and memory of the sheet that bends, with ratios; nothing is asserted.

    python -m figures.measure.bench.shell      (or `make bench-shell`, which also asks for one thread)

A minute. What the planar levels and the single effects cost, `make cost` tells. Errors are against
finer runs, of another element where there is one. The sheet is that of the paper: 2 : 1, h = 0.03,
nu = 1/2; lengths in L, times in periods.
"""

import io
import multiprocessing
import resource
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.depth import laid_down
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.material import Material
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.linear_solver import factorise
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.ramp import ramp
from fem_check.shell.stepping.simulation import simulate
from figures.common.output import Progress
from figures.common.scenes import shell_scene
from figures.measure.meters import RSS_UNIT, machine, timed
from linear_theory import Sheet, SineWave
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

SHEET, WAVE = Sheet(), SineWave()
MATERIAL = Material(SHEET.thickness, SHEET.poisson)
WEIGHT, STIFFNESS = Gravity(2.5e-4), Ground(0.5)
MEMBRANE, BENDING = Membrane(MATERIAL), Bending(MATERIAL)
SHELL = (MEMBRANE, BENDING)
LYING = (*SHELL, WEIGHT, STIFFNESS)

QUOTED = {"libshell (C++)": (110, 170), "Kratos IGA": (560, 560), "NGSolve HHJ": (1800, 10800)}
"""Milliseconds of one Newton step, least and most: quoted, from another run on another machine."""

ALPHA, COUPLING = 0.1, 3.0
"""Growth and curvature coupling of the sheets that bend."""

MESHES = {"BFS": (4, 8, 16), "Argyris": (2, 4, 8)}
"""Elements (pairs of triangles) across the width, twice as many along."""
REFERENCES = {"BFS": ("Argyris", 12), "Argyris": ("BFS", 24)}
POINTS = 21
"""Points across and along at which positions are compared."""

NEARLY = 0.98
"""Share of the growth whose shape is the start of the iterations that are timed."""

PATIENCE = 0.2
"""Seconds for the repeats of one measurement."""

PERIOD_ALPHA, PERIOD_COUPLING, PERIOD_SLIP = 0.02, 2.0, 0.0035
"""A bilayer (beta = 100 alpha) that bends without snapping over, and a slip speed that makes it dry."""

PERIODS: tuple[tuple[tuple[int, int], int | None], ...] = (
    ((3, 6), 64),
    ((4, 8), 32),
    ((4, 8), 64),
    ((4, 8), 128),
    ((6, 12), 64),
    ((4, 8), None),
)
"""Cells and steps per period; None: chosen for an error of 1 %."""
FINE: tuple[tuple[int, int], int] = ((8, 16), 128)

STAGES = 1 + len(PERIODS) + 12
Advance = Callable[[], None]


def bent(element: str, across: int, effects: Sequence[Effect]) -> Scene:
    """The bending sheet on a uniform mesh of that element."""
    return shell_scene(element, across, SHEET, WAVE, ALPHA, COUPLING, effects)


class Static:
    """The static shape of a scene at t = 0, and what one of its Newton iterations costs."""

    def __init__(self, scene: Scene) -> None:
        self.model = ShellModel(scene)
        self.sheet = self.model.discretisation
        self.supports = Supports(self.sheet).anchor(motions=held_motions(scene))
        self.minimiser = Minimiser(self.supports)
        self.result = ramp(self.minimiser, self.problem, laid_down(self.model), follow=1e-3)

    def problem(self, share: float) -> Potential:
        """Energy at a share of the growth."""
        return self.model.potential(self.model.rest(0.0, share))

    def positions(self) -> Array:
        """Of a grid of points, (3, points)."""
        share = np.linspace(-0.98, 0.98, POINTS) / 2
        grid = np.stack(np.meshgrid(share * SHEET.width, share * SHEET.length)).reshape(2, -1)
        return np.asarray(self.sheet.points(grid).position(self.result.state, (0,))[0])

    def iteration(self, keep_factor: bool = False) -> float:
        """Median seconds of an iteration on the way from nearly all of the growth to all of it."""
        start = self.minimiser.minimise(self.problem(NEARLY), self.result.state).state
        potential, found = self.problem(1.0), []
        minimiser = Minimiser(self.supports, keep_factor=keep_factor, check_stability=False)
        for _ in range(6):
            minimiser.kept = None
            result = minimiser.minimise(potential, start)
            found.append(result.seconds / result.iterations)
        return float(np.median(found[1:]))  # the first does the symbolic work

    def parts(self) -> tuple[float, float, float]:
        """Seconds of a gradient, a Hessian (assembled) and a factor."""
        potential, u, sparsity = self.problem(1.0), self.result.state, self.minimiser.sparsity
        values = sparsity.assemble(potential.hessian_blocks(u))
        return (
            timed(partial(potential.energy_and_gradient, u), PATIENCE).median,
            timed(lambda: sparsity.assemble(potential.hessian_blocks(u)), PATIENCE).median,
            timed(partial(factorise, sparsity, values), PATIENCE).median,
        )


def held_motions(scene: Scene) -> str:
    """Rigid motions that nothing but a support holds."""
    return "xyz" if scene.find(Ground) is None else "xy"


def relative(found: Array, exact: Array) -> float:
    """Relative L2 difference."""
    return float(np.linalg.norm(found - exact) / np.linalg.norm(exact))


def print_statics(name: str, effects: Sequence[Effect], advance: Advance) -> dict[str, float]:
    """Error and cost of the static shape on all meshes; ms per iteration by element and mesh."""
    exact = {e: Static(bent(*REFERENCES[e], effects)).positions() for e in MESHES}
    doubt = relative(exact["BFS"], exact["Argyris"])
    print(f"\n1. Static {name}, alpha 0.1, beta 3, t = 0; references agree to {doubt:.1e}")
    print("aims: error 1e-3 at 10 ms an iteration, exponent 1.5; kept: factor kept while it serves")
    print(
        f"{'mesh':<16}{'unknowns':>9}{'error':>9}{'iter.':>6}{'ms/it.':>8}{'10 ms/it.':>10}"
        f"{'kept':>7}{'gradient':>9}{'Hessian':>8}{'factor':>7}"
    )
    found: dict[str, float] = {}
    for element, counts in MESHES.items():
        rows = []
        for across in counts:
            label = f"{element} {across}x{2 * across}" + ("x2" if element == "Argyris" else "")
            rows.append(print_static(label, Static(bent(element, across, effects)), exact[element]))
            found[label] = rows[-1][1]
            advance()
        print_exponents(element, np.array(rows))
    return found


def print_static(label: str, static: Static, exact: Array) -> tuple[float, float]:
    """One row; unknowns and ms per iteration."""
    error, ms = relative(static.positions(), exact), 1e3 * static.iteration()
    kept = 1e3 * static.iteration(keep_factor=True)
    gradient, hessian, factor = (1e3 * seconds for seconds in static.parts())
    print(
        f"{label:<16}{static.sheet.size:>9}{error:9.1e}{static.result.iterations:>6}{ms:8.1f}"
        f"{10 / ms:10.2f}{kept:7.1f}{gradient:9.2f}{hessian:8.1f}{factor:7.2f}"
    )
    return static.sheet.size, ms


def print_exponents(element: str, rows: Array) -> None:
    """Growth of the cost of an iteration with the unknowns; rows (n, 2)."""
    size, ms = np.log(rows.T)
    whole, last = np.polyfit(size, ms, 1)[0], np.diff(ms[-2:])[0] / np.diff(size[-2:])[0]
    print(f"  {element}: ms/it. ~ unknowns^{whole:.2f} (last two meshes: ^{last:.2f})")


class Run(NamedTuple):
    """What one stepped period gave and cost; error as claimed, memory in MB."""

    unknowns: int
    mean: float
    error: float
    seconds: float
    steps: int
    iterations: int
    snapped: int
    memory: float


def stepped(cells: tuple[int, int], steps: int | None) -> Run:
    """The bending sheet on the ground: ramp of half a period and one period, in this process."""
    effects = (*LYING, Friction(1.0, PERIOD_SLIP))
    scene = Scene(SHEET, WAVE, PERIOD_ALPHA, PERIOD_COUPLING, effects, cells=cells)
    run = simulate(scene, periods=1, steps=steps, rtol=None if steps else 1e-2)
    return Run(
        run.model.discretisation.size,
        run.speed.mean,
        run.speed.error,
        run.seconds,
        run.times.size - 1,
        run.iterations,
        int(run.snapped.sum()),
        resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * RSS_UNIT / 1e6,
    )


def stepped_runs(advance: Advance) -> list[Run]:
    """All of PERIODS and then FINE, each in a process of its own, for its memory.

    To be called first: a process starts with the peak memory of the one that made it.
    """
    runs = []
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, mp_context=context, max_tasks_per_child=1) as pool:
        for cells, steps in (*PERIODS, FINE):
            runs.append(pool.submit(stepped, cells, steps).result())
            advance()
    return runs


def print_periods(runs: Sequence[Run]) -> None:
    """Accuracy against time of one stepped period."""
    exact = runs[-1].mean
    print("\n2. Bending, on the ground, with friction: ramp (1/2 period) and one period, stepped")
    given = f"alpha {PERIOD_ALPHA:g}, beta {PERIOD_COUPLING:g}, v0 {PERIOD_SLIP:g}"
    print(f"{given}; last row: what errors are measured against")
    print("aims: 1 % of V, 20 s, 15-30 ms a step, 1 GB; snapped: steps at which it snaps over")
    print(
        f"{'cells':<7}{'steps':>6}{'unknowns':>9}{'V':>10}{'error':>9}{'claimed':>9}{'s':>7}"
        f"{'20 s/s':>7}{'ms/step':>9}{'it./step':>9}{'snapped':>8}{'MB':>6}{'1 GB/MB':>8}"
    )
    for (cells, steps), run in zip((*PERIODS, FINE), runs, strict=True):
        print(
            f"{cells[0]}x{cells[1]:<5}{steps or '1e-2':>6}{run.unknowns:>9}{run.mean:10.5f}"
            f"{abs(run.mean / exact - 1):9.1e}{run.error / abs(run.mean):9.1e}{run.seconds:7.2f}"
            f"{20 / run.seconds:7.1f}{1e3 * run.seconds / run.steps:9.1f}"
            f"{run.iterations / run.steps:9.1f}{run.snapped:>8}{run.memory:6.0f}"
            f"{1e3 / run.memory:8.1f}"
        )


def print_quoted(found: dict[str, float]) -> None:
    """Other codes beside two meshes of the free sheet."""
    columns = ("BFS 8x16", "BFS 16x32", "Argyris 8x16x2")
    print("\n3. One Newton step of other codes: quoted, not measured here (another machine, another")
    print(
        "problem, 3 720 triangles or 32 x 62 control points); ratios to an iteration of the free sheet"
    )
    print(f"{'code':<18}{'ms':>12}" + "".join(f"{'/ ' + name:>18}" for name in columns))
    for name, (least, most) in QUOTED.items():
        ratios = [span_of(least / found[c], most / found[c]) for c in columns]
        print(f"{name:<18}{span_of(least, most):>12}" + "".join(f"{ratio:>18}" for ratio in ratios))


def span_of(least: float, most: float) -> str:
    """Both in words, or the one that they are."""
    return f"{least:.0f}" if least == most else f"{least:.0f}-{most:.0f}"


def main() -> None:
    """Print all tables."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        sys.stdout.reconfigure(line_buffering=True)  # rows show as they come, in a log as well
    print(machine())
    with Progress("bench_shell", STAGES) as progress:
        runs = stepped_runs(progress.advance)
        free = print_statics("free sheet", SHELL, progress.advance)
        print_statics("sheet on the ground", LYING, progress.advance)
        print_periods(runs)
        print_quoted(free)


if __name__ == "__main__":
    main()
