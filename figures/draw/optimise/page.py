"""The page on what optimisation buys, docs/optimisation.md, from its tables.

python -m figures.draw.optimise.page [--out FILE]
"""

import math
import textwrap
from collections.abc import Iterator, Sequence
from pathlib import Path

from figures.common.command import write_page
from figures.measure.optimise import buys, scan
from figures.measure.optimise.buys import FEW, GIVEN, LEVELS, MORE, SHEETS, Row
from figures.measure.optimise.rows import Row as Numbers
from linear_theory.optimisation.certificate import GAIN

PAGE = Path(__file__).parents[3] / "docs" / "optimisation.md"
COMMAND = "python -m figures.draw.optimise.page"

WORDS = {
    "paper": "the paper's, W = L/2, dry",
    "strip": "long, W = 0.1 L, dry",
    "wide": "wide, W = L, dry",
    "viscous": "hydrogel ribbon, W = 0.375 L, viscous",
    "directional": "W = L/2, dry, backward slip twice as hard",
}
"""Of `figures.measure.optimise.buys.SHEETS`."""

SIZES = {"largest": "the same largest |c|", "mean_square": "the same mean square of c"}

OWN = {"strip": "strip", "first order": "first", "second order": "second", "cycle": "cycle"}
"""The column of `Row` with the speeds by a level."""

HEAD = f"""# What optimisation buys

Is it worth looking for a better wave than a sine, and which level should look for it? Five sheets, all
with a Poisson ratio of ½ and one wave on the sheet, alpha = {buys.ALPHA:g}.
Each crawls under a sine, and under the best wave of two harmonics that is no larger than the sine: in
one search |c| <= 1, in the other the mean square of c is at most ½. The search finds its speeds by one
level; the wave that it ends with is then run on the **nonlinear sheet** (a cycle of static shapes), and
so is the sine. A gain of 2 is twice the speed of the sine there, whatever the level of the search has
claimed. How to search for your own wave: [the best wave, the best scene](howto/optimise.md).

Made by `{COMMAND}` from the tables optimisation_buys and best_numbers in
figures/data.
"""

FIGURE = """## The best waves

![Best waves on dry and viscous ground](../figures/gallery/best_waves.png)

(a) Dry friction, small strain: the best wave stretches half of its length as an anchor. (b) Its speed
in units of alpha L/(nT), by a linear program and by the optimiser, below the bound that no wave of N
harmonics passes. (c), (d) Viscous friction, c on the body through a period, for one mean square: the
sine and the best wave of a finite body, 1.28 L long, on top of a breathing of the whole body. How to
search for your own: [the best wave, the best scene](howto/optimise.md).
"""

VERDICT = """
**Verdict.** On dry ground a better wave is worth a lot: with two harmonics and |c| <= 1 the sheets are
{paper} (the paper's), {strip} (long) and {wide} (wide) times as fast as under the sine. The sine is a
poor wave there: its speed is of order alpha², that of a wave whose median is not its mean of order
alpha, so that the gain grows as alpha falls. On viscous ground, and where friction itself has a
direction, two harmonics bring little, {viscous} and {directional} times. Five bring more on every
sheet: {paper_more} times for the paper's, {viscous_more} and {directional_more} times for the last two.

The closed form of a strip is enough for a long sheet and worth having on any dry one: its wave keeps
{kept} % of the best speed known of the paper's sheet and {kept_wide} % of that of the wide one. It is
not safe: with directed friction its wave is slower than the sine ({wrong} times), while the strip
claims more. It needs the check by a higher level, which `optimise` makes unless it is told not to.
First order costs seconds and is right about its own waves to some percent; climbing from there on the
nonlinear sheet itself brings {more} % more for the paper's sheet, within the errors, at {price} times
the cost. It may rank waves wrongly where V is of order alpha²: on viscous ground at a given mean square
its wave gains {misled}, that of the strip, which is exact in alpha, {exact} times."""

Lines = Iterator[str]


def page(rows: Sequence[Row], numbers: Sequence[Numbers]) -> str:
    """Its text."""
    parts = [HEAD, *_verdict(rows), "## Gains", ""]
    for size, words in SIZES.items():
        parts += [f"**At {words}.** Gain on the nonlinear sheet, and seconds of the search:", ""]
        parts += [*_gains(rows, size), ""]
    parts += [
        "Seconds are those of one core; at second order and on the cycle those beyond the search at",
        'first order, from whose wave it climbs. "not run": the table goes on where it ends.',
        "\\*: the certificate of the search does not hold, for a kink, or because the errors of",
        f"gradients by differences of such speeds do not let it tell a gain of {100 * GAIN:g} %.",
        "",
        f"**With {MORE} harmonics**, |c| <= 1:",
        "",
        *_gains(rows, "largest", MORE, buys.BY_ADJOINT),
        "",
        "## What a level claims, and what the sheet does",
        "",
        "V of the best wave in alpha L/T, by the level that found it and by the nonlinear sheet, where",
        "|c| <= 1:",
        "",
        *_claims(rows),
        "",
        "## Best numbers",
        "",
        "The best number of waves (whole or not), width and growth at first order, by the gradient",
        f"from {scan.STARTS} starts and by a plain scan of a grid; the last by `optimise`:",
        "",
        *_numbers(numbers),
        "",
        FIGURE,
    ]
    return "\n".join(parts)


def sine_of(rows: Sequence[Row], sheet: str) -> Row:
    """The sine on a sheet. Raises ValueError, naming the command, for a table without it."""
    for row in rows:
        if row.sheet == sheet and row.level == GIVEN:
            return row
    raise ValueError(f"no sine on {sheet!r} in the table; `{buys.TABLE.command}` makes it")


def gain(rows: Sequence[Row], row: Row) -> tuple[float, float]:
    """Of a wave over the sine on the nonlinear sheet, and its error."""
    sine = sine_of(rows, row.sheet)
    value = row.cycle / sine.cycle
    return value, abs(value) * (row.cycle_error / abs(row.cycle) + sine.cycle_error / abs(sine.cycle))


def found(rows: Sequence[Row], sheet: str, size: str, level: str, harmonics: int = FEW) -> Row | None:
    """A row of the table, if it is there."""
    place = buys.Place(sheet, size, harmonics, level)
    return next((row for row in rows if buys.place_of(row) == place), None)


def _gains(
    rows: Sequence[Row], size: str, harmonics: int = FEW, levels: Sequence[str] = LEVELS
) -> Lines:
    yield "| sheet | V of the sine | " + " | ".join(f"by {level}" for level in levels) + " |"
    yield "| --- " * (2 + len(levels)) + "|"
    for sheet in SHEETS:
        sine = sine_of(rows, sheet)
        cells = [_gain(rows, found(rows, sheet, size, level, harmonics)) for level in levels]
        yield f"| {WORDS[sheet]} | {with_error(sine.cycle, sine.cycle_error)} | {' | '.join(cells)} |"


def _gain(rows: Sequence[Row], row: Row | None) -> str:
    if row is None:
        return "not run"
    proved = "" if row.left <= 100 * GAIN else " \\*"
    return f"{with_error(*gain(rows, row))} ({seconds(row.seconds)}){proved}"


def _claims(rows: Sequence[Row]) -> Lines:
    yield "| sheet | " + " | ".join(f"{level}: claimed, true" for level in LEVELS[:-1]) + " |"
    yield "| --- " * len(LEVELS) + "|"
    for sheet in SHEETS:
        yield f"| {WORDS[sheet]} | {' | '.join(_claim(rows, sheet, one) for one in LEVELS[:-1])} |"


def _claim(rows: Sequence[Row], sheet: str, level: str) -> str:
    row = found(rows, sheet, "largest", level)
    if row is None:
        return "not run"
    claimed, true = getattr(row, OWN[level]) / buys.ALPHA, row.cycle / buys.ALPHA
    return f"{claimed:.3f}, {true:.3f} ({signed(100 * (claimed / true - 1))} %)"


def _numbers(numbers: Sequence[Numbers]) -> Lines:
    yield (
        "| question | over | best by gradient | best of the grid | its spacing | V by gradient "
        "| V of the grid | seconds |"
    )
    yield "| --- " * 8 + "|"
    for row in numbers:
        values = (
            with_error(*pair) for pair in ((row.value, row.error), (row.scan_value, row.scan_error))
        )
        names = row.names.replace(" ", ", ")
        places = " | ".join(t.replace(" ", ", ") for t in (row.found, row.scanned, row.spacing))
        spent = f"{seconds(row.seconds)}, scan {seconds(row.scan_seconds)}"
        yield f"| {row.question} | {names} | {places} | {' | '.join(values)} | {spent} |"


def _verdict(rows: Sequence[Row]) -> Lines:
    """In words, with the numbers of the tables, wrapped."""
    words = VERDICT.format(
        **{sheet: f"{best(rows, sheet):.2f}" for sheet in SHEETS},
        **{f"{sheet}_more": f"{best(rows, sheet, MORE):.2f}" for sheet in SHEETS},
        kept=f"{100 * by(rows, 'paper', 'strip') / best(rows, 'paper'):.0f}",
        kept_wide=f"{100 * by(rows, 'wide', 'strip') / best(rows, 'wide'):.0f}",
        wrong=f"{by(rows, 'directional', 'strip'):.2f}",
        more=f"{100 * (by(rows, 'paper', 'cycle') / by(rows, 'paper', 'first order') - 1):.1f}",
        price=f"{spent(rows, 'paper', 'cycle') / spent(rows, 'paper', 'first order'):.0f}",
        misled=f"{by(rows, 'viscous', 'first order', 'mean_square'):.2f}",
        exact=f"{by(rows, 'viscous', 'strip', 'mean_square'):.2f}",
    )
    for paragraph in words.strip().split("\n\n"):
        unbroken = paragraph.replace("\n", " ").replace(" %", "\N{NO-BREAK SPACE}%")
        yield textwrap.fill(unbroken, 104)
        yield ""


def best(rows: Sequence[Row], sheet: str, harmonics: int = FEW) -> float:
    """The largest gain of a wave with |c| <= 1 that any search has found."""
    some = (r for r in rows if (r.sheet, r.size, r.harmonics) == (sheet, "largest", harmonics))
    return max(gain(rows, row)[0] for row in some)


def by(rows: Sequence[Row], sheet: str, level: str, size: str = "largest") -> float:
    """The gain by the search of a level. Raises ValueError for a table without it."""
    return gain(rows, _there(rows, sheet, level, size))[0]


def spent(rows: Sequence[Row], sheet: str, level: str) -> float:
    """Seconds of the search of a level, and of that of first order if it begins there."""
    own = _there(rows, sheet, level, "largest").seconds
    return own if level in buys.BY_ADJOINT else own + spent(rows, sheet, "first order")


def _there(rows: Sequence[Row], sheet: str, level: str, size: str) -> Row:
    row = found(rows, sheet, size, level)
    if row is None:
        raise ValueError(f"no wave of {level!r} on {sheet!r}; `{buys.TABLE.command}` finds it")
    return row


def with_error(value: float, error: float) -> str:
    """A number to the digits that its error leaves, four at most.

    >>> from figures.draw.optimise.page import with_error
    >>> print(with_error(3.1502, 0.004), with_error(0.015200, 7e-5), with_error(1.09724, 1e-6))
    3.150 ± 0.004 0.01520 ± 0.00007 1.097
    """
    size = math.floor(math.log10(abs(value))) if value else 0
    if error < 10.0 ** (size - 3) / 2:
        return f"{value:.{max(3 - size, 0)}f}"
    digits = max(-math.floor(math.log10(error)), 0)
    return f"{value:.{digits}f} ± {error:.{digits}f}"


def signed(value: float) -> str:
    """A number with its sign, to two digits, or 0.

    >>> from figures.draw.optimise.page import signed
    >>> print(signed(-13.2), signed(0.04))
    −13 0
    """
    text = f"{value:+.0f}" if abs(value) >= 10 else f"{value:+.1f}"
    return "0" if abs(value) < 0.05 else text.replace("-", "\N{MINUS SIGN}")


def seconds(value: float) -> str:
    """Of a search.

    >>> from figures.draw.optimise.page import seconds
    >>> print(seconds(0.283), seconds(33.77))
    0.3 s 34 s
    """
    return f"{value:.1f} s" if value < 9.95 else f"{value:.0f} s"


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the page."""
    write_page(COMMAND, __doc__, PAGE, lambda: page(buys.TABLE.read(), scan.TABLE.read()), arguments)


if __name__ == "__main__":
    main()
