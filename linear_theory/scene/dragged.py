"""Friction of the rigid sheet of a scene, with which its efficiency compares."""

from linear_theory.common.estimate import Estimate
from linear_theory.friction.mean_map import UNKNOWN, mean_map
from linear_theory.scene.scene import Scene


def mean_map_of(scene: Scene) -> Estimate:
    """Mean of the map of friction, see `mean_map`; NaN, too, for a map on a mesh of its own outline.

    >>> from linear_theory import Sheet, SineWave
    >>> print(mean_map_of(Scene(Sheet(), SineWave(), alpha=0.1)).value)
    1.0
    """
    sheet, law = scene.sheet, scene.contact.friction
    if law.map is not None and scene.mesh is not None:
        return UNKNOWN
    return mean_map(law, sheet.width, sheet.length, scene.period)
