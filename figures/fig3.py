"""Figure 3: friction under a crawling sheet at one instant, and its mean speed in 1D and 2D.

    python -m figures.fig3 [--out FOLDER] [--rtol 1e-4] [--formats png pdf]

Panel A: friction by the Airy series (top) and by linear finite elements (bottom). Panel B: mean
speed against the growth coupling, lines from theory, symbols from simulation, signs as they come
out. In 2D the load is 'current', weight per current area as in eq. 11; friction is dry (Coulomb).
"""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from figures import output, style
from figures.fig3_data import ALPHA_SHOWN, ARROWS, RTOL, Fig3Data, compute
from figures.fig3_draw import draw

Array = NDArray[np.float64]


def numbers_shown(data: Fig3Data) -> dict[str, object]:
    """What the JSON beside the figure holds."""
    shown = {}
    for series in data.series:
        at = np.flatnonzero(series.alpha == ALPHA_SHOWN)[0]
        shown[series.label] = {"speed": series.speed[at], "error": series.error[at]}
    coefficients = {
        f"{dimension}D": {"value": value, "error": error}
        for dimension, (value, error) in data.coefficients.items()
    }
    top, bottom = data.snapshots
    difference = np.hypot(*(top.force - bottom.force))
    return {
        "alpha_shown": ALPHA_SHOWN,
        "speeds_at_alpha_shown": shown,
        "speed_over_alpha_squared_as_alpha_to_0": coefficients,
        "largest_alpha": data.largest_alpha,
        "largest_difference_of_friction": difference.max(),
    }


def write(data: Fig3Data, out: Path | None, formats: Sequence[str]) -> list[Path]:
    """Figure, data (CSV) and numbers (JSON) in the folder `out`; returns their paths."""
    rows = [
        (series.label, series.kind, *numbers)
        for series in data.series
        for numbers in zip(series.alpha, series.speed, series.error, strict=True)
    ]
    speeds = dict(
        zip(("series", "kind", "alpha", "speed", "error"), zip(*rows, strict=True), strict=True)
    )
    arrows: dict[str, ArrayLike] = {
        "source": np.repeat([shot.label for shot in data.snapshots], math.prod(ARROWS))
    }
    for name, vectors in (("", "feet"), ("moved_", "moved"), ("force_", "force")):
        for i, axis in enumerate("xy"):
            arrows[name + axis] = np.ravel([getattr(shot, vectors)[i] for shot in data.snapshots])
    return [
        *style.save(draw(data), "fig3", out, tuple(formats)),
        output.write_csv(style.output_path("fig3_speed.csv", out), speeds),
        output.write_csv(style.output_path("fig3_friction.csv", out), arrows),
        output.write_json(style.output_path("fig3.json", out), numbers_shown(data)),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute, draw and write figure 3."""
    options = style.options("figures.fig3", main.__doc__, RTOL, "error of the speeds", arguments)
    for path in write(compute(options.rtol), options.out, options.formats):
        print(path)


if __name__ == "__main__":
    main()
