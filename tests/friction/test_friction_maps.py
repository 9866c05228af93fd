"""Maps of friction and friction with a direction: errors on random input, coefficients, one answer."""

import itertools

import numpy as np
import pytest

from fem_check import Friction, Gravity, Material, Membrane, Scene, solve
from linear_theory import (
    Contact,
    Coulomb,
    Directional,
    FrictionLaw,
    GivenMap,
    Mapped,
    OnLowerFace,
    Patches,
    Sheet,
    SineWave,
    Tanh,
    TravellingWave,
    Viscous,
    airy_series,
    crawl_speed,
    line_balance,
)
from linear_theory.balance.crawl import Crawl, Resolution


def random_case(seed: int) -> tuple[Sheet, SineWave | TravellingWave, FrictionLaw]:
    random = np.random.default_rng(seed)
    width = 10 ** random.uniform(-0.7, 0)
    patches = []
    for _ in range(2):
        low, high = np.sort(random.uniform(-0.6, 0.6, 2))
        side = random.uniform(0.1, 0.7) * width
        patches.append((-side, side, low, high, 10 ** random.uniform(-1, 1)))
    wave = SineWave() if seed % 2 else TravellingWave(random.normal(size=2), random.normal(size=2))
    law = Coulomb() if seed % 3 else Directional(*10 ** random.uniform(-0.7, 0.7, 3))
    return Sheet(width=width), wave, Mapped(law, Patches(patches, 10 ** random.uniform(-2.5, -1)))


@pytest.mark.parametrize("seed", range(4, 6))
def test_errors_under_random_patches_hold(seed: int) -> None:
    """Of the answer: against cells much smaller than its own, at six times."""
    sheet, wave, law = random_case(seed)
    field, contact = airy_series(sheet, wave, rtol=1e-4), Contact(friction=law)
    crawl = Crawl.to(1e-2, field, 0.1, contact)
    times = np.arange(6) / 6 + 0.03
    motion = crawl.balance(times)
    claimed = crawl_speed(sheet, wave, 0.1, friction=law, rtol=1e-2).error
    fine = Crawl(field, 0.1, contact, Resolution(40.0, 6, 8, 1e-5))
    true = (crawl.counted(motion) - fine.counted(fine.balance(times)))[1]
    assert abs(true.mean()) <= claimed


@pytest.mark.parametrize("seed", range(4))
def test_errors_of_friction_with_a_direction_hold(seed: int) -> None:
    """Both orders of theory, at ratios and slip speeds far apart, of either sign of alpha."""
    random = np.random.default_rng(40 + seed)
    form = (Coulomb(), Tanh(1e-3), Tanh(0.003), Viscous())[seed]
    sizes = 10 ** random.uniform(-0.8, 0.8, 3)
    alpha = (-1) ** seed * 10 ** random.uniform(-3, -1)
    wave = TravellingWave(random.normal(size=2), random.normal(size=2)) if seed % 2 else SineWave()
    for order in (1, 2):
        rough, fine = (
            crawl_speed(
                *(Sheet(width=0.4), wave, alpha),
                friction=Directional(*sizes, form=form),
                rtol=rtol,
                order=order,
            )
            for rtol in (2e-2, 1e-3)
        )
        assert abs(rough.mean - fine.mean) <= rough.error + fine.error
        assert rough.converged


@pytest.mark.parametrize("law", [Coulomb(), Directional(0.5, 1.5), Viscous()], ids=lambda law: law.name)
def test_coefficients_of_a_map_on_a_line_are_those_of_small_alpha(law: FrictionLaw) -> None:
    friction = Mapped(law, GivenMap(lambda x, y: 1 + 0.6 * np.sin(3 * y + 1) + 0 * x))
    wave, h = TravellingWave([1, 0.4], [0.2, -0.5]), 4e-3
    kinds = {"growth_law": "exp", "body": "strip", "friction": friction, "rtol": 1e-4}
    once, twice = (line_balance(wave, a, **kinds) for a in (h, 2 * h))  # type: ignore[arg-type]
    second = (twice.mean / 2 - once.mean) / h**2
    assert once.mean / h - second * h == pytest.approx(once.first_order, abs=3e-4)
    assert second == pytest.approx(once.second_order, abs=0.05)


def test_a_cycle_says_the_same_of_its_error_whichever_way_it_is_asked_for() -> None:
    law = Directional(0.5, 1.5, form=Tanh(2e-3))
    effects = [Membrane(Material(0.03, 0.5)), Gravity(3e-6, load="current"), Friction(1.0, law=law)]
    scene = Scene(Sheet(), SineWave(), 0.1, effects=effects, cells=(2, 4))
    found = [solve(scene, level, rtol=2e-2) for level in ("auto", "cycle")]
    for one in found:
        assert (one.level, one.converged) == ("cycle", True)
        assert one.not_in_error == ("deformation by friction, taken as too weak",)
        assert "NOT MET" not in str(one)
        assert "was not measured" not in str(one)
    assert abs(found[0].mean - found[1].mean) <= found[0].error + found[1].error


def test_creases_of_a_map_are_checked() -> None:
    for bad in (3, "ab", ((0.1,),), (("a",), ())):
        with pytest.raises(ValueError, match="creases"):
            GivenMap(lambda x, y: 1.0, creases=bad)  # type: ignore[arg-type]
    for bad in (((), 0.13), ("ab", ()), (np.array(0.1), ()), 5, None):
        with pytest.raises(ValueError, match=r"^creases = .*: must be two lists of numbers, x and y$"):
            GivenMap(lambda x, y: 1.0, creases=bad)  # type: ignore[arg-type]
    given = GivenMap(lambda x, y: 1.0, creases=([0.1], []))  # type: ignore[arg-type]
    assert given.creases == ((0.1,), ())


def test_words_of_laws_around_laws() -> None:
    law = OnLowerFace(Mapped(Directional(0.5, 1.5), GivenMap(lambda x, y: 1.0)))
    words = "dry friction times 0.5 forward, 1.5 backward, 1 sideways, fixed to the body"
    assert law.words == f"{words}, times a map on the body, on the lower face"


SQUARE = {(0.3, 0.2): 0.3 * 0.7 * 0.2**2 / (1 + 0.3 * 0.2)}
"""n T V of a square wave, share f stretched by 1 + e, viscous: f (1 - f) e^2/(1 + f e)."""


def test_square_wave_under_viscous_friction() -> None:
    """V = Var(lambda)/(<lambda> nT) (setting of DeSimone and Tatone 2012); nothing by mass.

    Friction per mass: Bolotnik, Pivovarov, Zeidis, Zimmermann 2016.
    """
    (share, e), wanted = next(iter(SQUARE.items()))
    points = 600
    wave = TravellingWave.from_samples((np.arange(points) < share * points).astype(float))
    for load, speed in (("current", wanted), ("material", 0.0)):
        found = line_balance(wave, e, load=load, friction="viscous")
        assert found.mean == pytest.approx(speed, abs=1e-2 * wanted)


def test_the_train_of_pulses_with_a_gap() -> None:
    """V = -(<lambda> - 1)/(nT): the outside rests (setting of Gidoni, Noselli, DeSimone 2014)."""
    phase = 2 * np.pi * np.arange(256) / 256
    wave = TravellingWave.from_samples(
        np.where(abs(phase - 3) < 1, np.cos((phase - 3) * np.pi / 2) ** 2, 0)
    )
    for law, count in itertools.product(("linear", "exp"), (1, 2)):
        moved = TravellingWave(wave.cosine, wave.sine, count=count, mean=wave.mean)
        found = line_balance(moved, 0.2, growth_law=law)
        c = np.asarray(moved.value(0.0, np.arange(4096) / 4096, 0.0))
        stretch = np.exp(0.2 * c) if law == "exp" else 1 + 0.2 * c
        assert found.mean == pytest.approx(-(stretch.mean() - 1) / count, abs=2e-5)
