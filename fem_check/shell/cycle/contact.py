"""The contact of a scene in a cycle of shapes: friction must hold the sheet on a slope."""

import math

from linear_theory.friction.contact import Contact
from linear_theory.scene.scene import Scene


def held_contact(scene: Scene) -> Contact:
    """The contact of a scene. Raises ValueError for a slope on which the sheet accelerates downhill."""
    contact = scene.contact
    steepest = -contact.friction.limits[1], contact.friction.limits[0]  # it slips down, against them
    if steepest[0] < contact.slope < steepest[1]:
        return contact
    incline = sum(effect.incline for effect in scene.effects)
    if not incline:
        raise ValueError(
            f"slope = {contact.slope:g}: friction cannot hold the sheet, must be between "
            f"{steepest[0]:g} and {steepest[1]:g} for {contact.friction.words}"
        )
    mu = math.tan(incline) / contact.slope
    low, high = (math.atan(mu * limit) for limit in steepest)
    allowed = f"within +-{high:.4g}" if low == -high else f"between {low:.4g} and {high:.4g}"
    raise ValueError(
        f"incline = {incline:g}: friction cannot hold the sheet, must be {allowed} "
        f"({contact.friction.words}, mu = {mu:g})"
    )


def creep(contact: Contact) -> float:
    """Sliding speed of a sheet without growth, length/time, towards +y."""
    slope = contact.slope
    return contact.friction.creep(-slope)
