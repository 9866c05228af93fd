from fem_check.answer.units import Units as Units

from .film.view import View as View
from .movies import movie as movie
from .pictures import plot as plot

__all__ = ["Units", "View", "movie", "plot"]
