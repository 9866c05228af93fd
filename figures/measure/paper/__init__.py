"""Bending gaits of the seed paper, sections 3.2 to 3.4."""
