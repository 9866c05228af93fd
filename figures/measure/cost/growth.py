"""How cost grows with the work: modes, degree, unknowns, waves on the sheet, scenes."""

from collections.abc import Callable, Iterator, Sequence
from functools import partial

import numpy as np

from fem_check.plane_stress.field import PlaneStressField
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.material import Material
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.linear_solver import factorise
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.sparsity import Sparsity
from figures.common.scenes import shell_scene
from figures.measure.cost.cases import LINE, P2, P4, PLAIN, RITZ, SHEET, TAIL, WAVE, Case, elements
from linear_theory import SineWave, airy_series, crawl_speed, field_speed, line_speed, ritz_field

PANEL = "growth"

MODES = (10, 30, 100, 300, 1000, 2000)
DEGREES = (11, 21, 41, 81, 161)
CELLS = {P2: (8, 16, 32, 64), P4: (4, 8, 16, 32)}
SHELLS = {"shell BFS": (4, 8, 16), "shell Argyris": (2, 4, 8)}
"""Elements (pairs of triangles) across the width, twice as many along."""

WAVES, WAVES_RTOL = (1, 2, 4, 8, 16, 32), 1e-6
BALANCED_WAVES, BALANCE_RTOL = (1, 2, 4, 8), 1e-2
SCENES = (1, 2, 4, 8)
LINES = (1, 10, 100, 1000, 10_000, 100_000, 1_000_000)

BALANCE = "small-strain balance"
ALPHA = 0.1

QUICK = 3
"""Points of each row that belong to the short run: the first ones."""


def cases() -> Iterator[Case]:
    """All rows, each from little to much work."""
    for rows in (_solutions(), _waves(), _scenes(), _shells()):
        for level, knob, values in rows:
            for i, (value, solve) in enumerate(values):
                yield Case(PANEL, level, knob, value, solve, quick=i < QUICK)


Row = tuple[str, str, Sequence[tuple[float, Callable[[], object]]]]


def _solutions() -> Iterator[Row]:
    """One displacement field, by the size of its basis."""
    for level, tail in ((PLAIN, False), (TAIL, True)):
        series = partial(airy_series, SHEET, WAVE, tail=tail)
        yield level, "modes", [(n, partial(series, modes=n)) for n in MODES]
    yield RITZ, "degree", [(n, partial(ritz_field, SHEET, WAVE, degree=n)) for n in DEGREES]
    for level, counts in CELLS.items():
        solves = [elements(level, n) for n in counts]
        yield level, "unknowns", [(_unknowns(solve), solve) for solve in solves]


def _unknowns(solve: Callable[[], PlaneStressField]) -> int:
    """Of the finite elements of a field: two at each node on vertices, edges and triangles."""
    field = solve()
    mesh, inner = field.mesh, field.degree - 1
    nodes = mesh.nvertices + inner * mesh.nfacets + inner * (inner - 1) // 2 * mesh.nelements
    return 2 * int(nodes)


def _waves() -> Iterator[Row]:
    """The same tolerance for more waves on the sheet."""
    for level, method in ((TAIL, airy_series), (RITZ, ritz_field)):
        solves = [(n, partial(method, SHEET, SineWave(n), rtol=WAVES_RTOL)) for n in WAVES]
        yield level, "waves", solves
    balances = [
        (n, partial(crawl_speed, SHEET, SineWave(n), ALPHA, rtol=BALANCE_RTOL)) for n in BALANCED_WAVES
    ]
    yield BALANCE, "waves", balances


def _scenes() -> Iterator[Row]:
    """Many couplings alpha: at once where the level takes an array, one by one otherwise."""
    yield LINE, "scenes", [(n, partial(line_speed, np.linspace(0, 0.9, n))) for n in LINES]
    field = airy_series(SHEET, WAVE, rtol=0.1 * BALANCE_RTOL)

    def many(count: int) -> None:
        for alpha in np.linspace(0.05, ALPHA, count):
            field_speed(field, float(alpha), rtol=BALANCE_RTOL)

    yield BALANCE, "scenes", [(n, partial(many, n)) for n in SCENES]


def _shells() -> Iterator[Row]:
    """One Newton iteration of a free shell: gradient, Hessian, factor and solution."""
    for level, counts in SHELLS.items():
        iterations = [NewtonIteration(level, across) for across in counts]
        yield level, "unknowns", [(it.potential.discretisation.size, it) for it in iterations]


class NewtonIteration:
    """An iteration at the flat, ungrown shape, where the Hessian is positive definite."""

    def __init__(self, level: str, across: int) -> None:
        material = Material(SHEET.thickness, SHEET.poisson)
        effects = (Membrane(material), Bending(material))
        scene = shell_scene(level.split()[1], across, SHEET, WAVE, ALPHA, 0.0, effects)
        model = ShellModel(scene)
        supports = Supports(model.discretisation).anchor()
        self.potential: Potential = model.potential(model.rest(0.0, 0.0))
        self.sparsity = Sparsity(model.discretisation, supports.free)
        self.start = np.zeros(model.discretisation.size)

    def __call__(self) -> object:
        """One correction, of nothing."""
        _, gradient = self.potential.energy_and_gradient(self.start)
        values = self.sparsity.assemble(self.potential.hessian_blocks(self.start))
        factor = factorise(self.sparsity, values)
        assert factor is not None
        return factor.solve(gradient[self.sparsity.order])
