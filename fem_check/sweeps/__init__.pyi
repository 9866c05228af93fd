"""Sweeps: many scenes that differ in some fields, answered on many cores, kept in one file."""

# Read by lazy_loader as it runs, and by type checkers.

from .cost import expected
from .plan import Plan
from .points.axes import Between
from .points.designs import Grid, LatinHypercube, Paired, Random
from .records.result import Sweep, kept
from .running import run, sweep
from .sweep_file import read

__all__ = [
    "Between",
    "Grid",
    "LatinHypercube",
    "Paired",
    "Plan",
    "Random",
    "Sweep",
    "expected",
    "kept",
    "read",
    "run",
    "sweep",
]
