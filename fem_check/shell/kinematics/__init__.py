"""Surfaces in finite elements: positions and their derivatives at quadrature points."""
