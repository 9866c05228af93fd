"""Snapshots of a run: plain npz files, written atomically, with a checksum."""

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

VERSION = 5

ANEW = "remove the file, or name another one, to start from the beginning"

_DAMAGED = (
    *(zipfile.BadZipFile, zlib.error, struct.error, UnicodeDecodeError),
    *(ValueError, EOFError, OSError, KeyError, RuntimeError, AttributeError, SyntaxError),
)
"""Exceptions of numpy and zipfile for damaged files."""

_LABELS = ("version", "checksum", "fingerprint", "python")

_PHASES = (0.0, 0.1234, 0.5678)
"""Phases, in periods, at which functions are sampled; incommensurate with common waves."""


class SnapshotError(SheetcrawlError, ValueError):
    """A snapshot that cannot be written or resumed from: damaged, altered or of another run."""


def check_path(path: Path) -> None:
    """Raise SnapshotError if a snapshot cannot be at this path."""
    if os.path.isdir(path):  # not path.is_dir(), which fails for names that are too long
        raise SnapshotError(f"snapshot = {path}: must be a file, is a folder")
    if not os.path.isdir(path.parent):
        raise SnapshotError(f"snapshot = {path}: must be in an existing folder; create {path.parent}")


def check_writable(path: Path) -> None:
    """Raise SnapshotError if the snapshot cannot be written, by writing a file next to it."""
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
    """Write arrays and the fingerprint of their run, atomically. Raises OSError that names the path."""
    labels = {
        "version": np.array(VERSION),
        "fingerprint": np.array(owner),
        "checksum": np.array(checksum(arrays, owner)),
        "python": np.array(platform.python_version()),
    }
    temporary = _temporary(path)
    try:
        with open(temporary, "wb") as file:
            # numpy 2.0 would keep allow_pickle=False as one more array
            np.savez(file, **arrays, **labels)  # type: ignore[arg-type]
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except OSError as error:  # of a full disk, which numpy's names no file
        raise OSError(f"{path}: cannot be written: {error.strerror or error}") from error
    finally:
        with contextlib.suppress(OSError):
            temporary.unlink()


def _temporary(path: Path) -> Path:
    return path.with_name(f"{path.name}.{os.getpid()}.tmp")


def load_snapshot(path: Path, owner: str) -> dict[str, Array]:
    """Arrays of a snapshot. Raises SnapshotError, with the reason, if they cannot be trusted."""
    try:
        contents = io.BytesIO(path.read_bytes())
    except OSError as error:
        raise SnapshotError(f"snapshot {path}: cannot be read ({error.strerror}); {ANEW}") from None
    try:
        with np.load(contents, allow_pickle=False) as file:
            found = {name: file[name] for name in file.files}
    except (*_DAMAGED, TypeError) as error:  # TypeError: a single array, which is no archive
        raise SnapshotError(f"snapshot {path}: is truncated or damaged ({error}); {ANEW}") from error
    version = found.get("version")
    if version is not None and not np.array_equal(version, VERSION):
        raise SnapshotError(
            f"snapshot {path}: has version {version}, must be {VERSION} for this program; {ANEW}"
        )
    missing = [name for name in _LABELS if name not in found]
    if missing:
        raise SnapshotError(
            f"snapshot {path}: is not a snapshot of a simulation (no {missing[0]}); {ANEW}"
        )
    _, stored, fingerprint, python = (found.pop(name) for name in _LABELS)
    if str(stored) != checksum(found, str(fingerprint)):
        raise SnapshotError(
            f"snapshot {path}: was altered, its checksum does not match its contents; {ANEW}"
        )
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
    """Everything that determines a run, as JSON: the content key of each part by its name.

    Sampled values of the functions are included: reusing a name for another function is detected.
    Raises Unidentifiable for a function without content or name.
    """
    model = ShellModel(scene)
    discretisation = model.discretisation
    mesh = discretisation.mesh
    x, y = discretisation.interior.parameters.reshape(2, -1)
    values = [np.asarray(scene.drive.alone.value(x, y, phase * scene.period)) for phase in _PHASES]
    ground: Ground | None = scene.find(Ground)
    hill = None if ground is None else ground.height
    parts = {
        **{name: getattr(scene, name) for name in PARTS if name != "elements"},
        **{f.name: getattr(settings, f.name) for f in fields(settings)},
        "mesh": (type(mesh).__name__, mesh.doflocs, mesh.t, discretisation.degree),
        # An element object caches tables; it is identified by its functions.
        "element": (type(discretisation.element), discretisation.interior.shapes((0,))[0]),
        "values of the wave": values,
        "values of the ground": None if hill is None else hill.values(x, y),
    }
    return json.dumps({name: content_key(part, name) for name, part in parts.items()}, sort_keys=True)


def run_fingerprint(path: Path, scene: Scene, settings: Settings) -> str:
    """`fingerprint` of a run with a snapshot. Raises SnapshotError, with a remedy, if there is none."""
    try:
        return fingerprint(scene, settings)
    except Unidentifiable as error:
        raise SnapshotError(
            f"snapshot = {path}: must be None if the run cannot be identified, and {error}; give the "
            "function a name: FieldWave(..., name=...), Terrain(..., name=...)"
        ) from error


def _differences(theirs: str, mine: str, python: str) -> str:
    """The differences between two fingerprints, as the end of a sentence."""
    text = "belongs to another scene or to a run with other settings"
    try:
        old, new = json.loads(theirs), json.loads(mine)
        names = sorted(name for name in old.keys() | new.keys() if old.get(name) != new.get(name))
    except (ValueError, AttributeError):  # not a fingerprint of this program
        return text
    text += f": different {', '.join(names)}"
    if python != platform.python_version():
        text += (
            f" (it was written by Python {python}; functions are identified by their compiled code, "
            "which depends on the version)"
        )
    return text
