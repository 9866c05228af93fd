"""Samples of a wave: on a grid of places and times, or scattered."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Shown

Array = NDArray[np.float64]

NAMES = ("x", "y", "t")
"""Coordinates, in the order of the axes of c."""

FEWEST = 16
"""Samples."""

LARGEST = 1e100
"""Of all numbers: squares of larger ones, and inverse squares, leave the range of computers."""


@dataclass(frozen=True, eq=False)
class Samples(Shown):
    """c at points and times, (n,) each; x is None where c does not depend on it."""

    x: Array | None
    y: Array
    t: Array
    c: Array

    @classmethod
    def of(cls, coordinates: Mapping[str, Any], c: Any) -> "Samples":
        """From c on the grid of its coordinates, or scattered where all have the shape of c.

        coordinates: y and t, or x, y and t. Raises ValueError, with what to do, for other shapes and
        for values that are not finite.
        """
        known = {name: _finite(name, value) for name, value in coordinates.items()}
        values = _finite("c", c)
        sizes = tuple(value.size for value in known.values())
        vectors = all(value.ndim == 1 for value in known.values())
        if vectors and values.ndim == len(known) and values.shape == sizes:
            spread = np.meshgrid(*known.values(), indexing="ij")
            known = dict(zip(known, spread, strict=True))
        elif any(value.shape != values.shape for value in known.values()):
            raise ValueError(_shapes(known, values))
        flat = _without_copies([value.ravel() for value in (*known.values(), values)])
        if flat[0].size < FEWEST:
            copies = ", without copies" if flat[0].size < values.size else ""
            raise ValueError(
                f"c has {flat[0].size} samples{copies}: must have >= {FEWEST}; measure more"
            )
        return cls(flat[0] if "x" in known else None, *flat[-3:])

    @property
    def size(self) -> int:
        """n."""
        return int(self.c.size)

    def some(self, most: int) -> "Samples":
        """At most so many of them, chosen at random, the same ones in every call."""
        if self.size <= most:
            return self
        return self.take(self.choice(most))

    def choice(self, most: int) -> NDArray[np.intp]:
        """Places of so many of them."""
        return np.random.default_rng(most).permutation(self.size)[:most]

    def take(self, places: NDArray[np.intp] | slice) -> "Samples":
        """Those at these places of the arrays."""
        x = None if self.x is None else self.x[places]
        return Samples(x, self.y[places], self.t[places], self.c[places])


def _without_copies(columns: list[Array]) -> list[Array]:
    order = np.lexsort(columns)
    if not order.size:
        return columns
    new = np.any([np.diff(column[order]) != 0 for column in columns], axis=0)
    kept = np.sort(order[np.concatenate([[True], new])])
    return [np.ascontiguousarray(column[kept]) for column in columns]


def _finite(name: str, value: Any) -> Array:
    try:
        found = validation.real_array(name, value)
    except ValueError as error:
        if "must be finite" not in str(error):
            raise
        raise ValueError(
            f"{error}; leave such samples out and give the others as scattered ones, "
            "all coordinates as long as c"
        ) from None
    largest = float(abs(found).max(initial=0.0))
    if largest > LARGEST or 0 < largest < 1 / LARGEST:
        raise ValueError(
            f"{name} reaches {largest:.3g}: must be between {1 / LARGEST:g} and {LARGEST:g}, or 0; "
            "take another unit"
        )
    return found


def _shapes(known: dict[str, Array], values: Array) -> str:
    names, sizes = ", ".join(known), tuple(value.size for value in known.values())
    turned = "; transpose it" if values.shape == sizes[::-1] else ""
    return (
        f"c has shape {values.shape}: must be {sizes}, by {names}{turned}; or scattered samples, where "
        f"{names} and c have one shape"
    )
