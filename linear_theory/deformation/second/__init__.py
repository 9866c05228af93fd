"""The deformation to second order in the growth coupling."""
