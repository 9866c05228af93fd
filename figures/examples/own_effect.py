"""Does a sheet crawl faster with stiff fibres across it, which do not grow?

An effect of one's own is an energy of the position and its derivatives, with gradient and Hessian.
"""

# %% Threads across the sheet store k/8 (a_11 - 1)² per area, a_11 = |x_1|² the square of their stretch
from dataclasses import dataclass

from matplotlib.figure import Figure

from fem_check import Material, Membrane, Scene, cycle_speed
from fem_check.shell.effects.effect import Array, Effect
from fem_check.shell.kinematics.point_state import PointState, dot
from figures.common import style
from linear_theory import Sheet, SineWave
from linear_theory.common.pairs import identity, outer
from linear_theory.common.shown import Value


@dataclass(frozen=True)
class Fibres(Value, Effect):
    """Threads along x of stiffness k, force per length."""

    k: float
    entries = (1,)  # it reads x_1, of x, x_1, x_2, x_11, x_22, x_12
    stored_as = "elastic"  # in the balance of power

    def energy(self, state: PointState) -> Array:
        return self.k / 8 * state.measure * self._excess(state) ** 2

    def gradient(self, state: PointState) -> Array:
        return (self.k / 2 * state.measure * self._excess(state) * state.tangent(1))[None]

    def hessian(self, state: PointState) -> Array:
        x1, one = state.tangent(1), identity(state.components)
        return (self.k * state.measure * (self._excess(state) / 2 * one + outer(x1, x1)))[None, None]

    def _excess(self, state: PointState) -> Array:
        return dot(state.tangent(1), state.tangent(1)) - 1


# %% The paper's sheet with ever stiffer fibres; k in units of the stiffness of the sheet, E h
sheet = Scene(Sheet(), SineWave(), alpha=0.2, effects=(Membrane(Material(0.03, 0.5)),), cells=(2, 8))
ratios, found = (0.01, 0.1, 1.0, 10.0, 1000.0), []
for ratio in ratios:
    found.append(cycle_speed(sheet.but(effects=(*sheet.effects, Fibres(0.03 * ratio))), rtol=1e-2))
    print(f"k = {ratio:6g} E h: V = {found[-1].mean:.4f} ± {found[-1].error:.4f} L/T")


def draw() -> Figure:
    """V over the stiffness of the fibres."""
    figure = style.figure()
    axes = figure.subplots(subplot_kw={"xlabel": "$k/(E h)$", "ylabel": "$V$  ($L/T$)"})
    axes.semilogx(ratios, [speed.mean for speed in found], "o-")
    return figure


if __name__ == "__main__":
    print(*style.save(draw(), "example_own_effect", formats=("png",)))
