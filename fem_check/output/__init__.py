"""Pictures and films of results: what `.plot()` and `.movie(path)` do."""

from fem_check.answer.units import Units
from fem_check.output.movies import movie
from fem_check.output.pictures import plot

__all__ = ["Units", "movie", "plot"]
