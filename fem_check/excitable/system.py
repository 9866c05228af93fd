"""The equation on the nodes of a mesh: rates, Jacobian and their time derivatives."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fem_check.excitable.kinetics import Equation
from fem_check.excitable.space import Body, Space

Array = NDArray[np.float64]


DENSE = 160
"""Nodes up to which products with a dense matrix are faster: scipy takes 20 microseconds to begin one
with a sparse matrix."""


@dataclass(frozen=True, eq=False)
class System:
    """States are c and w at all nodes, one after the other, (2 n,).

    strain: tr ε at the nodes (n,) at a time, for a wave that it acts on; given, it is a source as the
    pacing is.
    """

    equation: Equation
    body: Body
    space: Space
    strain: Callable[[float], Array] | None = None

    @cached_property
    def diffusion(self) -> Any:
        """γ² M⁻¹ K."""
        return self.equation.diffusion_length**2 * self.space.laplacian

    @cached_property
    def _spreading(self) -> Any:
        """`diffusion` in the form whose products are fastest."""
        return self.diffusion.toarray() if self.space.size <= DENSE else self.diffusion

    @property
    def stiffness(self) -> float:
        """Bound of the rates of diffusion, 1/time."""
        return float(self.equation.diffusion_length**2 * self.space.fastest)

    @cached_property
    def first(self) -> Array:
        """The state at time 0."""
        x, y = self.space.nodes
        return np.concatenate(self.equation.start.values(x, y, self.body.length, self.body.width))

    @cached_property
    def stimulus(self) -> Array:
        """Profile of the pacing at the nodes; 0 without."""
        pacing, y = self.equation.pacing, self.space.nodes[1]
        return np.zeros_like(y) if pacing is None else pacing.profile(y, self.body.length)

    def rates(self, t: float, state: Array) -> Array:
        """d state/dt."""
        n, equation, out = state.size // 2, self.equation, np.empty_like(state)
        c, dc = state[:n], out[:n]
        equation.react(c, state[n:], dc, out[n:])
        dc -= self._spreading @ c
        if equation.pacing is not None:
            dc += self.stimulus * equation.pacing.course(t)
        if self.strain is not None and equation.feedback is not None:
            dc += equation.feedback.coefficient * self.strain(t)
        return out

    def jacobian(self, t: float, state: Array) -> Any:
        """Derivative of the rates with respect to the state, sparse."""
        c, n, e = state[: state.size // 2], self.space.size, self.equation
        one = sp.identity(n)
        blocks = [
            [sp.diags(e.slope(c)) - self.diffusion, -one],
            [e.recovery_rate * one, -e.recovery_rate * e.recovery_decay * one],
        ]
        return sp.bmat(blocks, format="csc")

    def derivatives(self, times: Array, states: Array) -> tuple[Array, Array]:
        """dc/dt and d²c/dt² at times (T,) for states (T, 2 n): (T, n) each, exact for these states."""
        (c, w), e = np.split(states, 2, axis=1), self.equation
        dc, dw = e.reaction(c, w)
        dc = dc - (self.diffusion @ c.T).T
        if e.pacing is not None:
            dc += np.multiply.outer(e.pacing.course(times), self.stimulus)
        second = e.slope(c) * dc - dw - (self.diffusion @ dc.T).T
        if e.pacing is not None:
            second += np.multiply.outer(e.pacing.change(times), self.stimulus)
        return dc, second
