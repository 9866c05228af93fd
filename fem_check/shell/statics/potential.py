"""The potential: the sum of the effects of a scene as a function of the unknowns."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.contact.coupling import Coupling
from fem_check.shell.effects.effect import Effect
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.elements import require_h2
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries, Region
from fem_check.shell.kinematics.rest_state import RestState
from fem_check.shell.statics.meter import asked
from linear_theory.common.pairs import PAIRS
from linear_theory.common.shown import Shown

Array = NDArray[np.float64]

SECOND = 2
"""Entries of a jet beyond this one are second derivatives."""

POINTS_AT_ONCE = 2048
"""Points per batch: enough to hide Python's overhead, few enough that Hessians stay in the cache."""


class Load(NamedTuple):
    """An effect on part of the sheet: an edge or a point."""

    region: Region
    effect: Effect


class Group(NamedTuple):
    """Effects whose derivatives are multiplied by shape functions together."""

    entries: Entries
    effects: tuple[Effect, ...]


class Part(NamedTuple):
    """Some elements of a region, with the rest state and step at their points."""

    elements: slice
    rest: RestState | None
    step: Step | None


class _Blocks(NamedTuple):
    region: Region
    values: Array


class Blocks(Shown, _Blocks):
    """Element Hessians, (elements, shapes, component pairs, shapes)."""


class Potential(Shown):
    """Energy, gradient and Hessian of the sum of some effects.

    effects act on the whole sheet, loads on their region. rest is needed by elastic effects, step by
    inertia, friction and damping. couplings: those of effects between distant parts of the sheet, see
    `Effect.coupling`. Raises ValueError if one of these is missing, if effects contradict each other
    and if the elements are unsuitable for an effect.
    """

    def __init__(
        self,
        discretisation: Discretisation,
        effects: Sequence[Effect],
        rest: RestState | None = None,
        step: Step | None = None,
        loads: Sequence[Load] = (),
        couplings: Sequence[Coupling] = (),
    ) -> None:
        self.discretisation, self.effects, self.loads = discretisation, tuple(effects), tuple(loads)
        self.rest, self.step, self.couplings = rest, step, tuple(couplings)
        self._check()
        self._terms = [Term(discretisation.interior, self.effects, rest, step)] if effects else []
        self._terms += [Term(load.region, (load.effect,), None, None) for load in loads]

    def _contents(self) -> Mapping[str, Any]:
        names = ("discretisation", "effects", "loads", "rest", "step")
        return {name: getattr(self, name) for name in names}

    def _check(self) -> None:
        if not self.effects and not self.loads:
            raise ValueError("effects is empty: a scene must name at least one effect")
        if self.rest is None and any(effect.reads_rest for effect in self.effects):
            raise ValueError("rest = None: an effect of this scene needs a rest state")
        coupled = [type(effect).__name__ for effect in self.effects if effect.couples]
        if len(coupled) != len(self.couplings):
            raise ValueError(f"couplings: must be those of {', '.join(coupled) or 'no effect'}")
        for effect in (*self.effects, *(load.effect for load in self.loads)):
            effect.check(self.discretisation.components, self.step)
            if max(effect.entries) > SECOND:
                require_h2(self.discretisation.element)

    def shape(self, u: Array) -> PointState | None:
        """The sheet at unknowns u (size,), kept for its energies; None if its tangents are not."""
        for term in self._terms:
            if term.region is self.discretisation.interior and len(term.parts) == 1:
                return term.state(u, term.parts[0]) if {1, 2} <= set(term.entries) else None
        return None

    def energy(self, u: Array) -> float:
        """Sum of the effects at unknowns u (size,), force times length."""
        found = sum(term.energy(u) for term in self._terms)
        return found + sum(coupling.energy_and_gradient(u)[0] for coupling in self.couplings)

    def gradient(self, u: Array) -> Array:
        """Derivative of `energy`, (size,)."""
        out = np.zeros(self.discretisation.size)
        for term in self._terms:
            term.add_gradient(u, out)
        for coupling in self.couplings:
            out += coupling.energy_and_gradient(u)[1]
        return out

    def energy_and_gradient(self, u: Array) -> tuple[float, Array]:
        """Both at once, with the kinematics computed once."""
        out = np.zeros(self.discretisation.size)
        total = sum(term.add_gradient(u, out) for term in self._terms)
        for coupling in self.couplings:
            energy, gradient = coupling.energy_and_gradient(u)
            total, out = total + energy, out + gradient
        return total, out

    def hessian_blocks(self, u: Array) -> list[Blocks]:
        """Element Hessians at unknowns u, one entry per region."""
        return [Blocks(term.region, term.hessian(u)) for term in self._terms]

    def coupled_hessian(self, u: Array, convex: bool = False) -> Any:
        """Hessian of the couplings at unknowns u, sparse (size, size); None if they are inactive."""
        found = [coupling.hessian(u, convex) for coupling in self.couplings]
        active = [hessian for hessian in found if hessian is not None]
        return sum(active[1:], active[0]) if active else None

    def reach(self, u: Array, change: Array) -> float:
        """Fraction of a change of the unknowns, in [0, 1], that no coupling forbids."""
        return min((coupling.reach(u, change) for coupling in self.couplings), default=1.0)


class Term:
    """Some effects on one region."""

    def __init__(
        self, region: Region, effects: tuple[Effect, ...], rest: RestState | None, step: Step | None
    ) -> None:
        self.region = region
        self.groups = grouped(effects, region.components)
        self.entries = tuple(sorted({e for group in self.groups for e in group.entries}))
        self.parts: list[Part] = []
        self._last: tuple[Array, PointState] | None = None
        count = len(region.elements)
        elements = -(-count // -(-count * region.per_element // POINTS_AT_ONCE))  # batches of a size
        for start in range(0, count, elements):
            part = slice(start, min(start + elements, count))
            points = region.points(part)
            self.parts.append(
                Part(
                    part,
                    None if rest is None else rest.part(points),
                    None if step is None else step.part(points),
                )
            )

    def state(self, u: Array, part: Part) -> PointState:
        """Kinematics of some elements.

        A sheet of one batch keeps those of the last unknowns: a Hessian follows the gradient there.
        """
        if self._last is not None and np.array_equal(self._last[0], u):
            return self._last[1]
        state = PointState(self.region, u, self.entries, part.rest, part.step, part.elements)
        if len(self.parts) == 1:
            self._last = u.copy(), state
        return state

    def energy(self, u: Array) -> float:
        """Sum over effects and points."""
        total = 0.0
        for part in self.parts:
            state = self.state(u, part)
            total += sum(float(asked(e, "energy", state).sum()) for g in self.groups for e in g.effects)
        return total

    def add_gradient(self, u: Array, out: Array) -> float:
        """Add the gradient to `out`; returns the energy, available at little cost."""
        nodal, total = out.reshape(-1, self.region.components), 0.0
        for part in self.parts:
            state = self.state(u, part)
            forces: Array | float = 0.0
            for group in self.groups:
                density = _summed_gradient(group, state)
                forces = forces + self.region.integral(density, group.entries, part.elements)
                total += sum(float(asked(effect, "energy", state).sum()) for effect in group.effects)
            dofs = self.region.dofs[part.elements].ravel()
            for component, force in enumerate(np.asarray(forces)):
                nodal[:, component] += np.bincount(dofs, force.ravel(), len(nodal))
        return total

    def hessian(self, u: Array) -> Array:
        """Element Hessians, (elements, shapes, component pairs, shapes)."""
        shapes, pairs = self.region.dofs.shape[1], len(PAIRS[self.region.components][0])
        out = np.zeros((len(self.region.elements), shapes, pairs * shapes))
        for part in self.parts:
            state = self.state(u, part)
            for group in self.groups:
                out[part.elements] += self._group_hessian(group, state, part)
        return out.reshape(-1, shapes, pairs, shapes)

    def _group_hessian(self, group: Group, state: PointState, part: Part) -> Array | float:
        density = _summed_hessian(group, state)
        if density is None:
            return 0.0
        count, pairs = len(group.entries), len(PAIRS[self.region.components][0])
        shapes = self._shapes(group.entries, part)
        elements, points, _, functions = shapes.shape
        # At every point rows (entry k, pair), columns entry l: times shape functions of l, then of k.
        rows = density.transpose(3, 0, 2, 1).reshape(-1, points, count * pairs, count)
        half = (np.ascontiguousarray(rows) @ shapes).reshape(-1, points * count, pairs * functions)
        return np.asarray(shapes.reshape(elements, points * count, functions).swapaxes(1, 2) @ half)

    def _shapes(self, entries: Entries, part: Part) -> Array:
        shapes = self.region.shapes(entries)
        return shapes if len(shapes) == 1 else shapes[part.elements]


def grouped(effects: Sequence[Effect], components: int) -> list[Group]:
    """Effects sorted into groups: an effect joins a larger one that reads all of its derivatives.

    Effects that read only the position form a separate group, because adding the position to the five
    derivatives of a shell would slow all of them. Effects that do no work are omitted.
    """
    effects = [effect for effect in effects if not effect.idle(components)]
    groups: list[Group] = []
    for effect in sorted(effects, key=lambda e: -len(e.entries)):
        for i, group in enumerate(groups):
            if set(effect.entries) <= set(group.entries):
                groups[i] = Group(group.entries, (*group.effects, effect))
                break
        else:
            groups.append(Group(tuple(effect.entries), (effect,)))
    return groups


def _rows(group: Group, effect: Effect) -> slice:
    """Slice of the entries of an effect among those of its group."""
    start = group.entries.index(effect.entries[0])
    assert group.entries[start : start + len(effect.entries)] == tuple(effect.entries)
    return slice(start, start + len(effect.entries))


def _summed_gradient(group: Group, state: PointState) -> Array:
    shape = (len(group.entries), state.components, state.measure.size)
    first, *others = group.effects
    total = asked(first, "gradient", state)
    if total.shape != shape:
        others, total = list(group.effects), np.zeros(shape)
    for effect in others:
        total[_rows(group, effect)] += asked(effect, "gradient", state)
    return np.asarray(total)


def _summed_hessian(group: Group, state: PointState) -> Array | None:
    total: Array | None = None
    for effect in group.effects:
        density = asked(effect, "hessian", state)
        if density is None:
            continue
        if total is None and len(effect.entries) == len(group.entries):
            total = density
            continue
        if total is None:
            count = len(group.entries)
            total = np.zeros((count, count, *density.shape[2:]))
        rows = _rows(group, effect)
        total[rows, rows] += density
    return total
