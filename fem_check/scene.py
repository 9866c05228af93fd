"""The scene, shared with `linear_theory`."""

from linear_theory.growth.bilayer import bilayer
from linear_theory.scene.scene import Scene

__all__ = ["Scene", "bilayer"]
