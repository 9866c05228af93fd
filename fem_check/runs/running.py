"""A scene run to a folder: solved by the level that fits it, kept, drawn, and told on a page."""

import contextlib
import json
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from fem_check.answer.units import Units
from fem_check.choice.asked import check_contact_for
from fem_check.choice.settings import RunSettings
from fem_check.choice.solving import solved
from fem_check.choice.ways import check_shape, way_of
from fem_check.files.writing import write as write_scene
from fem_check.output.files import replacing
from fem_check.runs import netcdf
from fem_check.runs.capture import recorded
from fem_check.runs.errors import NotWrittenError
from fem_check.runs.finished import SEAL, Finished, checksum, finished, seal
from fem_check.runs.folder import (
    REPORT,
    RESULT,
    SCENE,
    SCENE_DATA,
    SNAPSHOT,
    TRAJECTORY,
    locked,
)
from fem_check.runs.pictures import write_films, write_pictures
from fem_check.runs.record import result_of
from fem_check.runs.report import write_report
from linear_theory.common import validation
from linear_theory.common.errors import Unidentifiable
from linear_theory.common.progress import Progress, Report
from linear_theory.common.shown import plain
from linear_theory.common.version import current_version
from linear_theory.scene.scene import Scene

SNAPSHOT_EVERY = 10
"""Steps in time, after which an interrupted run has lost nothing that takes longer than a moment."""

AGAIN = "run(..., resume=True)"

RESUME = "resume = True, --resume"


def run(
    scene: Scene,
    folder: str | Path,
    settings: RunSettings | None = None,
    units: Units | None = None,
    *,
    resume: bool = False,
    progress: Report | None = None,
    again: str = AGAIN,
) -> Finished:
    """Answer a scene by the level of `way_of`, and keep all of it in a folder.

    The folder, new or empty, then holds scene.toml (scene.json for scenes with functions), result.json
    (answer, errors, units, scene, cost, versions), trajectory.nc, pictures, films and report.html.
    settings: as in [run] of a scene file. units: names of those that the numbers of the scene are in.
    resume: go on from what an interrupted run has left there: the snapshot of a scene that is stepped
    through time, or a result whose pictures are missing. Files appear when they are whole. progress:
    called with a `Progress`. again: what is said to be called after Ctrl-C.

    Raises, before any work, ValueError for a scene that no level represents, for the level "line",
    which has no shape, and for a folder that is in use, not empty, not writable or of another scene,
    and ModuleNotFoundError without xarray; then what `solve` raises; OSError where a
    file cannot be written, NotWrittenError, with the block, once the answer is known;
    KeyboardInterrupt, saying what is kept. Warns of films that cannot be written, and of a motion whose
    file was missing or damaged and is written again.

    >>> import tempfile
    >>> from fem_check.files import RunSettings
    >>> from fem_check.runs import run
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     scene = Scene(Sheet(), SineWave(), alpha=0.05)
    ...     found = run(scene, f"{folder}/strip", RunSettings(rtol=0.2))
    ...     print(sorted(path.name for path in found.folder.glob("[!.]*")), found.converged)
    ['kymographs.pdf', 'kymographs.png', 'motion.gif', 'motion.mp4', 'motion.pdf', 'motion.png', \
'report.html', 'result.json', 'scene.toml', 'trajectory.nc'] True
    """
    scene = validation.instance("scene", scene, Scene)
    folder, settings = Path(folder), settings or RunSettings()
    way = way_of(scene, settings.level)
    check_shape(way)
    check_contact_for(scene, way)
    netcdf.require_netcdf()
    with locked(folder), _interruptible(again):
        known = _has_result(folder, scene, settings, resume)
        damage = _damage(folder) if known else ""
        if damage or not known:
            _solve(scene, way, folder, settings, units, progress)
        if damage:
            (folder / REPORT).unlink(missing_ok=True)  # drawn anew, with all that belongs to it
            warnings.warn(damage, stacklevel=2)
        found = finished(folder)
        with _kept_for(found.block):
            _draw(found, progress)
    return found


def _damage(folder: Path) -> str:
    """What is wrong with the file of the motion, and what is done about it; empty if it is right."""
    wrong = finished(folder).damage()
    if not wrong:
        return ""
    how = f"written again from {SNAPSHOT}" if (folder / SNAPSHOT).exists() else "solved again"
    return f"{wrong}; the motion was {how}"


def _has_result(folder: Path, scene: Scene, settings: RunSettings, resume: bool) -> bool:
    """Whether there is the answer to this scene. Raises ValueError for what must not be overwritten."""
    name = f"folder = {str(folder)!r}"
    if (folder / RESULT).exists():
        if not resume:
            raise ValueError(
                f"{name}: holds the result of an earlier run; name another folder, or resume it, which "
                f"draws what is missing ({RESUME})"
            )
        kept = finished(folder).result
        asked = {"scene": plain(scene), "run": plain(settings)}
        other = [part for part, value in asked.items() if kept.get(part) != _as_json(value)]
        if other:
            raise ValueError(f"{name}: holds the result of another {' and '.join(other)}")
        return True
    if (folder / SNAPSHOT).exists() and not resume:
        raise ValueError(
            f"{name}: holds a run that was interrupted; resume it ({RESUME}), or name another folder"
        )
    return False


def _as_json(value: Any) -> Any:
    return json.loads(json.dumps(value))


def _solve(
    scene: Scene,
    way: str,
    folder: Path,
    settings: RunSettings,
    units: Units | None,
    progress: Report | None,
) -> None:
    """Write the scene, its motion, and at last its result, by which the run is known to be finished."""
    _write_scene(scene, folder, settings, units)
    found = solved(scene, settings, progress, **_snapshots(scene, folder, way))
    result = found.motion or found.answer.speed
    recording = recorded(result, scene, found.answer.speed)
    told = result_of(found, settings, units, {})
    with _kept_for(str(told["block"])):
        netcdf.write(recording, result, folder / TRAJECTORY, units)
        told["files"] = {TRAJECTORY: checksum(folder / TRAJECTORY)}
        _write_json({**told, SEAL: seal(told)}, folder / RESULT)


def _snapshots(scene: Scene, folder: Path, way: str) -> dict[str, Any]:
    """Arguments of `simulate`; none for a scene that a snapshot could not know again."""
    if way != "stepped":
        return {}
    try:
        scene.key()
    except Unidentifiable:
        return {}
    return {"snapshot": folder / SNAPSHOT, "snapshot_every": SNAPSHOT_EVERY}


def _write_scene(scene: Scene, folder: Path, settings: RunSettings, units: Units | None) -> None:
    """The scene as it was resolved, to be run again."""
    said = f"lengths in {units.length}, times in {units.time}" if units else "in units of the sheet"
    head = f"The scene of this folder, as sheetcrawl {current_version()} ran it; plain numbers, {said}."
    try:
        write_scene(scene, folder / SCENE, settings, head)
    except ValueError:  # functions, which no text holds
        _write_json(plain(scene), folder / SCENE_DATA)


def _write_json(data: Any, path: Path) -> None:
    with replacing(path) as part:
        part.write_text(json.dumps(data, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def _draw(found: Finished, progress: Report | None) -> None:
    """Pictures, films and the page, which comes last; nothing where it is there."""
    if (found.folder / REPORT).exists():
        return
    recording, units = found.recording, found.units
    write_pictures(recording, found.folder, units)

    def report(done: int, total: int) -> None:
        if progress is not None:
            progress(Progress("film", done / total, 0.0, float("nan")))

    write_films(recording, found.folder, units, report)
    write_report(found, found.folder / REPORT)


@contextlib.contextmanager
def _kept_for(block: str) -> Iterator[None]:
    """An answer that could not be written, or not be drawn, is still told."""
    try:
        yield
    except OSError as problem:
        raise NotWrittenError(f"{problem}; what is written is kept", block) from problem


@contextlib.contextmanager
def _interruptible(again: str) -> Iterator[None]:
    """After Ctrl-C, say what is kept and how to go on."""
    try:
        yield
    except KeyboardInterrupt as stopped:
        said = str(stopped) or "interrupted; what is finished is kept, the rest follows by"
        raise KeyboardInterrupt(f"{said}: {again}") from None
