"""Shared by all parts: input checks, errors, display of results, progress, threads."""
