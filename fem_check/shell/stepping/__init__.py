"""Scenes in time: one minimisation per step, error control, balance of power, restart."""
