"""Periodic orbits of excitable waves, and the waves that levels take."""
