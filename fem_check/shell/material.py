"""The material of the sheet."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

SAME = 1e-12
"""Relative difference below which two values of a material parameter count as equal."""


@dataclass(frozen=True)
class Material(Value):
    """An isotropic sheet with Young modulus `young`, thickness h and Poisson ratio nu.

    thickness in units of length, young in force per area (1 by default: the unit of stress).
    Raises ValueError for thickness or young <= 0 and for a Poisson ratio outside (-1, 1/2].
    """

    thickness: float
    poisson: float
    young: float = 1.0

    def __post_init__(self) -> None:
        for name in ("thickness", "young"):
            object.__setattr__(self, name, validation.positive(name, getattr(self, name)))
        object.__setattr__(self, "poisson", validation.poisson(self.poisson))

    @property
    def stretching(self) -> float:
        """K = E h / (1 - nu^2) of appendix A.2, force per length."""
        return self.young * self.thickness / (1 - self.poisson**2)

    @property
    def bending(self) -> float:
        """D = E h^3 / (12 (1 - nu^2)) of appendix A.2, force times length."""
        return self.stretching * self.thickness**2 / 12


def elastic_tensor(metric: Array, poisson: float) -> Array:
    """H of appendix A.2 for a rest metric: (3, 3, points), rows and columns (11, 22, 12).

    metric: (3, points), covariant (11, 22, 12). It acts on (e_11, e_22, 2 e_12) and gives the
    contravariant (n^11, n^22, n^12). The inverse is that of the *grown* metric.
    """
    a11, a22, a12 = metric
    inverse = 1 / (a11 * a22 - a12**2)
    b11, b22, b12 = a22 * inverse, a11 * inverse, -a12 * inverse
    out = np.empty((3, 3, *a11.shape))
    out[0, 0], out[1, 1] = b11**2, b22**2
    out[0, 1] = out[1, 0] = poisson * b11 * b22 + (1 - poisson) * b12**2
    out[0, 2] = out[2, 0] = b11 * b12
    out[1, 2] = out[2, 1] = b22 * b12
    out[2, 2] = poisson * b12**2 + (1 - poisson) / 2 * (b11 * b22 + b12**2)
    return out


def check_materials(scene: Scene) -> None:
    """Raise ValueError if the materials of effects differ from each other or from the sheet."""
    materials = [effect.material for effect in scene.effects if hasattr(effect, "material")]
    for material in materials:
        if material != materials[0]:
            raise ValueError(f"effects: materials {materials[0]} and {material} must be the same")
        for name in ("thickness", "poisson"):
            mine, theirs = getattr(material, name), getattr(scene.sheet, name)
            none = 0.0 if name == "thickness" else SAME  # a length has no natural scale
            if not math.isclose(mine, theirs, rel_tol=SAME, abs_tol=none):
                raise ValueError(f"effects: material has {name} = {mine:g}, must be {theirs:g} (sheet)")
