"""Optimised waves and scenes against answers that are known otherwise."""
