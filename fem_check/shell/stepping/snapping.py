"""How a sheet is led through a snap-through.

Without inertia a sheet that loses its equilibrium jumps, however short the step: the minimisation has
far to go, and the load on the ground that it holds fixed is that of another shape. Steps that fail are
therefore made again with a `Restraint`, a drag that lets the sheet move a little at a time; it is
stiffened until steps succeed and relaxed until it is no longer needed. Such steps stay as short as the
last failed one until the drag is weak: in the limit a snap-through takes no time.
"""

import math
from dataclasses import dataclass

from fem_check.shell.material import Material
from linear_theory.sheet.rectangle import Sheet

SHORTENED = 3
"""Consecutive failures that shorten the step, before the sheet is restrained."""

STIFFER, SOFTER = 8.0, 3.0
"""Factors on the stiffness after a failure and after a success."""

RELEASED = 1e-3
"""Fraction of the first stiffness below which the sheet is released."""

STIFFEST = 1e6
"""Multiple of the first stiffness beyond which a step has failed for another reason than a snap."""

MOST = 60
"""Largest number of restrained steps without a free one between them: a snap-through takes about 15. A
sheet that then still moves slides or falls without end."""

LONGEST = 0.15
"""Longest time, in periods, of such steps."""


def first_stiffness(sheet: Sheet) -> float:
    """That of the bending of one wave along the sheet, force per length^3."""
    return Material(sheet.thickness, sheet.poisson).bending * (2 * math.pi / sheet.length) ** 4


@dataclass
class Snap:
    """The restraint of the next step.

    first: stiffness with which it begins, force per length^3. stiffness: 0 if the sheet is free.
    failures: of the step that is tried. steps: restrained ones in a row.
    """

    first: float
    stiffness: float = 0.0
    failures: int = 0
    steps: int = 0

    @property
    def weak(self) -> bool:
        """Whether the drag is so weak that steps may become longer."""
        return self.stiffness < self.first

    @property
    def restrained(self) -> bool:
        """Whether the next step is restrained."""
        return self.stiffness > 0

    def failed(self, shortest: bool) -> bool:
        """After a failed step, which may be the `shortest`; False if nothing is left to try."""
        self.failures += 1
        if self.restrained:
            self.stiffness *= STIFFER
        elif shortest or self.failures >= SHORTENED:
            self.stiffness = self.first
        return self.stiffness <= STIFFEST * self.first and self.steps < MOST

    def succeeded(self) -> None:
        """After an accepted step."""
        self.failures = 0
        if not self.restrained:
            self.steps = 0
            return
        self.steps += 1
        self.stiffness /= SOFTER
        if self.stiffness < RELEASED * self.first:
            self.stiffness = 0.0
