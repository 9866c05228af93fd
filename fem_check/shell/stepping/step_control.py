"""The size of the next step: given, or controlled by the error of the velocity."""

import math
from dataclasses import dataclass, field

import numpy as np

from linear_theory.wave.protocol import PER_HARMONIC
from linear_theory.wave.spectrum import Spectrum

GROWTH = 1.6
"""Largest ratio of neighbouring steps; the two-step rule is stable up to 1 + sqrt 2."""

JUMP = 0.5
"""Error of the velocity relative to it, beyond which a step of given length does not resolve it."""

LANDED = 1e-9
"""Fraction of the period below which two times count as equal."""

SAFETY = 0.9

DEADBAND = 1.15
"""Smallest increase of a step; steps are otherwise left unchanged, so that the factor can be reused."""

SHORTEST = 32
"""Fraction of the step for a sine wave below which steps are not shortened for their error: a sheet
that snaps through jumps however short they are, and shorter steps make damping stiff."""

HEAVY_SHORTEST = 512
"""The same for a sheet with inertia."""

SHORT_HARMONIC = 8
"""Highest harmonic of the wave resolved by such short steps."""

FEWEST, GIVEN_SHARE = 4, 0.1
"""Smallest number of steps per period of a harmonic, if their number is given, and the fraction of the
growth rate that may lie in higher harmonics."""

SINE = Spectrum(np.ones(1), 0.0)
"""Spectrum of a wave that is a sine in time."""


@dataclass
class StepSize:
    """Length of the next step: given, or chosen so that the velocity error meets `rtol`.

    dt: next step, in (smallest, largest]. rtol: error of the velocity relative to the largest velocity
    so far (`scale`), both as root mean square over the sheet; None: the step is given and only
    shortened if a minimisation fails. resolved: whether the last accepted step resolves the motion: its
    error meets rtol (JUMP, if the step is given). Velocities of jumps do not count for the scale.
    natural: the step for a sine; in shorter ones, where the motion is rough, larger errors are allowed,
    since their share of the way is small. repeated: whether the step is one that was shortened; the
    next one is then not longer.
    """

    dt: float
    smallest: float
    largest: float
    rtol: float | None = None
    scale: float = 0.0
    natural: float = 0.0
    resolved: bool = field(default=True, init=False)
    repeated: bool = field(default=False, init=False)

    def within(self, remaining: float) -> float:
        """The next step, adjusted so that equal steps fill the remaining time."""
        count = int(np.ceil(remaining / self.dt * (1 - 1e-9)))
        return remaining / max(count, 1)

    def judge(self, dt: float, error: float, speed: float, forced: bool = False) -> bool:
        """Whether a step of length dt is accepted; sets the next step (or attempt).

        forced: accepted whatever its error, as in a snap-through; the next one is as long.
        """
        scale = self.scale if forced else self._raised(dt, error, speed)
        limit = JUMP if self.rtol is None else self.rtol * max(1.0, np.sqrt(self.natural / dt))
        share = error / (limit * scale) if scale > 0 else 0.0
        self.resolved = share <= 1 and not forced
        if self.resolved:
            self.scale = scale
        if forced:
            return True
        if self.rtol is None:
            self.dt = min(self.largest, GROWTH * dt)
            return True
        most = 1.0 if self.repeated else GROWTH
        factor = float(np.clip(SAFETY / np.sqrt(max(share, 1e-12)), 0.3, most))
        accepted = share <= 1 or dt <= (1 + 1e-9) * self.smallest
        if not accepted or not 1 <= factor < DEADBAND:
            self.dt = float(np.clip(factor * dt, self.smallest, self.largest))
        self.repeated = not accepted
        return accepted

    def _raised(self, dt: float, error: float, speed: float) -> float:
        """The scale after a step with that speed, of which a short spike is a small part."""
        if error > JUMP * speed:
            return self.scale
        return self.scale + max(speed - self.scale, 0.0) * min(1.0, dt / (self.natural or dt))

    def limit(self, longest: float, period: float) -> None:
        """No steps longer than that. Raises ValueError for given ones that are."""
        if self.rtol is None and self.largest > longest * (1 + 1e-9):
            raise ValueError(
                f"steps = {round(period / self.largest)}: must be >= {math.ceil(period / longest)}, "
                "else the feedback of the strain on the wave is unstable"
            )
        self.largest, self.natural = min(self.largest, longest), min(self.natural, longest)
        self.dt = min(self.dt, longest)

    def halve(self, dt: float) -> bool:
        """Halve the step after a failure; False if it cannot be shorter."""
        self.dt, self.repeated = max(dt / 2, self.smallest), True
        return dt > (1 + 1e-9) * self.smallest


def step_size(
    period: float, rtol: float | None, steps: int | None, rates: Spectrum = SINE, heavy: bool = False
) -> StepSize:
    """Fixed steps of period/steps, or adaptive ones that start with an eighth of the step for a sine.

    rates: spectrum of the growth rate in time; each significant harmonic is resolved by at least
    PER_HARMONIC steps per period, since the step error does not detect unresolved harmonics. heavy:
    whether the sheet has inertia, so that it snaps through in a time that shorter steps can resolve.
    Raises ValueError for too few steps, or a wave too rough to be resolved.
    """
    if steps is not None:
        needed = fewest_steps(rates)
        if steps < needed:
            raise ValueError(
                f"steps = {steps}: must be >= {needed}, {FEWEST} per period of harmonic "
                f"{needed // FEWEST} of the wave, beyond which lies less than {GIVEN_SHARE:.0%} of its "
                "rate"
            )
        return StepSize(period / steps, period / steps / 1024, period / steps)
    assert rtol is not None
    harmonic = _harmonic(rates, rtol)
    # The relative error of the slope of a sine of this period is (2 pi dt/period)^2/3.
    natural = period * np.sqrt(3 * rtol) / (2 * np.pi)
    shortest = natural / (HEAVY_SHORTEST if heavy else SHORTEST) / max(harmonic / SHORT_HARMONIC, 1)
    return StepSize(
        natural / 8 / harmonic,
        shortest,
        period / max(12, PER_HARMONIC * harmonic),
        rtol,
        natural=natural,
    )


def fewest_steps(rates: Spectrum) -> int:
    """Equal steps per period that resolve a wave with that spectrum of its rate.

    Raises ValueError as `step_size`.
    """
    return FEWEST * _harmonic(rates, GIVEN_SHARE)


def _harmonic(rates: Spectrum, share: float) -> int:
    """The harmonic beyond which at most that fraction of dc/dt lies, or ten times it if unknown.

    Raises ValueError if even ten times the fraction is unresolved: growth that jumps in time.
    """
    known = [h for h in (rates.highest(s) for s in (share, 10 * share, GIVEN_SHARE)) if h < np.inf]
    if not known:
        raise ValueError(
            f"wave: must be resolved by its harmonics in time, of which {rates.sizes.size} contain "
            f"less than {1 - GIVEN_SHARE:.0%} of its rate; growth that jumps cannot be stepped in time"
        )
    return int(known[0])
