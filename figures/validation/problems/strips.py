"""Strips with a natural curvature that lie on the ground by their weight, and what carries them."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rest_state import grown_state, tensor_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.material import Material
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.ramp import ramp
from figures.validation.problems.sheets import affine, at, koiter, shell

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Shape:
    """Heights (points,) of a strip over the material coordinate along it, (points,), the end last."""

    along: Array
    height: Array

    @property
    def rise(self) -> float:
        """Of the end above the first point."""
        return float(self.height[-1] - self.height[0])

    @property
    def free(self) -> float:
        """Length off the ground at the end."""
        start = int(np.flatnonzero(self.height < 0)[-1])
        low, high = self.height[start : start + 2]
        share = -low / (high - low)
        gap = self.along[start + 1] - self.along[start]
        return float(self.along[-1] - self.along[start] - share * gap)


@dataclass(frozen=True)
class HeavyStrip:
    """Half of a strip, from its middle, a plane of mirror symmetry, to its free end.

    half, width, thickness: lengths; weight: per area, Young's modulus 1; stiffness: k of the ground,
    k z^2; wide: its long edges do not turn, as in the middle of a wide sheet.
    """

    half: float = 0.5
    width: float = 0.02
    thickness: float = 0.03
    weight: float = 2.5e-4
    stiffness: float = 5e5
    poisson: float = 0.0
    wide: bool = False

    @property
    def depth(self) -> float:
        """By which it sinks in where it is flat."""
        return float(np.sqrt(self.weight / self.stiffness))

    def lying(self, rest: Callable[[Array], Array], elements: int, first: float = 0.5) -> Shape:
        """The equilibrium shape under its weight.

        rest: natural curvature at places along the strip, upwards, 1/length; of all directions if it
        is wide. first: share of it in the first step.
        """
        sheet = shell("bfs", (0, self.half, elements), (0, self.width / 2, 1))
        supports = Supports(sheet).symmetric(at(0, 0), 0).symmetric(at(1, 0), 1)
        if self.wide:
            supports.symmetric(at(1, self.width / 2), 1)
        material = Material(self.thickness, self.poisson)
        effects = (*koiter(material), Gravity(self.weight), Ground(self.stiffness))
        natural = rest(sheet.interior.parameters.reshape(2, -1)[0])

        def problem(share: float) -> Potential:
            bent = share * natural
            curved = np.stack([bent, bent if self.wide else 0 * bent, 0 * bent])
            return Potential(sheet, effects, tensor_state(sheet.interior, [1, 1, 0], curved))

        start = affine(sheet, np.zeros((3, 2)), np.array([0, 0, -self.depth]))
        found = ramp(Minimiser(supports, iterations=100), problem, start, first=first)
        assert not found.buckled
        return _middle_line(sheet, found.state, self.half)


def _middle_line(sheet: Discretisation, state: Array, end: float) -> Shape:
    inside = sheet.interior
    along = np.append(inside.parameters.reshape(2, -1)[0], end)
    tip = sheet.point((end, 0.0)).position(state, (0,))[0, 2]
    height = np.append(inside.position(state, (0,))[0, 2], tip)
    order = np.argsort(along, kind="stable")
    return Shape(along[order], height[order])


def uniform_strip(
    curvature: float, stiffness: float, elements: int, poisson: float = 0.0, wide: bool = False
) -> Shape:
    """The strip of L = 1, h = 0.03, weight 2.5e-4 with one natural curvature."""
    strip = HeavyStrip(stiffness=stiffness, poisson=poisson, wide=wide)
    return strip.lying(lambda s: np.full_like(s, curvature), elements)


def rises(
    curvatures: tuple[float, ...],
    stiffness: float,
    elements: int,
    poisson: float = 0.0,
    wide: bool = False,
) -> tuple[float, ...]:
    """Heights of the ends above the middle."""
    shapes = (uniform_strip(c, stiffness, elements, poisson, wide) for c in curvatures)
    return tuple(shape.rise for shape in shapes)


def free_lengths(curvatures: tuple[float, ...], softest: float, elements: int) -> tuple[float, ...]:
    """Lengths off rigid ground: the limit of those off three grounds.

    They are 16 times as stiff as each other; the limit is that in powers of the width of the layer in
    which the ground lets go of the strip, stiffness^(-1/8).
    """
    grounds = softest * 16.0 ** np.arange(3)
    widths = grounds**-0.125

    found = []
    for curvature in curvatures:
        lengths = [uniform_strip(curvature, k, elements).free for k in grounds]
        found.append(float(np.polynomial.Polynomial.fit(widths, lengths, 2)(0.0)))
    return tuple(found)


def end_forces(curvatures: tuple[float, ...], stiffness: float, elements: int) -> tuple[float, ...]:
    """Force of the ground per width where it lets go, beyond the weight that lies there, over q l.

    Over the layer, a third of the length l off the ground to either side of that place.
    """
    found = []
    for curvature in curvatures:
        shape = uniform_strip(curvature, stiffness, elements)
        strip, free = HeavyStrip(stiffness=stiffness), shape.free
        edge = strip.half - free
        fine = np.linspace(edge - free / 3, edge, 4001)
        depth = np.minimum(np.interp(fine, shape.along, shape.height), 0)
        force = np.trapezoid(stiffness * depth**2, fine) - strip.weight * free / 3
        found.append(float(force / (strip.weight * free)))
    return tuple(found)


def greenhill(elements: int, steps: int = 24) -> tuple[float]:
    """Weight q L^3/B at which a column that is clamped at its foot bends under its own weight.

    The load along the undeformed strip, against its foot: by bisection of whether it is a minimum
    of the energy; so thin, L/h = 1000, that it does not shorten.
    """
    sheet, material = shell("bfs", (0, 1, elements), (0, 0.1, 1)), Material(1e-3, 0.0)
    minimiser = Minimiser(Supports(sheet).clamp(at(0, 0)).symmetric(at(1, 0), 1))
    rest = grown_state(sheet.interior)

    def stands(ratio: float) -> bool:
        weight = DeadLoad((-ratio * material.bending, 0.0, 0.0))
        potential = Potential(sheet, (*koiter(material), weight), rest)
        return not minimiser.minimise(potential, sheet.zeros()).buckled

    low, high = 4.0, 16.0
    for _ in range(steps):
        middle = (low + high) / 2
        low, high = (middle, high) if stands(middle) else (low, middle)
    return ((low + high) / 2,)
