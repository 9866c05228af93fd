"""Figures of what optimisation finds."""
