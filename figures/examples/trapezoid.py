"""Does a trapezoid crawl faster than a rectangle of the same area?

Three sheets of the same length and area carry the same pulse of growth: a rectangle, one that narrows
towards its front, and one that narrows towards its rear. E = L = T = 1.
"""

# %% Outlines: `rear` wide at y = -1/2, `front` wide at y = 1/2; Outline(corners, holes) is any other
from matplotlib.figure import Figure
from matplotlib.patches import Polygon

from fem_check import Outline, plane_stress_field
from figures.common import style
from linear_theory import field_speed, pulse_wave

wave, alpha = pulse_wave(width=0.3), 0.05
outlines = {
    "rectangle": Outline.trapezoid(rear=0.5, front=0.5, length=1.0),
    "narrow front": Outline.trapezoid(rear=0.7, front=0.3, length=1.0),
    "narrow rear": Outline.trapezoid(rear=0.3, front=0.7, length=1.0),
}

# %% Deformation by linear finite elements, then the balance of friction
speeds = {
    name: field_speed(plane_stress_field(outline, wave, size=0.2), alpha, rtol=1e-2)
    for name, outline in outlines.items()
}
for name, speed in speeds.items():
    print(f"{name:>12}: V = {speed.mean:.5f} ± {speed.error:.5f} L/T")
slower = 1 - speeds["narrow front"].mean / speeds["rectangle"].mean
print(f"a taper costs {slower:.0%} of the speed, whichever end leads")


# %% Which end leads does not matter: a period run backwards and mirrored is the other case
def draw() -> Figure:
    """The outlines, with the distance per period as an arrow, enlarged 20 times."""
    figure = style.figure(style.DOUBLE_CM, 6.0)
    for axes, (name, outline) in zip(figure.subplots(1, 3), outlines.items(), strict=True):
        axes.add_patch(Polygon(outline.corners, facecolor=style.COLORS["sky"], alpha=0.5))
        look = {"arrowstyle": "-|>", "linewidth": 1.5, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", (0, 20 * speeds[name].mean), (0, 0), arrowprops=look)
        axes.set(xlim=(-0.5, 0.5), ylim=(-0.6, 0.6), aspect="equal", xlabel="$x/L$")
        axes.set_title(f"{name}: {speeds[name].mean:.4f} $L/T$")
    return figure


if __name__ == "__main__":
    print(*style.save(draw(), "example_trapezoid", formats=("png",)))
