"""Friction balance of any wave c(S, t) on a line, from samples."""

from linear_theory.line.samples.doubling import coarse_means, sampled_balance, speeds_at

__all__ = ["coarse_means", "sampled_balance", "speeds_at"]
