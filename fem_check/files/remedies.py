"""What to write instead of keys, words and text that people take from the command, or from papers."""

import re
from collections.abc import Mapping
from typing import Any

from fem_check.files.quantities import NUMBER
from linear_theory.common import validation

KEYS: Mapping[tuple[str, str], str] = {
    ("wave", "pulse"): "a pulse is kind = 'pulse' with width = {given}",
    ("wave", "wave_csv"): "it is csv here",
    ("wave", "waves"): "the number of waves on the sheet is count",
    ("wave", "wavelength"): "it is the length of the sheet over count",
    ("wave", "frequency"): "its inverse is period",
    ("wave", "speed"): "it is the wavelength over period",
    ("wave", "amplitude"): "the size of the growth is alpha or swelling in [growth]",
    ("growth", "growth"): "growth at the crest is swelling = {given}",
    ("growth", "growth_law"): "it is law here",
    ("growth", "beta"): "beta of eq. 4 is curvature_coupling",
    ("friction", "friction"): "it is law here",
    ("friction", "mu"): "it is coefficient here",
    ("friction", "v0"): "it is slip_speed here",
    ("sheet", "nu"): "it is poisson here",
    ("sheet", "h"): "it is thickness here",
    ("sheet", "E"): "Young's modulus is young here",
    ("sheet", "alpha"): "it is a key of [growth]",
}
"""Of a table, what is none of its keys, and what is meant by it."""

TRAVELS = "every wave travels: 'sine', 'pulse', or 'harmonics' with lists cosine and sine"

WORDS: Mapping[tuple[str, str, str], str] = {
    ("wave", "kind", "travelling"): TRAVELS,
    ("wave", "kind", "traveling"): TRAVELS,
    ("wave", "kind", "fitzhugh-nagumo"): "'excitable' solves it",
    ("friction", "law", "coulomb"): "Coulomb's law is 'dry'",
    ("growth", "law", "exponential"): "it is 'exp'",
}
"""Of a key, a word that it does not take, and what is meant by it."""

QUANTITIES: Mapping[tuple[str, str], str] = {
    ("growth", "alpha"): "growth of lengths at the crest is swelling = {given}",
    ("friction", "slope"): "an angle is incline in [gravity]",
}
"""Of a key that takes a plain number, which one takes a number with a unit."""

NUMBERS = ("float_type", "int_type", "float_parsing", "int_parsing")
"""Kinds of mistakes of pydantic: something else was given for a number."""

NO_NUMBER = ("must be a single real number", "must be an integer")
"""Ends of what the checks of the library say of it."""


def key_meant(table: str, name: str, given: Any) -> str:
    """What is meant by a key that a table does not have; empty where that is not known.

    >>> from fem_check.files.remedies import key_meant
    >>> print(key_meant("wave", "pulse", 0.2))
    a pulse is kind = 'pulse' with width = 0.2
    """
    return KEYS.get((table, name), "").format(given=validation.shown(given))


def word_meant(table: str, name: str, given: str) -> str:
    """What is meant by a word that a key does not take; empty where that is not known."""
    return WORDS.get((table, name, given.strip().lower()), "")


def number_meant(table: str, name: str, given: str) -> str:
    """What is wrong with text in place of a plain number, and what takes it.

    >>> from fem_check.files.remedies import number_meant
    >>> print(number_meant("growth", "alpha", "12 %"))
    must be a plain number, without a unit; growth of lengths at the crest is swelling = '12 %'
    >>> print(number_meant("growth", "alpha", "0.1"))
    must be a number: write it without quotes
    """
    parts = NUMBER.fullmatch(given)
    if parts is None or not re.search(r"\d", given):
        return "must be a number, not text"
    if not parts[2]:
        return "must be a number: write it without quotes"
    hint = QUANTITIES.get((table, name), "").format(given=validation.shown(given))
    return "must be a plain number, without a unit" + (f"; {hint}" if hint else "")
