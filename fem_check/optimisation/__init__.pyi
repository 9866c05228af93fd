"""What `fem_check.optimisation` offers: read by `lazy_loader` as it runs, and by type checkers."""

from .objectives import CostOfTransport, Distance, Speed
from .optimising import optimise
from .over import Harmonics
from .result import Optimum

__all__ = ["CostOfTransport", "Distance", "Harmonics", "Optimum", "Speed", "optimise"]
