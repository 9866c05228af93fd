"""Speeds of sheets that bend on level ground, to second order in alpha and beta."""
