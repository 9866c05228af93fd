"""Finite elements that check the linear theory: plane stress, and a nonlinear shell for any alpha."""

import lazy_loader

# Each name is imported on first use: the command prints `--version` without loading finite elements.
# The names are listed in `__init__.pyi`.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
