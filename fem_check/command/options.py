"""The options of `sheetcrawl speed`, named like the arguments of `predict`, `Sheet` and the waves."""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from cyclopts import Group, Parameter

SHEET, WAVE, GROWTH, MODEL, COST, OUTPUT = (
    Group(name, sort_key=place)
    for place, name in enumerate(
        ("Sheet", "Wave", "Growth", "Friction and model", "Tolerance", "Output"), start=1
    )
)

In = Parameter
Amplitudes = Annotated[tuple[float, ...], Parameter(group=WAVE, consume_multiple=True)]


@dataclass(frozen=True, kw_only=True)
class Options:
    """What is asked for. Quantities are text: a number with a unit, or plain, in units of the sheet."""

    length: Annotated[str | None, In(group=SHEET)] = None
    """Along the wave, e.g. "40 mm". Plain numbers are in units of the sheet; 1 unless given."""
    width: Annotated[str | None, In(group=SHEET)] = None
    """Across; 0.5 unless given, half the length where that has a unit."""
    thickness: Annotated[str | None, In(group=SHEET)] = None
    """0.03 unless given, 3 % of the length where that has a unit; without effect on a flat sheet."""
    poisson: Annotated[float, In(group=SHEET)] = 0.5
    """Poisson ratio."""

    period: Annotated[str | None, In(group=WAVE)] = None
    """Of the wave, e.g. "8 s". 1 unless given."""
    count: Annotated[int, In(group=WAVE)] = 1
    """Waves on the sheet; negative runs the other way, towards -y."""
    pulse: Annotated[float | None, In(group=WAVE)] = None
    """A smooth pulse instead of a sine, above half its crest in this share of a wavelength, 0.02 to 1:
    c = exp(k (cos phi - 1)), k = ln 2/(1 - cos(pi share)), phi = 2 pi (count y/L - t/T)."""
    sine: Amplitudes = ()
    """Amplitudes of sin phi, sin 2 phi, ... instead of one sine."""
    cosine: Amplitudes = ()
    """Amplitudes of cos phi, cos 2 phi, ..."""

    growth: Annotated[str | None, In(group=GROWTH)] = None
    """Of lengths at the crest of the wave, e.g. "12 %". It sets alpha by the growth law: the stretch,
    exp(alpha c), 1 + alpha c or (1 + 2 alpha c)^(1/2), is 1.12 where c is largest."""
    alpha: Annotated[float | None, In(group=GROWTH)] = None
    """The growth coupling itself, instead; may be negative."""
    growth_law: Annotated[Literal["exp", "linear", "metric"], In(group=GROWTH)] = "exp"
    """How lengths grow with alpha c, in the order of the stretches above."""
    area: Annotated[Literal["grown", "undeformed"], In(group=GROWTH)] = "grown"
    """In which elastic energy is counted."""

    load: Annotated[Literal["current", "grown", "material"], In(group=MODEL)] = "current"
    """Weight on the ground: grows with the current or the grown area, or stays with the material."""
    friction: Annotated[Literal["coulomb", "tanh", "viscous"], In(group=MODEL)] = "coulomb"
    """Dry, dry but for slow slip, or in proportion to slip."""
    slip_speed: Annotated[str | None, In(group=MODEL)] = None
    """Of tanh friction, e.g. "0.1 mm/s"."""

    rtol: Annotated[str, In(group=COST)] = "1e-2"
    """Relative error of numbers and model together, e.g. "1 %"."""
    atol: Annotated[str | None, In(group=COST)] = None
    """Absolute error that is good enough, a speed."""
    method: Annotated[
        Literal["auto", "strip", "first order", "second order", "cycle"], In(group=COST)
    ] = "auto"
    """The level that answers; auto takes the cheapest that is known to meet the tolerance."""

    json: Annotated[bool, In(group=OUTPUT)] = False
    """Print the answer as JSON, in the units of the question."""
    csv: Annotated[bool, In(group=OUTPUT)] = False
    """Print the velocity V(t) through one period as CSV."""
    plot: Annotated[Path | None, In(group=OUTPUT)] = None
    """Write a picture of the motion: .png, .pdf or .svg."""
    movie: Annotated[Path | None, In(group=OUTPUT)] = None
    """Write a film of the crawling sheet: .gif, or .mp4 with the extra `movies`."""
    why: Annotated[bool, In(group=OUTPUT)] = False
    """Say of each level whether it was taken, and why."""
