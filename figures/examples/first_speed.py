"""How fast does my sheet crawl, and how sure is that?

A hydrogel strip of 40 x 15 x 0.8 mm swells by 12 % of its length at the crest of a sine wave that takes
8 s to run along it. Lengths and times are given in any units, here millimetres and seconds; results
are in the same.
"""

# %% The sheet, the wave and the growth strain per unit of the wave
import math

from matplotlib.figure import Figure

from fem_check import predict
from fem_check.output import Units
from figures.common import style
from linear_theory import Sheet, SineWave

sheet = Sheet(length=40.0, width=15.0, thickness=0.8)  # mm
wave = SineWave(period=8.0)  # s
alpha = math.log(1.12)  # growth of lengths is exp(alpha c)

# %% The cheapest theory whose numerical and model error together stay below 1 %
found = predict(sheet, wave, alpha, rtol=1e-2)

print(f"V = {found.mean:.4f} ± {found.error:.4f} mm/s, by the level {found.level!r}")
print(f"  = {found.mean * wave.period:.2f} mm per period, along the wave, which runs towards +y")
print(f"friction is {found.speed.regime}; left out: {found.left_out[0]}")


# %% The speed over one period: the sheet slips to and fro and gains a little
def draw() -> Figure:
    """V(t) with its mean, and the deformed sheet with the friction on it."""
    figure = style.figure(style.DOUBLE_CM, 7.0)
    left, right = figure.subplots(1, 2)
    found.plot("speed", ax=left, units=Units("mm", "s"))
    found.plot("sheet", ax=right, units=Units("mm", "s"))
    return figure


if __name__ == "__main__":
    print(*style.save(draw(), "example_first_speed", formats=("png",)))
