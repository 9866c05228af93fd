"""Frames of films: the sheet from above, and in space with its side view."""
