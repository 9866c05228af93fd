"""Waves of growth: travelling ones, given functions, and how fast they change in time."""
