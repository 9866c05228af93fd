"""The best growth and curvature of a bent sheet, by `optimise` and by a scan; a row of `scan`."""

import itertools
import time
import warnings

import numpy as np

from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane, Scene, optimise, solve
from figures.measure.optimise.rows import Row, told
from linear_theory import Sheet, SineWave
from linear_theory.common.errors import ViscousRegimeWarning
from linear_theory.optimisation.search import Ascent
from linear_theory.speed.result import CrawlSpeed

QUESTION = "alpha and beta, against the wave, paper's ground, viscous, second order"

BOUNDS = {"growth.alpha": (0.002, 0.03), "growth.curvature_coupling": (0.05, 0.4)}
"""Within contact with the ground."""

PLACES = 8
"""Of each."""

LEVEL, RTOL, STARTS = "second order", 1e-3, 2


def scene(alpha: float = 0.01, beta: float = 0.2) -> Scene:
    """The paper's sheet on its ground, which bends; a slip speed so large that friction is viscous."""
    material = Material(0.03, 0.5)
    ground = Gravity(2.5e-4), Ground(0.5), Friction(1e-3, slip_speed=1e3)
    effects = (Membrane(material), Bending(material), *ground)
    return Scene(Sheet(), SineWave(), alpha, beta, effects, cells=(4, 8))


def speed_at(alpha: float, beta: float) -> CrawlSpeed:
    """V of the scene."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ViscousRegimeWarning)  # it is meant to be viscous
        return solve(scene(alpha, beta), LEVEL, RTOL).speed


def row() -> Row:
    """Of the table."""
    begin = time.process_time()
    found = optimise(
        scene(),
        BOUNDS,
        "speed towards -y",
        level=LEVEL,
        rtol=RTOL,
        starts=STARTS,
        how=Ascent(change=1e-5),
        check=False,
    )
    middle = time.process_time()
    grids = [np.linspace(*ends, PLACES) for ends in BOUNDS.values()]
    answers = {
        place: solve(scene(*map(float, place)), LEVEL, RTOL) for place in itertools.product(*grids)
    }
    best = min(answers, key=lambda place: answers[place].mean)
    speed = answers[best].speed
    return Row(
        question=QUESTION,
        names=" ".join(BOUNDS),
        found=told([found.values[name] for name in BOUNDS]),
        scanned=told(best),
        spacing=told([grid[1] - grid[0] for grid in grids]),
        value=found.value.value,
        error=found.value.error,
        scan_value=-speed.mean,
        scan_error=speed.error,
        ended=found.agreed,
        evaluations=found.answers,
        places=PLACES ** len(grids),
        seconds=middle - begin,
        scan_seconds=time.process_time() - middle,
    )
