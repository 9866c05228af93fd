"""The FitzHugh–Nagumo equation (eq. 12 of the paper), and its solution on a body."""

from dataclasses import dataclass

from fem_check.excitable.excitation import Excitation
from fem_check.excitable.kinetics import Equation
from fem_check.excitable.methods import Method
from fem_check.excitable.space import Body


@dataclass(frozen=True)
class FitzHughNagumo(Equation):
    """c_t = γ² ∇²c + c (1 - c)(c - ν) - w,  w_t = ε (c - κ w), with Neumann edges (eq. 12).

    threshold: ν, > 0 excitable, < -εκ about oscillatory; recovery_decay: κ; recovery_rate: ε, both
    1/time; diffusion_length: γ, units of length (time has the unit of the reaction, 1). start: c and w
    at time 0, by default the paper's from the rear end. pacing: a periodic stimulus; feedback: of the
    strain of the sheet, added to c_t, see `StrainFeedback`; neither by default.

    Raises ValueError for numbers that are not finite, rates below 0 and a length that is not positive.

    >>> from fem_check import FitzHughNagumo
    >>> from linear_theory import Sheet
    >>> equation = FitzHughNagumo(-0.1, 1e-4, 0.05, 0.02)
    >>> solution = equation.on(Sheet(), until=100.0, rtol=1e-3)
    >>> print(f"c from {solution.smallest:.2f} to {solution.largest:.2f}")
    c from -0.48 to 0.83
    """

    def on(
        self, body: Body, until: float, rtol: float = 1e-3, method: Method | None = None
    ) -> Excitation:
        """The solution on a body from time 0 to `until`, see `Excitation`.

        body: a Sheet or an Outline; rtol: largest error of c, relative to the largest |c|; method:
        `Adaptive` by default, or `Euler`.
        """
        return Excitation(self, body, until, rtol, method)
