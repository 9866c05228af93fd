"""Nonlinear Koiter shell."""
