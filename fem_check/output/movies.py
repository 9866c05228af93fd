"""`.movie(path)`: frames of the crawling sheet, written as .gif or .mp4."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.output import writers
from fem_check.output.files import replacing, writable
from fem_check.output.film.race import Race
from fem_check.output.film.space import SpaceStage
from fem_check.output.film.stage import Stage
from fem_check.output.film.view import View
from fem_check.output.moving import Moving
from fem_check.output.pictures import checked_periods, checked_units, moving_of
from fem_check.output.progress import Progress
from linear_theory.common import validation

Pixels = NDArray[np.uint8]

PERIODS = 6
"""Default number of periods of a film."""

MOST_FRAMES = 3000
"""Largest number of frames: some minutes of computation, and of film."""

WIDTHS = 420, 1920
"""Range of widths in pixels: below the first, labels would overlap."""

STAGES: dict[View, type[Stage]] = {View.TOP: Stage, View.SPACE: SpaceStage}

Report = Callable[[int, int], object]


def movie(
    result: Any,
    path: str | Path,
    *,
    periods: int | None = None,
    frames: int = 24,
    fps: float = 15.0,
    width: int = 640,
    exaggerate: float = 1.0,
    view: View | str | None = None,
    units: Units | None = None,
    progress: Report | bool = False,
) -> Path:
    """See `linear_theory.common.drawable.Drawable.movie`.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from linear_theory import Sheet, SineWave, crawl_speed
    >>> speed = crawl_speed(Sheet(), SineWave(), alpha=0.2, rtol=1e-2)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = speed.movie(Path(folder) / "crawl.gif", periods=1, frames=4, width=420)
    ...     print(path.name, path.stat().st_size > 1000)
    crawl.gif True
    """
    target, moving = _target(path), _with_shape(result)
    periods = checked_periods(moving, periods, PERIODS)
    factor = validation.positive("exaggerate", exaggerate)
    _check_looks(periods, frames, fps, width)
    stage_of = STAGES[View.named(view, moving.components)]
    stage = stage_of(moving, checked_units(moving, units), periods, frames, width, factor)
    return _written(stage, periods * frames, target, fps, progress)


def race(
    results: Sequence[Any],
    names: Sequence[str],
    path: str | Path,
    *,
    periods: int | None = None,
    frames: int = 24,
    fps: float = 15.0,
    width: int = 640,
    units: Units | None = None,
    progress: Report | bool = False,
) -> Path:
    """Film two motions, the first above the second, on one ground, clock and scale.

    results: two, as `movie` takes them; names: how they are called in the picture. periods, frames: of
    the first; other arguments as for `movie`. Raises ValueError for results without a shape, and as
    `movie` does.

    >>> import tempfile
    >>> from pathlib import Path
    >>> from fem_check.output.movies import race
    >>> from linear_theory import Sheet, SineWave, crawl_speed
    >>> both = [crawl_speed(Sheet(), SineWave(), alpha=alpha, rtol=1e-2) for alpha in (0.1, 0.2)]
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     names = ("alpha = 0.1", "alpha = 0.2")
    ...     path = race(both, names, Path(folder) / "two.gif", periods=1, frames=3, width=420)
    ...     print(path.name, path.stat().st_size > 1000)
    two.gif True
    """
    target = _target(path)
    if len(results) != 2 or len(names) != 2:
        raise ValueError(f"results, names: {len(results)} and {len(names)} given, must be two each")
    movings = [_with_shape(result) for result in results]
    counts = [checked_periods(moving, periods, PERIODS) for moving in movings]
    _check_looks(min(counts), frames, fps, width)
    view = View.named(None, max(moving.components for moving in movings))
    known = checked_units(movings[0], units)
    shown = Race(movings, names, known, min(counts), frames, width, STAGES[view])
    return _written(shown, len(shown), target, fps, progress)


def _target(path: str | Path) -> Path:
    """A file that can be written, and its writer is there."""
    target = writable(path, tuple(writers.WRITERS))
    writers.require(target.suffix.lower())
    return target


def _with_shape(result: Any) -> Moving:
    moving = moving_of(result)
    if not moving.has_shape:
        raise ValueError("result: must have a shape; a speed on a line, or a copied one, has none")
    return moving


def _check_looks(periods: int, frames: int, fps: float, width: int) -> None:
    """Raises ValueError for what is out of range."""
    frames = validation.integer("frames", frames, 2)
    validation.positive("fps", fps)
    if not WIDTHS[0] <= validation.integer("width", width) <= WIDTHS[1]:
        raise ValueError(f"width = {width}: must be in [{WIDTHS[0]}, {WIDTHS[1]}] pixels")
    total = periods * frames
    if total > MOST_FRAMES:
        raise ValueError(
            f"periods = {periods}, frames = {frames}: gives {total} frames, must be at most "
            f"{MOST_FRAMES}; reduce either"
        )


def _written(
    stage: Stage | Race, total: int, target: Path, fps: float, progress: Report | bool
) -> Path:
    """The film of so many frames in its file."""
    write = writers.WRITERS[target.suffix.lower()]
    with replacing(target) as part, _progress(target, total, progress) as report:
        write(part, _reported(stage, report), fps)
    return target


def _reported(stage: Stage | Race, report: Report) -> Iterator[Pixels]:
    """The pictures, each reported when done."""
    for done, picture in enumerate(stage.pictures(), 1):
        yield picture
        report(done, len(stage))


def _progress(target: Path, total: int, progress: Report | bool) -> Any:
    """A context whose value is the function to call after each frame."""
    if callable(progress):
        return nullcontext(progress)
    if not isinstance(progress, bool):
        raise ValueError(f"progress = {validation.shown(progress)}: must be True, False or a function")
    return _Line(target.name, total) if progress else nullcontext(lambda done, total: None)


class _Line(Progress):
    """A progress line on stderr, called with the number of frames done."""

    def __call__(self, done: int, total: int) -> None:
        self.advance()
