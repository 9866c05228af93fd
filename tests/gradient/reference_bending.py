"""The speed of a bending sheet on a frozen grid of times and cells, with polynomials of fixed degrees.

It is a smooth function of all parameters, whose differences know nothing of adjoints.
"""

from dataclasses import dataclass, field, replace

import numpy as np

from linear_theory import Scene
from linear_theory.balance.course import Course
from linear_theory.balance.crawl import Resolution
from linear_theory.balance.time_grid import first_grid
from linear_theory.deformation.plate import PlateField, foundation
from linear_theory.deformation.plate.stretching import StretchField
from linear_theory.deformation.ritz import RitzField
from linear_theory.deformation.ritz.solver import RitzSolver
from linear_theory.deformation.second.field import SecondOrderField
from linear_theory.gradient import parameters
from linear_theory.gradient.quantity import ALONG, WORK
from linear_theory.gradient.second.means import SecondDerivatives
from linear_theory.gradient.second.shapes import Shapes
from linear_theory.motion.motion import CellGrid
from linear_theory.speed.expansion import TINY_ALPHA, tiny
from linear_theory.speed.plate.terms import PlateCoefficients, PlateTerms, Weights

DEGREE = (9, 17)

CELLS = Resolution(4.0, 7, 0, 1e-13)

PANELS = 8
"""Of half a period, where one half is known by V(t_0 - t) = V(t)."""

STEP = 1e-3
"""Of a direction; the error of its difference is of the fourth power."""

COARSE = 0.3
"""Tolerance of harmonics that the wave does not have: no higher degrees than those above."""


@dataclass(frozen=True)
class FrozenCoefficients(PlateCoefficients):
    """Of cells that keep their places as shares of the width."""

    cells: CellGrid = field(kw_only=True)
    width: float = field(kw_only=True)

    @property
    def grid(self) -> CellGrid:
        """See Crawl."""
        stretch = self.field.sheet.width / self.width
        return replace(self.cells, x_edges=tuple(stretch * x for x in self.cells.x_edges))


@dataclass(frozen=True)
class Frozen:
    """Speeds of scenes near one of them."""

    scene: Scene

    def solved(self, scene: Scene) -> tuple[PlateTerms, Course]:
        """Deformation and motion."""
        plane = SecondOrderField(RitzField(scene.drive, RitzSolver(scene.sheet, DEGREE)), scene.growth)
        plate = PlateField(scene.drive, foundation(scene.effects), DEGREE)
        plate.error = 1e-9
        terms = PlateTerms(plane, plate, StretchField(plate).measured())
        ratio, own = scene.curvature_coupling / scene.alpha, self.scene
        contact = terms.contact(scene)
        contact = tiny(replace(contact, friction=contact.friction.per(scene.alpha)))
        cells = CellGrid.graded(own.sheet, own.drive.short_waves[1], CELLS.density, half=True)
        crawl = FrozenCoefficients(
            plane,
            TINY_ALPHA,
            contact,
            CELLS,
            terms,
            Weights(1.0, ratio, ratio**2),
            cells=cells,
            width=own.sheet.width,
        )
        reversal = own.drive.reversal_time
        start, panels = (0.0, 5) if reversal is None else (reversal / 2, 2 * PANELS)
        share = 1.0 if crawl.reversal_time is None else 0.5
        grid = first_grid(start, start + share * own.period, int(share * panels))
        return terms, Course(crawl, grid, crawl.balance(grid.times))

    def orders(self, scene: Scene):
        """V_1, V_2 and p_0, p_1, (2, 2)."""
        _, course = self.solved(scene)
        means = course.means()[0][:, 1]
        return np.stack([means, course.works()[0]])

    def values(self, scene: Scene):
        """V and the power."""
        return self.orders(scene) @ [scene.alpha, scene.alpha**2]

    def along(self, names, direction):
        """Derivatives of both along a direction."""

        def at(step):
            scene = self.scene
            for one, part in zip(parameters(names), direction, strict=True):
                scene = one.changed(scene, one.value(self.scene) + step * part)
            return self.values(scene)

        near, far = (at(k * STEP) - at(-k * STEP) for k in (1, 2))
        return (8 * near - far) / (12 * STEP)

    def gradients(self, names):
        """By the adjoint, (2, parameters)."""
        scene, over = self.scene, parameters(names)
        terms, course = self.solved(scene)
        directions = [one.direction(scene) for one in over]
        quantities = ALONG, WORK
        of = SecondDerivatives(
            scene, Shapes.of(scene, terms), course, over, directions, quantities, COARSE
        )
        values = of.means().values
        orders, alpha = self.orders(scene), scene.alpha
        explicit = orders @ [1.0, 2 * alpha]
        by_alpha = np.array([d.alpha for d in directions])
        return np.array([alpha, alpha**2]) @ values + np.multiply.outer(explicit, by_alpha)
