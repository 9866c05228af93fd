"""Outlines of sheets, and meshes made of them or given."""
