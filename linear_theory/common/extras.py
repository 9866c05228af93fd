"""Optional packages, imported when they are first used."""

import importlib
from typing import Any


def optional(package: str, extra: str, use: str) -> Any:
    """The module of a package that belongs to an extra of `sheetcrawl`; use: the feature that needs it.

    Raises ModuleNotFoundError, with what to install, if it is missing or cannot be imported.
    """
    try:
        return importlib.import_module(package)
    except ImportError as missing:
        # Another name: the package is installed, but lacks a dependency or is broken.
        why = "" if missing.name == package else f", which cannot be imported ({missing})"
        raise ModuleNotFoundError(
            f"{use} needs {package}{why}: pip install 'sheetcrawl[{extra}]', or pip install {package}",
            name=package,
        ) from None
