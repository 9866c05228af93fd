"""Runs of a simulation beyond the first one: errors of mesh and ground, of the path through a snap."""
