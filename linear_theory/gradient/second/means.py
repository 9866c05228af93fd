"""Gradients of speed and power to second order, of a planar sheet and of one that bends on its ground.

    V = alpha <q_0> + alpha^2 <q_1>,     r = beta/alpha,

q_1 with the sources of growth and, of a sheet that bends, of pressure times r and of bending times r^2
(see `speed.plate.terms`).
Weights of velocity and load come from the adjoint of the balance (`weights`); what they make of the
deformation changes with harmonics of the wave (`waves`) and, by central differences of the deformation
alone, with all else: sheet, ground, couplings, other waves.

Of a motion known over half a period by its reversal in time, V(t_0 - t) = V(t), parameters may break
that symmetry: the weights of both halves are taken.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.course import Course
from linear_theory.balance.time_grid import TimeGrid
from linear_theory.common.progress import track
from linear_theory.gradient.direction import Direction
from linear_theory.gradient.means import CHECKED, PER_HARMONIC, SAFETY, law_changes
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.gradient.quantity import Quantity
from linear_theory.gradient.second.shapes import Shapes, ratio_of
from linear_theory.gradient.second.waves import Rules, Waves
from linear_theory.gradient.second.weights import Asked, TimeWeights, orders, time_weights
from linear_theory.scene.scene import Scene
from linear_theory.speed.expansion import Coefficients, field_tolerance

Array = NDArray[np.float64]

STEP = 1e-4
"""Of a parameter, relative to it, of differences of the deformation, whose errors are of its square."""

SMALL = 1e-6
"""a of the weights, where friction is smooth."""

SMALL_DRY = 2e-2, 1e-2
"""The same of dry friction, where points at rest move with a, which cells must resolve: what is of the
square of a counts, and is extrapolated."""

ROUGH = 0.03
"""Change between these, of a derivative or of all in the mean, from which on V is not smooth."""

ROUGH_SAFETY = 3.0
"""Of that change, for the error of such a derivative."""

FIELD_SAFETY = 3.0
"""Of the errors of the deformation, for those of its derivatives."""


class Means(NamedTuple):
    """Derivatives of means and their errors, (k, 2, parameters) each; flat: whether friction does not
    resist some motion at some time; rough: whether V is not smooth."""

    values: Array
    errors: Array
    flat: bool
    rough: bool = False


@dataclass(frozen=True)
class SecondDerivatives:
    """Of quantities along directions.

    shapes: of the scene; over: the parameters that these are of; size: a of the weights.
    """

    scene: Scene
    shapes: Shapes
    course: Course
    over: Sequence[Parameter]
    directions: Sequence[Direction]
    quantities: Sequence[Quantity]
    rtol: float
    size: float = SMALL

    def means(self) -> Means:
        """Of q_0 and q_1."""
        if self.scene.contact.friction.width > 0:
            return self._means()
        far, near = (replace(self, size=size)._means() for size in SMALL_DRY)
        values, changes = (4 * near.values - far.values) / 3, abs(near.values - far.values)
        usual = np.sqrt((values**2).mean(-1, keepdims=True))
        rough = changes > ROUGH * np.maximum(abs(values), usual)
        errors = (4 * near.errors + far.errors) / 3 + np.where(rough, ROUGH_SAFETY, 1.0) * changes
        return Means(values, errors, far.flat, bool(rough.any()))

    def _means(self) -> Means:
        """The same with weights of that size."""
        weights, differences = self._weights
        shape = len(self.quantities), 2, len(self.over)
        values, errors = np.zeros((2, *shape))
        for some, found in ((self._deformed, self._by_differences), (self._waves, self._by_waves)):
            if some:
                values[..., some], errors[..., some] = found(weights, differences)
        more, more_errors = self._by_law(weights, differences)
        values, errors = values + more, errors + more_errors
        self._drop_leading(values, errors)
        return Means(values, errors, weights.flat)

    def _drop_leading(self, values: Array, errors: Array) -> None:
        """q_0 keeps no mean along directions that keep c(t + T/2) = -c(t)."""
        crawl = self.course.crawl
        if not crawl.starts_at_second_order:
            return
        kept = [d.keeps_sign(crawl.drive) for d in self.directions]
        for i, quantity in enumerate(self.quantities):
            if quantity.work == 0:
                values[i, 0, kept] = errors[i, 0, kept] = 0.0

    @cached_property
    def _highest(self) -> int:
        return max(d.highest for d in self.directions)

    @cached_property
    def _wave_shapes(self) -> Waves:
        return Waves(self.shapes, self._highest, field_tolerance(self.rtol))

    @cached_property
    def _waves(self) -> list[int]:
        """Parameters of the harmonics of a series."""
        return [i for i, d in enumerate(self.directions) if d.harmonics and self.shapes.is_series]

    @cached_property
    def _deformed(self) -> list[int]:
        """Others that change the deformation, or the ratio of the couplings."""
        return [
            i
            for i, (one, d) in enumerate(zip(self.over, self.directions, strict=True))
            if i not in self._waves and d.deforms
        ]

    @cached_property
    def _grid(self) -> TimeGrid:
        """Of the course, with times that resolve the harmonics."""
        grid = self.course.grid
        highest = self._highest if self._waves else 0
        return grid.with_steps(self.scene.period / (PER_HARMONIC * highest)) if highest else grid

    @cached_property
    def _weights(self) -> tuple[TimeWeights, TimeWeights]:
        """At all times, and what finer cells change at a few."""
        course = self.course.on(self._grid)
        crawl = course.crawl
        assert isinstance(crawl, Coefficients)
        if self._waves:
            waves = self._highest * abs(self._wave_shapes.series.count)
            crawl = replace(crawl, waves=math.ceil(waves / 2))
        law = self.scene.contact.friction.per(self.scene.alpha)
        laws = law_changes(self.directions, self.scene.alpha, mirrored=True)
        asked = Asked(law, self.quantities, laws, self._counts, self.size)
        times, motion = course.grid.times, course.motion
        whole = time_weights(crawl, times, motion, asked)
        some = np.unique((np.array(CHECKED) * times.size).astype(int))
        fine = replace(crawl, resolution=crawl.resolution.finer())
        near = motion._replace(leading=motion.leading[some], remainder=motion.remainder[some])
        return whole, time_weights(fine, times[some], near, asked).minus(whole.some(some))

    @cached_property
    def _counts(self) -> tuple[int, int]:
        """Of moments, enough for all degrees and for c."""
        degrees = self.shapes.degrees
        if self._waves:
            degrees += self._wave_shapes.degrees
        across, along = (max(one[i] for one in degrees) for i in range(2))
        return across + across // 4 + 12, along + along // 4 + 12

    def _sides(self, weights: TimeWeights) -> list[TimeWeights]:
        """Weights at both halves of a period of which one is known by V(t_0 - t) = V(t)."""
        reversal = self.course.crawl.reversal_time
        return [weights] if reversal is None else [weights, weights.reversed(reversal)]

    def _by_differences(self, weights: TimeWeights, differences: TimeWeights) -> tuple[Array, Array]:
        """Of the deformation, (k, 2, parameters) and their errors."""
        some = [(self.over[i], self.directions[i]) for i in self._deformed]
        parts = [self._change(one, d, weights, differences) for one, d in track("deformation", some)]
        whole, finer = (np.stack(part, 2) for part in zip(*parts, strict=True))
        return self._averaged(whole, finer)

    def _change(
        self, one: Parameter, direction: Direction, weights: TimeWeights, differences: TimeWeights
    ) -> tuple[Array, Array]:
        """What weights make of the change of the deformation, (parts, k, 2, T) of both weights."""
        value = one.value(self.scene)
        step = STEP * (abs(value) or 1.0)
        nodes, factors = [-1, 1], [-0.5, 0.5]
        if direction.poisson:  # towards smaller values, as it may be at its bound
            nodes, factors = [0, -1, -2], [1.5, -2.0, 0.5]
        near = [self._near(one.changed(self.scene, value + node * step)) for node in nodes]
        whole, finer = (
            np.tensordot(np.array(factors) / step, [self._made(one, of) for one in near], 1)
            for of in (weights, differences)
        )
        return whole, finer

    def _made(self, shapes: Shapes, of: TimeWeights) -> Array:
        """What weights make of a deformation, the mean of both halves of the period."""
        return mean_of(shapes.works(side) for side in self._sides(of))

    def _near(self, scene: Scene) -> Shapes:
        """The deformation of a scene near the own one; the own one where only couplings differ."""
        own = self.scene
        parts = ("sheet", "wave", "effects")
        if all(getattr(scene, part) == getattr(own, part) for part in parts):
            bent = self.shapes.bent
            return self.shapes._replace(bent=bent and bent._replace(ratio=ratio_of(scene)))
        return self.shapes.near(scene)

    def _by_waves(self, weights: TimeWeights, differences: TimeWeights) -> tuple[Array, Array]:
        """Of harmonics, likewise."""
        changes = [self.directions[i].harmonics for i in self._waves]
        waves, checks = self._wave_shapes, np.eye(differences.times.size)
        at_times = [
            mean_of(waves.at_times(side, changes) for side in self._sides(of))
            for of in (weights, differences)
        ]
        values, errors = self._averaged(at_times[0], at_times[1], linear=True)
        whole, finer = waves.of_means(
            [Rules(self._sides(weights), _rules(self._grid)), Rules(self._sides(differences), checks)],
            changes,
        )
        values[:, 1] += whole[:, :, 0].sum(0)
        errors[:, 1] += abs(whole[:, :, 1:].sum(0)).max(1) + SAFETY * abs(finer.sum(0)).max(1)
        fields = self._field_errors[[1, 3][: len(whole)], None, None]
        errors[:, 1] += (fields * abs(whole[:, :, 0])).sum(0)
        return values, errors

    def _averaged(self, whole: Array, finer: Array, linear: bool = False) -> tuple[Array, Array]:
        """Means of parts (parts, k, n, 2, T) and their errors, (k, 2, n).

        finer: at a few times; linear: whether v_1, e and p alone are the parts.
        """
        parts = orders(whole, self._weights[0].size)
        summed = parts.sum(0)
        flat = summed.reshape(-1, summed.shape[-1])
        means, errors = (one.reshape(summed.shape[:-1]) for one in self._grid.means(flat))
        cells = abs(orders(finer.sum(0), self._weights[0].size)).max(-1)
        own = [0, 2, 4] if linear else range(5)
        fields = self._field_errors[[i for i in own if i < self._field_errors.size]]
        sizes = np.sqrt((parts**2).mean(-1))
        shape = (-1, *(1,) * (sizes.ndim - 1))
        errors = errors + SAFETY * cells + (fields.reshape(shape) * sizes).sum(0)
        return means.swapaxes(1, 2), errors.swapaxes(1, 2)

    @cached_property
    def _field_errors(self) -> Array:
        """Relative, of each of `shapes.PARTS`."""
        return FIELD_SAFETY * self.shapes.errors

    def _by_law(self, weights: TimeWeights, differences: TimeWeights) -> tuple[Array, Array]:
        """By what changes in the law: velocities per unit of it, or its numbers."""
        alpha = self.scene.alpha
        slips = np.array([d.alpha / alpha - d.slip - d.period for d in self.directions])
        both = []
        for of in (weights, differences):
            rows = slips[:, None, None] * of.slip[:, None]
            laws = iter(of.laws)
            for i, d in enumerate(self.directions):
                if d.law is not None:
                    rows[:, i] += next(laws)
            both.append(orders(rows, of.size))
        flat = both[0].reshape(-1, both[0].shape[-1])
        means, errors = (one.reshape(both[0].shape[:-1]) for one in self._grid.means(flat))
        errors = errors + SAFETY * abs(both[1]).max(-1)
        return means.swapaxes(1, 2), errors.swapaxes(1, 2)


def mean_of(parts: Iterable[Array]) -> Array:
    """Of arrays."""
    return np.mean(list(parts), axis=0)


def _rules(grid: TimeGrid) -> Array:
    """The mean over a grid, and its error with signs that are the same and alternate, (3, T)."""
    count = grid.times.size
    means, found = np.zeros(count), np.zeros((2, count))
    units = np.eye(5)
    shares = grid.lengths / grid.lengths.sum()
    signs = np.where(np.random.default_rng(3).random(shares.size) < 0.5, -1.0, 1.0)
    local = TimeGrid(np.linspace(0.0, 1.0, 5))
    boole, fourth = local.means(units)[0], np.array([1.0, -4.0, 6.0, -4.0, 1.0])
    for p, share in enumerate(shares):
        at = slice(4 * p, 4 * p + 5)
        means[at] += share * boole
        found[0, at] += share * fourth / 6
        found[1, at] += signs[p] * share * fourth / 6
    return np.stack([means, *found])
