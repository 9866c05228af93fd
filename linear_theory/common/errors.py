"""What is raised when an answer is not to be had, and what is warned of.

    SheetcrawlError             base of all errors below: every failure of a solver
      NotConvergedError         a tolerance was not reached                         RuntimeError
      ConvergenceError          no static shape, or no next step, was found         RuntimeError
        UnstableError           a shape that only its coarse mesh has
        NotPeriodicError        shapes that do not repeat with the wave
      UnresolvedError           too few phases for shapes that change so fast       ArithmeticError
      SnapshotError             a snapshot from which a run cannot be continued     ValueError
      Unidentifiable            a function that a snapshot could not know again     ValueError
      SceneFileError            a file from which no scene can be made              ValueError

    ViscousRegimeWarning        dry friction that acts as viscous                   UserWarning
    BeyondReachWarning          growth too large for the theory                     UserWarning

ConvergenceError and UnstableError are defined in `fem_check.shell.statics.equilibrium`,
NotPeriodicError and UnresolvedError in `fem_check.shell.cycle`, SnapshotError in
`fem_check.shell.stepping.snapshot`, SceneFileError in `fem_check.files.mistakes`, all others here. Bad
arguments are a plain ValueError.
"""

from collections.abc import Callable
from typing import Any


class SheetcrawlError(Exception):
    """Base of the errors of this package: one that is raised in another process arrives as it was.

    Exceptions are pickled by the arguments that they were made with, which are the message alone here;
    what an error keeps beside it (`best`, `state`, `parameter`) goes with it as it is.

    >>> import pickle
    >>> from linear_theory import NotConvergedError, SheetcrawlError
    >>> arrived = pickle.loads(pickle.dumps(NotConvergedError("no more memory", best=3.0)))
    >>> print(arrived, arrived.best, isinstance(arrived, SheetcrawlError))
    no more memory 3.0 True
    """

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...], dict[str, Any]]:
        return _as_it_was, (type(self), self.args), self.__dict__


def _as_it_was(kind: type[SheetcrawlError], args: tuple[Any, ...]) -> SheetcrawlError:
    """An error of that class and message; what it keeps is put back by pickle."""
    error = kind.__new__(kind)
    error.args = args
    return error


class NotConvergedError(SheetcrawlError, RuntimeError):
    """A tolerance was not reached; `best` keeps the best result that was found, None if there is none.

    >>> from linear_theory import NotConvergedError, Sheet, SineWave, ritz_field
    >>> try:
    ...     field = ritz_field(Sheet(), SineWave(count=400), rtol=1e-6)
    ... except NotConvergedError as missed:
    ...     print(missed.best)  # not even the first degrees fit in memory
    None
    """

    def __init__(self, message: str, best: Any) -> None:
        super().__init__(message)
        self.best = best


class ViscousRegimeWarning(UserWarning):
    """A law that stands for dry friction acts as viscous: its slip speed is above all speeds.

    >>> import warnings
    >>> from linear_theory import SineWave, line_balance
    >>> with warnings.catch_warnings(record=True, action="always") as seen:
    ...     speed = line_balance(SineWave(), alpha=0.25, friction="tanh", slip_speed=1.0)
    >>> print(f"{seen[0].category.__name__}: friction is {speed.regime}, V = {speed.mean:.4f} L/T")
    ViscousRegimeWarning: friction is viscous, V = 0.0317 L/T
    """


class Unidentifiable(SheetcrawlError, ValueError):
    """A value without a content that could be known again, in another process or at another time."""


class BeyondReachWarning(UserWarning):
    """A growth so large that the theory of the answer says nothing of a sheet: see `reach`.

    >>> import warnings
    >>> from linear_theory import BeyondReachWarning, Sheet, SineWave, crawl_speed
    >>> with warnings.catch_warnings(category=BeyondReachWarning, action="ignore"):
    ...     speed = crawl_speed(Sheet(), SineWave(), alpha=12.0, order=2, rtol=1e-2)
    >>> print(f"V = {speed.mean:.0f} L/T, converged {speed.converged}: {speed.beyond_reach}")
    V = 221 L/T, converged False: growth |alpha c| reaches 12, the theory ends at 0.5
    """
