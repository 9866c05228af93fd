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
    """All options. Quantities are text: a number with a unit, or a plain one in units of the sheet."""

    length: Annotated[str | None, In(group=SHEET)] = None
    """Length along the wave, e.g. "40 mm". Plain numbers are in units of the sheet; 1 by default."""
    width: Annotated[str | None, In(group=SHEET)] = None
    """Width across; by default 0.5, or half the length if that has a unit."""
    thickness: Annotated[str | None, In(group=SHEET)] = None
    """Thickness; by default 0.03, or 3 % of the length if that has a unit; unused for a flat sheet."""
    poisson: Annotated[float, In(group=SHEET)] = 0.5
    """Poisson ratio."""

    period: Annotated[str | None, In(group=WAVE)] = None
    """Period of the wave, e.g. "8 s"; 1 by default."""
    count: Annotated[int, In(group=WAVE)] = 1
    """Number of waves on the sheet; a negative number runs towards -y."""
    wave: Annotated[
        str | None,
        In(
            group=WAVE,
            help="An excitable wave instead (eq. 12), on its periodic orbit: "
            "excitable:pulse-train. Its unit of time is that of the reaction; other numbers are plain.",
        ),
    ] = None
    pulse: Annotated[
        float | None,
        In(
            group=WAVE,
            help="A smooth pulse instead of a sine; its width at half height in wavelengths, 0.02 "
            "to 1: c = exp(k (cos phi - 1)), k = ln 2/(1 - cos(pi share)), phi = 2 pi (count "
            "y/L - t/T).",
        ),
    ] = None
    sine: Amplitudes = ()
    """Amplitudes of sin phi, sin 2 phi, ... instead of one sine."""
    cosine: Amplitudes = ()
    """Amplitudes of cos phi, cos 2 phi, ..."""
    wave_csv: Annotated[
        str | None,
        In(
            group=WAVE,
            help="A measured wave instead: a file with the columns y, t, c (and x where c depends "
            "on it), in the units of --length and --period; y from the middle of the sheet. "
            "Without units, --period may be left out and is found from samples of more than "
            "one period.",
        ),
    ] = None

    growth: Annotated[
        str | None,
        In(
            group=GROWTH,
            help='Growth of lengths at the crest of the wave, e.g. "12 %". It sets alpha by the '
            "growth law: the stretch, exp(alpha c), 1 + alpha c or (1 + 2 alpha c)^(1/2), is "
            "1.12 where c is largest.",
        ),
    ] = None
    alpha: Annotated[float | None, In(group=GROWTH)] = None
    """The growth coupling, instead of --growth; may be negative."""
    growth_law: Annotated[Literal["exp", "linear", "metric"], In(group=GROWTH)] = "exp"
    """Law of the stretch as a function of alpha c, in the order of the formulas above."""
    area: Annotated[Literal["grown", "undeformed"], In(group=GROWTH)] = "grown"
    """Reference area of the elastic energy density."""

    load: Annotated[Literal["current", "grown", "material"], In(group=MODEL)] = "current"
    """Normal load: proportional to the current or the grown area, or conserved with the material."""
    friction: Annotated[Literal["coulomb", "dry", "tanh", "viscous"], In(group=MODEL)] = "coulomb"
    """Friction law: dry (two names), dry but regularised at small slip, or proportional to the slip."""
    slip_speed: Annotated[str | None, In(group=MODEL)] = None
    """Slip speed of tanh friction, e.g. "0.1 mm/s"."""
    forward: Annotated[float | None, In(group=MODEL)] = None
    """Friction against slip towards +y, for friction with a direction, over the coefficient."""
    backward: Annotated[float | None, In(group=MODEL)] = None
    """Likewise towards -y; both or none."""
    sideways: Annotated[float | None, In(group=MODEL)] = None
    """Likewise across; the mean of both unless given."""
    heading: Annotated[
        str | None,
        In(
            group=MODEL,
            help='Where "forward" points, e.g. "10 deg" or "0.2 rad", anticlockwise from +y; along '
            "+y unless given.",
        ),
    ] = None
    fixed_to: Annotated[Literal["body", "ground"], In(group=MODEL)] = "body"
    """What the direction belongs to: "body" for bristles below the sheet, "ground" for fur or grass."""

    rtol: Annotated[str, In(group=COST)] = "1e-2"
    """Relative tolerance for the numerical plus model error, e.g. "1 %"."""
    atol: Annotated[str | None, In(group=COST)] = None
    """Absolute tolerance for the same error, a speed."""
    level: Annotated[
        Literal["auto", "strip", "first order", "second order", "cycle", "line"], In(group=COST)
    ] = "auto"
    """Level of theory; auto chooses the cheapest that is known to meet the tolerance. "line" is the
    one-dimensional body of eqs 5 to 7, with its weight per length."""

    json: Annotated[bool, In(group=OUTPUT)] = False
    """Print the answer as JSON, in the units of the question."""
    csv: Annotated[bool, In(group=OUTPUT)] = False
    """Print the velocity V(t) through one period as CSV."""
    plot: Annotated[Path | None, In(group=OUTPUT)] = None
    """Write a picture of the motion: .png, .pdf or .svg."""
    movie: Annotated[Path | None, In(group=OUTPUT)] = None
    """Write a film of the crawling sheet: .gif, or .mp4 with the extra `movies`."""
    why: Annotated[bool, In(group=OUTPUT)] = False
    """Print for each level whether it was chosen, and why."""
