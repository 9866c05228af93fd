"""What was measured, as it is printed."""

from collections.abc import Sequence

from figures.measure.cost import effects
from figures.measure.cost.effects import EffectRow
from figures.measure.cost.tables import Order, Point
from figures.measure.meters import import_seconds, peak_memory

MEMORY = "from linear_theory import *; crawl_speed(Sheet(), SineWave(), 0.25, rtol=1e-6)"
"""Whose peak memory is told: the most that linear theory is asked for here."""


def print_points(points: Sequence[Point]) -> None:
    """As a table."""
    print(
        f"\n{'panel':<16}{'level':<21}{'knob':<13}{'value':>9}{'error':>9}{'claimed':>9}"
        f"{'model':>9}{'ms':>11}{'least':>11}{'most':>11}"
    )
    for p in points:
        times = "".join(f"{1e3 * s:11.3f}" for s in (p.seconds, p.fastest, p.slowest))
        errors = "".join(f"{e:9.1e}" for e in (p.error, p.claimed, p.model_claimed))
        print(f"{p.panel:<16}{p.level:<21}{p.knob:<13}{p.value:>9g}{errors}{times}")


def print_orders(found: Sequence[Order]) -> None:
    """As a table."""
    print("\nerror ~ work^-order while it falls, then the plateau; time ~ work^exponent at the end;")
    print("error ~ time^-efficiency. Work is the knob's value, or its inverse for tolerances")
    print(
        f"{'panel':<16}{'level':<21}{'knob':<13}{'from':>8}{'to':>9}{'points':>7}{'order':>7}"
        f"{'plateau':>9}{'exponent':>9}{'efficiency':>11}"
    )
    for o in found:
        print(
            f"{o.panel:<16}{o.level:<21}{o.knob:<13}{o.first:>8g}{o.last:>9g}{o.points:>7}"
            f"{o.error_order:7.1f}{o.plateau:9.1e}{o.time_exponent:9.2f}{o.efficiency:11.1f}"
        )


def print_effects(rows: Sequence[EffectRow]) -> None:
    """As a table."""
    print(
        f"\nEffects: sheet of {effects.CELLS[0]} x {effects.CELLS[1]} elements; per step: "
        "iterations, gradients, Hessians, factors"
    )
    print(
        f"{'scene':<22}{'unknowns':>9}{'deriv.':>7}{'iter.':>7}{'grad.':>7}{'Hess.':>7}{'fact.':>7}"
        f"{'MB':>7}{'ms/grad.':>9}{'ms/Hess.':>9}{'ms/step':>9}{'ratio':>8}"
    )
    for r in rows:
        counts = "".join(f"{c:7.1f}" for c in (r.iterations, r.gradients, r.hessians, r.factors))
        times = "".join(
            f"{1e3 * s:9.3f}" for s in (r.gradient_seconds, r.hessian_seconds, r.step_seconds)
        )
        print(
            f"{r.scene:<22}{r.unknowns:>9}{r.derivative:>7}{counts}{r.memory_mb:7.2f}{times}"
            f"{r.ratio:8.2g}"
        )


def print_process() -> None:
    """Import time and peak memory, each in a process of its own."""
    seconds, memory = import_seconds("linear_theory"), peak_memory(MEMORY)
    print(f"\nimport linear_theory: {seconds:.2f} s; crawl_speed at rtol 1e-6 takes {memory:.0f} MB")
