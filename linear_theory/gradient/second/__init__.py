"""Gradients of speed and cost of transport to second order, of planar and bending sheets."""
