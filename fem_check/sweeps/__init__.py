"""Sweeps: many scenes that differ in some fields, answered on many cores, kept in one file.

points, variation, plan   which scenes      records   what is kept    running, tally   all of it
sweep_file, schema        as text           work      who answers     cost             beforehand
"""

import lazy_loader

# Each name is imported when it is first used: to look into a file needs no solver.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
