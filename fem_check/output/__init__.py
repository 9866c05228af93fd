"""Pictures and films of results: implementation of `.plot()` and `.movie(path)`."""

import lazy_loader

from fem_check.answer.units import Units as Units

# What draws is imported when it is first used: writing a scene or a record starts without matplotlib.
# The names are listed for type checkers in `__init__.pyi`.
__getattr__, __dir__, _lazy = lazy_loader.attach(
    __name__, submod_attrs={"film.view": ["View"], "movies": ["movie"], "pictures": ["plot"]}
)
__all__ = ["Units", "View", "movie", "plot"]
