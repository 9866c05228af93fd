"""Uneven ground: height as a function, with or without derivatives, or as a sympy expression."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.shell.effects import formula
from fem_check.shell.effects.differences import Checked, checked_jets
from fem_check.shell.effects.height_sources import (
    ENTRIES,
    Plain,
    Source,
    Symbolic,
    is_expression,
    source,
)
from linear_theory.common import validation
from linear_theory.common.functions import callable_with
from linear_theory.common.shown import Value
from linear_theory.common.validation import shown
from linear_theory.scene.data import NotRestorable
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]

STEP = 1 / 4096
"""Step of the differences in lengths of the sheet. For waves of 1/50 of the sheet the relative error of
slopes is 1e-12, of second derivatives 1e-11; roundoff adds to slopes 1e-12 of the height over the
length of the sheet, and to second derivatives, used in Newton steps only, 1e-8 of the height over the
length squared."""

KINK = 1e-5
"""Largest error of a slope by differences for a height that counts as smooth."""

WRONG, SURE = 1e-4, 1e-6
"""Largest deviation of given derivatives from differences, and largest error of the differences for
which they are compared, relative to the largest derivative of that order."""

AROUND, CHECKED = 0.25, 4096
"""Number of points at which a terrain is checked, within the bounding box of the sheet and this
fraction of its length beyond; further away it is not checked. A line along which the slope jumps
crosses the difference stencils of about ten of them."""

SHARPEST, NEARER, ZOOMS = 64, 8, 6
"""Further rounds of checks, at NEARER points around each of the SHARPEST so far, which finds tips."""


@dataclass(frozen=True)
class Terrain(Value):
    """z = f(x, y), the ground under a sheet, in the coordinates of the sheet at rest.

    height: a function of arrays x, y (points,) that returns z, an array of their shape or one number;
    or one that returns the rows f, f_x, f_y, f_xx, f_yy, f_xy, (6, points); or a sympy expression in
    symbols named x and y; or a `HeightMap`. Derivatives of a function are differences with a step of
    STEP lengths of the sheet, those of an expression and of a map are exact; given ones are compared
    with differences.
    name: identifies a function in a snapshot where its code cannot, as in `FieldWave`.
    length: of the sheet, for the differences; supplied by a Scene.

    Raises ValueError for any other height, for an expression with other symbols or without
    derivatives, a length <= 0 and a name that is not text; and, when a Scene is constructed, for a
    height that fails on arrays or is not finite around the sheet, a function that is not smooth there,
    and wrong derivatives.

    >>> import sympy
    >>> from fem_check import Ground, Terrain
    >>> x, y = sympy.symbols("x y")
    >>> bumps = Terrain(0.01 * sympy.cos(6 * x) * sympy.cos(6 * y))
    >>> ground = Ground(stiffness=0.5, height=bumps)
    >>> print(ground.height(0.0, 0.0).ravel().round(3) + 0.0)  # f, f_x, f_y, f_xx, f_yy, f_xy
    [ 0.01  0.    0.   -0.36 -0.36  0.  ]
    """

    height: Any
    name: str | None = None
    length: float | None = None

    def __post_init__(self) -> None:
        if self.name is not None:
            validation.label("name", self.name)
        if self.length is not None:
            object.__setattr__(self, "length", validation.positive("length", self.length))
        if is_expression(self.height):
            _ = self._source
        elif not callable(self.height):
            raise ValueError(
                f"height = {shown(self.height)}: must be a function z = f(x, y), one that returns the "
                f"rows {', '.join(ENTRIES)}, or a sympy expression in x and y"
            )
        else:
            callable_with("height", self.height, "(x, y)", 2)

    def identified_by(self) -> object:
        """The content from which its key is computed; of symbols the names."""
        content = self.height
        if is_expression(content):
            content = content.xreplace({s: type(s)(s.name) for s in content.free_symbols})
        return content if self.name is None else self.name, self.length

    def _contents(self) -> Mapping[str, Any]:
        height = formula.text_of(self.height) if is_expression(self.height) else self.height
        return {"height": height, "name": self.name, "length": self.length}

    @classmethod
    def from_data(cls, height: object, name: str | None, length: float | None) -> "Terrain":
        """The terrain of what `to_dict` has written, of an expression: see `formula`.

        Raises NotRestorable, a ValueError, for a function.
        """
        if not isinstance(height, str):
            return cls(height, name, length)
        try:
            return cls(formula.parsed(height), name, length)
        except ValueError as problem:
            raise NotRestorable(
                f"a Terrain cannot be restored from data, its height = {shown(height)} {problem}"
            ) from None

    def under(self, sheet: Sheet) -> "Terrain":
        """The terrain with the length of a sheet, checked around it."""
        if self.__dict__.get("_checked") == sheet:
            return self
        terrain = replace(self, length=sheet.length)
        terrain._check(sheet)
        object.__setattr__(terrain, "_checked", sheet)
        return terrain

    def values(self, x: ArrayLike, y: ArrayLike) -> Array:
        """f at points, (points,)."""
        return self._source.values(*_points(x, y))

    def slopes(self, x: ArrayLike, y: ArrayLike) -> Array:
        """f_x, f_y at points, (2, points)."""
        return self._source.slopes(*_points(x, y))

    def __call__(self, x: ArrayLike, y: ArrayLike) -> Array:
        """f, f_x, f_y, f_xx, f_yy, f_xy at points, (6, points)."""
        return self._source.jets(*_points(x, y))

    @cached_property
    def _source(self) -> Source:
        if is_expression(self.height):
            return Symbolic(self.height)
        return source(self.height, None if self.length is None else STEP * self.length)

    def _check(self, sheet: Sheet) -> None:
        """Raise ValueError if the height cannot be used around a sheet."""
        x, y = self._places(sheet)
        found = self(x, y)
        _refuse(~np.isfinite(found).all(axis=0), x, y, "it is not finite")
        if getattr(
            self._source, "exact", False
        ):  # no differences needed, which take seconds of splines
            return
        reference = checked_jets(self.values, x, y, STEP * sheet.length)
        if isinstance(self._source, Plain):
            kinks = reference.error[1:3].max(axis=0) > KINK
            _refuse(kinks, x, y, "its slope jumps; smooth it, or give its derivatives in six rows")
        else:
            _compare(found, reference, x, y)

    def _places(self, sheet: Sheet) -> Array:
        """Check points (2, points): distributed over the box, and accumulating near tips."""
        rng = np.random.default_rng(0)
        half = np.array([[sheet.width], [sheet.length]]) / 2 + AROUND * sheet.length
        places = half * rng.uniform(-1, 1, (2, CHECKED))
        near, radius = places, half / np.sqrt(CHECKED)
        for _ in range(ZOOMS):
            sharpness = np.abs(self(*near)[3:]).max(axis=0)
            sharpest = near[:, np.argsort(sharpness)[-SHARPEST:]]
            around = np.repeat(sharpest, NEARER, axis=1)
            near = around + radius * rng.uniform(-1, 1, around.shape)
            near = np.hstack([sharpest, np.clip(near, -half, half)])
            places, radius = np.hstack([places, near]), radius / 3
        return places

    def __getstate__(self) -> dict[str, Any]:
        """The state without functions compiled from an expression, which cannot be pickled."""
        return {f.name: getattr(self, f.name) for f in fields(self)}


def _compare(found: Array, reference: Checked, x: Array, y: Array) -> None:
    """Raise ValueError for derivatives that deviate from differences where these are reliable."""
    for order in (slice(1, 3), slice(3, 6)):
        largest = np.abs(found[order]).max()
        for k in range(6)[order]:
            expected, error = reference.jets[k], reference.error[k]
            size = np.maximum(largest, np.abs(expected))
            bad = (error <= SURE * size) & (np.abs(found[k] - expected) > WRONG * size)
            at = int(bad.argmax())
            text = f"{ENTRIES[k]} is {found[k, at]:.6g}, must be {expected[at]:.6g} by differences of f"
            _refuse(bad, x, y, text)


def _points(x: ArrayLike, y: ArrayLike) -> tuple[Array, Array]:
    """Coordinates as arrays (points,)."""
    x, y = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
    return x.ravel(), y.ravel()


def _refuse(bad: Any, x: Array, y: Array, what: str) -> None:
    """Raise ValueError that names the first bad point; bad: (points,)."""
    if np.any(bad):
        k = int(np.argmax(bad))
        raise ValueError(f"height: at x = {x[k]:.4g}, y = {y[k]:.4g}, under or near the sheet, {what}")
