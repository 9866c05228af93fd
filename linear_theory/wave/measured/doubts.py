"""Why a fitted wave is not to be trusted, whatever its error, and what else a reader should know."""

from collections.abc import Iterator

import numpy as np

from linear_theory.wave.measured.fit import Fit
from linear_theory.wave.measured.misfit import EXACT, MOST_OF, Misfit
from linear_theory.wave.measured.samples import Samples

LARGEST_MISSED = 0.2
"""Of what varies in time."""

LARGEST_SHARE = 0.1
"""Of a fit that is the noise of its samples, where it leaves most of them."""

LARGEST_ALIASED = 0.1
"""Of what varies in time, in harmonics that are sampled less than twice in their period."""

USUAL = 10.0
"""c beyond which it may be in per cent."""


def doubts(samples: Samples, fit: Fit, misfit: Misfit) -> Iterator[str]:
    """Reasons for which no speed of the wave is converged."""
    varying = misfit.varying > EXACT * np.sqrt(np.mean(samples.c**2))
    if varying and not fit.basis.harmonics:
        yield "no harmonic in time stands out of the noise of the samples"
    elif varying and misfit.missed > LARGEST_MISSED * misfit.varying:
        share = 100 * min(misfit.missed / misfit.varying, 1.0)
        yield (
            f"the fit may miss {share:.0f} % of what varies in time, which it does not resolve; "
            "measure at more places and times, or ask for more functions"
        )
    elif varying and misfit.dropped > MOST_OF and _noise_share(samples, fit) > LARGEST_SHARE:
        yield f"the fit leaves {100 * misfit.dropped:.0f} % of the variance in time; measure more"
    if _aliased(samples, fit) > LARGEST_ALIASED:
        yield f"{_rests_on_period(samples, fit)}, and these hold much of the wave"


def remarks(samples: Samples, fit: Fit, copies: int) -> Iterator[str]:
    """What does not make the wave doubtful."""
    if copies:
        yield f"{copies} samples are copies of others and do not count"
    if (largest := float(abs(samples.c).max())) > USUAL:
        yield f"c reaches {largest:.4g}: is it in per cent? Growth is alpha c"
    aliased = _aliased(samples, fit) > LARGEST_ALIASED  # which is a doubt
    if fit.basis.harmonics > _followed(samples, fit) and not aliased:
        yield _rests_on_period(samples, fit)


def _noise_share(samples: Samples, fit: Fit) -> float:
    size = float(np.sqrt(np.mean(fit.values(samples) ** 2)))
    return float(fit.noise * np.sqrt(fit.basis.size / samples.size) / size) if size else 1.0


def _interval(samples: Samples) -> float:
    """Between times of samples, as a rule."""
    return float(np.median(np.diff(np.unique(samples.t))))


def _followed(samples: Samples, fit: Fit) -> int:
    """The highest harmonic with two samples or more in its period, one after the other."""
    return int(fit.basis.period / (2 * _interval(samples)) + 1e-6)


def _aliased(samples: Samples, fit: Fit) -> float:
    """Share of what varies in time in harmonics that are not followed, of root mean squares."""
    squares = np.sum(fit.coefficients[1:] ** 2, axis=(1, 2))
    total = float(squares.sum())
    return float(np.sqrt(squares[2 * _followed(samples, fit) :].sum() / total)) if total else 0.0


def _rests_on_period(samples: Samples, fit: Fit) -> str:
    followed = _followed(samples, fit)
    which = f"above harmonic {followed}" if followed else "of the wave"
    return (
        f"samples are {_interval(samples):.4g} apart in time, less than two in a period {which}: such "
        "harmonics are known only if the wave repeats exactly after its period"
    )
