"""Waves that are not known exactly: how far the true one may be from the one that is given."""

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

from linear_theory.wave.protocol import Wave


@runtime_checkable
class Uncertainty(Protocol):
    """What a wave with the attribute `uncertainty` says of its own error.

    Speeds count that error: see `linear_theory.speed.wave_error`. A wave whose `uncertainty` is None,
    or that has none, is exact. Its `words`, where it has some, say what the error is. A wave whose
    `doubt` says something has an error that is not known.
    """

    @property
    def share(self) -> float:
        """Root mean square of the error of c, as a share of that of c."""

    def waves(self, count: int, scale: float = 1.0) -> Sequence[Wave]:
        """Waves that could as well be the true one, `count` at most, the same ones in every call.

        scale: factor of their distance from the given wave.
        """


def uncertainty_of(wave: Wave) -> Uncertainty | None:
    """What the wave says of its own error; None where it is exact."""
    return getattr(wave, "uncertainty", None)


def error_words(wave: Wave) -> str:
    """What the error of an uncertain wave is, in a few words: the `words` of its `uncertainty`."""
    return str(getattr(uncertainty_of(wave), "words", "error of the wave"))


def doubt_of(wave: Wave) -> str:
    """Why speeds of the wave are not converged, whatever their error; empty for most waves."""
    return str(getattr(wave, "doubt", ""))
