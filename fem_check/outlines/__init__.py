"""Outlines with parameters: gradients of the speed with respect to them, and the best ones."""
