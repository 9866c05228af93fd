"""Pictures and films of results: what `.plot()` and `.movie(path)` do."""

from fem_check.output.movies import movie
from fem_check.output.pictures import plot
from fem_check.output.units import Units

__all__ = ["Units", "movie", "plot"]
