"""The best scene between bounds: what may change, what is to be large, and the certificate."""

# Read by lazy_loader as it runs, and by type checkers.

from .objectives import CostOfTransport, Distance, Speed
from .optimising import optimise
from .options.constraints import Bound
from .options.robust import Robust
from .over import Harmonics
from .result import Optimum

__all__ = [
    "Bound",
    "CostOfTransport",
    "Distance",
    "Harmonics",
    "Optimum",
    "Robust",
    "Speed",
    "optimise",
]
