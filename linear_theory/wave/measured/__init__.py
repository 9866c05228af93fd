"""Waves of growth that were measured: smooth and periodic functions fitted to samples of c."""

from linear_theory.wave.measured.wave import SampledWave

__all__ = ["SampledWave"]
