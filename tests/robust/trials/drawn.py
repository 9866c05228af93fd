"""Sheets, waves, laws and couplings at random."""

from typing import Any

import numpy as np

from linear_theory import Coulomb, Directional, Sheet, SineWave, Tanh, TravellingWave, Viscous
from linear_theory.friction.law import FrictionLaw


def a_sheet(rng: np.random.Generator, widest: float = 2.0) -> Sheet:
    width = float(np.exp(rng.uniform(np.log(0.05), np.log(widest))))
    return Sheet(width=width, poisson=float(rng.uniform(-0.5, 0.5)))


def a_wave(rng: np.random.Generator, harmonics: int = 4) -> TravellingWave:
    """A sine in half of all cases, else a few harmonics that fall off, with or without a mean."""
    count = int(rng.choice([1, 1, 1, 2, -1, -2, 3]))
    if rng.random() < 0.5:
        return SineWave(count)
    order = np.arange(1, rng.integers(2, harmonics + 1) + 1)
    cosine, sine = rng.normal(size=(2, order.size)) / order**1.5
    size = np.abs(cosine).sum() + np.abs(sine).sum()
    mean = float(rng.choice([0.0, rng.uniform(-0.3, 0.3)]))
    return TravellingWave(cosine / size, sine / size, count, 1.0, mean)


def a_law(rng: np.random.Generator, alpha: float) -> dict[str, Any]:
    """Friction; slip speeds from dry to viscous, in units of alpha L/T."""
    name = str(rng.choice(["coulomb", "coulomb", "tanh", "viscous"]))
    slip = {"slip_speed": abs(alpha) * 10.0 ** rng.uniform(-3, 1)} if name == "tanh" else {}
    return {"friction": name, **slip}


def an_alpha(rng: np.random.Generator, largest: float) -> float:
    return float(rng.choice([-1, 1]) * np.exp(rng.uniform(np.log(1e-3), np.log(largest))))


def a_directional_law(rng: np.random.Generator, alpha: float) -> FrictionLaw:
    """With directions, dry in half of all cases, in half along the sheet."""
    forward, backward, sideways = 10.0 ** rng.uniform(-0.5, 0.5, size=3)
    heading = float(rng.choice([0.0, 0.0, rng.uniform(-np.pi, np.pi)]))
    form = {"dry": Coulomb(), "viscous": Viscous()}.get(
        str(rng.choice(["dry", "dry", "tanh", "viscous"])),
        Tanh(abs(alpha) * 10.0 ** float(rng.uniform(-2, 0))),
    )
    return Directional(float(forward), float(backward), float(sideways), form=form, heading=heading)
