"""Laws of one's own that are wrong are refused, with the method that is wrong and its numbers."""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np
import pytest

from fem_check import Friction, Ground
from linear_theory import (
    Contact,
    Coulomb,
    FrictionLaw,
    Isotropic,
    Scene,
    Sheet,
    SineWave,
    Tanh,
    Viscous,
    crawl_speed,
    line_balance,
)
from linear_theory.friction.isotropic import IsotropicResponse
from linear_theory.friction.law import ALL
from linear_theory.friction.trial import check_law
from tests.friction.test_friction_laws import ElliptTanh
from tests.scenes.test_scene import SPACE


@dataclass(frozen=True)
class Soft(Isotropic):
    """f = r/sqrt(r^2 + w^2), with all methods right."""

    w: float
    name: ClassVar[str] = "soft"

    @property
    def width(self) -> float:
        return self.w

    def speed_at(self, share: float) -> float:
        return self.w * share / math.sqrt(1 - share**2)

    def scaled(self, factor: float) -> "Soft":
        return replace(self, w=self.w / factor)

    def energy(self, r: Any) -> Any:
        return r * r / (np.hypot(r, self.w) + self.w)

    def size(self, r: Any) -> Any:
        return r / np.hypot(r, self.w)

    def slope(self, r: Any) -> Any:
        return self.w**2 / np.hypot(r, self.w) ** 3

    def rise(self, before: Any, after: Any, change: Any, step: float) -> Any:
        """f' - f = w^2 (r' - r)(r' + r)/(s s' (r' s + r s')), s = sqrt(r^2 + w^2)."""
        r, p = before.speed, after.speed
        s, q = np.hypot(r, self.w), np.hypot(p, self.w)
        return self.w**2 * change * (p + r) / (s * q * (p * s + r * q))


class Wrong(Soft):
    """To be made wrong in one method."""


def wrong(**methods: Callable[..., Any] | property) -> FrictionLaw:
    return type("Wrong", (Wrong,), methods)(0.1)


def naive(self: Any, v: Any, change: Any, step: float) -> Any:
    return (self.force(v + step * change) - self.force(v)) / step


def stribeck() -> FrictionLaw:
    """f = r exp(-r/w): falls with speed."""

    def rise(self: Any, before: Any, after: Any, change: Any, step: float) -> Any:
        return self.slope(before.speed) * change

    return wrong(
        energy=lambda self, r: self.w**2 - self.w * (r + self.w) * np.exp(-r / self.w),
        size=lambda self, r: r * np.exp(-r / self.w),
        slope=lambda self, r: (1 - r / self.w) * np.exp(-r / self.w),
        rise=rise,
    )


WRONG = {
    "scaled": (
        wrong(scaled=lambda self, factor: replace(self, w=self.w * factor)),
        r"scaled\(0.25\).force\(v/0.25\) = .*must be .*the force at v of the law that is not scaled",
    ),
    "scaled width": (
        wrong(width=property(lambda self: 0.1)),
        r"scaled\(0.25\).width = 0.1: must be width/0.25 = 0.4",
    ),
    "potential": (
        wrong(potential=lambda self, v: 2 * Soft.potential(self, v)),
        r"force along a change of v = .*must be .*, as differences of the potential give it",
    ),
    "energy": (wrong(energy=lambda self, r: r), "potential give it"),
    "tangent": (
        wrong(tangent=lambda self, v: 1.01 * Soft.tangent(self, v)),
        r"tangent times a change of v = .*must be .*, as differences of the force give it",
    ),
    "slope": (wrong(slope=lambda self, r: 0 * r), "tangent times a change of v"),
    "force_difference": (
        wrong(force_difference=lambda self, v, d, h: 1.001 * Soft.force_difference(self, v, d, h)),
        r"force_difference = .*must be .*at the step 0.5",
    ),
    "rise": (
        wrong(rise=lambda self, before, after, change, step: self.slope(before.speed) * change),
        "force_difference = .*at the step 0.5",
    ),
    "cancels": (wrong(force_difference=naive), "at the step 1e-15; it must not cancel there"),
    "moved": (
        wrong(at=lambda self, v, kept=slice(None): Soft.at(Soft(0.2), v, kept)),
        "must be|failed",
    ),
    "rest": (
        wrong(potential=lambda self, v: 1 + Soft.potential(self, v)),
        "potential = 1 at rest: must be 0",
    ),
    "convex": (stribeck(), "tangent has the eigenvalue -.*the potential of a law being convex"),
    "even": (
        type("Odd", (ElliptTanh,), {"even": True})(0.4, 0.7, 2.0, 0.5),
        "mirrored in component 0, for a law that says that it is even",
    ),
    "width": (
        wrong(width=property(lambda self: 1e4 * self.w)),
        "width = 1000: must be the least speed over which the force changes sign",
    ),
    "speed_at": (
        wrong(speed_at=lambda self, share: share * self.w),
        r"speed_at\(0.25\) = 0.025: must be the speed along y",
    ),
    "shape": (
        wrong(force=lambda self, v: Soft.force(self, v)[0]),
        r"force of v with shape \(2, 5, 6\) has shape \(5, 6\)",
    ),
    "fails": (
        wrong(force=lambda self, v: v[5]),
        r"force of v with shape \(2, 5, 6\) must be an array .* failed: IndexError",
    ),
    "not finite": (
        wrong(tangent=lambda self, v: np.nan * Soft.tangent(self, v)),
        r"tangent is not finite at v = \(",
    ),
    "no law": (wrong(scaled=lambda self, factor: factor), r"scaled\(0.25\) = 0.25: must be a law"),
    "no name": (wrong(name=None), "name must be text"),
    "subclass of a library law": (
        type("Harder", (Tanh,), {"size": lambda self, r: 2 * Tanh.size(self, r)})(0.1),
        "force along a change of v",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_law_is_refused(name: str) -> None:
    law, words = WRONG[name]
    for take_in in (
        lambda: Contact("current", law),
        lambda: crawl_speed(Sheet(), SineWave(), 0.1, friction=law),
        lambda: Friction(1.0, law=law),
    ):
        with pytest.raises(ValueError, match=f"^(friction|law) = .*{words}"):
            take_in()


RIGHT = {
    "soft": Soft(0.1),
    "narrow": Soft(1e-9),
    "wide": Soft(1e9),
    "elliptic": ElliptTanh(0.4, 0.7, 2.0),
    "turned": ElliptTanh(0.4, 0.7, 2.0, 0.5),
    "coulomb": Coulomb(),
    "tanh": Tanh(1e-5),
    "viscous": Viscous(3.0),
}


@pytest.mark.parametrize("components", [1, 2, 3])
@pytest.mark.parametrize("name", RIGHT)
def test_a_right_law_passes(name: str, components: int) -> None:
    check_law(RIGHT[name], components)


def test_a_law_is_tried_once_and_those_with_names_never(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []
    size = Soft.size
    monkeypatch.setattr(Soft, "size", lambda self, r: asked.append(1) or size(self, r))
    law = Soft(0.123)
    Contact("current", law)
    assert asked
    asked.clear()
    Contact("grown", Soft(0.123))
    assert not asked
    monkeypatch.setattr(Tanh, "potential", lambda self, v: 1 / 0)
    Contact("grown", Tanh(0.1))


def test_a_law_is_asked_for_slip_along_the_ground_alone() -> None:
    """In space, too: a law that knows no height is fine there, one wrong in the plane is not."""

    class Flat(Soft):
        def at(self, v: np.ndarray, kept: slice = ALL) -> IsotropicResponse:
            assert len(v) == 2
            return super().at(v, kept)

    effects = (*SPACE[:3], Ground(0.5), Friction(0.3, law=Flat(0.1)))
    scene = Scene(Sheet(), SineWave(), 0.1, effects=effects)
    assert scene.contact.friction == Flat(0.1)
    with pytest.raises(ValueError, match=r"^law = .*as differences of the potential give it"):
        Friction(0.3, law=wrong(force=lambda self, v: 2 * Soft.force(self, v)))


def test_a_line_takes_the_laws_with_names_only() -> None:
    """A subclass may have changed anything."""
    for law in (Soft(0.1), type("Mine", (Tanh,), {})(0.1)):
        with pytest.raises(
            ValueError, match="must be one of Coulomb, Tanh, Viscous, Directional for a body on a line"
        ):
            line_balance(SineWave(), 0.1, friction=law)


class Bare:
    """A wave without the argument length."""

    period = 1.0

    def value(self, x: Any, y: Any, t: Any) -> Any:
        return np.sin(2 * np.pi * (y - t)) + 0 * x

    def rate(self, x: Any, y: Any, t: Any, length: float = 1.0) -> Any:
        return -2 * np.pi * np.cos(2 * np.pi * (y - t)) + 0 * x


def test_a_wave_must_take_the_length() -> None:
    for take_in in (
        lambda: Scene(Sheet(), Bare(), 0.1),
        lambda: crawl_speed(Sheet(), Bare(), 0.1),
        lambda: line_balance(Bare(), 0.1, length=1.0),
    ):
        with pytest.raises(
            ValueError, match=r"wave.value has the signature \(x: .*must be \(x, y, t, l"
        ):
            take_in()
    with pytest.raises(ValueError, match=r"wave.rate = 3: must be a function, \(x, y, t, length"):
        Scene(Sheet(), type("Number", (Bare,), {"value": Bare.rate, "rate": 3})(), 0.1)
    Scene(Sheet(), type("Whole", (Bare,), {"value": Bare.rate})(), 0.1)
