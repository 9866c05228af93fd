"""The nonlinear sheet, scenes with their effects, and the calls that choose a level of theory.

Start with `predict`, the speed of a flat sheet to a tolerance, or `solve`, that of any scene;
`simulate` gives the motion in time of a sheet that bends, slips and leaves the ground.
"""

import lazy_loader

# Each name is imported on first use: the command prints `--version` without loading finite elements.
# The names are listed in `__init__.pyi`.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
