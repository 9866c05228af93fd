"""`sheetcrawl new` and `schema`: scene files written and described; what they say, in words."""

import json
from pathlib import Path
from typing import TYPE_CHECKING

from fem_check.command.status import MET
from fem_check.files import gallery

if TYPE_CHECKING:
    from fem_check.files.parts.scene_file import SceneFile

WIDEST = 100
"""Columns of what is said of a scene, at the most."""

SWEEP = "sweep"
"""Beside the scenes of the gallery, a sweep file to start from."""

OPTIMISE = "optimise"
"""Likewise an optimisation file."""

WAYS = {
    "predict": "the cheapest theory or cycle of shapes that is known to meet the tolerance",
    "cycle": "static shapes through one period, then the balance of friction on them",
    "stepped": "in time, with friction that acts back on the shape",
    "strip": "the closed-form balance of a narrow strip",
    "first order": "small-strain theory",
    "second order": "theory to second order in growth and curvature",
}
"""How a scene is answered, in words, by each level but "auto"."""


def new(name: str | None, path: Path | None) -> int:
    """Write a scene of the gallery to a file that is not there yet; list them without a name."""
    if name is None:
        from fem_check.command.screens import listed

        print("\n".join(listed()))
        return MET
    target = path or Path(f"{name}.toml")
    if not target.parent.exists():
        raise ValueError(f"{target}: must be in a folder that is there, {str(target.parent)!r} is not")
    if name == SWEEP:
        from fem_check.command.actions.sweep import example

        _write_all({target: example()}, name)
        print(f"{target} written; next: sheetcrawl sweep {target} --dry-run")
        return MET
    if name == OPTIMISE:
        from fem_check.command.actions.optimise import example as optimisation

        _write_all({target: optimisation()}, name)
        print(f"{target} written; next: sheetcrawl check {target}")
        return MET
    texts = {target.parent / file: text for file, text in gallery.tables(name).items()}
    _write_all({**texts, target: gallery.text(name)}, name)
    also = f" (and {', '.join(map(str, texts))})" if texts else ""
    print(f"{target} written{also}; next: sheetcrawl check {target}")
    return MET


def _write_all(texts: dict[Path, str], name: str) -> None:
    """All files or none."""
    written: list[Path] = []
    try:
        for path, text in texts.items():
            _write_new(text, path)
            written.append(path)
    except BaseException as problem:  # Ctrl-C, too, leaves no half of them
        for done in written:
            done.unlink()
        if isinstance(problem, FileExistsError):
            raise ValueError(
                f"{path}: is there already; give another name or folder, as in {_other(name)}"
            ) from None
        if isinstance(problem, OSError):
            raise type(problem)(f"{path}: {problem.strerror or problem}") from None
        raise


def _other(name: str) -> str:
    where = "mine" if name in (SWEEP, OPTIMISE) or not gallery.tables(name) else "folder/mine"
    return f"sheetcrawl new {name} {where}.toml"


def _write_new(text: str, path: Path) -> None:
    """Whole or not at all, and never over another file."""
    with open(path, "x", encoding="utf-8") as file:
        try:
            file.write(text)
            file.flush()
        except BaseException:  # Ctrl-C, too, leaves no half of it
            path.unlink()
            raise


def scene_said(found: "SceneFile", way: str) -> dict[str, str]:
    """The scene, the level that answers it, and its cost."""
    from fem_check.choice.expected import expected_seconds
    from fem_check.files.mistakes import SceneFileError

    run = found.run
    try:
        rows = scene_rows(found)
    except ValueError as problem:
        raise SceneFileError(f"{found.path}: {problem}") from None
    seconds = expected_seconds(found.scene, way, run)
    accuracy = f"{run.steps} steps a period" if run.steps else f"to {100 * (run.rtol or 0):g} %"
    periods = f", {_counted(run.periods, 'period')} after a ramp" if way == "stepped" else ""
    most = "at most " if way == "predict" else ""
    units = f"in {found.units.length} and {found.units.time}" if found.units else "plain, of the sheet"
    return {
        "units": units,
        **dict(rows),
        "answer": f"{way}: {WAYS[way]}; {accuracy}{periods}",
        "cost": f"{most}about {_rounded(seconds)} on one core, to a factor of 5",
        "next": f"sheetcrawl speed {found.path}",
    }


def scene_rows(found: "SceneFile") -> list[tuple[str, str]]:
    """What the scene consists of, in words."""
    from fem_check.answer.block import asked
    from fem_check.answer.units import Units

    scene = found.scene
    units = found.units or Units.of_sheet(scene.sheet.length, scene.period)
    sheet, growth = asked(scene, units)
    effects = ", ".join(type(effect).__name__ for effect in scene.effects) or "stretching alone"
    mesh = "a rectangle" if scene.mesh is None else f"an outline of {scene.mesh.nelements} elements"
    contact = f"{scene.contact.friction.words}, load {scene.contact.load}"
    return [
        ("sheet", sheet),
        ("growth", growth),
        ("body", mesh),
        ("effects", effects),
        ("contact", contact),
    ]


def _counted(number: int, name: str) -> str:
    return f"{number} {name}" if number == 1 else f"{number} {name}s"


def _rounded(seconds: float) -> str:
    """One digit, with its unit."""
    if seconds >= 90:
        return f"{float(f'{seconds / 60:.1g}'):g} min"
    return f"{float(f'{seconds:.1g}'):g} s"


def schema(of_sweeps: bool) -> int:
    """Print the JSON Schema of scene files, or of sweep files."""
    if of_sweeps:
        from fem_check.sweeps.schema import schema as made
    else:
        from fem_check.files.schema import schema as made

    print(json.dumps(made(), indent=1))
    return MET
