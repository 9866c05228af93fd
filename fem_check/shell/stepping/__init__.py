"""Time integration of scenes: one minimisation per step, error control, energy balance, restart."""
