"""The largest stretch, and the largest of what is known at some times of a period."""

import numpy as np
import pytest

from fem_check.optimisation.options.quantities import TIMES, largest_of_period
from fem_check.optimisation.options.stretch import Stretch
from fem_check.optimisation.unknowns import Unknowns
from linear_theory import FieldWave, FractionalWave, Scene, Sheet, TravellingWave


def crest(wave: TravellingWave) -> float:
    """Largest c, at the roots of its derivative as a polynomial of z = exp(i phi)."""
    order = np.arange(1, wave.cosine.size + 1)
    half = (wave.cosine - 1j * wave.sine) / 2
    slopes = 1j * order * half  # of z^m; those of z^-m are conjugate to them
    phases = np.angle(np.roots([*slopes[::-1], 0, *np.conj(slopes)]))
    angles = np.multiply.outer(phases, order)
    return float((wave.mean + np.cos(angles) @ wave.cosine + np.sin(angles) @ wave.sine).max())


@pytest.mark.parametrize("seed", range(12))
def test_the_stretch_of_a_travelling_wave_is_that_of_its_crest(seed: int) -> None:
    rng = np.random.default_rng(seed)
    harmonics = int(rng.integers(1, 12))
    wave = TravellingWave(
        *rng.normal(size=(2, harmonics)), mean=rng.normal(), count=int(rng.integers(1, 14))
    )
    opposite = TravellingWave(-wave.cosine, -wave.sine, mean=-wave.mean, count=wave.count)
    part = FractionalWave(wave, 0.7)
    true = np.exp(0.1 * crest(wave))
    for given, alpha, most in ((wave, 0.1, 1e-12), (opposite, -0.1, 1e-12), (part, 0.1, 0.1)):
        value, error = Stretch().of_scene(Scene(Sheet(), given, alpha))
        assert value == pytest.approx(true, rel=1e-9 if given is part else 1e-12)
        assert error < most


@pytest.mark.parametrize("seed", range(8))
def test_the_stretch_of_a_spot_is_found_where_it_is(seed: int) -> None:
    """One that moves on a circle, smaller and smaller away from one place."""
    rng = np.random.default_rng(seed)
    at_x, at_y, when = rng.uniform(-0.5, 0.5, 3) * [0.5, 1.0, 3.0]
    narrow = 10 ** rng.uniform(1.0, 2.3)

    def spot(x, y, t):  # type: ignore[no-untyped-def]
        turned = np.cos(2 * np.pi * (t - when) / 3.0) - 1.0
        return np.exp(-narrow * ((x - at_x) ** 2 + (y - at_y) ** 2) + 2 * turned)

    scene = Scene(Sheet(), FieldWave(spot, period=3.0), alpha=0.2)
    value, error = Stretch().of_scene(scene)
    assert abs(value - np.exp(0.2)) <= error < 0.02
    assert value == pytest.approx(np.exp(0.2), rel=1e-6)


@pytest.mark.parametrize("seed", range(20))
def test_what_lies_between_the_times_is_within_the_error(seed: int) -> None:
    rng = np.random.default_rng(seed)
    order = np.arange(1, int(rng.integers(2, 9)))
    amplitudes = rng.normal(size=(2, order.size, 3))

    def at(times: int) -> np.ndarray:
        angles = 2 * np.pi * np.multiply.outer(np.arange(times) / times, order)
        return np.cos(angles) @ amplitudes[0] + np.sin(angles) @ amplitudes[1]

    value, error = largest_of_period(at(TIMES))
    assert value <= at(64 * TIMES).max() <= value + error


def test_a_stretch_limit_has_no_steps_along_an_unknown() -> None:
    """At equal steps of alpha, third differences vanish as those of exp do."""
    wave = TravellingWave([0.3, 0.9], [0.7, -0.4])
    unknowns = Unknowns(Scene(Sheet(), wave, alpha=0.1), {"growth.alpha": (0.1, 0.1001)})
    values = [
        Stretch().of_scene(unknowns.scene_at(np.array([place]))).value
        for place in np.linspace(0.0, 1.0, 4)
    ]
    assert abs(np.diff(values, 3)).max() < 1e-13
