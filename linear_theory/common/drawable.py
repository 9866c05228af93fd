"""Results that can be drawn: `.plot()` and `.movie(path)`.

The methods are declared here, with the results, and implemented by the package `fem_check.output`,
which is imported by name when a picture is requested. Nothing in `linear_theory` imports that package
or matplotlib: pure computations load neither.
"""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

OUTPUT = "fem_check.output"
"""The package that draws."""


class Drawable:
    """A result whose motion can be drawn and filmed."""

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

        what: one panel,

        - "speed": V(t) over a period with its mean and error band,
        - "sheet": the deformed sheet coloured by its growth alpha c, with friction forces as arrows,
        - "friction": the sheet coloured by the friction along y, per mu times the weight per area,
        - "pressure": a sheet in space coloured by its normal load over the weight per area,
        - "side": a sheet in space and its ground, seen from the edge,
        - "kymograph", "displacement", "height": along the middle of the sheet, y across and time
          upwards, the wave c, the displacement along y in the frame of the body (as in fig. 2 of the
          paper) and the height over z = 0,
        - "power": of a simulation, the work of growth and where it goes,
        - "path": the path of the centre over several periods, with the outline at both ends;

        None for a figure of all that the result has. ax: matplotlib axes for one panel; new ones by
        default. phase: time at which the sheet is drawn, in periods. periods: shown, of a motion that
        repeats by default 10 in a path and 2 in kymographs. units: an `fem_check.output.Units`; by
        default the length of the sheet and the period of the wave.

        Returns the axes, or an array (panels,) of them if what is None; `axes.figure.savefig(path)`
        writes the picture. Raises ValueError for bad input and for a panel for which the result has no
        data.
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
        view: Any = None,
        units: Any = None,
        progress: Callable[[int, int], object] | bool = False,
    ) -> Path:
        """Write a film of the crawling sheet, .gif or .mp4, and return its path.

        periods: duration in periods of the wave; by default 6, for a trajectory all of its periods.
        frames: per period. fps: frames per second. width: of the picture, 420 to 1920 pixels.
        exaggerate: factor on the displacement within the sheet (never on the distance crawled), which
        the film then states. view: "top", from above, or "space", from the side and above with a
        section to scale below it (heights too small to be seen are stretched by a factor that the film
        states); by default in space for a sheet that leaves the plane; an `fem_check.output.View` or
        its name. Colours are growth alpha c, arrows friction. units: as in `plot`. progress: called
        with the number of frames done and the total; True prints a line once writing takes more than
        two seconds.

        The file appears when it is complete, and not at all if writing is interrupted. A .gif is
        reproducible byte for byte. Raises, before any work, ValueError for bad input and for a
        folder that is not there, OSError for a path that cannot be written to, and ModuleNotFoundError
        for .mp4 without the extra `movies`.
        """
        return import_module(OUTPUT).movie(
            self,
            path,
            periods=periods,
            frames=frames,
            fps=fps,
            width=width,
            exaggerate=exaggerate,
            view=view,
            units=units,
            progress=progress,
        )
