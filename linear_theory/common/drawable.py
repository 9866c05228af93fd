"""Results that can be drawn: `.plot()` and `.movie(path)`.

The methods are declared here, where the results are, and done by the package `fem_check.output`, which
is looked up by its name when a picture is asked for. Nothing in `linear_theory` imports it or
matplotlib: whoever only computes loads neither.
"""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

OUTPUT = "fem_check.output"
"""The package that draws."""


class Drawable:
    """A result that shows how its sheet moves."""

    def plot(
        self,
        what: str | None = None,
        *,
        ax: Any = None,
        phase: float = 0.0,
        periods: int | None = None,
        units: Any = None,
    ) -> Any:
        """Draw the motion with matplotlib.

        what: "speed", V(t) through a period with its mean and error band; "sheet", the deformed sheet
        coloured by its growth alpha c, with the friction of the ground as arrows; "path", the way of
        its centre over some periods with its outline at both ends; None for a figure of all of them.
        ax: matplotlib axes to draw "speed", "sheet" or "path" in, new ones unless given. phase: of the
        sheet, in periods. periods: of the path, 10 unless given. units: an `fem_check.output.Units`;
        lengths of the sheet and periods of the wave unless given.

        Returns the axes, an array (panels,) of them where what is None; `axes.figure.savefig(path)`
        writes the picture. Raises ValueError for bad input and for a panel that the result has nothing
        for.
        """
        return import_module(OUTPUT).plot(self, what, ax=ax, phase=phase, periods=periods, units=units)

    def movie(
        self,
        path: str | Path,
        *,
        periods: int | None = None,
        frames: int = 24,
        fps: float = 15.0,
        width: int = 640,
        exaggerate: float = 1.0,
        units: Any = None,
        progress: Callable[[int, int], object] | bool = False,
    ) -> Path:
        """Write a film of the crawling sheet, .gif or .mp4, and return its path.

        periods: of the wave, 6 unless given, of a trajectory all that it has. frames: per period. fps:
        frames per second. width: of the picture, 420 to 1920 pixels. exaggerate: factor of the
        displacement within the sheet (never of the way it crawls), which the film then states. units:
        as in `plot`. progress: called with the frames done and their number; True prints a line once
        writing takes more than two seconds.

        The file appears when it is whole, and not at all if writing is interrupted. The same film has
        the same bytes as a .gif. Raises, before any work, ValueError for bad input, OSError for a path
        that cannot be written to, and ModuleNotFoundError for .mp4 without the extra `movies`.
        """
        return import_module(OUTPUT).movie(
            self,
            path,
            periods=periods,
            frames=frames,
            fps=fps,
            width=width,
            exaggerate=exaggerate,
            units=units,
            progress=progress,
        )
