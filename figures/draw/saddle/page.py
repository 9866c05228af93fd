"""The page on V over growth and curvature, docs/saddle.md, from its tables.

python -m figures.draw.saddle.page [--out FILE]
"""

import math
import textwrap
from collections.abc import Iterator, Sequence
from pathlib import Path

from fem_check.shell.effects.friction import WEAK
from figures.common.command import write_page
from figures.draw.saddle import limits
from figures.draw.saddle.figure import GROUND_WORDS, SHARES, form_of
from figures.measure import saddle
from figures.measure.plate import bent_alone, lower_face, model_error, saddle_range
from figures.measure.plate.saddle_range import BILAYER, GROUNDS, within
from linear_theory.speed.plate import error as rule

PAGE = Path(__file__).parents[3] / "docs" / "saddle.md"
COMMAND = "python -m figures.draw.saddle.page"

PARTS = {"aa": "V_aa", "ab": "V_ab", "bb": "V_bb"}

SHEETS = {
    "paper": "the paper's",
    "stiff ground": "on a ground 100 times as stiff",
    "soft ground": "on a ground a tenth as stiff",
    "narrow": "0.2 L wide, ν = 0.3",
    "wide": "L wide, ν = 0.3, h = 0.02 L",
    "thin and heavy": "h = 0.015 L, ν = 0, ρg = 1e-3",
}
"""Of `figures.measure.saddle.PLACES`."""

HEAD = """# V to second order in growth and curvature

Made by `python -m figures.draw.saddle.page` from the tables saddle, saddle_range, bent_alone and
lower_face in figures/data.

A sheet that lies on its ground and bends a little presses it harder here than there. To second order in
the growth coupling alpha and the curvature coupling beta (eq. 4, rest curvature −beta c),

    V = V_a alpha + V_aa alpha² + V_ab alpha beta + V_bb beta²,

with V_a = 0 for a sine. `second_order(scene).coefficients` gives all four with their errors in about
0.1 s for a sine and a second for a pulse; `.converged` says whether they meet the tolerance, which they
do not on the stiffest grounds, with (D/s)^(1/4) of some 0.005 L. `crawl_speed(scene, order=2)` gives
the speed of a scene with `Bending`, `Gravity` and level `Ground`, with its power, cost of transport and
efficiency.

**The theory.** On a ground linearised about the depth at which it carries the weight (eq. 2:
s = 2 sqrt(k ρg)) the deflection beta w, upwards, obeys D∇⁴w + s w = −D(1 + ν)∇²c with free edges. The
pressure is ρg (1 + beta p), p = −s w/ρg. The load of the friction balance becomes 1 + alpha e + beta p,
e as in the planar theory. Points of the mid-surface slip with beta² by the stretching of the slopes,
−∇w∇w/2, and by the moments that turn with the sheet, a part of order (h/wavelength)², or all of it
where the ground is stiff. There is no slip of order beta, nor of alpha beta: turned upside down,
(beta, w) → −(beta, w), the sheet has the same energy.

**Why the sign of alpha beta.** V_ab is negative for every sheet, wave and law below. The planar sheet
crawls along the wave because its grown parts carry more load. With alpha beta > 0 the parts that grow
bend into a dome, w > 0, and press less: that works against the load by area, and under a sine the sheet
crawls against the wave from beta = −V_aa alpha/V_ab on. With alpha beta < 0 they bend into a trough and
press more, and the sheet is faster.

**Power.** Growth does the work that friction takes, the mean of (1 + alpha e + beta p) f(w) · w over
the sheet, w the same slip: exact to one order beyond the leading one. At alpha beta only pressure adds
to it, nothing under a sine, at beta² only the slip by bending. `growth_power` has its course over a
period, with what the sheet stores by stretching, by bending and on its ground.

![V over alpha and beta, and along the lines of two layers](../figures/gallery/saddle.png)

"""

Lines = Iterator[str]


def made() -> str:
    """The page of the kept tables."""
    faces, alone = lower_face.TABLE.read(), bent_alone.TABLE.read()
    return page(saddle.TABLE.read(), saddle_range.TABLE.read(), faces, alone)


def page(
    rows: Sequence[saddle.Row],
    along: Sequence[saddle_range.Row],
    faces: Sequence[lower_face.Row],
    alone: Sequence[bent_alone.Row],
) -> str:
    """Its text."""
    first = _coefficients(rows), _bilayers(rows, faces), _range(rows, along)
    parts = *first, _bound(), [limits.TEXT], _alone(alone), _lower(faces)
    return HEAD + "\n\n".join(block for part in parts for block in part) + "\n"


def wrapped(*parts: str) -> str:
    """A paragraph."""
    return textwrap.fill(" ".join(parts), 104, break_long_words=False, break_on_hyphens=False)


def table(*rows: Sequence[str]) -> str:
    """The first row is the head."""
    lines = [f"| {' | '.join(row)} |" for row in rows]
    return "\n".join([lines[0], "| --- " * len(rows[0]) + "|", *lines[1:]])


def told(value: float, error: float = 0.0) -> str:
    """To four digits; 0 where it is below its error."""
    if abs(value) <= error:
        return "0"
    sign = "\N{MINUS SIGN}" if value < 0 else ""
    return sign + f"{abs(value):#.4g}".replace("e-0", "e-")


def _coefficients(rows: Sequence[saddle.Row]) -> Lines:
    yield table(
        ["sheet", "wave", "law", *PARTS.values(), "by steps: V_aa, V_ab, V_bb"], *map(_cells, rows)
    )
    yield wrapped(
        "Speeds in L/T, beta in 1/L; V_a of the pulse is that of the planar sheet. Steps that differ",
        "from 0 by less than the error of theory are 0 here. The tanh law has a slip speed of 0.3",
        "|alpha| L/T. Under viscous friction V_bb is exactly 0, since no mean slip is left. The",
        "largest distance from theory of the speeds of cycles of shapes and of the stepper,",
        f"extrapolated to small couplings (`{saddle.TABLE.command}`): {_distances(rows)}.",
    )


def _cells(r: saddle.Row) -> list[str]:
    errors = [getattr(r, f"error_{p}") for p in PARTS]
    theory, steps = (
        [told(getattr(r, f"{way}_{p}"), e) for p, e in zip(PARTS, errors, strict=True)]
        for way in ("theory", "stepper")
    )
    return [SHEETS[r.place], r.wave, r.law, *theory, ", ".join(steps)]


def _distances(rows: Sequence[saddle.Row]) -> str:
    words = []
    for part, name in PARTS.items():
        shown = [f"{100 * distance(rows, way, part):.1g}" for way in ("cycle", "stepper")]
        words.append(f"{name} {' and '.join(shown)} %")
    return ", ".join(words)


def distance(rows: Sequence[saddle.Row], way: str, part: str) -> float:
    """The largest relative distance between theory and "cycle" or "stepper", where theory is not 0."""
    found = [
        abs(getattr(r, f"{way}_{part}") / getattr(r, f"theory_{part}") - 1)
        for r in rows
        if abs(getattr(r, f"theory_{part}")) > getattr(r, f"error_{part}")
    ]
    return max(found, default=math.nan)


def _bilayers(rows: Sequence[saddle.Row], faces: Sequence[lower_face.Row]) -> Lines:
    limit = form_of(rows, "paper", "tanh").lift_off[1]
    yield wrapped(
        f"**Bilayers.** Two equal layers have beta = ±3 alpha/h = ±{BILAYER:g} alpha/L. On the",
        f"paper's ground, for |alpha| < {limit / BILAYER:.1g}, beyond which the sheet lifts off",
        "somewhere, V over alpha² L/T is on these lines:",
    )
    face = "on the lower face"
    yield table(
        ["friction", "on the mid-surface", face, f"{face}, by cycles", f"{face}, by steps"],
        *([law, *_on_lines(faces, law)] for law in lower_face.LAWS),
    )
    yield wrapped(
        "On the mid-surface the sheet runs along the wave where the growing layer is below (alpha",
        "beta < 0) and against it where it is above: the paper's claim, always along the wave, does",
        "not hold to second order. With friction on the lower face it holds if that is viscous. Dry",
        "and tanh friction on the lower face still push the sheet against the wave where the growing",
        f"layer is above, with {_fraction(faces)} of that speed.",
    )


def _on_lines(faces: Sequence[lower_face.Row], law: str) -> list[str]:
    lines = [_line(faces, law, way) for way in (1, -1)]
    return [
        " and ".join(f"{getattr(line, name):+.1f}" for line in lines).replace("-", "−")
        if math.isfinite(getattr(lines[0], name))
        else ""
        for name in ("middle", "lower", "cycle", "stepper")
    ]


def _line(faces: Sequence[lower_face.Row], law: str, way: int) -> lower_face.Row:
    """The row of the paper's ground."""
    return next(r for r in faces if lower_face.line_of(r) == lower_face.Line("paper", law, way))


def _fraction(faces: Sequence[lower_face.Row]) -> str:
    """The speed on the lower face over that on the mid-surface, of dry and tanh friction."""
    found = [_line(faces, law, 1) for law in ("dry", "tanh")]
    return " and ".join(f"{r.lower / r.middle:.2f}" for r in found)


def _range(rows: Sequence[saddle.Row], along: Sequence[saddle_range.Row]) -> Lines:
    soft, stiff = (form_of(rows, ground).lift_off[1] for ground in GROUNDS)
    yield wrapped(
        "**Where it ends.** At `coefficients.lift_off` the pressure of the linearised ground",
        f"vanishes somewhere: ±{soft:.2f}/L for the paper's sheet and ground, ±{stiff:.2f}/L on a",
        "ground 100 times as stiff. There `crawl_speed` refuses. Cycles of shapes along both lines",
        f"of two layers go further (`{saddle_range.TABLE.command}`): V does not jump at lift-off, and",
        f"the form differs from them by {_at_lift_off(along, 'paper')} and",
        f"{_at_lift_off(along, 'stiff ground')} % of V there, and by 5 and 10 % at a rest curvature",
        "kappa = |beta|, at the worse of both lines, of",
    )
    reached = [
        [GROUND_WORDS[ground], law, *(_reached(along, ground, law, s) for s in SHARES)]
        for ground, law in saddle_range.complete(along)
    ]
    yield table(["ground", "law", "5 %", "10 %"], *reached)
    yield wrapped(
        "The paper's gaits, beta = −0.15 and 0.1, are within this range if beta is a curvature over",
        f"1/L. In the reading kappa = beta/h they have 5 and 3.3/L, {3.3 / soft:.0f} to",
        f"{5 / soft:.0f} times lift-off, far beyond ([the readings](gaits.md)); their alpha, −0.25",
        "and −0.3, is large for second order in any.",
    )
    yield wrapped(
        "Growth of weight and pressure per different areas, damping, uneven ground, inclines and",
        "inertia are refused by name, and so is friction that deforms the sheet, mu weight",
        f"L/(E h |alpha|) > {WEAK:g}: `simulate` has it act back.",
    )


def _bound() -> Lines:
    """The distance to cycles, and how it was checked."""
    rows = [r for r in model_error.TABLE.read() if r.number >= rule.FITTED and model_error.within(r)]
    missed = sum(not model_error.off(r) <= model_error.bound_of(r) + r.error for r in rows)
    yield wrapped(
        "For a sine, scenes at random give a bound of that difference",
        f"(`{model_error.TABLE.command}`), by which `predict` chooses between the form and cycles of",
        f"shapes: {rule.PLANE:g} alpha² of the term in alpha², and {rule.CONTACT:g} b² +",
        f"{rule.TENSION:g} m² + q of those in beta. b is beta",
        "over that of lift-off. m = alpha E h W/(L sqrt(D s)) compares the forces that growth makes in",
        "the plane with those that hold the sheet flat; the bound stands up to m =",
        f"{rule.RANGES['tension'][1]:g}. q is the slip by bending over that by growth, 0 for viscous",
        f"friction. Of {len(rows)} scenes that it was not made of {missed or 'none'} was off by more.",
    )


def _reached(along: Sequence[saddle_range.Row], ground: str, law: str, share: float) -> str:
    reached = within(along, ground, law, share)
    if math.isfinite(reached):
        return f"{reached:.2g}/L"
    return f"beyond {max(r.beta for r in saddle_range.ray(along, ground, law, 1)):.2g}/L"


def _at_lift_off(along: Sequence[saddle_range.Row], ground: str) -> str:
    near = [r for r in along if r.ground == ground and r.beta == r.lift_off]
    return f"{100 * max(abs(r.form / r.cycle - 1) for r in near):.1f}"


def _alone(rows: Sequence[bent_alone.Row]) -> Lines:
    speed = max(abs(r.speed / r.cycle_speed - 1) for r in rows)
    power = max(abs(r.power / r.cycle_power - 1) for r in rows)
    yield wrapped(
        "**Bending alone.** At alpha = 0 dry friction has no such form: the slip is of order beta²,",
        "and V, of order beta², too, is that of this motion, another multiple of beta² than V_bb. For",
        "a sine it vanishes, and for most sheets and waves it is lost in the error of the slip; where",
        f"it is not, cycles of shapes (`{bent_alone.TABLE.command}`) give the same V within",
        f"{100 * speed:.1f} % and the same power within {100 * power:.1f} %:",
    )
    cells = [
        [
            SHEETS[r.place],
            r.wave,
            f"{told(r.speed)} ± {r.speed_error:.0e}".replace("e-0", "e-"),
            told(r.cycle_speed),
            f"{told(r.power)} ± {r.power_error:.0e}".replace("e-0", "e-"),
            told(r.cycle_power),
        ]
        for r in rows
    ]
    yield table(["sheet", "wave", "V/beta²", "by cycles", "power/beta²", "by cycles"], *cells)


def _lower(faces: Sequence[lower_face.Row]) -> Lines:
    sizes = [max(abs(r.lower), abs(r.middle)) for r in faces]  # in which terms of both signs cancel
    cycles, steps = (
        100
        * max(
            abs(getattr(r, way) - r.lower) / size
            for r, size in zip(faces, sizes, strict=True)
            if math.isfinite(getattr(r, way))
        )
        for way in ("cycle", "stepper")
    )
    yield wrapped(
        "**The lower face.** Friction acts on the mid-surface above, as in the paper. A law that is",
        '`OnLowerFace(law)`, or `Friction(..., surface="bottom")`, acts on the lower face, a point',
        "h/2 below, in this theory, in cycles of shapes and in the stepper. The normal of the",
        "deflected sheet is n = (−beta ∇w, 1), and its lower face lies at x − (h/2) n: its points are",
        "displaced by +(h/2) beta ∇w and slip by +(h/2) beta ∇ẇ in addition, of first order in beta.",
        "For w = A sin(ky − ωt) that is (h/2) beta k ω w along y: where the sheet is a trough and",
        "presses most, the lower face slips against the wave and pushes the sheet along it, for",
        "either sign of beta: bending alone makes the sheet crawl. At second order the normal of the",
        "sheet that has grown counts, too, and with it the deflection of order alpha beta (the grown",
        "sheet is larger, and forces in its plane pull at its slopes) and that of order beta² (the",
        "pressure k z² is not linear).",
    )
    yield wrapped(
        "Slips of order alpha and of order beta then compete. Under viscous friction V stays a",
        "quadratic form; under dry and tanh friction it is another multiple of alpha² on each ray",
        "beta/alpha, given by `crawl_speed(scene, order=2)`, while V_ab and V_bb of `coefficients`",
        "are NaN. Nothing that relates alpha beta and −alpha beta is left: turned upside down, the",
        "sheet rubs on the other face. V(−alpha, −beta) = V(alpha, beta) holds for a sine as before.",
        f"On both lines of two layers and both grounds (`{lower_face.TABLE.command}`) theory is",
        f"within {cycles:.2g} % of cycles and {steps:.2g} % of steps, extrapolated to small couplings,",
        "of the larger of V on both surfaces. The pressure still acts by the height of the",
        "mid-surface, and h is that of the sheet before growth.",
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the page."""
    write_page(COMMAND, __doc__, PAGE, made, arguments)


if __name__ == "__main__":
    main()
