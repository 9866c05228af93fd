"""The version of the program, from the installed package or the source tree."""

import tomllib
from pathlib import Path

PROJECT = Path(__file__).parents[2] / "pyproject.toml"


def current_version() -> str:
    """The version in pyproject.toml in a source tree, else that of the installed package."""
    if PROJECT.exists():
        project = tomllib.loads(PROJECT.read_text(encoding="utf-8")).get("project", {})
        if project.get("name") == "sheetcrawl":
            return str(project["version"])
    import importlib.metadata  # here: it takes a tenth of the time that all of the package takes

    return importlib.metadata.version("sheetcrawl")
