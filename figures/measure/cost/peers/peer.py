"""Other finite element codes on the displacement of the paper's sheet, where they are installed.

Not needed for anything else: `pip install .[peers]`. Each peer is a module with a function `peers()`
that solves, with quadratic or quartic elements on a uniform grid,

    int sigma(eps(u) - c I) : eps(v) dx dy = 0,     plane stress, Young's modulus 1,

for the two parts of the wave: c = sin(2 pi y/L) cos(2 pi t/T) - cos(2 pi y/L) sin(2 pi t/T).
"""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]

MODULES = {"ngsolve": "figures.measure.cost.peers.ngsolve", "sfepy": "figures.measure.cost.peers.sfepy"}
"""Of this package, by the package that each needs."""

PARTS = ((1.0, 0.0), (0.0, -1.0))
"""Factors of sin(2 pi y/L) and cos(2 pi y/L) that go with cos(2 pi t/T) and with sin(2 pi t/T)."""


@dataclass(frozen=True)
class Peer:
    """A code that solves for given growths.

    name: with its element; cells: elements along the sheet, half as many across. solve(sheet, parts, n)
    returns anything, of which displacements(solution, x, y) gives (parts, 2, *x.shape), free of strain
    up to a rigid motion.
    """

    name: str
    cells: tuple[int, ...]
    solve: Callable[[Sheet, tuple[tuple[float, float], ...], int], Any]
    displacements: Callable[[Any, Array, Array], Array]


def installed() -> list[Peer]:
    """The peers that are there; one printed line for those that are not."""
    there = [name for name in MODULES if find_spec(name) is not None]
    missing = sorted(set(MODULES) - set(there))
    if missing:
        print(f"peers not installed, left out: {', '.join(missing)}")
    return [peer for name in there for peer in import_module(MODULES[name]).peers()]
