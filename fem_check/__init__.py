"""Finite elements that check the linear theory across alpha: plane stress and a nonlinear shell."""

from typing import Any

import lazy_loader

# Each name is imported when it is first used: the command answers `--version` without loading finite
# elements. The list of names is `__init__.pyi`.
_lazy, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __getattr__(name: str) -> Any:
    """Of the names in the list, and the version."""
    if name == "__version__":
        from linear_theory.version import current_version

        return current_version()
    return _lazy(name)
