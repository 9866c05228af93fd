"""Sweeps: many scenes that differ in some fields, answered on many cores, kept in one file.

fields, axes, designs    which scenes            store, records, result, export   what is kept
plan, sweep_file         what is asked, as text  answering, here, cluster         who answers
running                  all of it               cost                             what it will cost
"""

import lazy_loader

# Each name is imported when it is first used: to look into a file needs no solver.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
