"""Random scenes: a sheet, a travelling wave of several harmonics, a load, a law of friction."""

import numpy as np

from linear_theory import (
    Contact,
    Coulomb,
    Directional,
    FrictionLaw,
    Scene,
    Sheet,
    Tanh,
    TravellingWave,
    Viscous,
)

LAWS = ("viscous", "tanh", "directional", "coulomb")
"""Of the scenes in turn; "directional" is tanh friction with a direction."""


def law(name: str, random: np.random.Generator) -> FrictionLaw:
    """One of that kind; of slip speeds from dry to viscous."""
    slip = Tanh(float(np.exp(random.uniform(np.log(0.02), np.log(0.5)))))
    if name == "directional":
        forward, backward, sideways = random.uniform(0.5, 1.5, 3).tolist()
        return Directional(forward, backward, sideways, form=slip)
    return {"viscous": Viscous(), "tanh": slip, "coulomb": Coulomb()}[name]


def scene_of(name: str, random: np.random.Generator, harmonics: int | None = None) -> Scene:
    """A random scene with friction of that kind; harmonics: 2 to 5 unless given."""
    count = int(random.integers(2, 6)) if harmonics is None else harmonics
    k = np.arange(1, count + 1)
    cosine, sine = random.normal(size=(2, count)) / k**1.5
    size = np.hypot(cosine, sine).sum()
    wave = TravellingWave(
        cosine / size, sine / size, int(random.choice([-1, 1, 2])), 1.0, random.uniform(-0.2, 0.2)
    )
    sheet = Sheet(width=float(random.uniform(0.2, 1.0)), poisson=float(random.uniform(-0.3, 0.49)))
    alpha = float(random.choice([-1, 1]) * random.uniform(0.05, 0.25))
    load = str(random.choice(["current", "grown", "material"]))
    if name == "viscous" and load == "material":
        load = "current"  # V = 0 otherwise, whatever the wave
    return Scene(sheet, wave, alpha=alpha, contact=Contact(load, law(name, random)))


def names_of(scene: Scene) -> list[str]:
    """All parameters of a random scene but its period."""
    assert isinstance(scene.wave, TravellingWave)
    waves = [f"wave.{part}.{k}" for k in range(scene.wave.cosine.size) for part in ("cosine", "sine")]
    friction = scene.contact.friction
    names = ["growth.alpha", "sheet.width", "sheet.poisson", "wave.mean", *waves]
    if isinstance(friction, Directional):
        names += [f"friction.{name}" for name in ("forward", "backward", "sideways")]
    return names + (["friction.slip_speed"] if friction.regularised else [])
