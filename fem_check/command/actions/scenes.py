"""The question that a scene file asks, with the options that may stand beside it."""

from dataclasses import fields, replace
from pathlib import Path

from fem_check.choice.prediction import Prediction
from fem_check.choice.solving import solved
from fem_check.choice.ways import way_of
from fem_check.command.options import Options
from fem_check.command.quantities import share
from fem_check.files.mistakes import SceneFileError
from fem_check.files.parts.scene_file import SceneFile
from fem_check.files.reading import read
from linear_theory.common import validation
from linear_theory.common.progress import Report

BESIDE = ("rtol", "json", "csv", "plot", "movie", "why")
"""Options that may stand beside a scene file; all others are said by it."""

SUFFIX = ".toml"


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
    found = read(path)
    if options.rtol != default.rtol:
        rtol = validation.tolerance(share("rtol", options.rtol))
        found = replace(found, run=replace(found.run, rtol=rtol, steps=None))
    _check(found, options)
    return found


def _check(found: SceneFile, options: Options) -> None:
    """Raise ValueError where no level answers, or the one that does has nothing to be drawn."""
    try:
        way = way_of(found.scene, found.run.level)
    except ValueError as problem:
        raise SceneFileError(f"{found.path}: {problem}") from None
    for name in ("plot", "movie"):
        if way == "stepped" and getattr(options, name) is not None:
            raise ValueError(
                f"--{name}: must be left out for a scene that is stepped through time; in Python "
                f"simulate(Scene.from_toml({str(found.path)!r})).{name}(...) makes one"
            )


def answered(found: SceneFile, report: Report) -> Prediction:
    """The answer, as the table [run] wants it."""
    return solved(found.scene, found.run, report).answer
