"""The sheet: a rectangle of one material."""
