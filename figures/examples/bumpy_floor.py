"""How much speed does a sheet lose on a bumpy floor?

A sheet that stretches and bends is stepped through time on elastic ground whose height is a wave of two
bumps to the length of the sheet. E = L = T = 1.
"""

# %% The ground is a formula here; a function of arrays x, y or a spline of measured heights also serves
import sympy
from matplotlib.figure import Figure

from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane, Scene, simulate
from figures.common import style
from linear_theory import Sheet, SineWave

material, y = Material(thickness=0.03, poisson=0.5), sympy.Symbol("y")


def on_bumps(height: float) -> Scene:
    """A sheet on bumps of that height above and below the mean."""
    ground = Ground(stiffness=0.5, height=height * sympy.cos(4 * sympy.pi * y))
    friction = Friction(coefficient=0.1, slip_speed=0.02)
    effects = (Membrane(material), Bending(material), Gravity(1e-4), ground, friction)
    return Scene(Sheet(), SineWave(), alpha=0.1, effects=effects, cells=(2, 8))


# %% Growth ramps up from rest, then two periods; the error includes their difference
heights = (0.0, 0.0025, 0.01)
runs = [simulate(on_bumps(height), periods=2, rtol=0.05) for height in heights]
for height, run in zip(heights, runs, strict=True):
    print(f"bumps of {height:.4f} L: V = {run.speed.mean:.4f} ± {run.speed.error:.4f} L/T")
lost = 1 - runs[1].speed.mean / runs[0].speed.mean
print(f"bumps of {heights[1] / material.thickness:.2f} thicknesses cost {lost:.0%}; on higher ones the")
print("speed depends on where the sheet is, which the error includes")


# %% Where the sheet was
def draw() -> Figure:
    """Position of the centre of mass over time."""
    figure = style.figure()
    axes = figure.subplots()
    for height, run in zip(heights, runs, strict=True):
        axes.plot(run.times, run.centre[1], label=f"{height:.4f} $L$")
    axes.set(xlabel="$t/T$", ylabel="centre of mass  $y/L$")
    axes.legend(title="height of the bumps")
    return figure


if __name__ == "__main__":
    print(*style.save(draw(), "example_bumpy_floor", formats=("png",)))
