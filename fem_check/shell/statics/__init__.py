"""Minima of the sum of the effects: Newton, growth put on in steps, buckling found and followed."""
