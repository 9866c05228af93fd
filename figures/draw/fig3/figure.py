"""Figure 3: friction under a crawling sheet at one instant, and its mean speed by all the models.

    python -m figures.draw.fig3 [--out FOLDER] [--rtol 1e-4] [--formats png pdf]

Panel A: friction by the Airy series (left) and by linear finite elements (right). Panel B: mean speed
against the growth coupling under dry (Coulomb) friction, signs as they come out. Panel C: the same over
alpha^2, where the models differ: linear strains (eqs 10 and 11, corrected) in a balance that is not
expanded, by series and by linear finite elements; the nonlinear planar sheet, which grows by exp(alpha
c), and its second order V_2 alpha^2; bodies in one dimension that grow by 1 + alpha c (eq. 7,
corrected) and by exp(alpha c), exactly. The speed is of second order, beyond what small strains
determine: the nonlinear sheet has the limit V_2, 20 per cent below that of linear strains. Panel D:
speed over alpha^2 at the slip speeds v0 = 0.01, 1 and 100 alpha L/T of friction tanh(v/v0), dry, mixed
and viscous: lines from linear strains, symbols from the nonlinear sheet. In viscous crawling alone both
have the same limit.

In 2D the load is 'current', weight per current area as in eq. 11. Error bars are the estimated
numerical errors, less than the size of a symbol. Nonlinear speeds are read from the table that
`python -m figures.measure.nonlinear` writes, figures/data/nonlinear.csv.
"""

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from figures.common import output, style
from figures.common.records import write_csv
from figures.draw.fig3.data import ALPHA_SHOWN, ARROWS, RTOL, Fig3Data, compute
from figures.draw.fig3.panels import draw
from figures.draw.fig3.speeds import LABELS, REGIMES, Series
from figures.measure import nonlinear

Array = NDArray[np.float64]


def numbers_shown(data: Fig3Data) -> dict[str, object]:
    """What the JSON beside the figure holds."""
    coefficients = {
        LABELS[name]: {"value": value, "error": error}
        for name, (value, error) in data.coefficients.items()
    }
    top, bottom = data.snapshots
    difference = np.hypot(*(top.force - bottom.force))
    return {
        "alpha_shown": ALPHA_SHOWN,
        "speeds_at_alpha_shown": {series.label: at_alpha_shown(series) for series in data.series},
        "speed_over_alpha_squared_as_alpha_to_0": coefficients,
        "slip_regimes": slip_numbers(data),
        "largest_alpha": data.largest_alpha,
        "largest_difference_of_friction": difference.max(),
    }


def slip_numbers(data: Fig3Data) -> dict[str, dict[str, object]]:
    """Panel D by regime and model: at ALPHA_SHOWN, and V/alpha^2 at the smallest alpha there is."""
    found: dict[str, dict[str, object]] = {
        name: {"slip_speed_over_alpha": nonlinear.SLIPS[name]} for name in REGIMES
    }
    for series in data.slips:
        smallest = series.alpha[0]
        model = "linear theory" if series.kind == "theory" else "nonlinear sheet"
        found[series.friction][model] = {
            "at_alpha_shown": at_alpha_shown(series),
            "smallest_alpha": smallest,
            "speed_over_alpha_squared_at_smallest_alpha": {
                "value": series.speed[0] / smallest**2,
                "error": series.error[0] / smallest**2,
            },
        }
    return found


def at_alpha_shown(series: Series) -> dict[str, float]:
    """Speed and error of a series at ALPHA_SHOWN."""
    at = np.flatnonzero(series.alpha == ALPHA_SHOWN)[0]
    return {"speed": float(series.speed[at]), "error": float(series.error[at])}


def speed_columns(data: Fig3Data) -> dict[str, ArrayLike]:
    """Panels B to D, one row for each point."""
    rows = [
        (series.label, series.kind, series.friction, *numbers)
        for series in (*data.series, *data.slips)
        for numbers in zip(series.alpha, series.speed, series.error, strict=True)
    ]
    names = ("series", "kind", "friction", "alpha", "speed", "error")
    return dict(zip(names, zip(*rows, strict=True), strict=True))


def write(data: Fig3Data, out: Path | None, formats: Sequence[str]) -> list[Path]:
    """Figure, data (CSV) and numbers (JSON) in the folder `out`; returns their paths."""
    arrows: dict[str, ArrayLike] = {
        "source": np.repeat([shot.label for shot in data.snapshots], math.prod(ARROWS))
    }
    for name, vectors in (("", "feet"), ("moved_", "moved"), ("force_", "force")):
        for i, axis in enumerate("xy"):
            arrows[name + axis] = np.ravel([getattr(shot, vectors)[i] for shot in data.snapshots])
    return [
        *style.save(draw(data), "fig3", out, tuple(formats)),
        write_csv(style.output_path("fig3_speed.csv", out), speed_columns(data)),
        write_csv(style.output_path("fig3_friction.csv", out), arrows),
        output.write_json(style.output_path("fig3.json", out), numbers_shown(data)),
    ]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute, draw and write figure 3."""
    options = style.options("fig3", __doc__, arguments, rtol=(RTOL, "error of the speeds"))
    for path in write(compute(options.rtol), options.out, options.formats):
        print(path)
