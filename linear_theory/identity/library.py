"""Members of Python and its installed packages, which are identified by name."""

import functools
import importlib.util
import site
import sys
import sysconfig
from pathlib import Path
from typing import Any

OWN = ("linear_theory", "fem_check")

OUTSIDE = {
    *("datetime", "io", "os", "pathlib", "random", "secrets", "shelve", "socket", "sqlite3"),
    *("subprocess", "tempfile", "time", "urllib", "uuid", "numpy.random", "scipy.io"),
}
"""Modules that give a function access to external data: files, the clock, random numbers."""

OUTSIDE_NAMES = {
    *("fromfile", "fromregex", "genfromtxt", "load", "loadtxt", "memmap", "random", "read_csv"),
}
"""Names with the same access in the modules of installed packages."""


@functools.cache
def is_library(module: str | None) -> bool:
    """Whether a module belongs to Python, to an installed package or to this one."""
    top = (module or "").partition(".")[0]
    if top in sys.stdlib_module_names or top in OWN or top in sys.builtin_module_names:
        return True
    try:
        found = importlib.util.find_spec(top) if top else None
    except (ValueError, ImportError):  # __main__ has no spec
        return False
    if found is None:
        return False
    places = [found.origin, *(found.submodule_search_locations or ())]
    return any(Path(p).is_relative_to(f) for p in places if p for f in _folders())


@functools.cache
def _folders() -> tuple[Path, ...]:
    """Folders in which packages are installed."""
    paths = sysconfig.get_paths()
    named = [paths["purelib"], paths["platlib"], *site.getsitepackages(), site.getusersitepackages()]
    return tuple(Path(folder) for folder in named)


def is_outside(module: str | None) -> bool:
    """Whether a module is one of OUTSIDE, or inside one of them."""
    parts = (module or "").split(".")
    return any(".".join(parts[:k]) in OUTSIDE for k in range(1, len(parts) + 1))


def qualified(value: Any) -> str:
    """Module and name of a class or function."""
    return f"{value.__module__}.{value.__qualname__}"


def is_by_name(value: Any) -> bool:
    """Whether a function or class is found in its library module under its name."""
    module, name = getattr(value, "__module__", None), getattr(value, "__qualname__", None)
    if not is_library(module) or not isinstance(name, str):
        return False
    found: Any = sys.modules.get(module or "")
    for part in name.split("."):
        found = getattr(found, part, None)
    return found is value
