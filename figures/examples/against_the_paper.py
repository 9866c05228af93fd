"""Which of the published speeds hold?

P. W. Miller and J. Dunkel, Soft Matter 16, 3991 (2020), give a closed form for a body on a line (eq. 8)
and the balance of friction for a sheet (eq. 11, figure 3). Speeds in L/T, positive along the wave.
"""

# %% A body on a line: as printed, and with the sign and the factor corrected
import numpy as np
from matplotlib.figure import Figure

from figures.common import style
from figures.measure import nonlinear
from linear_theory import Sheet, SineWave, crawl_speed, line_speed, second_order

alphas = np.linspace(0.0, 0.4, 9)
line, printed = line_speed(alphas), line_speed(alphas, form="printed")
print(f"line, alpha = 0.2: V = {line_speed(0.2):.6f} L/T exactly, as printed {printed[4]:.6f}")

# %% The paper's sheet: eq. 11 as it stands, and the leading coefficient of the nonlinear sheet
sheet, wave = Sheet(), SineWave()
first = [crawl_speed(sheet, wave, alpha, rtol=1e-2).mean for alpha in alphas[1:]]
leading = second_order(sheet, wave, rtol=3e-3)
coefficient = first[0] / alphas[1] ** 2
print(f"sheet, eq. 11: V = {coefficient:.2f} alpha² L/T")
print(f"nonlinear sheet: V = ({leading.second:.4f} ± {leading.second_error:.4f}) alpha² L/T")


# %% Figure 3, with speeds of the nonlinear sheet that `make tables` measured
def draw() -> Figure:
    """V over alpha: every theory, and the nonlinear sheet as symbols."""
    figure = style.figure(height=7.0)
    axes = figure.subplots()
    axes.plot(alphas, printed, "--", label="line, eq. 8 as printed")
    axes.plot(alphas, line, label="line, corrected")
    axes.plot(alphas[1:], first, label="sheet, eq. 11")
    axes.plot(alphas, leading.second * alphas**2, label="sheet, $V_2 \\alpha^2$")
    rows = [row for row in nonlinear.TABLE.read() if (row.body, row.friction) == ("sheet", "coulomb")]
    axes.plot([r.alpha for r in rows], [r.speed for r in rows], "ko", label="nonlinear sheet")
    axes.set(xlabel="$\\alpha$", ylabel="$V$  ($L/T$)")
    axes.legend()
    return figure


if __name__ == "__main__":
    print(*style.save(draw(), "example_against_the_paper", formats=("png",)))
