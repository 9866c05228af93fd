"""Parameters by the names of their fields, as in scene files and sweeps."""

import difflib
from collections.abc import Iterable
from typing import Any

from linear_theory.common.validation import shown
from linear_theory.gradient.parameters.bending import (
    CurvatureCoupling,
    Stiffness,
    Thickness,
    Weight,
)
from linear_theory.gradient.parameters.friction import (
    Backward,
    Forward,
    Heading,
    PatchFriction,
    Sideways,
    SlipSpeed,
)
from linear_theory.gradient.parameters.harmonics import (
    Amplitude,
    Cosine,
    Count,
    Mean,
    OfHarmonic,
    Period,
    Phase,
    Sine,
)
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.gradient.parameters.sheet import Alpha, Poisson, Width

SINGLE: dict[str, Parameter] = {
    one.name: one
    for one in (
        *(Alpha(), Width(), Poisson(), Mean(), Period(), Count()),
        *(CurvatureCoupling(), Thickness(), Weight(), Stiffness()),
        *(SlipSpeed(), Forward(), Backward(), Sideways(), Heading()),
    )
}
"""Those of which a scene has one."""

HARMONICS: dict[str, type[OfHarmonic]] = {
    f"wave.{kind.field}": kind for kind in (Cosine, Sine, Amplitude, Phase)
}
"""Lists by harmonics, of which the first is k = 1."""

PATCHES = "friction.map.mu"

SHORT = {"alpha": "growth.alpha"}


def parameters(over: Any) -> tuple[Parameter, ...]:
    """Parameters from names or objects, one or several.

    Raises ValueError for none, for names that are not known, and for one that is named twice.

    >>> from linear_theory.gradient.parameters.names import parameters
    >>> print(*(one.name for one in parameters(["alpha", "wave.sine.1"])))
    growth.alpha wave.sine.1
    """
    listed = [over] if isinstance(over, str | Parameter) else over
    if not isinstance(listed, Iterable):
        raise ValueError(f"over = {shown(over)}: must be parameters or their names")
    found = tuple(map(parameter, listed))
    if not found:
        raise ValueError("over = []: must have at least one parameter")
    names = [one.name for one in found]
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise ValueError(f"over: {twice[0]!r} is named twice, must be named once")
    return found


def parameter(name: Any) -> Parameter:
    """That of a name; an object is returned as it is."""
    if isinstance(name, Parameter):
        return name
    if isinstance(name, str):
        name = SHORT.get(name, name)
        if name in SINGLE:
            return SINGLE[name]
        table, _, last = name.rpartition(".")
        if _is_place(last) and table in HARMONICS:
            return HARMONICS[table](int(last) + 1)
        if _is_place(last) and table == PATCHES:
            return PatchFriction(int(last))
    known = [*SINGLE, *(f"{table}.0" for table in (*HARMONICS, PATCHES))]
    close = difflib.get_close_matches(str(name), known, n=1)
    hint = f", the nearest is {close[0]!r}" if close else f"; known are {', '.join(known)}"
    raise ValueError(f"over = {shown(name)}: is no parameter with a gradient{hint}")


def _is_place(word: str) -> bool:
    """Whether it is a place in a list, 0, 1, ..., in digits that scene files know."""
    return word.isascii() and word.isdecimal()
