"""Pictures and films of a recording, written to the folder of a run."""

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

from fem_check.answer.units import Units
from fem_check.output import writers
from fem_check.output.files import replacing
from fem_check.output.look import styled
from fem_check.output.movies import movie
from fem_check.output.moving import Moving
from fem_check.output.pictures import checked_units, draw_figure, panels
from fem_check.runs.recording import Recording

LINES = ("kymograph", "displacement", "height")
"""Panels that show a line of the sheet over time."""


def pictures(moving: Moving) -> dict[str, tuple[str, ...]]:
    """The panels of each picture by its name: "motion", "kymographs", and every panel alone."""
    names = panels(moving)
    lines = tuple(name for name in names if name in LINES)
    motion = tuple(name for name in names if name not in LINES)
    return {"motion": motion, "kymographs": lines, **{name: (name,) for name in names}}


WRITTEN = ("motion", "kymographs")
"""Pictures in the folder of every run."""

SUFFIXES = (".png", ".pdf")

METADATA: dict[str, dict[str, Any]] = {
    ".pdf": {"CreationDate": None},
    ".svg": {"Date": None},
    ".png": {"Software": None},
}
"""Nothing that changes from one writing to the next."""

DPI = 150

PERIODS, PER_PERIOD = 2, 24
"""Length of a film of a motion that repeats, in periods, and its frames to a period."""

FILMS = tuple(writers.WRITERS)

Report = Callable[[int, int], object]


def write_pictures(recording: Recording, folder: Path, units: Units | None = None) -> list[Path]:
    """Those of `WRITTEN` as PNG and PDF; their paths."""
    targets = {name: [folder / f"{name}{suffix}" for suffix in SUFFIXES] for name in WRITTEN}
    for name, paths in targets.items():
        save(recording, paths, units, name)
    return [path for paths in targets.values() for path in paths]


def save(recording: Recording, paths: list[Path], units: Units | None, name: str) -> None:
    """Draw one of `pictures`, and write it to files of the types that their names say."""
    import matplotlib.pyplot as plt  # here: it selects a backend

    units = checked_units(recording, units)
    figure = draw_figure(pictures(recording)[name], recording, units, 0.0, None)[0].figure
    try:
        for path in paths:
            with styled(), replacing(path) as part:
                figure.savefig(part, dpi=DPI, metadata=METADATA[path.suffix.lower()])
            figure.set_layout_engine("none")  # the others are laid out as the first, in half the time
    finally:
        plt.close(figure)


def possible_films() -> list[str]:
    """Suffixes of films that can be written here: .gif, and .mp4 where there is an encoder."""
    return [suffix for suffix in FILMS if not _missing(suffix)]


def _missing(suffix: str) -> str:
    """What these films lack here, in words; empty where they can be written."""
    try:
        writers.require(suffix)
    except ModuleNotFoundError as missing:
        return str(missing)
    return ""


def write_films(
    recording: Recording, folder: Path, units: Units | None = None, report: Report | None = None
) -> list[Path]:
    """motion.gif, and motion.mp4 where it can be written; their paths. report: as in `movie`.

    Warns of films that cannot be written, with what to install.
    """
    for suffix in FILMS:
        if missing := _missing(suffix):
            warnings.warn(f"motion{suffix} is left out: {missing}", stacklevel=2)
    periods = PERIODS if recording.most_periods is None else None
    targets = [folder / f"motion{suffix}" for suffix in possible_films()]
    for target in targets:
        movie(
            *(recording, target),
            periods=periods,
            frames=PER_PERIOD,
            units=units,
            progress=report or False,
        )
    return targets
