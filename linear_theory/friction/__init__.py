"""Friction with the ground: its law and its load."""
