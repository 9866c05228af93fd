"""What the answer to a scene will cost, before it is sought."""

import math

from fem_check.choice.settings import RTOL, RunSettings
from fem_check.choice.ways import THEORIES
from fem_check.shell.effects.contact.self_contact import SelfContact
from fem_check.shell.model import ShellModel
from linear_theory.scene.scene import Scene
from linear_theory.wave.uncertain import uncertainty_of

RAMP = 0.5
"""Periods in which growth rises before those that are counted, of `simulate`."""

PRICES = {"strip": 0.006, "line": 0.006, "first order": 0.09, "second order": 0.13}
"""Processor seconds of a level of `predict` for the paper's sheet to 2 %, to a factor of 5."""

PLATE = 0.3
"""Of "second order" for a sheet that bends: 0.05 to 1.5 by wave and tolerance."""

RECTANGLES, TRIANGLES, IN_SPACE, STEP = 1.2e-3, 4e-3, 3e-3, 75e-6
"""Seconds of a cycle of shapes to a quadrature point, of planar rectangles, of planar triangles and of
sheets that bend; and of a step in time. Measured on the scenes of the gallery, to a factor of 3."""

TIGHTER = 0.35
"""Power of 1 % over the tolerance with which a cycle grows: 0.6, 2, 12 s of the paper's sheet at 1e-2,
1e-4 and 1e-6."""

UNCERTAIN = 8.0
"""Factor of a cycle for a wave with an error of its own, from measured samples or an equation: speeds
of others that could be the true one, and what they leave of the tolerance."""

CURLED, IN_CONTACT = 4.0, 20.0
"""Angle to which a sheet bends beyond which it may touch itself, and the factor of a step in time then,
its second run with another gap included: 13 to 125 on strips that roll up."""

STEPS = 20
"""In time, to a period, at a tolerance of 10 %; they grow with its square root."""


def expected_seconds(scene: Scene, way: str, settings: RunSettings) -> float:
    """What the answer will cost on one core, to a factor of about 5; of `predict` at the most.

    way: as `way_of` names it for these settings.

    >>> from fem_check.choice.expected import expected_seconds
    >>> from fem_check.choice.settings import RunSettings
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.25)
    >>> quick, slow = (expected_seconds(scene, way, RunSettings()) for way in ("strip", "cycle"))
    >>> print(quick < slow)
    True
    """
    bends = not scene.planar
    if way in THEORIES:
        return PLATE if bends else PRICES[way]
    points = ShellModel(scene).discretisation.interior.measure.size
    rtol = settings.rtol or RTOL
    if way != "stepped":
        triangles = scene.mesh is not None and scene.mesh.t.shape[0] == 3
        price = IN_SPACE if bends else TRIANGLES if triangles else RECTANGLES
        tried = PLATE if bends and way == "predict" else 0.0
        doubts = 1.0 if uncertainty_of(scene.wave) is None else UNCERTAIN
        return float(doubts * price * points * max(1.0, 1e-2 / rtol) ** TIGHTER + tried)
    count = settings.steps or STEPS * math.sqrt(0.1 / rtol) * _highest(scene)
    touching = IN_CONTACT if _touches(scene) else 1.0
    return float(touching * STEP * points * count * (settings.periods + RAMP))


def _touches(scene: Scene) -> bool:
    """Whether contact of the sheet with itself is likely to be more than looked for."""
    if scene.find(SelfContact) is None:
        return False
    angle = abs(scene.curvature_coupling) * scene.sheet.length * abs(scene.extremes).max()
    return bool(angle > CURLED)


def _highest(scene: Scene) -> float:
    """Harmonics in time to which steps in time are fine, 1 for a sine."""
    highest = scene.drive.rates.highest(0.1)
    return min(max(float(highest), 1.0), 32.0)
