"""How much slower is a sheet when the end of it reflects part of the wave?

A wave of one's own is any function c(x, y, t) of NumPy arrays with its period. Here a wave of amplitude
1 runs towards +y, and one of amplitude r runs back.
"""

# %% The wave; r = 1 would be a standing wave, which moves nothing
import numpy as np
from matplotlib.figure import Figure

from figures.common import style
from linear_theory import FieldWave, Sheet, second_order

TAU = 2 * np.pi


def partly_reflected(share: float) -> FieldWave:
    """A sine towards +y and `share` of it backwards; y in lengths of the sheet, t in periods."""
    return FieldWave(
        lambda x, y, t: np.sin(TAU * (y - t)) + share * np.sin(TAU * (y + t)) + 0 * x, period=1.0
    )


# %% V = V_2 alpha^2 for small alpha, in sheet lengths L per period T
shares = (0.0, 0.2, 0.4, 0.6, 0.8)
found = [second_order(Sheet(), partly_reflected(share), rtol=1e-2) for share in shares]
for share, speed in zip(shares, found, strict=True):
    print(f"r = {share:.1f}: V = ({speed.second:.3f} ± {speed.second_error:.3f}) alpha² L/T")


# %% Compared with 1 - r², the share of the power that is not sent back
def draw() -> Figure:
    """V_2 over the reflected share of the amplitude."""
    figure = style.figure()
    axes = figure.subplots()
    speeds = [speed.second for speed in found]
    axes.errorbar(shares, speeds, [speed.second_error for speed in found], fmt="o", label="computed")
    r = np.linspace(0, 1)
    axes.plot(r, speeds[0] * (1 - r**2), label="$V_2(0)\\,(1 - r^2)$")
    axes.set(xlabel="reflected amplitude $r$", ylabel="$V/\\alpha^2$  ($L/T$)", ylim=(0, None))
    axes.legend()
    return figure


if __name__ == "__main__":
    print(*style.save(draw(), "example_own_wave", formats=("png",)))
