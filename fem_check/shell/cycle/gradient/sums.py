"""Sums over times of V_y, differentiated: the part of friction, and the weights left to the states."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.cycle.balance import LOT, CycleBalance
from fem_check.shell.cycle.gradient.changes import CENTRAL, Changes
from fem_check.shell.cycle.gradient.friction import CycleAdjoint, PointWeights
from fem_check.shell.cycle.gradient.kinematics import MotionAdjoint
from fem_check.shell.cycle.motion import CycleMotion, depth_of
from linear_theory.common.progress import track
from linear_theory.friction.load import Load
from linear_theory.gradient.adjoint import LawChange
from linear_theory.gradient.means import law_changes
from linear_theory.gradient.sensitivity import MapChange
from linear_theory.motion.motion import Motion

Array = NDArray[np.float64]

GROWTH_STEP = 1e-4
"""Of alpha c, by which grown areas are differentiated."""


class Sums(NamedTuple):
    """Derivatives of sums (rules,) over times.

    states: by the shapes at all phases, (rules, phases, size); explicit: by parameters at fixed shapes,
    (rules, parameters); values: the sums themselves, (rules,); flat: whether at some time there is a
    motion that friction does not resist.
    """

    states: Array
    explicit: Array
    values: Array
    flat: bool


@dataclass(frozen=True, eq=False)
class FrictionAdjoint:
    """Of a balance of shapes; changes: those of the parameters, for these shapes."""

    balance: CycleBalance
    changes: Changes

    def sums(self, times: Array, q: Array, rule: Array) -> Sums:
        """Of V_y at times (T,) in the motions q (T, 3), with factors rule (rules, T)."""
        whole = MotionAdjoint(self._motion, len(rule))
        explicit = np.zeros((len(rule), len(self.changes.directions)))
        flat = False
        starts = track("adjoint of the friction balance", range(0, times.size, LOT))
        for some in (slice(i, i + LOT) for i in starts):
            at = self._weights(times[some], q[some])
            whole.add(times[some], at, rule[:, some])
            explicit += rule[:, some] @ self._explicit(times[some], at, q[some], whole)
            flat |= bool(at.flat.any())
        return Sums(whole.by_states(), explicit, rule @ q[:, 1], flat)

    @property
    def _motion(self) -> CycleMotion:
        return self.balance._motion

    def _weights(self, times: Array, q: Array) -> PointWeights:
        return self.balance.balance_of(CycleAdjoint, times).by_points(q, self._laws)

    @cached_property
    def _laws(self) -> list[LawChange]:
        return list(law_changes(self.changes.directions, 1.0, self.balance.mirrored))

    def _explicit(self, times: Array, at: PointWeights, q: Array, whole: MotionAdjoint) -> Array:
        """Derivatives by the parameters at fixed shapes, (T, parameters)."""
        changes = self.changes
        found = np.zeros((times.size, len(changes.directions)))
        laws = iter(at.laws)
        motion = self._motion.at(times) if any(d.map for d in changes.directions) else None
        for i, d in enumerate(changes.directions):
            found[:, i] = -d.slip * at.slip - d.period * (q[:, 1] + at.slip)
            if d.law is not None:
                found[:, i] += next(laws)
            if d.map is not None:
                assert motion is not None
                share = MapChange(*d.map, self.balance.mirrored)
                found[:, i] += self._by_map(times, at, motion, share)
        if changes.waves and (grown := whole.by_grown_area(times, at)) is not None:
            found[:, changes.waves] += self._by_growth(times, grown)
        for i, others in self._others.items():
            for other, factor in others:
                found[:, i] += factor * _met(at, other.at(times))
        return found

    def _by_map(self, times: Array, at: PointWeights, motion: Motion, change: MapChange) -> Array:
        x, y = self._motion.region.reference[0, :2]
        share = change.share(self._motion.map, x, y, times)  # type: ignore[arg-type]
        weights = (at.load * motion.area).reshape(times.size, -1)
        return np.asarray((weights * share).sum(-1))

    def _by_growth(self, times: Array, by_area: Array) -> Array:
        """By waves through areas that grow with c, (T, waves)."""
        model, (x, y) = self._motion.shapes.model, self._motion.region.reference[0, :2]
        growth = model.scene.growth
        c = np.stack([model.growth(float(t), x, y) for t in times])
        step = GROWTH_STEP / abs(growth.alpha) if growth.alpha else 1.0
        slope = sum(f / step * growth.metric(c + k * step) for k, f in CENTRAL.items())
        changed = self.changes.of_waves.at(x, y, times[:, None])
        return np.asarray(np.einsum("tp,wtp->tw", by_area * slope, changed))

    @cached_property
    def _others(self) -> dict[int, list[tuple[CycleMotion, float]]]:
        """Motions of the same states in other scenes, of the parameters that change them so."""
        own, contact = self._motion, self.balance.contact
        found = {}
        for i, scenes in self.changes.scenes.items():
            shapes = [replace(own.shapes, model=variant.model) for variant in scenes]
            same = all(one.discretisation is own.shapes.discretisation for one in shapes)
            if same and not own.depth and own.load in (Load.CURRENT, Load.MATERIAL):
                continue  # places, velocities and areas are those of the states
            found[i] = [
                (replace(own, shapes=one, depth=depth_of(one, contact)), variant.factor)
                for one, variant in zip(shapes, scenes, strict=True)
            ]
        return found


def _met(at: PointWeights, motion: Motion) -> Array:
    """Weights times velocities, places and loads of a motion, (T,)."""
    vectors = at.velocity * motion.velocity + at.place * motion.position
    return np.asarray((vectors.sum(0) + at.load * motion.area).sum((1, 2, 3)))
