"""The adjoint of the static shapes: from weights of states to growth and scenes that change them.

A shape u is where the forces R(u, p) of all effects vanish. A sum G . u changes by

    dJ = -lambda . dR/dp,      K lambda = G,

K the tangent stiffness there: one factor per phase, and one solve per sum. The virtual work
lambda . R is a sum over points, so that growth enters by a density per dc.
"""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.cycle.gradient.changes import CENTRAL, Changes, Variant
from fem_check.shell.cycle.shapes import Shapes, minimiser_of, working_effects
from fem_check.shell.effects.effect import Effect
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.region import Entries, Region
from fem_check.shell.kinematics.rest_state import RestState, grown_state
from fem_check.shell.statics.equilibrium import UnstableError
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Potential
from linear_theory.common.progress import track

Array = NDArray[np.float64]

GROWTH_STEP = 1e-4
"""Of alpha c, and of beta c L, by which forces are differentiated with respect to growth."""


@dataclass(eq=False)
class StaticAdjoint:
    """Of the shapes of a cycle."""

    shapes: Shapes
    minimiser: Minimiser = field(init=False)
    effects: tuple[Effect, ...] = field(init=False)
    entries: Entries = field(init=False)

    def __post_init__(self) -> None:
        self.minimiser = minimiser_of(self.shapes.model)
        self.effects = tuple(
            effect
            for effect in working_effects(self.shapes.model)
            if not effect.idle(self.shapes.discretisation.components)
        )
        self.entries = tuple(sorted({e for effect in self.effects for e in effect.entries}))

    def along(self, weights: Array, changes: Changes) -> Array:
        """What sums with weights of the states (rules, phases, size) change by, (rules, parameters).

        Raises UnstableError where a shape is no strict minimum.
        """
        found = np.zeros((len(weights), len(changes.directions)))
        phases = zip(self.shapes.times.tolist(), self.shapes.states, strict=True)
        for n, (t, state) in enumerate(track("adjoint of the shapes", list(phases))):
            found -= self._at(t, state, weights[:, n], changes)
        return found

    def _at(self, t: float, state: Array, weights: Array, changes: Changes) -> Array:
        model = self.shapes.model
        rest, region = model.rest(t), model.discretisation.interior
        virtual = self._solved(t, state, weights, rest)
        jets = _jets(region, virtual, self.effects)
        x, y = region.parameters.reshape(2, -1)
        c = model.growth(t, x, y)
        found = np.zeros((len(weights), len(changes.directions)))
        here = PointState(region, state, self.entries, rest)
        for effect in self.effects:
            effect.gradient(here)  # what is known of the shape is kept for other growth
        if changes.waves:
            density = self._by_growth(c, here, jets)
            found[:, changes.waves] = density @ changes.of_waves.at(x, y, t).T
        for i, scenes in changes.scenes.items():
            for variant in scenes:
                found[:, i] += variant.factor * self._work(variant, c, here, state, virtual, jets)
        return found

    def _solved(self, t: float, state: Array, weights: Array, rest: RestState) -> Array:
        """lambda, (rules, size)."""
        potential = Potential(self.shapes.discretisation, self.effects, rest)
        met = self.minimiser.factorised(potential, state, 0.0, convex=False)
        if met.shift > 0:
            raise UnstableError(f"the shape at t = {t:g} is no strict minimum: V has a kink", state, t)
        order = self.minimiser.sparsity.order
        virtual = np.zeros_like(weights)
        virtual[:, order] = np.stack([met.factor.solve(row) for row in weights[:, order]])
        return virtual

    def _by_growth(self, c: Array, here: PointState, jets: list[Array]) -> Array:
        """Virtual work per dc at each point, (rules, points)."""
        scene, region = self.shapes.scene, here.region
        growth = scene.growth
        bent = abs(growth.curvature_coupling) * scene.sheet.length
        step = GROWTH_STEP / max(abs(growth.alpha), bent)
        found = np.zeros(1)
        for k, factor in CENTRAL.items():
            other = here.under(grown_state(region, c + k * step, growth))
            found = found + factor / step * _virtual_work(self.effects, other, jets)
        return np.asarray(found)

    def _work(
        self,
        variant: Variant,
        c: Array,
        here: PointState,
        state: Array,
        virtual: Array,
        jets: list[Array],
    ) -> Array:
        """Virtual work in another scene with the same growth c at its points, (rules,)."""
        model = variant.model
        region = model.discretisation.interior
        rest = grown_state(region, c, model.scene.growth)
        effects = [e for e in variant.effects if not e.idle(region.components)]
        if region is here.region:
            return _virtual_work(effects, here.under(rest), jets).sum(-1)
        other = PointState(region, state, self.entries, rest)
        return _virtual_work(effects, other, _jets(region, virtual, effects)).sum(-1)


def _jets(region: Region, virtual: Array, effects: Any) -> list[Array]:
    """Derivatives of virtual displacements that effects read, (rules, entries, components, points)."""
    return [np.stack([region.displacement(row, e.entries) for row in virtual]) for e in effects]


def _virtual_work(effects: Any, state: PointState, jets: list[Array]) -> Array:
    """Of the forces of effects, (rules, points)."""
    return np.asarray(
        sum(
            np.einsum("ecp,recp->rp", effect.gradient(state), jet)
            for effect, jet in zip(effects, jets, strict=True)
        )
    )
