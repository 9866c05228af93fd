"""Heights as formulas: text to a sympy expression in x and y and back, without running what it says.

Only names, numbers, + - * / **, brackets and a few functions are understood. The text is taken apart by
Python's parser and put together again as sympy's objects; nothing of it is evaluated as a program.
"""

import ast
import math
from collections.abc import Callable
from typing import Any

LONGEST = 2000
"""Characters of a formula, at the most."""

HIGHEST, MOST_BITS = 64, 1024
"""Power of a number or a symbol, and size of a number that it makes, at the most: 9**9**9 has more
digits than there is memory."""

SYMBOLS = ("x", "y")
FUNCTIONS = ("sin", "cos", "exp", "sqrt", "tanh")
KNOWN = f"x, y, pi, numbers, + - * / ** ( ) and {', '.join(FUNCTIONS)}"

OPERATIONS: dict[type, Callable[[Any, Any], Any]] = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
}


def parsed(text: str) -> Any:
    """The sympy expression of a formula in x and y. Raises ValueError for anything but KNOWN.

    >>> from fem_check.shell.effects.formula import parsed
    >>> print(parsed("0.5*cos(2*pi*y/10) + x**2"))
    x**2 + 0.5*cos(pi*y/5)
    """
    import sympy

    if len(text) > LONGEST:
        raise ValueError(f"has {len(text)} characters, must have {LONGEST} at most")
    try:
        # Python below 3.11.4 has another error for a null byte
        tree = ast.parse(text.strip().replace("\0", "?"), mode="eval")
        found = _made(tree.body)
    except (SyntaxError, RecursionError, MemoryError):
        raise ValueError(f"is not a formula, must be made of {KNOWN}") from None
    if found.has(sympy.zoo, sympy.nan, sympy.oo, sympy.I) or not found.is_commutative:
        raise ValueError(f"is {found}, must be a real height")
    return found


def _made(node: ast.AST) -> Any:
    """The expression of a part of the formula."""
    import sympy

    if isinstance(node, ast.Constant) and isinstance(node.value, int | float):
        return _number(node.value)
    if isinstance(node, ast.Name) and node.id in SYMBOLS:
        return sympy.Symbol(node.id)
    if isinstance(node, ast.Name) and node.id == "pi":
        return sympy.pi
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.UAdd | ast.USub):
        value = _made(node.operand)
        return -value if isinstance(node.op, ast.USub) else value
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Pow):
        return _power(_made(node.left), _made(node.right))
    if isinstance(node, ast.BinOp) and type(node.op) in OPERATIONS:
        return OPERATIONS[type(node.op)](_made(node.left), _made(node.right))
    if _is_call(node):
        return getattr(sympy, node.func.id)(_made(node.args[0]))  # type: ignore[attr-defined]
    word = ast.unparse(node) if isinstance(node, ast.expr) else type(node).__name__
    raise ValueError(f"{word[:60]!r} is not understood, must be made of {KNOWN}")


def _is_call(node: ast.AST) -> bool:
    """Whether it is one of FUNCTIONS of one argument."""
    if not isinstance(node, ast.Call) or node.keywords or len(node.args) != 1:
        return False
    return isinstance(node.func, ast.Name) and node.func.id in FUNCTIONS


def _number(value: int | float) -> Any:
    import sympy

    if isinstance(value, bool):
        raise ValueError(f"{value!r} is not understood, must be made of {KNOWN}")
    if not math.isfinite(value) or abs(value) > 1e30:
        raise ValueError(f"{value:g} is too large for a height")
    return sympy.Integer(value) if isinstance(value, int) else sympy.Float(value)


def _power(base: Any, exponent: Any) -> Any:
    """base**exponent, where it cannot grow out of all bounds as it is made."""
    if not exponent.is_real or not exponent.is_number or abs(exponent) > HIGHEST:
        raise ValueError(f"the power {_short(exponent)} must be a number from -{HIGHEST} to {HIGHEST}")
    if base.is_Rational and max(abs(base.p), base.q).bit_length() * abs(exponent) > MOST_BITS:
        raise ValueError(f"{_short(base)}**{exponent} is too large for a height")
    return base**exponent


def _short(expression: Any) -> str:
    """For a message."""
    text = str(expression)
    return text if len(text) <= 40 else f"{text[:37]}..."


def text_of(expression: Any) -> str:
    """The formula from which `parsed` makes that expression; it may fail on what has no such text."""
    from sympy.printing.str import StrPrinter

    class Printer(StrPrinter):  # type: ignore[misc]
        """Numbers with all their digits."""

        def _print_Float(self, value: Any) -> str:
            return repr(float(value))

        def _print_Exp1(self, value: Any) -> str:
            return "exp(1)"

    return str(Printer().doprint(expression))
