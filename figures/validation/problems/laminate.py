"""Layers bonded into one plate: stiffness, weight, and curvature when a layer grows."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class Layer:
    """thickness, modulus of plane strain E/(1 - nu^2), density, and expansion; any one unit system."""

    thickness: float
    modulus: float
    density: float
    expansion: float = 0.0


@dataclass(frozen=True)
class Laminate:
    """Layers, the lowest first (S. Timoshenko, J. Opt. Soc. Am. 11:233, 1925, for any number)."""

    layers: Sequence[Layer]

    @property
    def middles(self) -> list[float]:
        """Height of the middle of each layer above the lower face."""
        heights, bottom = [], 0.0
        for layer in self.layers:
            heights.append(bottom + layer.thickness / 2)
            bottom += layer.thickness
        return heights

    @property
    def neutral(self) -> float:
        """Height of the axis about which it bends without a force."""
        weights = [layer.modulus * layer.thickness for layer in self.layers]
        return sum(w * z for w, z in zip(weights, self.middles, strict=True)) / sum(weights)

    @property
    def stiffness(self) -> float:
        """Bending stiffness per width."""
        return sum(
            layer.modulus * layer.thickness * (layer.thickness**2 / 12 + (z - self.neutral) ** 2)
            for layer, z in zip(self.layers, self.middles, strict=True)
        )

    @property
    def areal_density(self) -> float:
        """Mass per area."""
        return sum(layer.density * layer.thickness for layer in self.layers)

    @property
    def curvature(self) -> float:
        """By the expansions of the layers, of a plate that bends in one direction."""
        moment = sum(
            layer.modulus * layer.thickness * layer.expansion * (z - self.neutral)
            for layer, z in zip(self.layers, self.middles, strict=True)
        )
        return moment / self.stiffness
