"""Model error of the second order in (alpha, beta)."""

from dataclasses import dataclass
from pathlib import Path

PATH = Path(__file__).parents[1] / "data" / "plate_error.csv"
COMMAND = "python -m figures.measure.plate.model_error"


@dataclass(frozen=True)
class Row:
    """One scene."""

    number: int
    width: float
    poisson: float
    thickness: float
    weight: float
    stiffness: float
    law: str
    alpha: float
    share: float
    planar: float
    mixed: float
    bent: float
    theory: float
    cycle: float
    error: float
    seconds: float
