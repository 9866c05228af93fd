"""The statements of sections 3.2 to 3.4 of the seed paper, each with its verdict, from the tables."""

import math
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from figures.draw.fig5 import OPTIMUM, WAY, of, optimum
from figures.draw.speed_map import Grid
from figures.measure.paper import decisive, gait_map, terrain, trapezoids

ENOUGH = 4
"""Grounds of a law of friction among which extremes are told: those of the paper, A to D."""


def statements() -> Iterator[str]:
    """Rows of the table: statement, verdict, what decides it."""
    yield "| statement | verdict | decided by |"
    yield "| --- | --- | --- |"
    changed = {(r.gait, r.friction, r.change): r for r in decisive.TABLE.read()}
    for statement, verdict, figure in (
        *_waves(changed),
        *_map(),
        *_lengths(),
        *_grounds(),
        *_assumptions(changed),
    ):
        yield f"| {statement} | {verdict} | {figure} |"


def number(value: float, error: float = math.nan) -> str:
    """A speed with its sign and its error."""
    text = f"{value:+.3g}" if math.isnan(error) else f"{value:+.3g} ± {error:.1g}"
    return text.replace("-", "\N{MINUS SIGN}")


def _waves(changed: dict[Any, Any]) -> Iterator[tuple[str, str, str]]:
    kept = [changed["forward", "viscous", name] for name in ("wave printed", "wave nu = -0.05", "none")]
    speeds = ", ".join(number(r.third, r.error) for r in kept)
    yield (
        "the printed numbers of eq. 12 give travelling waves",
        "for a while: amplitude 0.12, not of order one, and the lag along the sheet decays. "
        f"V of the forward gait, threshold −0.01 as printed, −0.05 and −0.1: {speeds}",
        "[waves](../figures/gallery/excitable.png)",
    )
    yield (
        "y²/(1 + y²) starts a wave that travels",
        "only with y from the rear end; with y from the centre all is mirror symmetric",
        "[waves](../figures/gallery/excitable.png)",
    )


def _map() -> Iterator[tuple[str, str, str]]:
    rows = gait_map.TABLE.read()
    small = [r for r in rows if abs(r.alpha) == 0.02 and r.friction == "viscous"]
    saddle = len(small) == 4 and all(r.third * r.alpha * r.kappa < 0 for r in small)
    yield (
        "V is a saddle over alpha and beta",
        f"{'yes' if saddle else 'no'} under viscous friction: V has the sign of −alpha kappa",
        "[fig. 4](../figures/gallery/fig4.png)",
    )
    crossed = [r for r in rows if r.crossed]
    least = min(abs(r.kappa) for r in crossed)
    yield (
        "(not mentioned) the sheet passes through itself",
        f"in {len(crossed)} of {len(rows)} gaits, from \\|kappa\\| = {least:g}/L on",
        "[fig. 4](../figures/gallery/fig4.png)",
    )


def _lengths() -> Iterator[tuple[str, str, str]]:
    rows = trapezoids.TABLE.read()
    for gait, printed in OPTIMUM.items():
        found = of(rows, gait)
        tops = optimum(found, WAY[gait]) if found.speed.size else {}
        best, ratios = tops.get(1.0), sorted(tops)
        verdict = "not run yet"
        if best is not None:
            verdict = f"{'yes' if abs(best - printed) < 0.1 else 'no'}: the rectangle at {best:.2f} L"
        yield (
            f"trapezoids: the {gait} gait is fastest at L' ≈ {printed} L",
            verdict,
            "[fig. 5](../figures/gallery/fig5.png)",
        )
        yield (
            f"trapezoids: a wider leading edge makes the {gait} gait faster",
            _tapered(found, WAY[gait]) if len(ratios) > 2 else "not run yet: rectangles only",
            "[fig. 5](../figures/gallery/fig5.png)",
        )


def _tapered(found: Grid, way: int) -> str:
    """Whether the best speed changes in one direction with w1/w2; the edge that leads moves ahead."""
    whole = ~np.isnan(found.speed).any(0)
    best = (way * found.speed[:, whole]).max(0)
    falls = bool((np.diff(way * best) < 0).all())
    pairs = zip(found.x[whole], best, strict=True)
    ends = ", ".join(f"{number(way * v)} at w1/w2 = {x:g}" for x, v in pairs)
    return f"{'yes' if falls else 'no'}: {ends}"


def _grounds() -> Iterator[tuple[str, str, str]]:
    rows = [r for r in terrain.TABLE.read() if (r.gait, r.form) == ("forward", "cosine")]
    for law in ("dry", "viscous"):
        kept = {(r.nx, r.ny): r for r in rows if r.friction == law and not math.isnan(r.third)}
        found = {name: kept.get(place) for name, place in terrain.SHOWN.items()}
        if len(kept) < ENOUGH or not all(found.values()):
            continue
        shown = {name: kept[place] for name, place in terrain.SHOWN.items()}
        a = shown["A"]
        for letter, words, way in (("B", "least", -1), ("C", "largest", 1)):
            yield _extreme(law, words, way, shown[letter], list(kept.values()))
        d = shown["D"]
        near = abs(d.third - a.third) <= d.error + a.error
        yield (
            f"on fine ground (D) V is that of flat ground, {law}",
            f"{'agrees within the errors' if near else 'no'}: {number(d.third, d.error)}, "
            f"flat {number(a.third, a.error)}",
            "[fig. 6](../figures/gallery/fig6.png)",
        )
        forward = sum(r.third > 0 for r in kept.values())
        sure = sum(r.third > r.error for r in kept.values())
        yield (
            f"V is forward on all grounds, {law}",
            f"on {forward} of {len(kept)} (by more than its error on {sure})",
            "[fig. 6](../figures/gallery/fig6.png)",
        )


def by_steps(gait: str) -> dict[int, float]:
    """V of a gait under dry friction on flat ground by the number of steps a cycle, L a cycle.

    A sheet that buckles may take another way with other steps.
    """
    steps = {"none": decisive.STEPS, **decisive.OTHER_STEPS}
    rows = [r for r in decisive.TABLE.read() if (r.gait, r.friction) == (gait, "dry")]
    return {
        steps[r.change]: r.third
        for r in sorted(rows, key=lambda r: steps.get(r.change, 0))
        if r.change in steps
    }


def _extreme(law: str, words: str, way: int, at: Any, rows: Sequence[Any]) -> tuple[str, str, str]:
    """Whether a ground of the paper has the extreme V, or cannot be told from the one that has."""
    best = max(rows, key=lambda r: way * r.third)
    if best is at:
        rest = max((r for r in rows if r is not at), key=lambda r: way * r.third)
        clear = way * (at.third - rest.third) > at.error + rest.error
        verdict = "yes" if clear else "yes, but not beyond the errors"
    elif way * (best.third - at.third) <= best.error + at.error:
        verdict = "cannot be told within the errors"
    else:
        verdict = "no"
    place = f"({at.nx:g}, {at.ny:g})"
    found = f"{number(at.third, at.error)}; {words} at ({best.nx:g}, {best.ny:g})"
    return (
        f"V is {words} at (L/λx, L/λy) = {place}, {law}",
        f"{verdict}: {found}, {number(best.third, best.error)}, of {len(rows)} grounds",
        "[fig. 6](../figures/gallery/fig6.png)",
    )


def _assumptions(changed: dict[Any, Any]) -> Iterator[tuple[str, str, str]]:
    for words, change in (
        ("gravity does not matter for the deformation", "tenth of the weight"),
        ("the ground is rigid", "stiff ground"),
        ("(our mesh, 4 × 8, suffices)", "finer mesh"),
    ):
        told, same = [], True
        for gait in decisive.GAITS:
            old, new = (changed[gait, "viscous", name] for name in ("none", change))
            same &= abs(old.third - new.third) <= old.error + new.error
            told.append(f"{gait} {number(old.third, old.error)}, {number(new.third, new.error)}")
        depth = max(changed[gait, "viscous", "none"].depth for gait in decisive.GAITS)
        deep = f"; but points sink by up to {depth:.2f} L" if change == "stiff ground" else ""
        verdict = "yes for V, within the errors" if same else "no"
        yield words, f"{verdict}: with {change} {'; '.join(told)}{deep}", "figures/data/decisive.csv"
