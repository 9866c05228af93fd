"""The sheet that bends and does not grow, alpha = 0: dry speed and power of theory and of cycles.

    python -m figures.measure.plate.bent_alone [--out FILE]

Writes figures/data/bent_alone.csv, one row for each sheet and wave, a minute of the processor each; it
goes on where the file ends. Slip is beta^2 v_b, and V and power are beta^2 times what the table has.
That is far below the errors of V for symmetric waves, where it vanishes, and for most sheets: these
have waves that are not symmetric, and soft ground or a narrow sheet. Cycles of shapes at +-BETA and at
half of that, with the error of the square of beta extrapolated. On these elements they are 0.5 % off;
on twice as many each way those of the narrow sheet give V = 2.005e-4, theory 2.006e-4.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check import cycle_speed
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from figures.measure import saddle
from linear_theory import CrawlSpeed, Tanh, TravellingWave, crawl_speed, pulse_wave
from linear_theory.scene.scene import Scene
from linear_theory.wave.protocol import Wave

Array = NDArray[np.float64]

WAVES: dict[str, Wave] = {
    "two harmonics": TravellingWave(np.array([1.0, 0.4]), np.array([0.0, 0.3])),
    "short pulse": pulse_wave(0.2),
}

CASES = (
    ("narrow", "two harmonics"),
    ("paper", "two harmonics"),
    ("soft ground", "two harmonics"),
    ("soft ground", "short pulse"),
)
"""Of `saddle.PLACES` and WAVES."""

DRY = Tanh(1e-9)
"""Far below the slip, 1e-5 L/T."""

BETA, RTOL, CYCLE_RTOL = 0.3, 1e-3, 3e-3


@dataclass(frozen=True)
class Row:
    """V and power over beta^2 (L^3/T), of theory with errors, and of cycles."""

    place: str
    wave: str
    speed: float
    speed_error: float
    power: float
    power_error: float
    cycle_speed: float
    cycle_power: float


TABLE = Table(
    DATA / "bent_alone.csv",
    Row,
    "python -m figures.measure.plate.bent_alone",
    "alpha = 0; over beta^2, in L^3/T",
    6,
)


def scene(place: str, wave: str, beta: float) -> Scene:
    """A sheet on its ground that bends alone."""
    return saddle.scene(saddle.PLACES[place], WAVES[wave], DRY, 1.0, beta).but(alpha=0.0)


def by_theory(place: str, wave: str, rtol: float = RTOL) -> CrawlSpeed:
    """The answer at a beta at which the sheet lies on its ground."""
    return crawl_speed(scene(place, wave, 0.1), order=2, rtol=rtol)


def by_cycles(place: str, wave: str) -> Array:
    """V and power over beta^2, (2,)."""

    def even(beta: float) -> Array:
        found = [cycle_speed(scene(place, wave, b), rtol=CYCLE_RTOL) for b in (beta, -beta)]
        return np.mean([[f.mean, f.power.value] for f in found], axis=0) / beta**2

    return np.asarray((4 * even(BETA / 2) - even(BETA)) / 3)


def row(place: str, wave: str) -> Row:
    """One row of the table."""
    found = by_theory(place, wave)
    values = [v / 0.1**2 for v in (found.mean, found.error, *found.power)]
    return Row(place, wave, *values, *(float(v) for v in by_cycles(place, wave)))


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    out = TABLE.options(__doc__, arguments).out
    rows = TABLE.read(out) if out.exists() else []
    known = {(r.place, r.wave) for r in rows}
    for place, wave in tracked("sheets", [case for case in CASES if case not in known]):
        rows.append(row(place, wave))
        TABLE.write(rows, out)


if __name__ == "__main__":
    main()
