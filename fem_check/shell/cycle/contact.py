"""The contact of a scene in a cycle of shapes: friction must hold the sheet on a slope."""

import math

from linear_theory.friction.contact import Contact
from linear_theory.scene.scene import Scene


def held_contact(scene: Scene) -> Contact:
    """The contact of a scene. Raises ValueError for a slope on which the sheet accelerates downhill."""
    contact = scene.contact
    if abs(contact.slope) >= 1:
        incline = sum(effect.incline for effect in scene.effects)
        mu = math.tan(incline) / contact.slope if incline else 1.0
        raise ValueError(
            f"incline = {incline or math.atan(contact.slope):g}: friction cannot hold the sheet, "
            f"must be within +-{math.atan(mu):.4g} (its tangent below mu = {mu:g})"
        )
    return contact


def creep(contact: Contact) -> float:
    """Sliding speed of a sheet without growth, length/time, towards +y."""
    slope = contact.slope
    return -math.copysign(contact.friction.speed_at(abs(slope)), slope) if slope else 0.0
