"""How the sheet crawls under each preset of the excitable wave, cycle by cycle.

    python -m figures.measure.excitable [--out FILE] [--alpha 0.1]

Writes figures/data/excitable.csv and prints it: two minutes. The body is a line, and the paper's sheet
in the theory of small strain; friction is dry or viscous, the load follows the current size. Cycles are
counted from 0; the pulse train has settled in its last one.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from fem_check.excitable.presets import PRESETS
from fem_check.excitable.speeds import speeds
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from linear_theory.friction.contact import Contact
from linear_theory.friction.laws import Coulomb, Viscous
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet

SHEET = Sheet()

ALPHA, RTOL, WAVE_RTOL = 0.1, 1e-2, 3e-3
"""Growth per c, tolerance of the speeds and of c."""

WAVES = ("printed", "nu = -0.1", "nu = -0.05", "pulse train")
"""The presets that run along a sheet; a spiral turns about a place on a square one."""

FRICTION = {"dry": Coulomb(), "viscous": Viscous()}

CYCLES = (0, 1, 3, -1)
"""Cycles that are shown: those that the paper's four periods have, and the last one."""

DIGITS = 4


@dataclass(frozen=True)
class Row:
    """Displacement in one cycle, lengths; lag: cycles by which the front end is behind the rear."""

    preset: str
    body: str
    friction: str
    cycle: int
    period: float
    lag: float
    displacement: float
    error: float


TABLE = Table(
    DATA / "excitable.csv",
    Row,
    "python -m figures.measure.excitable",
    f"alpha = {ALPHA}; L = 1, time in units of the reaction; displacement per cycle in L",
    DIGITS,
)


def measure(name: str, alpha: float) -> list[Row]:
    """All bodies and laws of friction under one preset."""
    chosen = PRESETS[name]
    wave = chosen.equation.on(SHEET, chosen.until, WAVE_RTOL)
    numbers = sorted({wave.cycle(k).number for k in CYCLES})
    rows = []
    for body in ("line", "sheet"):
        for words, law in FRICTION.items():
            scene = Scene(SHEET, wave, alpha, contact=Contact(friction=law), growth_law="linear")
            found = speeds(scene, numbers, RTOL, body)
            for i, k in enumerate(numbers):
                period, lag = float(found.period[i]), float(wave.cycles.lag[k])
                error = float(found.error[i]) * period
                moved = float(found.displacement[i])
                rows.append(Row(name, body, words, k, period, lag, moved, error))
    return rows


def shown(rows: Sequence[Row]) -> str:
    """The table as text, displacements in thousandths of the length."""
    heads = "".join(f"{name:>11}" for name in ("line, dry", "viscous", "sheet, dry", "viscous"))
    lines = [f"{'preset':<13}{'cycle':>6}{'period':>8}{'lag':>6}{heads}  (L/1000 per cycle)"]
    for key in dict.fromkeys((row.preset, row.cycle) for row in rows):
        own = [row for row in rows if (row.preset, row.cycle) == key]
        moved = "".join(f"{1e3 * row.displacement:>11.3f}" for row in own)
        lines.append(f"{key[0]:<13}{key[1]:>6}{own[0].period:>8.2f}{own[0].lag:>6.2f}{moved}")
    return "\n".join(lines)


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure, write and print the table."""
    options = TABLE.options(__doc__, arguments, alpha=(ALPHA, "growth per c"))
    rows = [row for name in tracked("presets", WAVES) for row in measure(name, options.alpha)]
    TABLE.write(rows, options.out)
    print(shown(rows))


if __name__ == "__main__":
    main()
