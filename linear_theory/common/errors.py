"""Exceptions raised when no answer can be given, and warnings.

    SheetcrawlError             base of all errors below: every failure of a solver
      NotConvergedError         a tolerance was not reached                         RuntimeError
      ConvergenceError          no equilibrium, or no next time step, was found     RuntimeError
        UnstableError           an equilibrium that exists on a coarse mesh only
        NotPeriodicError        shapes that do not repeat with the wave
      CrossingsUnknown          whether a sheet passes through itself               RuntimeError
      UnresolvedError           too few phases for rapidly changing shapes          ArithmeticError
      SnapshotError             a snapshot from which a run cannot be continued     ValueError
      Unidentifiable            a value that cannot be identified by its content    ValueError
      SceneFileError            a file from which no scene can be made              ValueError
      NotRestorable             a part of a scene that plain data cannot hold       ValueError
      Refused, RefusedScenes    scenes of a sweep that cannot be                    ValueError
      StoreError                records of a sweep that cannot be written
      LostScheduler             a scheduler of workers that is gone
      WrongWorkers              workers that cannot answer
      Fault                     a friction law that contradicts itself             ValueError
      KeptError                 answers with which an optimisation cannot go on    ValueError
      NothingFound              an optimisation none of whose starts has an answer within its limits
      NoFilm                    scenes whose shapes are not known, or not alike
      NoOutline                 no outline between the bounds has an answer
      Unusable                  a point at which an objective has no value         ValueError
      NotWrittenError           an answer whose files cannot be written            OSError

    ViscousRegimeWarning        dry friction that acts as viscous                   UserWarning
    BeyondReachWarning          growth too large for the theory                     UserWarning

ConvergenceError and UnstableError are defined in `fem_check.shell.statics.equilibrium`,
CrossingsUnknown in `fem_check.shell.kinematics.crossing`,
NotPeriodicError and UnresolvedError in `fem_check.shell.cycle`, SnapshotError in
`fem_check.shell.stepping.snapshot`, SceneFileError in `fem_check.files.mistakes`, NotRestorable in
`linear_theory.scene.data`, Refused, RefusedScenes, StoreError, LostScheduler and WrongWorkers in
`fem_check.sweeps`, NotWrittenError in `fem_check.runs.errors`, KeptError, NothingFound and NoFilm in
`fem_check.optimisation`, NoOutline in `fem_check.outlines.best`, Unusable in
`linear_theory.optimisation.problem`, Fault in `linear_theory.friction.trial`, all others here. Bad
arguments are a plain ValueError.
"""

from collections.abc import Callable
from typing import Any


class SheetcrawlError(Exception):
    """Base class of the errors of this package; they survive pickling between processes unchanged.

    Exceptions are pickled by their constructor arguments, here the message alone; further attributes
    (`best`, `state`, `parameter`) are pickled with them.

    >>> import pickle
    >>> from linear_theory import NotConvergedError, SheetcrawlError
    >>> arrived = pickle.loads(pickle.dumps(NotConvergedError("out of memory", best=3.0)))
    >>> print(arrived, arrived.best, isinstance(arrived, SheetcrawlError))
    out of memory 3.0 True
    """

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...], dict[str, Any]]:
        return _as_it_was, (type(self), self.args), self.__dict__


def _as_it_was(kind: type[SheetcrawlError], args: tuple[Any, ...]) -> SheetcrawlError:
    """An error of that class and message; pickle restores its further attributes."""
    error = kind.__new__(kind)
    error.args = args
    return error


class NotConvergedError(SheetcrawlError, RuntimeError):
    """A tolerance was not reached; `best` holds the best result found, None if there is none.

    >>> from linear_theory import NotConvergedError, Sheet, SineWave, ritz_field
    >>> try:
    ...     field = ritz_field(Sheet(), SineWave(count=400), rtol=1e-6)
    ... except NotConvergedError as missed:
    ...     print(missed.best)  # even the lowest degrees need more memory than is available
    None
    """

    def __init__(self, message: str, best: Any) -> None:
        super().__init__(message)
        self.best = best


class ViscousRegimeWarning(UserWarning):
    """Regularised dry friction acts as viscous: its slip speed exceeds all sliding speeds.

    >>> import warnings
    >>> from linear_theory import SineWave, line_balance
    >>> with warnings.catch_warnings(record=True, action="always") as seen:
    ...     speed = line_balance(SineWave(), alpha=0.25, friction="tanh", slip_speed=1.0)
    >>> print(f"{seen[0].category.__name__}: friction is {speed.regime}, V = {speed.mean:.4f} L/T")
    ViscousRegimeWarning: friction is viscous, V = 0.0317 L/T
    """


class Unidentifiable(SheetcrawlError, ValueError):
    """A value that has no content by which it could be identified in another process or later."""


class BeyondReachWarning(UserWarning):
    """Growth so large that the theory is no longer valid, see `reach`.

    >>> import warnings
    >>> from linear_theory import BeyondReachWarning, Sheet, SineWave, crawl_speed
    >>> with warnings.catch_warnings(category=BeyondReachWarning, action="ignore"):
    ...     speed = crawl_speed(Sheet(), SineWave(), alpha=12.0, order=2, rtol=1e-2)
    >>> print(f"V = {speed.mean:.0f} L/T, converged {speed.converged}: {speed.beyond_reach}")
    V = 221 L/T, converged False: growth |alpha c| reaches 12, must be <= 0.5 in this theory
    """
