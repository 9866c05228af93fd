"""Finite elements that check the linear theory across alpha: plane stress and a nonlinear shell."""

import lazy_loader

# Each name is imported when it is first used: the command answers `--version` without loading finite
# elements. The list of names is `__init__.pyi`.
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
