"""Parameters by the names of their fields."""

from collections.abc import Iterable

from linear_theory.gradient.parameters.harmonics import (
    Amplitude,
    Cosine,
    Mean,
    OfHarmonic,
    Period,
    Phase,
    Sine,
)
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.gradient.parameters.sheet import Alpha, Poisson, Width

PLAIN: dict[str, Parameter] = {one.name: one for one in (Alpha(), Width(), Poisson(), Mean(), Period())}
LISTS: dict[str, type[OfHarmonic]] = {f"wave.{kind.field}": kind for kind in (Cosine, Sine, Amplitude, Phase)}


def parameters(over) -> tuple[Parameter, ...]:
    return tuple(parameter(one) for one in over)


def parameter(name) -> Parameter:
    if isinstance(name, Parameter):
        return name
    if name in PLAIN:
        return PLAIN[name]
    head, _, last = name.rpartition(".")
    return LISTS[head](int(last) + 1)
