"""Assumptions of a result in one line: `CrawlSpeed.model`."""

from linear_theory.friction.contact import Contact
from linear_theory.growth.growth import Growth


def model_words(shape: str, growth: Growth | None, contact: Contact | None, *remarks: str) -> str:
    """The method for the shape, the growth (if relevant), remarks, and (if any) load and friction.

    >>> from linear_theory import Contact, Growth, Tanh
    >>> print(model_words("static shapes", Growth(0.1), Contact(friction=Tanh(0.02))))
    static shapes, growth law exp, energy per grown area, current load, friction tanh(v/0.02)
    """
    parts = [shape]
    if growth is not None:
        parts += [f"growth law {growth.law.name}", f"energy per {growth.energy_area} area"]
    if contact is not None and contact.slope:
        parts.append(f"on a slope of {contact.slope:g} times its friction")
    parts += filter(None, remarks)
    if contact is not None:
        parts += [f"{contact.load} load", contact.friction.words]
    return ", ".join(parts)
