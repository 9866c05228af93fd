"""Newton's method with line search, for the free unknowns of a discretised sheet."""

import time
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.statics.equilibrium import ConvergenceError, Equilibrium
from fem_check.shell.statics.linear_solver import Factor, factorise
from fem_check.shell.statics.orientation import Orientation
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.saddle import NO_SADDLE, saddle
from fem_check.shell.statics.secants import NO_SECANTS, Secants
from fem_check.shell.statics.sparsity import Sparsity
from linear_theory.common import validation
from linear_theory.common.threads import one_blas_thread

Array = NDArray[np.float64]

FIRST_SHIFT = 1e-10
"""First multiple of its diagonal added to a Hessian that is not positive definite."""

SUFFICIENT_DECREASE = 1e-4
"""Smallest decrease of a step relative to that predicted by the slope (Armijo)."""

ROUNDOFF = 1e-12
"""Relative error of an energy: smaller decreases cannot be resolved."""

UNSEEN = 1e-6
"""Relative error of the energy of strains of 1e-10, which are differences of lengths of order 1. For
smaller predicted decreases the energy is unreliable, and a step that halves the forces is accepted."""

CONTRACTION = 0.5
"""A factor is reused as long as each correction is at most this fraction of the previous one: those
that would still follow the last one then add up to no more than it. A Hessian and its factor cost as
much as five evaluations of the forces."""

SMALLEST_STEP = 2.0**-30


@dataclass(eq=False)
class Minimiser:
    """Newton's method with a line search; symbolic factorisation and, optionally, the factor are
    reused.

    tolerance: root mean square over the sheet of the last correction, relative to the size of the
    sheet (the root of its area). iterations: limit per minimisation. keep_factor: reuse the factor of
    an earlier iteration or minimisation while it converges, for series of similar problems.
    check_stability: test for negative curvature at the end; if False, only if the last factorised
    Hessian had one. Raises ValueError for values out of range.
    """

    supports: Supports
    tolerance: float = 1e-8
    iterations: int = 60
    keep_factor: bool = False
    check_stability: bool = True
    sparsity: Sparsity = field(init=False)
    kept: "Factorised | None" = field(init=False, default=None)

    def __post_init__(self) -> None:
        self.tolerance = validation.tolerance(self.tolerance)
        self.iterations = validation.integer("iterations", self.iterations, 1)
        self.sparsity = Sparsity(self.supports.discretisation, self.supports.free)
        self.region = self.supports.discretisation.interior
        units = np.repeat(self.supports.discretisation.units, self.sparsity.components)
        self.units = units[self.sparsity.order]
        self.orientation = Orientation(self.region)

    @one_blas_thread
    def minimise(self, potential: Potential, start: Array, patience: int = 1) -> Equilibrium:
        """The minimum near `start` (size,), within `patience` times the usual iterations.

        Raises ConvergenceError if it is not found within the iterations or if the line search fails
        because every step inverts an element.
        """
        begin = time.perf_counter()
        search = _Search(self, potential, np.array(start, float))
        count = 0
        while search.correction > search.tolerance:
            if count == patience * self.iterations:
                text = f"no minimum within {count} iterations (last correction {search.correction:.2g})"
                raise ConvergenceError(text, search.state)
            search.advance()
            count += 1
        suspected = self.check_stability or search.shifted
        size = search.correction
        found = saddle(self, potential, search.state, size) if suspected else NO_SADDLE
        seconds = time.perf_counter() - begin
        return Equilibrium(
            search.state, search.energy, count, size, seconds, *found.curvature, found.mode
        )

    @property
    def length(self) -> float:
        """Root of the undeformed area."""
        return float(np.sqrt(self.region.measure.sum()))

    def rms(self, change: Array) -> float:
        """Root mean square over the sheet of a displacement (size,)."""
        square = (self.region.displacement(change, (0,))[0] ** 2).sum(0)
        return float(np.sqrt(square @ self.region.measure / self.region.measure.sum()))

    def factorised(
        self, potential: Potential, u: Array, shift: float, convex: bool = True
    ) -> "Factorised":
        """The Hessian at u, plus the smallest multiple of its diagonal that makes it definite.

        convex: of couplings take the semidefinite part, before a shift, if it is not definite. That is
        a better model far from a minimum; close to one it would converge slowly.
        """
        values = self.sparsity.assemble(potential.hessian_blocks(u))
        if not np.all(np.isfinite(values)):
            raise ConvergenceError("the Hessian is not finite", u)
        coupled = self._ordered(potential.coupled_hessian(u))
        factor, used = factorise(self.sparsity, values, coupled), 0.0
        if factor is None and coupled is not None and convex:
            coupled = self._ordered(potential.coupled_hessian(u, convex=True))
        while factor is None:
            used = max(FIRST_SHIFT, shift / 10) if used == 0 else 10 * used
            factor = factorise(self.sparsity, self._shifted(values, used, coupled), coupled)
        return Factorised(values, self._scale(values, coupled), used, factor, coupled=coupled)

    def factorised_again(
        self, values: Array, shift: float, secants: Secants, coupled: Any = None
    ) -> "Factorised":
        """The factor with these entries, shift, secants and couplings, reproduced bit for bit."""
        shifted = values if shift == 0 else self._shifted(values, shift, coupled)
        factor = factorise(self.sparsity, shifted, coupled)
        assert factor is not None
        return Factorised(values, self._scale(values, coupled), shift, factor, secants, coupled)

    def _ordered(self, coupled: Any) -> Any:
        """The Hessian of the couplings for the free unknowns in their order."""
        order = self.sparsity.order
        return None if coupled is None else coupled[order][:, order]

    def _scale(self, values: Array, coupled: Any = None) -> Array:
        """Unit of the shifts of the diagonal, (n,)."""
        diagonal = values[self.sparsity.diagonal]
        if coupled is not None:
            diagonal = diagonal + coupled.diagonal()
        diagonal = np.abs(diagonal) * self.units**2
        return np.asarray(np.maximum(diagonal, 1e-12 * diagonal.max()) / self.units**2)

    def _shifted(self, values: Array, shift: float, coupled: Any = None) -> Array:
        shifted = values.copy()
        shifted[self.sparsity.diagonal] += shift * self._scale(values, coupled)
        return shifted


@dataclass(frozen=True, eq=False)
class Factorised:
    """Stored entries of a Hessian, and the factor of values + shift * diag(scale).

    secants: what steps since then have taught of it. coupled: sparse (n, n), the part of the Hessian
    between distant parts of the sheet; None if these do not act on each other.
    """

    values: Array
    scale: Array
    shift: float
    factor: Factor
    secants: Secants = NO_SECANTS
    coupled: Any = None


class _Search:
    """One minimisation: the present state with its energy and derivatives.

    correction: root mean square over the sheet of the last one.
    """

    def __init__(self, minimiser: Minimiser, potential: Potential, state: Array) -> None:
        self.minimiser, self.potential, self.state = minimiser, potential, state
        self.directors = self._directors(state)
        if not minimiser.orientation.keeps(self.directors, self.directors):
            raise ConvergenceError("the initial state is inverted, or has no area, somewhere", state)
        self.energy, gradient = potential.energy_and_gradient(state)
        self.gradient = gradient[minimiser.sparsity.order]
        self.current: Factorised | None = minimiser.kept if minimiser.keep_factor else None
        self.fresh = self.inverts = False
        self.correction = np.inf
        self.tolerance = minimiser.tolerance * minimiser.length
        if not np.isfinite(self.energy):
            raise ConvergenceError("the energy of the initial state is not finite", state)

    def advance(self) -> None:
        """Make one correction."""
        size = self._correct() if self.current is not None else None
        if size is None:
            self._factorise()
            size = self._correct()
        if size is None:
            raise ConvergenceError(self._why(), self.state)
        if not self.minimiser.keep_factor:
            self.current = None
        self.correction, self.fresh = size, False

    def _why(self) -> str:
        """Why no step is possible."""
        if not self.inverts:
            return "line search failed: the energy does not decrease along any step"
        areas = np.sqrt((self.directors**2).sum(0))
        x, y = self.minimiser.region.parameters.reshape(2, -1)[:, areas.argmin()]
        return (
            f"line search failed: every step inverts an element, near x = {x:.3g}, y = {y:.3g}, where "
            f"the area is {areas.min():.3g} of the undeformed one"
        )

    def _factorise(self) -> None:
        before = 0.0 if self.minimiser.kept is None else self.minimiser.kept.shift
        self.current = self.minimiser.factorised(self.potential, self.state, before)
        self.minimiser.kept, self.fresh = self.current, True

    def _correct(self) -> float | None:
        """Correct with the present factor; None if it does not converge (any longer)."""
        assert self.current is not None
        step = -self.current.secants.solve(self.current.factor, self.gradient)
        change = np.zeros_like(self.state)
        change[self.minimiser.sparsity.order] = step
        size = self.minimiser.rms(change)
        if not self.fresh and (self.current.shift > 0 or size > CONTRACTION * self.correction):
            return None
        slope, self.inverts = float(step @ self.gradient), True
        share = self.potential.reach(self.state, change)
        if size <= self.tolerance and share == 1 and self._accept_last(self.state + change, slope):
            return size
        while share >= (SMALLEST_STEP if self.fresh else 1.0):
            before = self.gradient
            if self._accept(self.state + share * change, share * slope):
                self._learn(share * step, self.gradient - before)
                return size
            share /= 2
        return None

    def _learn(self, step: Array, change: Array) -> None:
        """Correct the factor, if it is kept, by a step and the change of the gradient along it."""
        if not self.minimiser.keep_factor or self.current is None or self.current.shift > 0:
            return
        secants = self.current.secants.with_step(step, change)
        self.minimiser.kept = self.current = replace(self.current, secants=secants)

    def _accept_last(self, trial: Array, slope: float) -> bool:
        """Accept a step within the tolerance, whose energy the quadratic model gives to roundoff."""
        assert self.current is not None
        if self.current.shift > 0:
            return False
        if not self.minimiser.orientation.keeps(self.directors, self._directors(trial)):
            return False
        self.state, self.energy = trial, self.energy + slope / 2
        return True

    def _directors(self, state: Array) -> Array:
        return self.minimiser.orientation.directors(state, self.potential.shape(state))

    def _accept(self, trial: Array, slope: float) -> bool:
        directors = self._directors(trial)
        if not self.minimiser.orientation.keeps(self.directors, directors):
            return False
        self.inverts = False
        energy, gradient = self.potential.energy_and_gradient(trial)
        if not np.isfinite(energy):
            return False
        allowed = self.energy + SUFFICIENT_DECREASE * slope + ROUNDOFF * abs(self.energy)
        unseen = -slope <= ROUNDOFF * max(abs(self.energy), abs(energy))
        force = gradient[self.minimiser.sparsity.order]
        if not energy <= allowed and not unseen and not self._relaxed(force, slope):
            return False
        self.state, self.energy, self.directors = trial, energy, directors
        self.gradient = force
        return True

    def _relaxed(self, force: Array, slope: float) -> bool:
        """Whether a step within the noise of the energy halves the forces."""
        assert self.current is not None
        flat = self.current.shift == 0 and -slope <= UNSEEN * abs(self.energy)
        after, before = ((f**2 / self.current.scale).sum() for f in (force, self.gradient))
        return bool(flat and 4 * after <= before)

    @property
    def shifted(self) -> bool:
        """Whether the last factorised Hessian was not positive definite."""
        return self.minimiser.kept is not None and self.minimiser.kept.shift > 0
