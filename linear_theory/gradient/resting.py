"""Whether part of a sheet is at rest, so that dry friction balances a range of forces there."""

import numpy as np

from linear_theory.balance.course import Course
from linear_theory.gradient.adjoint import AdjointBalance

TIMES = 9
"""At which parts at rest are looked for."""

SLOWER = 2.0
"""Largest speed of a part at rest, over the error of the deformation, with which it ripples."""

SHARE = 0.05
"""Of the sheet, from which on a part counts: less is as slow as that about a stagnation point."""


def rests(course: Course) -> bool:
    """Whether at some time part of the sheet moves by no more than the deformation is in error."""
    crawl, motion, times = course.crawl, course.motion, course.grid.times
    some = np.unique(np.linspace(0, times.size - 1, TIMES).astype(int))
    q = motion.leading[some] + crawl.alpha * motion.remainder[some]
    slower = SLOWER * crawl.field.error
    return bool(crawl.balance_of(AdjointBalance, times[some]).resting(q, slower).max() > SHARE)
