"""What a wave is asked for and its samples must have."""

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.wave.measured.samples import Samples

Array = NDArray[np.float64]

LARGEST_GAP = 0.3
"""Of a period without a sample."""


def numbers_asked(
    harmonics: int | None, degree: int | tuple[int, int] | None, across: bool
) -> tuple[int | None, int | None, int | None]:
    """What is asked for: harmonics, degree across (0 for waves c(y, t)) and along."""
    if harmonics is not None:
        harmonics = validation.integer("harmonics", harmonics, 1)
    if degree is None:
        return harmonics, None if across else 0, None
    pair = tuple(degree) if isinstance(degree, tuple | list) else (None if across else 0, degree)
    if len(pair) != 2:
        raise ValueError(f"degree = {validation.shown(degree)}: must be one integer or (across, along)")
    checked = [None if d is None else validation.integer("degree", d, 0) for d in pair]
    if checked[0] and not across:
        raise ValueError(f"degree = {degree}: must be one integer for samples without x")
    return harmonics, checked[0], checked[1]


def check_covered(data: Samples, period: float) -> None:
    """Raise ValueError where samples are missing in a part of the period, or places."""
    phases = np.unique(np.mod(data.t / period, 1.0))
    gap = float(np.diff(np.append(phases, phases[0] + 1)).max())
    if gap > LARGEST_GAP:
        raise ValueError(
            f"t: samples leave {100 * gap:.0f} % of a period of {period:g} without any, must be at "
            f"most {100 * LARGEST_GAP:.0f} %; measure a whole period, or correct `period`"
        )
    for name, values in (("x", data.x), ("y", data.y)):
        if values is not None and np.unique(values).size < 3:
            raise ValueError(
                f"{name} has {np.unique(values).size} different values: must have >= 3"
                + ("; leave x out of a wave c(y, t)" if name == "x" else "; measure at more places")
            )


def margin(places: Array | None) -> float:
    """How far beyond its samples c is known: half of the widest gap between neighbours."""
    if places is None:
        return 0.0
    known = np.unique(places)
    return float((0.5 + 1e-9) * np.diff(known).max())
