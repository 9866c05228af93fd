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
        if values.size < FEWEST:
            raise ValueError(f"c has {values.size} samples: must have >= {FEWEST}; measure more")
        flat = {name: np.ascontiguousarray(value.ravel()) for name, value in known.items()}
        return cls(flat.get("x"), flat["y"], flat["t"], np.ascontiguousarray(values.ravel()))

    @property
    def size(self) -> int:
        """n."""
        return int(self.c.size)

    def some(self, most: int) -> "Samples":
        """At most so many of them, chosen at random, the same ones in every call."""
        if self.size <= most:
            return self
        return self.take(np.random.default_rng(most).permutation(self.size)[:most])

    def take(self, places: NDArray[np.intp] | slice) -> "Samples":
        """Those at these places of the arrays."""
        x = None if self.x is None else self.x[places]
        return Samples(x, self.y[places], self.t[places], self.c[places])


def _finite(name: str, value: Any) -> Array:
    try:
        return validation.real_array(name, value)
    except ValueError as error:
        if "must be finite" not in str(error):
            raise
        raise ValueError(
            f"{error}; leave such samples out and give the others as scattered ones, "
            "all coordinates as long as c"
        ) from None


def _shapes(known: dict[str, Array], values: Array) -> str:
    names, sizes = ", ".join(known), tuple(value.size for value in known.values())
    turned = "; transpose it" if values.shape == sizes[::-1] else ""
    return (
        f"c has shape {values.shape}: must be {sizes}, by {names}{turned}; or scattered samples, where "
        f"{names} and c have one shape"
    )
