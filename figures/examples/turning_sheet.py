"""On which circle does a sheet go whose wave is stronger on one side?

The amplitude of a sine wave rises across the sheet from 1/2 at the left edge to 3/2 at the right one,
so that the right side goes further in each period and the sheet turns to the left.
"""

# %% A wave that depends on x as well; x and y in lengths of the sheet, origin at its centre
import math

import numpy as np
from matplotlib.figure import Figure

from fem_check import predict
from figures.common import style
from linear_theory import FieldWave, Sheet, rigid_path

sheet, alpha = Sheet(length=1.0, width=0.5), 0.2
wave = FieldWave(lambda x, y, t: (1 + x / sheet.width) * np.sin(2 * np.pi * (y - t)), period=1.0)

# %% Velocity along, across and about the centre of mass of the nonlinear sheet
found = predict(sheet, wave, alpha, rtol=1e-2)

# %% The motion of one period, repeated
path = rigid_path(found.speed, periods=100)
turn, error = np.degrees([path.turn, path.turn_error])
print(f"turns by {turn:.3f} ± {error:.3f} degrees a period, a circle in {360 / turn:.0f} periods")
print(f"radius {path.radius:.3f} ± {path.radius_error:.3f} L, speed {path.speed:.4f} L/T")


# %% The path, with the sheet every ten periods
def draw() -> Figure:
    """Path of the centre of mass, and the axis of the sheet on it."""
    figure = style.figure()
    axes = figure.subplots()
    axes.plot(*path.position)
    every = path.times.size // 10
    for x, y, heading in zip(*path.position[:, ::every], path.heading[::every], strict=True):
        half = sheet.length / 2 * np.array([-math.sin(heading), math.cos(heading)])
        axes.plot([x - half[0], x + half[0]], [y - half[1], y + half[1]], color="0.6")
    axes.set(xlabel="$x/L$", ylabel="$y/L$", aspect="equal")
    return figure


if __name__ == "__main__":
    print(*style.save(draw(), "example_turning_sheet", formats=("png",)))
