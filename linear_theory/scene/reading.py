"""Scenes from plain data, as written by `Scene.to_dict`."""

import math
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from linear_theory.common import validation
from linear_theory.common.shown import plain
from linear_theory.friction.contact import Contact
from linear_theory.scene.data import NotRestorable, check_keys, check_same, part_of

if TYPE_CHECKING:
    from linear_theory.scene.scene import Scene

MESHES = "fem_check.mesh.elements"
"""Module of meshes, imported by name if a scene has any."""

PARTS = ("sheet", "wave", "growth", "effects")
RESOLUTION = ("cells", "mesh", "element")
KEYS = ("type", "sheet", "wave", "growth", "contact", "effects", *RESOLUTION)

SLOPE = 1e-12
"""Relative difference of slopes that count as the same: a tangent may differ between machines."""

Data = Mapping[str, Any]


def scene_of(make: "Callable[..., Scene]", data: Data, given: Data) -> "Scene":
    """The scene of these data; given: arguments that replace what the data say.

    Effects that are given say what they say of the contact, too: load and friction.
    Raises ValueError, with the place, for data that `Scene.to_dict` has not written, and for parts that
    cannot be stored as text and are not given.
    """
    if not isinstance(data, Mapping) or data.get("type") != "Scene":
        raise ValueError(f"data = {validation.shown(data)}: must be what Scene.to_dict() returns")
    check_keys(data, KEYS, "", "a Scene", spared=given)
    found = _parts(data, given)
    contact = found.pop("contact", None)
    resolution = {name: data[name] for name in RESOLUTION if name not in given}
    if any(value is not None for value in resolution.values()):
        found |= import_module(MESHES).from_data(resolution)
    with np.errstate(all="ignore"):  # by numbers near the largest
        scene = make(**{**found, **given})
    if resolution and scene.elements is not None:
        written = plain(scene.elements.contents())
        for name, value in resolution.items():
            check_same(written[name], value, name)
    if not {"sheet", "effects"} & given.keys():  # effects adapt to their sheet
        check_same(plain(scene.effects), data["effects"], "effects")
    if contact is not None:
        return _on_contact(scene, contact)
    return _on_rest_of_contact(scene, data) if "contact" not in given else scene


def _parts(data: Data, given: Data) -> dict[str, Any]:
    """Sheet, wave, growth, effects and contact, where not given; the contact only with its effects.

    Raises ValueError that names all parts that must be given.
    """
    names = [name for name in PARTS if name not in given]
    if "effects" in names and not isinstance(data["effects"], list | tuple):
        raise ValueError(f"effects = {validation.shown(data['effects'])}: must be a list")
    if not {"effects", "contact"} & given.keys():
        names.append("contact")
    found, lost = {}, {}
    for name in names:
        try:
            with np.errstate(all="ignore"):
                found[name] = part_of(data[name], name)
        except NotRestorable as error:
            lost[name] = str(error)
    if "effects" in lost:  # which say what the contact is
        lost.pop("contact", None)
    _refuse(lost)
    if "contact" in found:
        validation.instance("contact", found["contact"], Contact)
    return found


def _refuse(lost: Mapping[str, str]) -> None:
    """Raise ValueError, with the call to make instead, if parts are lost."""
    if lost:
        again = ", ".join(f"{name}={name}" for name in lost)
        raise ValueError(
            f"{'; '.join(lost.values())}; pass the {' and '.join(lost)} of that scene again: "
            f"Scene.from_dict(data, {again})"
        )


def _on_contact(scene: "Scene", contact: Contact) -> "Scene":
    """The scene on the contact of its data, which its effects must not contradict."""
    if _same(scene.contact, contact):
        return scene
    try:
        scene = scene.but(contact=contact)
    except ValueError as error:
        raise ValueError(f"contact: {error}") from None
    if not _same(scene.contact, contact):
        check_same(scene.contact.to_dict(), contact.to_dict(), "contact")
    return scene


def _same(one: Contact, other: Contact) -> bool:
    same = (one.load, one.friction) == (other.load, other.friction)
    return same and math.isclose(one.slope, other.slope, rel_tol=SLOPE)


def _on_rest_of_contact(scene: "Scene", data: Data) -> "Scene":
    """The scene with new effects, on what they leave open of the contact of its data."""
    presses = any(effect.pressed_by(scene.components) is not None for effect in scene.effects)
    if any(effect.law is not None for effect in scene.effects):
        return scene
    try:
        contact = part_of(data["contact"], "contact")
    except NotRestorable as error:
        _refuse({"contact": str(error)})
    validation.instance("contact", contact, Contact)
    if presses:
        contact = Contact(scene.contact.load, contact.friction, contact.slope)
    return scene.but(contact=contact)
