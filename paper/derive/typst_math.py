"""sympy expressions as Typst mathematics: as much of it as the appendix of the write-up needs."""

import sympy as sp
from sympy.printing.printer import Printer

NAMES = {"alpha", "nu", "mu", "phi", "theta", "lambda", "gamma", "delta", "epsilon"}
"""Greek letters, which Typst knows by the same names; other names longer than a letter are quoted."""

FUNCTIONS = {"sin", "cos", "tan", "sinh", "cosh", "tanh", "coth", "exp", "log"}


class TypstPrinter(Printer):
    """Prints sums, products, powers, elementary functions and symbols; anything else is refused."""

    printmethod = "_typst"

    def emptyPrinter(self, expression: object) -> str:
        """Raise TypeError: a formula that is not understood must not be printed in some way."""
        raise TypeError(f"{expression!r} of type {type(expression).__name__}: cannot be printed")

    def _print_Symbol(self, symbol: sp.Symbol) -> str:
        head, *subscripts = str(symbol.name).split("_")
        parts = [_name(part) for part in (head, *subscripts)]
        return parts[0] if len(parts) == 1 else f"{parts[0]}_({' '.join(parts[1:])})"

    def _print_Integer(self, number: sp.Integer) -> str:
        return str(number)

    def _print_Rational(self, number: sp.Rational) -> str:
        sign = "-" if number < 0 else ""
        return f"{sign}frac({abs(number.p)}, {number.q})"

    def _print_Pi(self, _: object) -> str:
        return "pi"

    def _print_Exp1(self, _: object) -> str:
        return "e"

    def _print_Add(self, total: sp.Add) -> str:
        text = ""
        for term in total.as_ordered_terms(order="rev-lex"):
            piece = self._print(term)
            sign, piece = ("-", piece[1:]) if piece.startswith("-") else ("+", piece)
            text += f" {sign} {piece}"
        return text.removeprefix(" + ").removeprefix(" ").replace("- ", "-", text.startswith(" - "))

    def _print_Mul(self, product: sp.Mul) -> str:
        coefficient, rest = product.as_coeff_Mul()
        sign = "-" if coefficient.is_negative else ""
        above, below = sp.fraction(abs(coefficient) * rest)
        if below == 1:
            return sign + self._factors(above)
        return f"{sign}frac({self._factors(above)}, {self._factors(below)})"

    def _print_Pow(self, power: sp.Pow) -> str:
        base, exponent = power.as_base_exp()
        if exponent == sp.Rational(1, 2):
            return f"sqrt({self._print(base)})"
        if exponent.is_negative and exponent.is_number:
            return f"frac(1, {self._print(base**-exponent)})"
        raised = self._print(exponent)
        if isinstance(base, sp.Function):
            head, arguments = self._print(base).split("(", 1)
            return f"{head}^({raised})({arguments}"
        return f"{self._bracketed(base)}^({raised})"

    def _print_Abs(self, value: sp.Abs) -> str:
        return f"abs({self._print(value.args[0])})"

    def _print_Function(self, call: sp.Function) -> str:
        name = type(call).__name__
        if name not in FUNCTIONS:
            return self.emptyPrinter(call)
        arguments = ", ".join(self._print(a) for a in call.args)
        return f"{name}({arguments})"

    def _print_ExpBase(self, power: sp.exp) -> str:
        return f"e^({self._print(power.args[0])})"

    def _factors(self, product: sp.Expr) -> str:
        factors = sorted(product.as_ordered_factors(), key=_place)
        if len(factors) == 1:
            return str(self._print(factors[0]))
        return " ".join(self._bracketed(factor) for factor in factors)

    def _bracketed(self, factor: sp.Expr) -> str:
        text = self._print(factor)
        return f"({text})" if isinstance(factor, sp.Add) or text.startswith("-") else str(text)


def _place(factor: sp.Expr) -> tuple[int, str]:
    """Numbers first, then symbols, small letters before capitals, then all else as sympy has it."""
    if factor.is_number:
        return 0, ""
    base, _ = factor.as_base_exp()
    return (1, base.name.swapcase()) if base.is_Symbol else (2, "")


def _name(part: str) -> str:
    return part if len(part) == 1 or part in NAMES or part.isdigit() else f'"{part}"'


def typst(expression: sp.Expr | int) -> str:
    """The expression as Typst mathematics. Raises TypeError for what the printer does not know."""
    return str(TypstPrinter().doprint(sp.sympify(expression)))
