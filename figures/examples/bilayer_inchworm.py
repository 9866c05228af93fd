"""Does a sheet of two layers that bends crawl the same way as one that only stretches?

Only the upper one of two bonded layers grows, so that the sheet bends where it grows and arches off the
ground between its points of contact. It lies on elastic ground under its weight; E = L = T = 1.
"""

# %% The couplings of the two layers: strain of the middle surface, and curvature, per unit of the wave
from matplotlib.figure import Figure

from fem_check import Bending, Gravity, Ground, Material, Membrane, Scene, bilayer, cycle_speed
from figures.common import style
from linear_theory import CrawlSpeed, Sheet, SineWave

sheet = Sheet(length=1.0, width=0.5, thickness=0.03)
material = Material(sheet.thickness, sheet.poisson)
alpha, curvature = bilayer(growth=0.04, thickness=sheet.thickness)
effects = (Membrane(material), Bending(material), Gravity(2.5e-4), Ground(stiffness=0.5))


# %% A cycle of static shapes: friction is weak against the stiffness
def speed_with(coupling: float) -> CrawlSpeed:
    """Mean speed for a rest curvature of -coupling c."""
    scene = Scene(sheet, SineWave(), alpha, coupling, effects, cells=(2, 8))
    return cycle_speed(scene, rtol=2e-2)


flat, bent = speed_with(0.0), speed_with(curvature)
for name, speed in (("stretches", flat), (f"bends, curvature {curvature:.1f}/L at most", bent)):
    sign = "along" if speed.mean > 0 else "against"
    print(f"{name}: V = {speed.mean:.5f} ± {speed.error:.5f} L/T, {sign} the wave")


# %% V(t) of both: where the sheet presses harder on the ground it rubs more
def draw() -> Figure:
    """Velocity over a period."""
    figure = style.figure()
    axes = figure.subplots()
    for name, speed in (("stretches", flat), ("bends", bent)):
        axes.plot(speed.times, speed.velocity, label=f"{name}: mean {speed.mean:.4f}")
    axes.axhline(0, color="0.6", linewidth=0.6)
    axes.set(xlabel="$t/T$", ylabel="$V(t)$  ($L/T$)")
    axes.legend()
    return figure


if __name__ == "__main__":
    print(*style.save(draw(), "example_bilayer_inchworm", formats=("png",)))
