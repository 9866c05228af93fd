"""Snapshots of a run: plain npz files, written atomically, refused when they are not what they were."""

import contextlib
import hashlib
import io
import json
import os
import platform
import struct
import zipfile
import zlib
from dataclasses import fields
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.ground import Ground
from fem_check.shell.model import ShellModel
from fem_check.shell.stepping.settings import Settings
from linear_theory.common.errors import SheetcrawlError, Unidentifiable
from linear_theory.identity import content_key
from linear_theory.scene.scene import PARTS, Scene

Array = NDArray[np.float64]

VERSION = 2

_DAMAGED = (
    *(zipfile.BadZipFile, zlib.error, struct.error, UnicodeDecodeError),
    *(ValueError, EOFError, OSError, KeyError, RuntimeError, AttributeError, SyntaxError),
)
"""What numpy and zipfile raise for files that are not what they should be."""

_LABELS = ("version", "checksum", "fingerprint", "python")

_PHASES = (0.0, 0.1234, 0.5678)
"""Of the period; no usual wave repeats itself there."""


class SnapshotError(SheetcrawlError, ValueError):
    """A snapshot that cannot be written, or not be gone on from: damaged, altered or of another run."""


def check_path(path: Path) -> None:
    """Raise SnapshotError if there can be no snapshot at a path."""
    if os.path.isdir(path):  # not path.is_dir(), which fails for names that are too long
        raise SnapshotError(f"snapshot = {path}: must be a file, is a folder")
    if not os.path.isdir(path.parent):
        raise SnapshotError(f"snapshot = {path}: must be in a folder that exists; make {path.parent}")


def check_writable(path: Path) -> None:
    """Raise SnapshotError if the snapshot cannot be written, found out by writing next to it."""
    temporary = _temporary(path)
    try:
        temporary.touch()
    except OSError as error:
        reason = error.strerror or str(error)
        raise SnapshotError(f"snapshot = {path}: cannot be written there ({reason})") from None
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink()


def save_snapshot(path: Path, arrays: dict[str, Array], owner: str) -> None:
    """Write arrays and the fingerprint of their run; always the old or the new file is there."""
    labels = {
        "version": np.array(VERSION),
        "fingerprint": np.array(owner),
        "checksum": np.array(checksum(arrays, owner)),
        "python": np.array(platform.python_version()),
    }
    temporary = _temporary(path)
    try:
        with open(temporary, "wb") as file:
            np.savez(file, allow_pickle=False, **arrays, **labels)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def _temporary(path: Path) -> Path:
    return path.with_name(f"{path.name}.{os.getpid()}.tmp")


def load_snapshot(path: Path, owner: str) -> dict[str, Array]:
    """Arrays of a snapshot. Raises SnapshotError, saying why, if they are not to be trusted."""
    try:
        contents = io.BytesIO(path.read_bytes())
    except OSError as error:
        raise SnapshotError(f"snapshot {path}: cannot be read ({error.strerror})") from None
    try:
        with np.load(contents, allow_pickle=False) as file:
            found = {name: file[name] for name in file.files}
    except (*_DAMAGED, TypeError) as error:  # TypeError: a single array, which is no archive
        raise SnapshotError(f"snapshot {path}: is truncated or damaged ({error})") from error
    version = found.get("version")
    if version is not None and not np.array_equal(version, VERSION):
        raise SnapshotError(
            f"snapshot {path}: has version {version}, this program reads {VERSION}; remove the "
            "file, or name another one, to start from the beginning"
        )
    missing = [name for name in _LABELS if name not in found]
    if missing:
        raise SnapshotError(f"snapshot {path}: is no snapshot of a simulation (no {missing[0]})")
    _, stored, fingerprint, python = (found.pop(name) for name in _LABELS)
    if str(stored) != checksum(found, str(fingerprint)):
        raise SnapshotError(f"snapshot {path}: was altered, its checksum does not fit its contents")
    if str(fingerprint) != owner:
        raise SnapshotError(f"snapshot {path}: {_differences(str(fingerprint), owner, str(python))}")
    return found


def checksum(arrays: dict[str, Array], owner: str) -> str:
    """SHA-256 of the names, types, shapes and bytes of arrays and of the fingerprint."""
    digest = hashlib.sha256(owner.encode())
    for name in sorted(arrays):
        array = np.ascontiguousarray(arrays[name])
        digest.update(f"{name} {array.dtype.str} {array.shape} ".encode())
        digest.update(array.tobytes())
    return digest.hexdigest()


def fingerprint(scene: Scene, settings: Settings) -> str:
    """All that determines a run, as JSON: the key of the content of each part by its name.

    Values of the functions belong to it too: a name that stands for another one shall not pass.
    Raises Unidentifiable for a function without content or name.
    """
    model = ShellModel(scene)
    discretisation = model.discretisation
    mesh = discretisation.mesh
    x, y = discretisation.interior.parameters.reshape(2, -1)
    values = [model.growth(phase * scene.period, x, y) for phase in _PHASES]
    ground: Ground | None = scene.find(Ground)
    hill = None if ground is None else ground.height
    parts = {
        **{name: getattr(scene, name) for name in PARTS if name != "elements"},
        **{f.name: getattr(settings, f.name) for f in fields(settings)},
        "mesh": (type(mesh).__name__, mesh.doflocs, mesh.t, discretisation.degree),
        # An element object fills up with tables; its functions are what tells it apart.
        "element": (type(discretisation.element), discretisation.interior.shapes((0,))[0]),
        "values of the wave": values,
        "values of the ground": None if hill is None else hill.values(x, y),
    }
    return json.dumps({name: content_key(part, name) for name, part in parts.items()}, sort_keys=True)


def run_fingerprint(path: Path, scene: Scene, settings: Settings) -> str:
    """The same for a run with a snapshot. Raises SnapshotError, saying what to do, without one."""
    try:
        return fingerprint(scene, settings)
    except Unidentifiable as error:
        raise SnapshotError(
            f"snapshot = {path}: must be None unless the run can be known again, and {error}; give the "
            "function a name: FieldWave(..., name=...), Terrain(..., name=...)"
        ) from error


def _differences(theirs: str, mine: str, python: str) -> str:
    """What two fingerprints do not share, as the end of a sentence."""
    text = "belongs to another scene or to a run with other settings"
    try:
        old, new = json.loads(theirs), json.loads(mine)
        names = sorted(name for name in old.keys() | new.keys() if old.get(name) != new.get(name))
    except (ValueError, AttributeError):  # no fingerprint of this program
        return text
    text += f": other {', '.join(names)}"
    if python != platform.python_version():
        text += (
            f" (it was written by Python {python}; functions are known by their compiled code, which "
            "is not the same in all versions)"
        )
    return text
