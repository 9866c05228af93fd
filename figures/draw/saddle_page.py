"""The page on V over growth and curvature, docs/saddle.md, from the tables of its coefficients and range.

python -m figures.draw.saddle_page [--out FILE]
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from figures.common.command import parser
from figures.common.output import replacing
from figures.draw.saddle import GROUND_WORDS, SHARES, form_of
from figures.measure import lower_face, saddle, saddle_range
from figures.measure.saddle_range import BILAYER, GROUNDS, within
from linear_theory import Estimate
from linear_theory.speed.quadratic_form import QuadraticForm

PAGE = Path(__file__).parents[2] / "docs" / "saddle.md"
COMMAND = "python -m figures.draw.saddle_page"

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

Made by `python -m figures.draw.saddle_page` from the tables saddle, saddle_range and lower_face
in figures/data.

A sheet that lies on its ground and bends a little presses it harder here than there. To second order in
the growth coupling alpha and the curvature coupling beta (eq. 4, rest curvature −beta c),

    V = V_a alpha + V_aa alpha² + V_ab alpha beta + V_bb beta²,

with V_a = 0 for a sine. `second_order(scene).coefficients` gives all four with their errors in about
0.1 s, and `crawl_speed(scene, order=2)` the speed of a scene with `Bending`, `Gravity` and level `Ground`.

**The theory.** On a ground linearised about the depth at which it carries the weight (eq. 2:
s = 2 sqrt(k ρg)) the deflection beta w, upwards, obeys D∇⁴w + s w = −D(1 + ν)∇²c with free edges. The
pressure is ρg (1 + beta p), p = −s w/ρg. The load of the friction balance becomes 1 + alpha e + beta p,
e as in the planar theory. Points of the mid-surface slip with beta² by the stretching of the slopes,
−∇w∇w/2, and by the moments that turn with the sheet, a part of order (h/wavelength)², or all of it where
the ground is stiff. There is no slip of order beta, nor of alpha beta: turned upside down,
(beta, w) → −(beta, w), the sheet has the same energy.

**Why the sign of alpha beta.** V_ab is negative for every sheet below. The planar sheet crawls along the
wave because its grown parts carry more load. With alpha beta > 0 the parts that grow bend into a dome,
w > 0, and press less: that works against the load by area, and from beta = −V_aa alpha/V_ab on the sheet
crawls against the wave. With alpha beta < 0 they bend into a trough and press more, and the sheet is
faster.

![V over alpha and beta, and along the lines of two layers](../figures/gallery/saddle.png)

"""

TAIL = """At alpha = 0 dry friction is not a quadratic form: the slip is of order beta² alone, and V is
that of this motion; for a sine it vanishes. Growth of weight and pressure per different areas, damping,
uneven ground, inclines and inertia are refused by name.
"""


def page(
    rows: Sequence[saddle.Row],
    along: Sequence[saddle_range.Row],
    faces: Sequence[lower_face.Row],
) -> str:
    """Its text."""
    parts = _coefficients(rows), _bilayers(rows, faces), _range(rows, along), _lower(faces)
    return HEAD + "\n".join(line for part in parts for line in (*part, "")) + TAIL


def _coefficients(rows: Sequence[saddle.Row]) -> Iterator[str]:
    yield "| sheet | wave | law | V_aa | V_ab | V_bb | by steps: V_aa, V_ab, V_bb |"
    yield "| --- | --- | --- | --- | --- | --- | --- |"
    for r in rows:
        theory = [_told(getattr(r, f"theory_{p}"), getattr(r, f"error_{p}")) for p in PARTS]
        steps = [_told(getattr(r, f"stepper_{p}"), getattr(r, f"error_{p}")) for p in PARTS]
        yield f"| {SHEETS[r.place]} | {r.wave} | {r.law} | {' | '.join(theory)} | {', '.join(steps)} |"
    yield ""
    count = len({r.place for r in rows})
    waves, laws = (" and ".join(sorted({getattr(r, k) for r in rows})) for k in ("wave", "law"))
    yield f"Rows: {count} sheets and grounds, wave {waves}, law {laws}; speeds in L/T, beta in 1/L. The tanh"
    yield "law has a slip speed of 0.3 |alpha| L/T. Under viscous friction V_bb is exactly 0, since no mean"
    yield "slip is left. The largest distance from theory, of the extrapolated speeds of cycles of shapes"
    yield f"and of the stepper (`{saddle.TABLE.command}`): {_distances(rows)}."
    yield from _weak_part(rows)


def _told(value: float, error: float) -> str:
    """To four digits; 0 where it is below its error."""
    return "0" if abs(value) <= error else f"{value:.4g}".replace("-", "\N{MINUS SIGN}", 1)


def _distances(rows: Sequence[saddle.Row]) -> str:
    words = []
    for part, name in PARTS.items():
        shown = [f"{100 * distance(rows, way, part):.1g} %" for way in ("cycle", "stepper")]
        words.append(f"{name} {' and '.join(shown)}")
    return ", ".join(words)


def distance(rows: Sequence[saddle.Row], way: str, part: str) -> float:
    """The largest relative distance between theory and "cycle" or "stepper", where theory is not 0."""
    found = [
        abs(getattr(r, f"{way}_{part}") / getattr(r, f"theory_{part}") - 1)
        for r in rows
        if abs(getattr(r, f"theory_{part}")) > getattr(r, f"error_{part}")
    ]
    return max(found, default=math.nan)


def _weak_part(rows: Sequence[saddle.Row]) -> Iterator[str]:
    if distance(rows, "stepper", "bb") > 0.01:
        yield "The steps resolve V_bb worst where it is smallest: beta² V_bb is a difference of speeds that are"
        yield "all alpha² V_aa but for some thousandths, which is what the extrapolation in time leaves."


def _bilayers(rows: Sequence[saddle.Row], faces: Sequence[lower_face.Row]) -> Iterator[str]:
    dry, viscous = (form_of(rows, "paper", law) for law in ("tanh", "viscous"))
    most = dry.lift_off[1] / BILAYER
    yield f"**Bilayers.** Two equal layers have beta = ±3 alpha/h = ±{BILAYER:g} alpha/L. On the paper's ground, for"
    yield f"|alpha| < {most:.1g}, beyond which the sheet lifts off somewhere, V is, in L/T,"
    yield ""
    yield "| friction | V on beta = ±100 alpha/L |"
    yield "| --- | --- |"
    yield f"| tanh, on the mid-surface | {_on_lines(dry)} |"
    yield f"| viscous, on the mid-surface | {_on_lines(viscous)} |"
    yield f"| viscous, on the lower face | {_on_lines(lower(viscous, faces))} |"
    yield ""
    yield "On the mid-surface the sheet runs along the wave where the growing layer is below (alpha beta < 0)"
    yield "and against it where it is above: the paper's claim, always along the wave, does not hold to second"
    yield "order. With friction on the lower face it does hold."


def _on_lines(form: QuadraticForm) -> str:
    mixed, bent = BILAYER * form.alpha_beta.value, BILAYER**2 * form.beta_beta.value
    return f"alpha² ({form.alpha_alpha.value:.2f} ∓ {-mixed:.1f} + {abs(bent):.1f})"


def lower(form: QuadraticForm, faces: Sequence[lower_face.Row]) -> QuadraticForm:
    """The form of the paper's sheet under viscous friction with friction on its lower face."""
    (face,) = (f for f in faces if f.ground == "paper")
    return replace(
        form,
        alpha_beta=Estimate(form.alpha_beta.value + face.added_ab, form.alpha_beta.error),
        beta_beta=Estimate(form.beta_beta.value + face.added_bb, form.beta_beta.error),
    )


def _range(rows: Sequence[saddle.Row], along: Sequence[saddle_range.Row]) -> Iterator[str]:
    soft, stiff = (form_of(rows, ground).lift_off[1] for ground in GROUNDS)
    yield "**Where it ends.** At `coefficients.lift_off` the pressure of the linearised ground vanishes"
    yield f"somewhere: ±{soft:.2f}/L for the paper's sheet and ground, ±{stiff:.2f}/L on a ground 100 times as stiff."
    yield "There `crawl_speed` refuses. Cycles of shapes along both lines of two layers go further"
    yield f"(`{saddle_range.TABLE.command}`), and lift-off is no jump of V. The form differs"
    yield "from them, at the worse of both lines, by less than"
    yield ""
    yield "| ground | law | 5 % up to kappa L = | 10 % up to |"
    yield "| --- | --- | --- | --- |"
    for ground in GROUNDS:
        for law in saddle.LAWS:
            reached = (f"{within(along, ground, law, share):.2f}" for share in SHARES)
            yield f"| {GROUND_WORDS[ground]} | {law} | {' | '.join(reached)} |"
    yield ""
    yield "kappa = |beta| is the rest curvature at c = 1. The gaits of the paper, beta = −0.15 and 0.1, lie within"
    yield f"lift-off if beta is a curvature over 1/L; in the reading kappa = beta/h they have 3 to 5/L, {3 / soft:.0f} to {5 / soft:.0f}"
    yield "times lift-off, and nothing here applies ([the readings](gaits.md)). Their alpha, −0.25 and"
    yield "−0.3, is large for second order in any reading."


def _lower(faces: Sequence[lower_face.Row]) -> Iterator[str]:
    (face,) = (f for f in faces if f.ground == "paper")
    yield "**The mid-surface.** Friction acts on the mid-surface here, in the paper and in the shell. The normal of"
    yield "the deflected sheet is (−beta ∇w, 1), and its lower face lies h/2 below, at x − (h/2) n: its points are"
    yield "displaced by +(h/2) beta ∇w and slip by +(h/2) beta ∇ẇ in addition, of first order in beta, which all"
    yield "three leave out. Where the sheet is a trough and presses most, the lower face slips against the wave"
    yield "and pushes the sheet along it. Under viscous friction this adds"
    yield f"{_told(face.added_ab, 0)} to V_ab = {_told(face.middle_ab, 0)} and {_told(face.added_bb, 0)} to V_bb = 0 for the paper's sheet"
    yield f"(`{lower_face.TABLE.command}`; shapes of the nonlinear shell give the same within"
    yield "2 %): much for a bent sheet, since a beta of 100 alpha counts twice. Under dry friction V is no quadratic"
    yield "form then: slips of order alpha and of order beta compete."


def made() -> str:
    """The page of the kept tables."""
    return page(saddle.TABLE.read(), saddle_range.TABLE.read(), lower_face.TABLE.read())


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the page."""
    options = parser(COMMAND, __doc__, PAGE).parse_args(arguments)
    with replacing(options.out) as part:
        part.write_text(made(), encoding="utf-8")
    print(options.out)


if __name__ == "__main__":
    main()
