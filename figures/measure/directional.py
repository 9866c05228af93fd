"""Speeds under friction with a direction: V against r, of a wave and of a sheet that breathes.

    python -m figures.measure.directional [--out FILE] [--rtol 3e-3]

Writes figures/data/directional.csv, which `figures.draw.directional` draws: a minute of computing. Dry
friction with coefficients 1 - r forward, 1 + r backward and 1 sideways. "wave": one sine wave on the
body; "breathing": c = sin(2 pi t/T) everywhere. The models: "line", a body on a line with stretch
exp(alpha c); "theory", the 2:1 sheet of the paper at small strain (eqs 10 and 11); "nonlinear", the
same sheet with growth exp(2 alpha c) of its area, by static shapes.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from fem_check.shell.cycle.speed import cycle_speed
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.common.scenes import smooth_scene
from linear_theory import (
    CrawlSpeed,
    Directional,
    FieldWave,
    Sheet,
    SineWave,
    crawl_speed,
    line_balance,
)
from linear_theory.wave.protocol import Wave

SHEET, ALPHA = Sheet(), 0.1

BREATHING = FieldWave(lambda x, y, t: np.sin(2 * np.pi * t) + 0 * x * y, period=1.0)

WAVES: dict[str, Wave] = {"wave": SineWave(), "breathing": BREATHING}

RTOL = 3e-3
"""Relative error asked of the speeds: a third of the width of a line."""

DIFFERENCES = tuple(round(0.05 * k, 2) for k in range(20))
"""r of the lines; every fourth one for the symbols."""

CELLS = (4, 8)
"""Elements across and along of the nonlinear sheet."""

DIGITS = 6
"""Significant digits written."""


@dataclass(frozen=True)
class Row:
    """V/alpha and its estimated numerical error in L/T.

    model, wave: see above. r: (backward - forward)/(backward + forward).
    """

    model: str
    wave: str
    r: float
    coefficient: float
    error: float


TABLE = Table(
    DATA / "directional.csv",
    Row,
    "python -m figures.measure.directional",
    f"alpha = {ALPHA:g}; r: (backward - forward)/(backward + forward), coefficient: V/alpha, L/T",
    DIGITS,
)


def law(r: float) -> Directional:
    """Dry friction with that difference of its coefficients."""
    return Directional(1 - r, 1 + r, 1.0)


def line(wave: Wave, r: float, rtol: float) -> CrawlSpeed:
    """The body on a line."""
    return line_balance(
        wave, ALPHA, friction=law(r), rtol=rtol, atol=rtol * ALPHA, growth_law="exp", length=1.0
    )


def theory(wave: Wave, r: float, rtol: float) -> CrawlSpeed:
    """The paper's theory."""
    return crawl_speed(SHEET, wave, ALPHA, friction=law(r), rtol=rtol, atol=rtol * ALPHA)


def nonlinear(wave: Wave, r: float, rtol: float) -> CrawlSpeed:
    """The cycle of static shapes."""
    scene = smooth_scene(SHEET, wave, ALPHA, CELLS)
    return cycle_speed(scene, "current", law(r), rtol=rtol, atol=rtol * ALPHA)


MODELS: dict[str, tuple[Callable[[Wave, float, float], CrawlSpeed], tuple[float, ...]]] = {
    "line": (line, DIFFERENCES),
    "theory": (theory, DIFFERENCES),
    "nonlinear": (nonlinear, DIFFERENCES[::4]),
}
"""How each model finds a speed, and at which r."""


def row(model: str, wave: str, r: float, rtol: float = RTOL) -> Row:
    """One speed. Raises RuntimeError if it misses its tolerance."""
    found = MODELS[model][0](WAVES[wave], r, rtol)
    if not found.converged:
        raise RuntimeError(f"{model}, {wave}, r = {r:g}: error {found.error:.2g} misses {rtol:g}")
    return Row(model, wave, r, found.mean / ALPHA, found.error / ALPHA)


def compute(rtol: float = RTOL) -> list[Row]:
    """All rows of the table, saying how far it is."""
    chosen = [(m, wave, r) for m, (_, rs) in MODELS.items() for wave in WAVES for r in rs]
    return [row(*one, rtol) for one in tracked("directional", chosen)]


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments, rtol=(RTOL, "relative error of the speeds"))
    TABLE.write(compute(options.rtol), options.out)


if __name__ == "__main__":
    main()
