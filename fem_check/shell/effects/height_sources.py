"""Sources of the derivatives of the ground's height: differences, given functions, sympy."""

import sys
from collections.abc import Callable
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects import differences
from linear_theory.common.validation import shown

Array = NDArray[np.float64]
Function = Callable[[Array, Array], Any]

ENTRIES = ("f", "f_x", "f_y", "f_xx", "f_yy", "f_xy")
"""Rows of the jets of a height."""

_PROBES = 7
"""Number of points for a trial call of a function, different from 1 and from the number of ENTRIES."""


@runtime_checkable
class Source(Protocol):
    """A height; x, y and its values are (points,). An object that is one is used as it is."""

    def values(self, x: Array, y: Array) -> Array:
        """f, (points,)."""

    def slopes(self, x: Array, y: Array) -> Array:
        """f_x, f_y, (2, points)."""

    def jets(self, x: Array, y: Array) -> Array:
        """ENTRIES, (6, points)."""


class Plain:
    """A function z = f(x, y), with derivatives by differences."""

    def __init__(self, function: Function, step: float | None) -> None:
        self._function, self._step = function, step

    def values(self, x: Array, y: Array) -> Array:
        """See Source."""
        return np.array(np.broadcast_to(self._function(x, y), x.shape), float)

    def slopes(self, x: Array, y: Array) -> Array:
        """See Source."""
        return differences.slopes(self.values, x, y, self._length())

    def jets(self, x: Array, y: Array) -> Array:
        """See Source."""
        return differences.jets(self.values, x, y, self._length())

    def _length(self) -> float:
        if self._step is None:
            raise ValueError(
                "height: differences of a function need the length of the sheet, from a Scene or from "
                "Terrain(height, length=...)"
            )
        return self._step


class Given:
    """A function that returns all six rows."""

    def __init__(self, function: Function) -> None:
        self._function = function

    def values(self, x: Array, y: Array) -> Array:
        """See Source."""
        return self.jets(x, y)[0]

    def slopes(self, x: Array, y: Array) -> Array:
        """See Source."""
        return self.jets(x, y)[1:3]

    def jets(self, x: Array, y: Array) -> Array:
        """See Source."""
        return np.array(np.broadcast_to(self._function(x, y), (len(ENTRIES), x.size)), float)


class Symbolic:
    """A sympy expression in symbols named x and y, with its derivatives as functions."""

    def __init__(self, expression: Any) -> None:
        self._rows = [_compiled(row) for row in _derivatives(expression)]

    def values(self, x: Array, y: Array) -> Array:
        """See Source."""
        return self._evaluated(slice(0, 1), x, y)[0]

    def slopes(self, x: Array, y: Array) -> Array:
        """See Source."""
        return self._evaluated(slice(1, 3), x, y)

    def jets(self, x: Array, y: Array) -> Array:
        """See Source."""
        return self._evaluated(slice(0, 6), x, y)

    def _evaluated(self, rows: slice, x: Array, y: Array) -> Array:
        found = [np.broadcast_to(np.asarray(row(x, y), float), x.shape) for row in self._rows[rows]]
        return np.stack(found)


def is_expression(value: object) -> bool:
    """Whether a value is a sympy expression, without importing sympy, which is slow."""
    sympy = sys.modules.get("sympy")
    return sympy is not None and isinstance(value, sympy.Basic)


def source(function: Any, step: float | None) -> Source:
    """The source for a function, by the shape that it returns. Raises ValueError for other shapes."""
    if isinstance(function, Source):
        return function
    origin = np.zeros(_PROBES)
    try:
        with np.errstate(all="ignore"):
            found = np.asarray(function(origin, origin))
    except Exception as error:  # a user's function may raise anything, and is told why it is refused
        raise ValueError(
            f"height = {shown(function)}: must take arrays x, y of one shape (np.sin and np.where, not "
            f"math.sin and if), and failed on them: {error}"
        ) from error
    if found.dtype.kind not in "iuf":
        raise ValueError(f"height(x, y) has dtype {found.dtype}: must be real numbers")
    if found.ndim == 2 and found.shape in ((len(ENTRIES), _PROBES), (len(ENTRIES), 1)):
        return Given(function)
    if found.shape in ((_PROBES,), (1,), ()):
        return Plain(function, step)
    raise ValueError(
        f"height(x, y) has shape {found.shape} at {_PROBES} points: must be ({_PROBES},), z, or "
        f"({len(ENTRIES)}, {_PROBES}), the rows {', '.join(ENTRIES)}"
    )


def _derivatives(expression: Any) -> tuple[Any, ...]:
    """The six rows, in real symbols x and y. Raises ValueError for other symbols or no derivatives."""
    import sympy

    if not isinstance(expression, sympy.Expr):
        raise ValueError(f"height = {expression}: must be an expression with a value, z = f(x, y)")
    x, y = sympy.symbols("x y", real=True)
    others = sorted(s.name for s in expression.free_symbols if s.name not in ("x", "y"))
    if others:
        raise ValueError(f"height = {expression}: must have no symbols but x and y, has {others}")
    f = expression.subs({s: {"x": x, "y": y}[s.name] for s in expression.free_symbols})
    rows = (f, f.diff(x), f.diff(y), f.diff(x, 2), f.diff(y, 2), f.diff(x, y))
    for name, row in zip(ENTRIES, rows, strict=True):
        if row.has(sympy.DiracDelta, sympy.Derivative, sympy.zoo, sympy.nan):
            raise ValueError(f"height = {expression}: must be smooth, but {name} = {row}")
    return rows


def _compiled(row: Any) -> Function:
    import sympy

    x, y = sympy.symbols("x y", real=True)
    function: Function = sympy.lambdify((x, y), row, "numpy")
    return function
