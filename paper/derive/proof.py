"""Formulas that are printed only after their proof."""

from dataclasses import dataclass

import sympy as sp

from paper.derive.typst_math import typst
from tests.theory.derivations import sheet as on_sheet


class ProofError(ArithmeticError):
    """A stated formula is not what is derived."""


@dataclass(frozen=True)
class Step:
    """rows: of the list of corrections; text: Typst markup; formulas: Typst mathematics, one "
    "a line."""

    rows: str
    text: str
    formulas: tuple[str, ...]


def prove(name: str, derived: sp.Expr, stated: sp.Expr | int) -> None:
    """Raise ProofError, with the name, unless derived - stated vanishes."""
    difference = sp.sympify(derived - stated)
    for simplified in (sp.simplify, lambda z: sp.simplify(sp.expand_trig(z))):
        if simplified(difference) == 0:
            return
    if not on_sheet.vanishes(difference):
        raise ProofError(f"{name}: stated is {stated}, derived is {derived}")


def proved(left: str, derived: sp.Expr, stated: sp.Expr | int) -> str:
    """The formula `left` = stated, after its proof."""
    prove(left, derived, stated)
    return f"{left} = {typst(stated)}"
