"""Snapshots of a run: plain npz files, written atomically, refused when they are not what they were."""

import hashlib
import io
import os
import struct
import zipfile
import zlib
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.scene import Scene
from linear_theory.errors import SheetcrawlError

Array = NDArray[np.float64]

VERSION = 1

_DAMAGED = (
    *(zipfile.BadZipFile, zlib.error, struct.error, UnicodeDecodeError),
    *(ValueError, EOFError, OSError, KeyError, RuntimeError, AttributeError, SyntaxError),
)
"""What numpy and zipfile raise for files that are not what they should be."""

_LABELS = ("version", "checksum", "fingerprint")


class SnapshotError(SheetcrawlError, ValueError):
    """A snapshot that cannot be gone on from: truncated, altered, of another version or another run."""


def save_snapshot(path: Path, arrays: dict[str, Array], owner: str) -> None:
    """Write arrays and the fingerprint of their run; always the old or the new file is there."""
    labels = {
        "version": np.array(VERSION),
        "fingerprint": np.array(owner),
        "checksum": np.array(checksum(arrays, owner)),
    }
    temporary = path.with_name(f"{path.name}.{os.getpid()}.tmp")
    try:
        with open(temporary, "wb") as file:
            np.savez(file, allow_pickle=False, **arrays, **labels)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def load_snapshot(path: Path, owner: str) -> dict[str, Array]:
    """Arrays of a snapshot. Raises SnapshotError, saying why, if they are not to be trusted."""
    contents = io.BytesIO(path.read_bytes())
    try:
        with np.load(contents, allow_pickle=False) as file:
            found = {name: file[name] for name in file.files}
    except _DAMAGED as error:
        raise SnapshotError(f"snapshot {path}: is truncated or damaged ({error})") from error
    missing = [name for name in _LABELS if name not in found]
    if missing:
        raise SnapshotError(f"snapshot {path}: is no snapshot of a simulation (no {missing[0]})")
    version, stored, fingerprint = (found.pop(name) for name in _LABELS)
    if version != VERSION:
        raise SnapshotError(f"snapshot {path}: has version {version}, this program reads {VERSION}")
    if str(stored) != checksum(found, str(fingerprint)):
        raise SnapshotError(f"snapshot {path}: was altered, its checksum does not fit its contents")
    if str(fingerprint) != owner:
        raise SnapshotError(
            f"snapshot {path}: belongs to another scene or to a run with other settings"
        )
    return found


def checksum(arrays: dict[str, Array], owner: str) -> str:
    """SHA-256 of the names, types, shapes and bytes of arrays and of the fingerprint."""
    digest = hashlib.sha256(owner.encode())
    for name in sorted(arrays):
        array = np.ascontiguousarray(arrays[name])
        digest.update(f"{name} {array.dtype.str} {array.shape} ".encode())
        digest.update(array.tobytes())
    return digest.hexdigest()


def fingerprint(scene: Scene, settings: Any) -> str:
    """SHA-256 of all that determines a run: the scene's values, mesh and element, and settings.

    A wave or height that is a function of no dataclass is known by its values at the points.
    """
    discretisation = scene.discretisation()
    x, y = discretisation.interior.parameters.reshape(2, -1)
    digest = hashlib.sha256(f"{VERSION} {settings!r} ".encode())
    for name in ("sheet", "alpha", "curvature_coupling", "growth_law", "curvature", "area", "effects"):
        digest.update(_canonical(getattr(scene, name), x, y).encode())
    for t in (0.0, 0.1234, 0.5678):  # phases at which no usual wave repeats itself
        digest.update(scene.growth(t * scene.period, x, y).tobytes())
    digest.update(f"{scene.period!r} {type(discretisation.element).__name__} {x.size}".encode())
    digest.update(np.ascontiguousarray(discretisation.mesh.p).tobytes())
    digest.update(np.ascontiguousarray(discretisation.mesh.t).tobytes())
    return digest.hexdigest()


def _canonical(value: Any, x: Array, y: Array) -> str:
    """Text that is the same whenever the values are."""
    if is_dataclass(value):
        inner = [f"{f.name}={_canonical(getattr(value, f.name), x, y)}" for f in fields(value)]
        return f"{type(value).__name__}({', '.join(inner)})"
    if isinstance(value, tuple | list):
        return f"[{', '.join(_canonical(v, x, y) for v in value)}]"
    if callable(value):
        return hashlib.sha256(np.asarray(value(x, y)).tobytes()).hexdigest()
    if isinstance(value, np.ndarray):
        return f"{value.shape}{value.tobytes().hex()}"
    return repr(value)
