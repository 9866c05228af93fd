"""Packages that only some calls need, imported when they are first used."""

import importlib
from typing import Any


def optional(package: str, extra: str, use: str) -> Any:
    """The module of a package of an extra of `sheetcrawl`; use: what needs it.

    Raises ModuleNotFoundError, with what to install, where it is missing.
    """
    try:
        return importlib.import_module(package)
    except ModuleNotFoundError as missing:
        if missing.name != package:
            raise  # it is there, and lacks something itself
        raise ModuleNotFoundError(
            f"{use} needs {package}: pip install 'sheetcrawl[{extra}]', or pip install {package}",
            name=package,
        ) from None
