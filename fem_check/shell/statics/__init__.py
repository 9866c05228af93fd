"""Minima of the potential: Newton's method, load continuation, buckling detected and followed."""
