"""Outlines of sheets and their meshes."""
