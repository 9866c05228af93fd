"""Pictures and films of results: implementation of `.plot()` and `.movie(path)`."""

from fem_check.answer.units import Units
from fem_check.output.film.view import View
from fem_check.output.movies import movie
from fem_check.output.pictures import plot

__all__ = ["Units", "View", "movie", "plot"]
