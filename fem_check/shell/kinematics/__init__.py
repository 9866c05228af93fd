"""Surfaces on finite elements: positions and their derivatives at quadrature points."""
