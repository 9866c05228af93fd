"""Arguments of a scene that say the same thing twice, and must not contradict each other."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from linear_theory.common import validation
from linear_theory.growth.growth import Growth, Reference
from linear_theory.growth.laws import growth_law

GROWTH = {
    "alpha": "alpha",
    "curvature_coupling": "curvature_coupling",
    "growth_law": "law",
    "curvature": "curvature",
    "area": "energy_area",
}
"""Arguments of a scene that define its Growth, and the corresponding fields."""


def growth_of(growth: Growth | None, said: dict[str, Any]) -> Growth:
    """The growth given as an object, or made from the separate arguments."""
    changes = {name: value for name, value in said.items() if value is not None}
    if growth is not None:
        validation.instance("growth", growth, Growth)
        twice = [name for name, part in GROWTH.items() if part in changes]
        if twice:
            value = validation.shown(said[GROWTH[twice[0]]])
            raise ValueError(f"{twice[0]} = {value}: must be None if growth is given")
        return growth
    if "alpha" not in changes:
        raise ValueError("alpha = None: must be given, or growth = Growth(alpha, ...)")
    names = {part: name for name, part in GROWTH.items()}
    if "law" in changes:
        changes["law"] = growth_law(changes["law"], names["law"])
    if "energy_area" in changes:
        changes["energy_area"] = Reference.named(names["energy_area"], changes["energy_area"])
    return Growth(**changes)


def check_not_given(beside: str, **arguments: object) -> None:
    """Raise ValueError for an argument that must be None beside another."""
    for name, value in arguments.items():
        if value is not None:
            raise ValueError(f"{name} = {validation.shown(value)}: must be None if {beside} is given")


def check_growth(own: Growth, given: Mapping[str, Any]) -> None:
    """Raise ValueError for growth_law, curvature or area (None: not given) other than its own."""
    for name, value in given.items():
        if value is not None:
            part = GROWTH[name]
            check_agrees(name, getattr(replace(own, **{part: value}), part), getattr(own, part))


def check_agrees(name: str, given: object, own: object) -> None:
    """Raise ValueError for an argument that contradicts the scene beside which it is given."""
    if given != own:
        raise ValueError(
            f"{name} = {_quoted(given)}: must be None or that of the scene, {_quoted(own)}"
        )


def _quoted(value: object) -> str:
    return repr(str(value)) if isinstance(value, str) else validation.shown(value)
