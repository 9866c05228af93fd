"""What does one more digit of the speed cost?

The same speed is asked for to tighter and tighter tolerances. Every answer claims an error; here the
true one is known too, from a far tighter tolerance and another solution of the deformation.
"""

# %% The paper's sheet in small-strain theory, by the Airy series
from matplotlib.figure import Figure

from figures.common import style
from linear_theory import Sheet, SineWave, crawl_speed

sheet, wave, alpha = Sheet(), SineWave(), 0.25
tolerances = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
found = [crawl_speed(sheet, wave, alpha, rtol=rtol, method="airy") for rtol in tolerances]

# %% The reference, by the method of Ritz
reference = crawl_speed(sheet, wave, alpha, rtol=1e-6, method="ritz")
errors = [abs(speed.mean - reference.mean) for speed in found]

print("asked   claimed    true   times solved   seconds")
for rtol, speed, error in zip(tolerances, found, errors, strict=True):
    claimed, true = speed.error / reference.mean, error / reference.mean
    print(f"{rtol:.0e}    {claimed:.0e}   {true:.0e}   {speed.times.size:>12}   {speed.seconds:.1g}")
print(f"V = {reference.mean:.7f} ± {reference.error:.7f} L/T")


# %% The claim lies below what was asked and above the truth
def draw() -> Figure:
    """Relative errors over the tolerance."""
    figure = style.figure()
    axes = figure.subplots()
    axes.loglog(tolerances, tolerances, color="0.6", label="asked")
    axes.loglog(tolerances, [speed.error / reference.mean for speed in found], "o-", label="claimed")
    axes.loglog(tolerances, [error / reference.mean for error in errors], "s", label="true")
    axes.set(xlabel="tolerance", ylabel="relative error of $V$")
    axes.legend()
    return figure


if __name__ == "__main__":
    print(*style.save(draw(), "example_cost_of_accuracy", formats=("png",)))
