"""The contact of a scene in a cycle of shapes: friction must hold the sheet on a slope."""

import math

from linear_theory.friction.contact import Contact
from linear_theory.scene.scene import Scene


def held_contact(scene: Scene) -> Contact:
    """The contact of a scene. Raises ValueError for a slope on which the sheet accelerates downhill."""
    contact = scene.contact
    if abs(contact.slope) < 1 or not contact.friction.limited:
        return contact
    incline = sum(effect.incline for effect in scene.effects)
    if not incline:
        raise ValueError(
            f"slope = {contact.slope:g}: friction cannot hold the sheet, must be between -1 and 1 for "
            f"{contact.friction.words}"
        )
    mu = math.tan(incline) / contact.slope
    raise ValueError(
        f"incline = {incline:g}: friction cannot hold the sheet, must be within +-{math.atan(mu):.4g} "
        f"(its tangent below mu = {mu:g})"
    )


def creep(contact: Contact) -> float:
    """Sliding speed of a sheet without growth, length/time, towards +y."""
    slope = contact.slope
    return -math.copysign(contact.friction.speed_at(abs(slope)), slope) if slope else 0.0
