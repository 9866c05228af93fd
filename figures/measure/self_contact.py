"""What the gap and the stiffness of contact of a sheet with itself do to its speed, and its error.

    python -m figures.measure.self_contact [--out FILE]

Writes figures/data/self_contact.csv: three minutes of computing. The strip of docs/howto/bending.md,
rolled up by more than a full turn, and some that are rolled up more or less, over a period of 16
steps. Only at a small gap and a large stiffness are the surfaces those of the sheet.
"""

import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane, SelfContact, simulate
from fem_check.shell.statics.equilibrium import ConvergenceError
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from linear_theory import FieldWave, Sheet
from linear_theory.scene.scene import Scene

STRIP = Sheet(length=1.0, width=0.06, thickness=0.04)
MATERIAL = Material(STRIP.thickness, STRIP.poisson)
WAVE = FieldWave(lambda x, y, t: 1 + 0.4 * y + 0.1 * np.sin(2 * np.pi * (y - t)), 1.0)

KAPPAS = (-9.0, -8.0, -8.5, -10.0)
GAPS = (0.02, 0.01, 0.004, 0.001)
STIFFNESSES = (0.1, 10.0)
"""Over the one that `SelfContact` has unless it is given."""

STEPS, DIGITS = 16, 4


@dataclass(frozen=True)
class Row:
    """V in L/T with its estimated error, `contact` the part by the gap; touching, crossed: shares of
    the states. kappa in 1/L, gap in L, stiffness over the usual one; seconds of the processor. NaN
    where the strip finds no rest: it falls over before it touches itself."""

    kappa: float
    gap: float
    stiffness: float
    speed: float
    error: float
    contact: float
    touching: float
    crossed: float
    seconds: float


TABLE = Table(
    DATA / "self_contact.csv",
    Row,
    "python -m figures.measure.self_contact",
    f"{STEPS} steps a period; speeds in L/T, kappa in 1/L, gap in L, seconds of the processor",
    DIGITS,
)


def scene(
    kappa: float,
    gap: float | None = None,
    stiffness: float = 1.0,
    cells: tuple[int, int] = (1, 8),
) -> Scene:
    """A strip. stiffness: over the usual one."""
    contact = SelfContact(MATERIAL, gap, stiffness * SelfContact(MATERIAL).stiffness)
    bearing = Gravity(2.5e-4), Ground(5.0), Friction(1.0, law="viscous")
    effects = (Membrane(MATERIAL), Bending(MATERIAL), *bearing, contact)
    return Scene(STRIP, WAVE, 0.05, kappa, effects, cells=cells)


def row(kappa: float, gap: float, stiffness: float = 1.0) -> Row:
    """One strip."""
    begin = time.process_time()
    try:
        found = simulate(scene(kappa, gap, stiffness), 1, steps=STEPS)
    except ConvergenceError:
        lost = (float("nan"),) * 5
        return Row(kappa, gap, stiffness, *lost, time.process_time() - begin)
    assert found.crossed is not None
    speeds = found.mean_speed, found.speed.error, found.errors.contact
    shares = float(found.touching.mean()), float(found.crossed.mean())
    return Row(kappa, gap, stiffness, *speeds, *shares, time.process_time() - begin)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    options = TABLE.options(__doc__, arguments)
    places = [(kappa, gap, 1.0) for kappa in KAPPAS for gap in GAPS]
    places += [(KAPPAS[0], GAPS[0], stiffness) for stiffness in STIFFNESSES]
    TABLE.write([row(*place) for place in tracked("strips", places)], options.out)


if __name__ == "__main__":
    main()
