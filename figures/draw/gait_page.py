"""The page on the gaits of the seed paper, docs/gaits.md, from `figures.measure.paper.gait_map`.

python -m figures.draw.gait_page [--out FILE]
"""

import math
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from figures.common.command import write_page
from figures.draw.gait_statements import by_steps, number, statements
from figures.measure.paper.gait_map import BILAYER, TABLE, Row
from figures.measure.paper.paper_gait import BACKWARD, FORWARD, FRICTIONS, READINGS, kept
from figures.measure.paper.terrain import HEIGHT, MOST

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "gaits.md"
COMMAND = "python -m figures.draw.gait_page"

SAME = 1e-3
"""V of the second and the third cycle that differ by less, L a cycle, have one sign or none."""

HEAD = """# What of sections 3.2 to 3.4 holds

Made by `python -m figures.draw.gait_page` from the tables gait_map, trapezoids, terrain and decisive in
figures/data, which `make gaits` fills: 6 to 30 s of one core for each gait.

Section 3.2 of the seed paper drives a sheet that bends by the waves of eq. 12 and maps its speed
over alpha and beta. Three of its numbers leave open what was computed, so that every reading is run
by name:

* **The wave.** With the printed numbers eq. 12 has no travelling wave of order one on the sheet.
  The threshold −0.1 has one, for twenty cycles: the preset "nu = -0.1"
  ([waves](howto/own_wave.md)). Its second and third cycle count here.
* **Friction.** With the printed v0 = 1 and a cycle of 42 units of time, friction is *viscous*;
  *dry* here has v0 = 0.02 L a cycle.
* **beta.** Rest curvature kappa c with kappa = beta ("printed"), beta/h ("thickness") or 100 beta
  ("hundred").

The ground is the printed one, 4 × 8 elements, 64 steps a cycle, no inertia. V is in L a cycle,
positive along the wave, of the third cycle; where the second one has another sign, both are given.
*crosses*: the sheet passes through itself at some time, which no real sheet does.

"""

TAIL = """## The map

![Speed over growth coupling and rest curvature](../figures/gallery/fig4.png)

Colours: V in L a cycle. Line: V = 0. Dots: the sheet crosses itself. Dashed: the two lines of two
equal layers, kappa = ±100 alpha. Symbols: the paper's two gaits, in the reading of their colour.

Hatched: |V| is below its error. Stars: the largest speeds against and along the wave. Right: the path
of the centre of mass.

![A gait in space, its wave and its poses](../figures/gallery/fig2.png)

## Trapezoids and uneven ground

w1 and w2 are in units of the width of the rectangle, L/2: only so do the paper's L' = 2L/(w1 + w2) and
its area L²/2 agree.

![Speed of trapezoids of one area](../figures/gallery/fig5.png)

Dashed: the best length according to the paper; circles: the best of each ratio; hatched: |V| is below
its error.

With sines, as eq. 13 has it, ground with ridges along one axis only (B, C) would be flat, so that
"cosine" ground is run too. The paper's viscous friction, weight times v/v0, is some thousandths of the
weight at 0.1 L a cycle; slopes reach SLOPE. Under dry friction a sheet that buckles may
take another way with other steps: on flat ground V of the forward gait is
SPEEDS.
Such sheets are run a second time with other steps, and the difference is part of their errors.

![Speed on uneven ground](../figures/gallery/fig6.png)

Grey places have not been computed. How sure such speeds are: [sheets that bend](howto/bending.md).
"""


def page(rows: Sequence[Row]) -> str:
    """Its text."""
    known = {(r.alpha, r.kappa, r.friction): r for r in rows}

    def found(alpha: float, kappa: float, friction: str) -> Row | None:
        return known.get((kept(alpha), kept(kappa), friction))

    tail = TAIL.replace("SPEEDS", _speeds()).replace("SLOPE", f"{2 * math.pi * HEIGHT * MOST:.1f}")
    told = [*statements(), "", *_gaits(found), *_bilayers(found), tail]
    return "\n".join([HEAD + told[0], *told[1:]])


def _speeds() -> str:
    """V of the forward gait by its steps, in words."""
    return ", ".join(f"{number(v)} with {n} steps a cycle" for n, v in by_steps("forward").items())


Found = Callable[[float, float, str], Row | None]


def _gaits(found: Found) -> Iterator[str]:
    yield "## The two gaits\n"
    yield "The paper: (alpha, beta) = (−0.25, −0.15) runs against the wave, (−0.3, 0.1) along it.\n"
    yield "| reading of beta | friction | (−0.25, −0.15) | (−0.3, 0.1) | as the paper says |"
    yield "| --- | --- | --- | --- | --- |"
    for reading, factor in READINGS.items():
        for law in FRICTIONS:
            rows = [found(alpha, beta * factor, law) for alpha, beta in (BACKWARD, FORWARD)]
            signs = [sign(row) for row in rows]
            holds = "yes" if signs == [-1, 1] else "no"
            if holds == "yes" and any(row and row.crossed for row in rows):
                holds = "only where it crosses itself"
            yield f"| {reading} | {law} | {' | '.join(map(told, rows))} | {holds} |"
    yield ""


def _bilayers(found: Found) -> Iterator[str]:
    yield "## Two layers, one of which grows\n"
    yield "The paper: on both lines beta = ±100 alpha (kappa in 1/L) the sheet runs along the wave.\n"
    yield "| friction | line | " + " | ".join(f"alpha = {sign_of(a)}" for a in _alphas()) + " |"
    yield "| --- " * (2 + len(_alphas())) + "|"
    for law in FRICTIONS:
        for way in (1, -1):
            cells = [told(found(a, way * 100 * a, law)) for a in _alphas()]
            yield f"| {law} | kappa = {'+' if way > 0 else '−'}100 alpha | {' | '.join(cells)} |"
    yield ""
    yield (
        "The layer that grows being the upper or the lower one is the sign of the line; expansion\n"
        "or contraction is the sign of alpha. Under viscous friction V has one sign on each line for\n"
        "small alpha: a saddle. The statement holds on the line kappa = −100 alpha and fails on the\n"
        "other one, as the theory for alpha -> 0 has it; were friction on the lower face of the\n"
        "sheet and not on its mid-surface, it would hold on both there\n"
        "([V to second order](saddle.md)).\n"
    )


def _alphas() -> list[float]:
    return [*(-a for a in reversed(BILAYER)), *BILAYER]


def sign(row: Row | None) -> int:
    """1 or -1 if both cycles agree, 0 otherwise."""
    if row is None or math.isnan(row.third):
        return 0
    signs = {math.copysign(1, v) for v in (row.second, row.third) if abs(v) > SAME}
    return int(signs.pop()) if len(signs) == 1 else 0


def told(row: Row | None) -> str:
    """V in a cell of a table."""
    if row is None:
        return "not run"
    if math.isnan(row.third):
        return "stopped"
    values = [row.third] if row.second * row.third > 0 else [row.second, row.third]
    crossed = ", crosses" if row.crossed else ""
    return " then ".join(map(sign_of, values)) + crossed


def sign_of(value: float) -> str:
    """A number with its sign, to two digits."""
    return f"{value:+.2g}".replace("-", "\N{MINUS SIGN}")


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the page."""
    write_page(COMMAND, __doc__, PAGE, lambda: page(TABLE.read()), arguments)


if __name__ == "__main__":
    main()
