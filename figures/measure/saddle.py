"""V to second order in (alpha, beta) of sheets on a ground: theory, cycles of shapes and steps in time.

    python -m figures.measure.saddle [--out FILE]

Writes figures/data/saddle.csv, one row for each sheet, wave and friction law, about 40 s of the
processor each; it goes on where the file ends. The coefficients V_aa, V_ab and V_bb of cycle and
stepper come from speeds at (+-alpha, +-beta) and (+-alpha, 0), and from half of these couplings, with
the error of order (alpha, beta)^2 extrapolated; those of the stepper also from STEPS and twice as many.
The slip speed of the tanh law and the couplings shrink together. Friction is so weak (mu = 1e-3) that
it does not deform the sheet.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check import (
    Bending,
    Friction,
    Gravity,
    Ground,
    Material,
    Membrane,
    cycle_speed,
    simulate,
)
from figures.common.folders import DATA
from figures.common.output import tracked
from figures.common.records import Table
from linear_theory import FrictionLaw, Sheet, SineWave, Tanh, Viscous, pulse_wave, second_order
from linear_theory.scene.scene import Scene
from linear_theory.wave.protocol import Wave

Array = NDArray[np.float64]


class Place(NamedTuple):
    """A sheet and its ground, with elements that resolve its edge layers."""

    sheet: Sheet
    weight: float
    stiffness: float
    cells: tuple[int, int]


PLACES = {
    "paper": Place(Sheet(), 2.5e-4, 0.5, (4, 8)),
    "stiff ground": Place(Sheet(), 2.5e-4, 50.0, (6, 12)),
    "soft ground": Place(Sheet(), 2.5e-4, 0.05, (4, 8)),
    "narrow": Place(Sheet(width=0.2, poisson=0.3), 2.5e-4, 0.5, (2, 8)),
    "wide": Place(Sheet(width=1.0, poisson=0.3, thickness=0.02), 2.5e-4, 0.5, (8, 8)),
    "thin and heavy": Place(Sheet(thickness=0.015, poisson=0.0), 1e-3, 0.5, (6, 12)),
}

WAVES: dict[str, Wave] = {"sine": SineWave(), "pulse": pulse_wave(0.4)}

LAWS: dict[str, FrictionLaw] = {"tanh": Tanh(0.3), "viscous": Viscous()}
"""For speeds per unit alpha."""

ALPHA, OF_LIFT_OFF = {"sine": 0.005, "pulse": 0.01}, 0.3
"""Couplings: alpha by wave, and beta as a share of that at which the sheet lifts off.

The differences for V_bb have an error of alpha^2 beta^2, large on stiff ground: forces in the plane due
to growth pull at the slopes. For a sine at alpha = 0.01 it is 1.1 V_bb there, at 0.0025 it is 0.07. At
less than 0.01 V_a alpha of a pulse would hide its V_aa.
"""

STEPS, CYCLE_RTOL, COEFFICIENT = 64, 1e-3, 1e-3


@dataclass(frozen=True)
class Row:
    """Coefficients over L/T, L^2/T and L^3/T; beta: the larger coupling used; seconds: of cycle and
    stepper together."""

    place: str
    wave: str
    law: str
    beta: float
    theory_aa: float
    theory_ab: float
    theory_bb: float
    error_aa: float
    error_ab: float
    error_bb: float
    cycle_aa: float
    cycle_ab: float
    cycle_bb: float
    stepper_aa: float
    stepper_ab: float
    stepper_bb: float
    theory_seconds: float
    seconds: float


TABLE = Table(
    DATA / "saddle.csv",
    Row,
    "python -m figures.measure.saddle",
    "speeds in L/T, beta in 1/L, seconds of the processor",
    6,
)


def scene(place: Place, wave: Wave, law: FrictionLaw, alpha: float, beta: float) -> Scene:
    """A sheet on its ground; law: for speeds per unit alpha."""
    material = Material(place.sheet.thickness, place.sheet.poisson)
    friction = Friction(1e-3, law=law.scaled(1 / abs(alpha)))
    ground = Gravity(place.weight), Ground(place.stiffness), friction
    effects = [Membrane(material), Bending(material), *ground]
    return Scene(place.sheet, wave, alpha, beta, effects, cells=place.cells)


def coefficients(speed: Callable[[float, float], float], alpha: float, beta: float) -> Array:
    """V_aa, V_ab, V_bb from speeds at couplings of both signs, with an error of their square."""
    plane = [speed(a, 0.0) for a in (alpha, -alpha)]
    corners = {(a, b): speed(a * alpha, b * beta) for a in (1, -1) for b in (1, -1)}
    mixed = sum(a * b * v for (a, b), v in corners.items())
    bent = sum(corners.values()) - 2 * sum(plane)
    return np.array([sum(plane) / (2 * alpha**2), mixed / (4 * alpha * beta), bent / (4 * beta**2)])


def extrapolated(speed: Callable[[float, float], float], alpha: float, beta: float) -> Array:
    """`coefficients` from these couplings and from half of them."""
    whole, half = (coefficients(speed, alpha * s, beta * s) for s in (1.0, 0.5))
    return np.asarray((4 * half - whole) / 3)


def by_cycle(place: Place, wave: Wave, law: FrictionLaw) -> Callable[[float, float], float]:
    """V of a cycle of static shapes."""
    return lambda a, b: cycle_speed(scene(place, wave, law, a, b), rtol=CYCLE_RTOL).mean


def by_steps(place: Place, wave: Wave, law: FrictionLaw) -> Callable[[float, float], float]:
    """V of the second period by the stepper, its error of second order extrapolated."""

    def speed(alpha: float, beta: float) -> float:
        asked = scene(place, wave, law, alpha, beta)
        few, many = (
            float(simulate(asked, 2, steps=s, mesh_error=False).period_speeds[-1])
            for s in (STEPS, 2 * STEPS)
        )
        return (4 * many - few) / 3

    return speed


def opposite(wave: Wave, speed: Callable[[float, float], float]) -> Callable[[float, float], float]:
    """The speed, computed once for (a, b) and (-a, -b) where the wave cannot tell them apart."""
    known: dict[tuple[float, float], float] = {}
    same = isinstance(wave, SineWave)

    def either(alpha: float, beta: float) -> float:
        key = (abs(alpha), beta if alpha > 0 else -beta) if same else (alpha, beta)
        if key not in known:
            known[key] = speed(*key)
        return known[key]

    return either


def row(name: str, wave: str, law: str) -> Row:
    """One row of the table."""
    place, driven, rubs = PLACES[name], WAVES[wave], LAWS[law]
    begin = time.process_time()
    found = second_order(scene(place, driven, rubs, ALPHA[wave], 0.0), rtol=COEFFICIENT).coefficients
    theory_seconds = time.process_time() - begin
    theory = found.alpha_alpha, found.alpha_beta, found.beta_beta
    alpha, beta = ALPHA[wave], OF_LIFT_OFF * min(abs(b) for b in found.lift_off)
    cycle, stepper = (
        extrapolated(opposite(driven, way(place, driven, rubs)), alpha, beta)
        for way in (by_cycle, by_steps)
    )
    seconds = time.process_time() - begin - theory_seconds
    numbers = {
        f"{kind}_{part}": float(value)
        for kind, values in {
            "theory": [e.value for e in theory],
            "error": [e.error for e in theory],
            "cycle": list(cycle),
            "stepper": list(stepper),
        }.items()
        for part, value in zip(("aa", "ab", "bb"), values, strict=True)
    }
    return Row(name, wave, law, beta, **numbers, theory_seconds=theory_seconds, seconds=seconds)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write the table."""
    out = TABLE.options(__doc__, arguments).out
    rows = TABLE.read(out) if out.exists() else []
    known = {(r.place, r.wave, r.law) for r in rows}
    wanted = [(p, w, law) for w in WAVES for law in LAWS for p in PLACES]
    for place, wave, law in tracked("sheets", [key for key in wanted if key not in known]):
        rows.append(row(place, wave, law))
        TABLE.write(rows, out)


if __name__ == "__main__":
    main()
