"""The tables of a scene file and their keys, with what they mean: the one list of what can be said.

A table that is not there is an effect that the scene does not name. Quantities are text with a unit, or
plain numbers in units of the sheet: all with a dimension in the one way or all in the other.
"""

from typing import Annotated, Any, Literal

from pydantic import Field

from fem_check.files.bodies import OutlineTable, TerrainTable
from fem_check.files.equations import EquationTable
from fem_check.files.fields import (
    Angle,
    Count,
    Curvature,
    Damping,
    Density,
    Length,
    Level,
    Natural,
    Poisson,
    Positive,
    PositivePressure,
    PositiveShare,
    Pressure,
    Share,
    Size,
    Speed,
    Stiffness,
    Table,
    Time,
)

Span = Annotated[list[Length], Field(min_length=2, max_length=2)]
Weight = Literal["current", "grown", "material"]
Cells = Annotated[list[Natural], Field(min_length=2, max_length=2)]


class SheetTable(Table):
    """The sheet: a rectangle, or the box around its outline."""

    length: Size | None = None
    """Along the wave, e.g. "40 mm"; its unit is the file's unit of length. 1 unless given."""
    width: Size | None = None
    """Across; half the length unless given."""
    thickness: Size | None = None
    """3 % of the length unless given; without effect where nothing bends."""
    poisson: Poisson = 0.5
    """Poisson ratio, in (-1, 0.5]."""
    young: PositivePressure | None = None
    """Young modulus, e.g. "1 MPa": needed beside weights, ground and inertia with units."""


class SamplesTable(Table):
    """Samples of a measured wave: on the grid of y and t, and x, or scattered, all of one shape."""

    x: list[Any] | None = None
    """Across."""
    y: list[Any]
    """Along."""
    t: list[Any]
    """Times, over one period or more."""
    c: list[Any]
    """Growth at all of them."""


class WaveTable(Table):
    """The wave of growth c(y, t) that runs along the sheet."""

    kind: Literal["sine", "pulse", "harmonics", "excitable"] | None = None
    """A sine unless given; "pulse" is smooth and has a width, "harmonics" any periodic wave;
    "excitable" solves an equation, whose unit of time is that of the file."""
    period: Time | None = None
    """E.g. "8 s"; its unit is the file's unit of time. 1 unless given; of a measured wave, found."""
    count: Count = 1
    """Waves on the sheet; negative runs towards -y."""
    width: PositiveShare | None = None
    """Of a pulse: the share of a wavelength in which it is above half its crest, 0.02 to 1."""
    cosine: list[float] | None = None
    """Of harmonics: amplitudes of cos phi, cos 2 phi, ..., phi = 2 pi (count y/L - t/T)."""
    sine: list[float] | None = None
    """Of harmonics: amplitudes of sin phi, sin 2 phi, ..."""
    mean: float = 0.0
    """Of harmonics: what is added to all of them."""
    csv: str | None = None
    """A measured wave instead: a file with columns y, t, c, and x where c depends on it, in the units
    of length and time of the scene; its path from the folder of the scene file."""
    samples: SamplesTable | None = None
    """The same in the scene file itself."""
    harmonics: Natural | None = None
    """Of a measured wave, in time; chosen by what its noise leaves unless given."""
    degree: int | list[int] | None = None
    """Of a measured wave: of the polynomial along, or of those across and along; likewise."""
    equation: EquationTable | None = None
    """Of an excitable wave."""
    until: Time | None = None
    """Of an excitable wave: how long it is solved for, its ramp of half a period included."""
    rtol: PositiveShare | None = None
    """Of an excitable wave: largest error of c over the largest |c|, 0.1 % unless given."""
    orbit: bool = False
    """Of an excitable wave: the periodic one that it approaches, instead of the wave from its start."""


class BilayerTable(Table):
    """Two bonded layers, of which one grows; the effect `bending` must be there."""

    growth: Share
    """Strain of the layer that grows, per c, e.g. "20 %"."""
    thickness_ratio: Positive = 1.0
    """Of the layer that grows over the other one; the sheet's thickness is that of both."""
    modulus_ratio: Positive = 1.0
    """Likewise of Young's moduli."""
    side: Literal["upper", "lower"] = "upper"
    """Where the layer that grows is."""


class GrowthTable(Table):
    """How c grows the sheet: one of alpha, swelling and bilayer."""

    alpha: float | None = None
    """Growth of lengths per c, may be negative."""
    swelling: PositiveShare | None = None
    """Growth of lengths at the crest of the wave instead, e.g. "12 %"."""
    bilayer: BilayerTable | None = None
    """Two layers instead."""
    law: Literal["exp", "linear", "metric"] = "exp"
    """Stretch exp(alpha c), 1 + alpha c or (1 + 2 alpha c)^(1/2)."""
    area: Literal["grown", "undeformed"] = "grown"
    """In which elastic energy is counted."""
    curvature_coupling: Curvature | None = None
    """beta of eq. 4: rest curvature -beta c, e.g. "0.2 1/mm"; needs the effect `bending`."""
    curvature: Literal["grown", "undeformed"] = "grown"
    """The metric that the rest curvature goes with."""


class FrictionMapTable(Table):
    """Patches of other friction, rectangles with soft edges; the last one wins."""

    x: Annotated[list[Span], Field(min_length=1)]
    """Of each patch its ends across, e.g. [["-5 mm", "5 mm"]]."""
    y: Annotated[list[Span], Field(min_length=1)]
    """Likewise along."""
    mu: list[Positive]
    """Of each patch, over the coefficient elsewhere."""
    edge: Size
    """Length over which friction changes at the edges of patches."""
    outside: Positive = 1.0
    """The same outside of all patches."""
    fixed_to: Literal["body", "ground"] = "body"
    """What x and y belong to: the undeformed sheet, or the ground, from where its middle starts."""


class FrictionTable(Table):
    """Friction with the ground."""

    law: Literal["dry", "tanh", "viscous"] | None = None
    """"dry" unless a slip speed is given: then "tanh", dry but for slow slip."""
    slip_speed: Speed | None = None
    """Of tanh, e.g. "0.1 mm/s"."""
    coefficient: Positive | None = None
    """Given, friction also deforms the sheet; it then is tanh. Left out, any coefficient gives the same
    speed of a sheet that is stiff against it."""
    load: Weight | None = None
    """Weight that friction is proportional to, where neither gravity nor ground say it: grows with the
    "current" or the "grown" area, or stays with the "material"."""
    slope: float | None = None
    """Of the ground over the friction coefficient, where no effects say it."""
    forward: Positive | None = None
    """Over the coefficient, against slip towards +y, for friction with a direction."""
    backward: Positive | None = None
    """Likewise towards -y; both or none."""
    sideways: Positive | None = None
    """Likewise across; the mean of both unless given."""
    heading: Angle | None = None
    """Where forward is, anticlockwise from +y, e.g. "20 deg"; plain ones are in radians."""
    fixed_to: Literal["body", "ground"] = "body"
    """What the direction turns with."""
    surface: Literal["middle", "bottom"] = "middle"
    """Of a sheet that bends, on which friction acts: its mid-surface, or its lower face."""
    map: FrictionMapTable | None = None
    """Patches with other friction."""


class BendingTable(Table):
    """The sheet resists bending. The table has no keys."""


class GravityTable(Table):
    """Weight, by one of weight and density."""

    weight: PositivePressure | None = None
    """Force per area of the sheet, e.g. "8 Pa": the rho g of the paper."""
    density: Density | None = None
    """Mass per volume instead, e.g. "1100 kg/m^3", on Earth; in files with units."""
    load: Weight = "grown"
    """Area by which it is counted."""
    incline: Angle | None = None
    """By which the ground rises towards +y, e.g. "5 deg"; plain ones are in radians."""


class GroundTable(Table):
    """Ground that carries the sheet, eq. 2: pressure = stiffness z^2 - damping dz/dt."""

    stiffness: Stiffness
    """Pressure per penetration squared, e.g. "2 kPa/mm^2"."""
    damping: Damping | None = None
    """Pressure per speed, e.g. "3 Pa*s/mm"."""
    load: Weight = "grown"
    """Area in which the pressure is counted."""
    form: Literal["clipped", "printed"] = "clipped"
    """"printed": damping may pull, as eq. 2 stands."""
    terrain: TerrainTable | None = None
    """Height of uneven ground; flat unless given."""


class InertiaTable(Table):
    """The sheet has mass."""

    density: Density
    """Mass per volume, e.g. "1100 kg/m^3"."""


class SelfContactTable(Table):
    """Parts of the sheet that meet keep apart by its thickness, without friction between them."""

    gap: Length | None = None
    """Between two faces, from which they repel each other; half the thickness unless given."""
    stiffness: Pressure | None = None
    """Pressure at which the gap is about a third of that; a tenth of Young's modulus unless given."""


class DeadLoadTable(Table):
    """A force per undeformed area that keeps its size and direction."""

    force: Annotated[list[Pressure], Field(min_length=2, max_length=3)]
    """Two components in the plane, three in space, each e.g. "2 Pa"."""


class RunTable(Table):
    """How the scene is to be answered."""

    level: Level = "auto"
    """"auto" takes the cheapest that can represent the scene; "predict" may take any theory or a cycle
    of shapes that meets the tolerance, of a sheet that bends, too, "second order" that theory alone;
    "line" is a one-dimensional body."""
    rtol: PositiveShare | None = None
    """Relative error of the speed, e.g. "1 %", which it is unless given."""
    periods: Natural = 2
    """Of the wave, for a scene that is stepped through time."""
    steps: Natural | None = None
    """Equal steps per period instead of rtol, for a scene that is stepped through time."""
    cells: Cells | None = None
    """Elements across and along, where they are not chosen for the wave."""
    element: str | None = None
    """Of scikit-fem, such as "ElementQuadBFS()"."""


TABLES: dict[str, type[Table]] = {
    "sheet": SheetTable,
    "outline": OutlineTable,
    "wave": WaveTable,
    "growth": GrowthTable,
    "friction": FrictionTable,
    "bending": BendingTable,
    "gravity": GravityTable,
    "ground": GroundTable,
    "inertia": InertiaTable,
    "self_contact": SelfContactTable,
    "dead_load": DeadLoadTable,
    "run": RunTable,
}
"""By name, each read for itself: a mistake in one does not hide those in others."""

REQUIRED = ("growth",)
ALWAYS = ("sheet", "wave", "run")
"""Tables that must be there, and those that stand for themselves where they are not."""
