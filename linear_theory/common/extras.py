"""Optional packages, imported when they are first used."""

import importlib
from typing import Any


def optional(package: str, extra: str, use: str) -> Any:
    """The module of a package that belongs to an extra of `sheetcrawl`; use: the feature that needs it.

    Raises ModuleNotFoundError, with what to install, if it is missing.
    """
    try:
        return importlib.import_module(package)
    except ModuleNotFoundError as missing:
        if missing.name != package:
            raise  # the package is installed, but lacks a dependency
        raise ModuleNotFoundError(
            f"{use} needs {package}: pip install 'sheetcrawl[{extra}]', or pip install {package}",
            name=package,
        ) from None
