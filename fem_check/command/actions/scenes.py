"""The question that a scene file asks, with the options that may stand beside it."""

from dataclasses import fields, replace
from pathlib import Path

from fem_check.choice.asked import check_contact_for, way_for
from fem_check.choice.result import Prediction
from fem_check.choice.solving import solved
from fem_check.command.options import Options
from fem_check.command.typed import share
from fem_check.command.waiting import Waiting
from fem_check.files.mistakes import Mistakes, SceneFileError
from fem_check.files.parts.scene_file import SceneFile
from fem_check.files.reading import parsed, text_of
from linear_theory.common import validation
from linear_theory.common.progress import Report, watched

BESIDE = ("rtol", "json", "csv", "plot", "movie", "why")
"""Options that may stand beside a scene file; all others are said by it."""

SUFFIX = ".toml"

ASKED = {"level": "run", "until": "wave", "curvature_coupling": "growth", "width": "sheet"}
"""Keys that a scene may be refused for only once all of it is known, and their tables."""


def asked_by_file(path: Path, options: Options) -> SceneFile:
    """The scene of a file. Raises ValueError for a word that names none and for options that it says.

    The tolerance of the options, where it is another than the default, replaces that of the file.
    """
    if path.suffix != SUFFIX:
        raise ValueError(
            f"{str(path)!r}: must follow an option, such as --growth, or be a scene file, "
            f"NAME{SUFFIX}; see sheetcrawl speed --help"
        )
    default = Options()
    for field in fields(options):
        value = getattr(options, field.name)
        if field.name not in BESIDE and value != getattr(default, field.name):
            option = f"--{field.name.replace('_', '-')}"
            raise ValueError(f"{option} {value!r}: must be left out, {path} says it")
    found, way = answerable(path)
    _check(found, way, options)
    if options.rtol != default.rtol:
        rtol = validation.tolerance(share("rtol", options.rtol))
        found = replace(found, run=replace(found.run, rtol=rtol, steps=None))
    return found


def answerable(path: Path) -> tuple[SceneFile, str]:
    """A scene file and the level that answers it, with progress: an equation of a wave is solved.

    Raises SceneFileError, with the line and the key, where it cannot be answered.
    """
    with Waiting() as waiting, watched(waiting.report, "sheetcrawl"):
        text = text_of(path)
        found = parsed(text, path)
        try:
            way = way_for(found.scene, found.run)
            check_contact_for(found.scene, way)
            return found, way
        except ValueError as problem:
            mistakes = Mistakes()
            words = " ".join(str(problem).split())
            table = next((name for key, name in ASKED.items() if words.startswith(f"{key} = ")), None)
            if table is None and found.run.level == "auto":
                raise SceneFileError(f"{path}: {words}") from None
            if table is None:
                mistakes.add(
                    ("run", "level"), f"level = {found.run.level!r}: {words.removeprefix('effects: ')}"
                )
            else:
                mistakes.add_raised((table,), words)
            raise mistakes.error(path, text) from None


def _check(found: SceneFile, way: str, options: Options) -> None:
    """Raise ValueError where the level that answers has nothing to be drawn."""
    for name in ("plot", "movie"):
        if way == "stepped" and getattr(options, name) is not None:
            raise ValueError(
                f"--{name}: must be left out for a scene that is stepped through time; in Python "
                f"simulate(Scene.from_toml({str(found.path)!r})).{name}(...) makes one"
            )


def answered(found: SceneFile, report: Report) -> Prediction:
    """The answer, as the table [run] wants it."""
    return solved(found.scene, found.run, report).answer
