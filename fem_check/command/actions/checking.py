"""`sheetcrawl check`: what a scene, a sweep or an optimisation file says, or all its mistakes."""

import shutil
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fem_check.command.actions.scene_files import WAYS, WIDEST, scene_rows, scene_said
from fem_check.command.status import MET
from fem_check.command.text import printable

if TYPE_CHECKING:
    from fem_check.optimisation.optimise_file import OptimiseFile

SEARCHED = ("optimise", "harmonics", "constraints", "robust")
"""Tables that an optimisation file alone may have."""


def check(path: Path) -> int:
    """Print what a file asks for; the exit status. Raises SceneFileError for mistakes."""
    from fem_check.files.reading import data_of, text_of

    data = data_of(text_of(path), path)
    if "scene" not in data and not {"over", "sweep", *SEARCHED} & data.keys():
        from fem_check.command.actions.scenes import answerable

        return _printed(f"{path} is a scene", scene_said(*answerable(path)))
    if is_search(data):
        from fem_check.optimisation.optimise_file import read

        return _printed(f"{path} is an optimisation", _optimisation(path, read(path)))
    from fem_check.command.actions.sweep import sweep

    return sweep(path, None, None, None, dry_run=True, export=[], retry=False)


def is_search(data: Mapping[str, Any]) -> bool:
    """Whether the tables are those of an optimisation, not of a sweep.

    >>> from fem_check.command.actions.checking import is_search
    >>> bounds = {"growth": {"alpha": {"low": 0.1, "high": 0.2}}}
    >>> print(is_search({"over": bounds}), is_search({"over": {"growth": {"alpha": [0.1, 0.2]}}}))
    True False
    """
    if "sweep" in data or set(SEARCHED) & data.keys():
        return "sweep" not in data
    over = data.get("over")
    if not isinstance(over, Mapping):
        return False
    from fem_check.sweeps.sweep_file import flattened

    ranges = [given for _, given in flattened(over)]
    return all(isinstance(given, Mapping) and "count" not in given for given in ranges)


def _printed(title: str, rows: Mapping[str, str]) -> int:
    from fem_check.answer.block import wrapped

    width = min(shutil.get_terminal_size((WIDEST, 0)).columns, WIDEST)
    lines = [title, *(wrapped(label, text, width) for label, text in rows.items() if text)]
    print(printable("\n".join(lines), sys.stdout))
    return MET


def _optimisation(path: Path, found: "OptimiseFile") -> dict[str, str]:
    """The scene, what may change, what is to be best, and where the scene stands to its limits."""
    from fem_check.files.mistakes import SceneFileError
    from fem_check.optimisation.standing import standings

    base = found.asked.unknowns.base
    try:
        asked = found.asked.with_level()
        limits = standings(asked)
    except ValueError as problem:
        raise SceneFileError(f"{path}: {' '.join(str(problem).split())}") from None
    rows = dict(scene_rows(base.file)) if base is not None else {}
    objective, searching, level = asked.objective, found.searching, asked.settings.level
    wanted = "large" if objective.sign > 0 else "small"
    return {
        **{label: rows[label] for label in ("sheet", "growth", "contact") if label in rows},
        "best": f"{objective.name}, to be {wanted}",
        "over": ", ".join(asked.unknowns.bounds),
        "outside": "; ".join(asked.unknowns.outside),
        "limits": "; ".join(map(str, limits)),
        "regimes": "; ".join(name for name, _ in asked.regimes),
        "answer": f"{level}: {WAYS[level]}",
        "search": f"{searching.starts} start{'s' * (searching.starts > 1)} by {searching.how.method}",
        "next": f"sheetcrawl optimise {path}",
    }
