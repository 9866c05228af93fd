"""What parameters change in a cycle of shapes: the wave at every point, friction, or all of the scene.

Waves are many and cheap: their changes dc(x, y, t) meet one density for all. Couplings, sheet, weight
and ground are few: forces and motions at frozen shapes are taken from scenes with other values, by
differences, so that no formula of theirs is written twice.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.cycle.balance import CycleBalance
from fem_check.shell.cycle.shapes import working_effects
from fem_check.shell.effects.effect import Effect
from fem_check.shell.model import ShellModel
from linear_theory.gradient.direction import Direction
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

STEP = 1e-4
"""Of a number of a scene, relative to it or, where it is 0, to 1: forces at a frozen shape are smooth
in it, so that their differences have errors of 1e-8."""

CENTRAL = {-1: -0.5, 1: 0.5}
BACKWARD = {0: 1.5, -1: -2.0, -2: 0.5}
"""Differences of second order: steps and factors; the latter where a number is at its upper bound."""


class Variant(NamedTuple):
    """A scene with another value, on the same mesh, and its factor in the difference."""

    model: ShellModel
    factor: float

    @property
    def effects(self) -> tuple[Effect, ...]:
        """Those that determine the shape."""
        return working_effects(self.model)


def variants(one: Parameter, scene: Scene, like: ShellModel) -> list[Variant]:
    """Scenes by which a parameter is differentiated. Raises ValueError where there are none.

    scene: that of the speed; like: the model to be changed, which may have another mesh.
    """
    value = one.value(scene)
    step = STEP * (abs(value) or 1.0)
    if one.name == "sheet.width" and scene.mesh is not None:
        raise ValueError(f"over = {one.name!r}: the scene must have no mesh of its own")
    refused: ValueError | None = None
    for rule in (CENTRAL, BACKWARD):
        try:
            scenes = {k: one.changed(scene, value + k * step) for k in rule}
        except ValueError as problem:
            refused = refused or problem
            continue
        return [Variant(_model(scenes[k], like), rule[k] / step) for k in rule]
    assert refused is not None
    raise refused


def _model(scene: Scene, like: ShellModel) -> ShellModel:
    """The model of a scene on the mesh of another one, stretched if the width is another one."""
    stretch = scene.sheet.width / like.scene.sheet.width
    if stretch == 1:
        model = ShellModel(scene)
        model.discretisation = like.discretisation
        return model
    mesh = like.discretisation.mesh.scaled((stretch, 1.0))
    return ShellModel(scene.but(cells=None, mesh=mesh))


class WaveChanges:
    """dc(x, y, t) of several directions, each with all images of the motion by its symmetries.

    A motion known from half a sheet, or from part of a period by its reversal V(t_0 - t) = V(t), has
    for dc the mean of the derivatives for dc and for its images.
    """

    def __init__(self, scene: Scene, directions: Sequence[Direction], balance: CycleBalance) -> None:
        self._scene, self._directions = scene, directions
        self._mirrored, self._reversal = balance.mirrored, balance.reversal_time

    def at(self, x: Array, y: Array, t: float | Array) -> Array:
        """At points (P,) and times of any shape that broadcasts with them, (directions, ...)."""
        found = self._mean(x, y, t)
        if self._reversal is not None:
            found = (found + self._mean(x, -y, self._reversal - t)) / 2
        return found

    def _mean(self, x: Array, y: Array, t: float | Array) -> Array:
        found = self._own(x, y, t)
        if self._mirrored and self._across:
            found = (found + self._own(-x, y, t)) / 2
        return found

    @cached_property
    def _across(self) -> bool:
        return any(d.growth is not None and d.growth.across for d in self._directions)

    def _own(self, x: Array, y: Array, t: float | Array) -> Array:
        t = np.asarray(t, float)
        shape = np.broadcast_shapes(x.shape, t.shape)
        found = np.zeros((len(self._directions), *shape))
        parts: dict[int, tuple[Array, Array]] = {}
        for row, d in zip(found, self._directions, strict=True):
            for k, cosine, sine in d.harmonics:
                if k not in parts:
                    parts[k] = self._harmonic(k, y, t)
                row += cosine * parts[k][0] + sine * parts[k][1]
            if d.growth is not None:
                row += d.growth.value(x, y, t)
        return found

    def _harmonic(self, k: int, y: Array, t: Array) -> tuple[Array, Array]:
        from linear_theory.wave.fractional import count_of

        scene = self._scene
        angle = 2 * np.pi * k * (count_of(scene.wave) * y / scene.sheet.length - t / scene.period)
        return np.cos(angle), np.sin(angle)


@dataclass(frozen=True, eq=False)
class Changes:
    """Those of all parameters, sorted: which of them change the wave, and which the whole scene.

    directions: of each parameter; waves: places of those that change c; scenes: places and variants of
    those that change the scene as a whole.
    """

    directions: Sequence[Direction]
    waves: list[int]
    scenes: dict[int, list[Variant]]
    of_waves: WaveChanges

    @classmethod
    def of(
        cls,
        chosen: Sequence[Parameter],
        directions: Sequence[Direction],
        balance: CycleBalance,
        scene: Scene,
    ) -> "Changes":
        """Of parameters; balance: of the shapes to be differentiated; scene: that of the speed."""
        model = balance.shapes.model
        waves = [i for i, d in enumerate(directions) if d.harmonics or d.growth is not None]
        others = [i for i, d in enumerate(directions) if is_of_scene(d)]
        scenes = {i: variants(chosen[i], scene, model) for i in others}
        changed = WaveChanges(scene, [directions[i] for i in waves], balance)
        return cls(directions, waves, scenes, changed)


def is_of_scene(d: Direction) -> bool:
    """Whether a parameter is differentiated by scenes with other values."""
    return not (d.harmonics or d.growth or d.slip or d.period or d.law or d.map)
