"""Deformation of the sheet at small growth: Airy series, Ritz solution, and second order."""
