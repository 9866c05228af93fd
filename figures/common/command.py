"""Options of the scripts: where files go, and how accurate they are."""

import argparse
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from fem_check.output.files import replacing
from figures.common.folders import FIGURES


def parser(
    command: str, text: str | None, out: Path | None = None, **settings: tuple[Any, str]
) -> argparse.ArgumentParser:
    """The parser of a script, to which more may be added.

    command: as the user types it; text: docstring of the script, of which the first line is shown; out:
    file or folder that is written unless --out says otherwise. settings: default and meaning of further
    options, which are of the type of their default; one that is False is a flag.
    """
    made = argparse.ArgumentParser(prog=command, description=(text or "").partition("\n")[0])
    if out is not None:
        form, words = "FILE" if out.suffix else "FOLDER", f"where to write ({_shown(out)})"
        made.add_argument("--out", type=Path, default=out, metavar=form, help=words)
    for name, (default, meaning) in settings.items():
        if default is False:
            made.add_argument(f"--{name}", action="store_true", help=meaning)
            continue
        is_path = isinstance(default, Path)
        kind, named = (Path, "FOLDER") if is_path else (type(default), name.upper())
        words = f"{meaning} ({_shown(default)})"
        made.add_argument(f"--{name}", type=kind, default=default, metavar=named, help=words)
    return made


def write_page(
    command: str,
    text: str | None,
    out: Path,
    made: Callable[[], str],
    arguments: Sequence[str] | None = None,
) -> None:
    """The script of a page of the documentation: write what `made` returns. Others: see `parser`."""
    options = parser(command, text, out).parse_args(arguments)
    with replacing(options.out) as part:
        part.write_text(made(), encoding="utf-8")
    print(options.out)


def _shown(default: Any) -> Any:
    """A default; a path as it is seen from the root of the project."""
    return default.relative_to(FIGURES.parent) if isinstance(default, Path) else default
