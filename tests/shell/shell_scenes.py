"""Scenes of the tests that step through time."""

import numpy as np

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.material import Material
from linear_theory import FieldWave, Sheet, SineWave
from linear_theory.scene.scene import Scene

PAPER = Sheet()
MATERIAL = Material(PAPER.thickness, PAPER.poisson)
WEAK = 1e-4 * PAPER.thickness
"""Weight per area for which friction (mu = 1) is 1e-4 of the stiffness, mu weight L/(E h)."""
WEIGHT, STIFFNESS = 2.5e-4, 0.5
"""The paper's weight and ground."""


def planar(
    alpha: float = 0.25,
    wave: object = None,
    slip: float = 1e-3,
    load: str = "current",
    weight: float = WEAK,
    extra: tuple[Effect, ...] = (),
    **options: object,
) -> Scene:
    """The paper's sheet in the plane under weak friction with mu = 1."""
    effects = (Membrane(MATERIAL), Gravity(weight, load), Friction(1.0, slip), *extra)
    return Scene(PAPER, wave or SineWave(), alpha, effects=effects, **options)


def lying(
    alpha: float = 0.02,
    bending: float = 2.0,
    slip: float = 0.1,
    damping: float = 0.0,
    load: str = "grown",
    cells: tuple[int, int] = (3, 6),
    **options: object,
) -> Scene:
    """The paper's bilayer (beta = 100 alpha) under its weight on the ground."""
    effects = (
        Membrane(MATERIAL),
        Bending(MATERIAL),
        Gravity(WEIGHT, load),
        Ground(STIFFNESS, damping, load),
        Friction(1.0, slip),
    )
    return Scene(PAPER, SineWave(), alpha, bending, effects, cells=cells, **options)


def pulsating(profile: object) -> FieldWave:
    """A standing wave, profile(y) cos 2 pi t."""
    return FieldWave(lambda x, y, t: profile(y) * np.cos(2 * np.pi * t) + 0 * x, 1.0)
