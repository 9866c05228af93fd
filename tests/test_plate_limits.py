"""The plate and V to second order on very soft and very stiff ground, and of very thin sheets.

With l = (D/s)^(1/4), lengths over L and times over T, a strip has (see `reference_strip`)

                    soft, l >> 1                            stiff or thin, l << 1
    V_ab, viscous   -(s/(rho g)) (1 - 12/k^2)/(2 k^2)       -(k^2 D/(2 rho g)) (1 - 2 sqrt(2) l)
    V_bb, dry       -(1 - 144/k^4)/(4 k^2)                  (sqrt(2)/8) k^2 l^3 (3 l^2 - h^2)
    lift-off        rho g/(s max w), free shape w           rho g/sqrt(D s)

Soft ground presses little and lets the sheet take its free shape; on stiff ground the sheet stays flat but
for layers at its edges, and pressure tends to D (1 + nu) times the Laplacian of c, in the weak sense:
V_ab tends to -D (1 + nu)/(rho g) <c lap v_y>. A thin sheet is one on stiff ground, with D -> 0.
"""

import math

import numpy as np
import pytest
import skfem
from skfem.helpers import dd, trace

from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane
from linear_theory import Scene, Sheet, SineWave, Tanh, Viscous, airy_series, second_order
from linear_theory.deformation.plate import Foundation, plate_field
from linear_theory.speed.plate.quadratic_form import QuadraticForm
from tests.reference_strip import K, Strip

WEIGHT, SINE = 2.5e-4, SineWave()


def form(sheet: Sheet, spring: float, law=None, rtol: float = 1e-3) -> QuadraticForm:
    """V of a sheet on a ground of rate s; law: for speeds per unit alpha."""
    material, law = Material(sheet.thickness, sheet.poisson), law or Viscous()
    ground = Gravity(WEIGHT), Ground((spring / 2) ** 2 / WEIGHT), Friction(1e-3, law=law)
    asked = Scene(sheet, SINE, 1.0, 0.0, [Membrane(material), Bending(material), *ground])
    return second_order(asked, rtol=rtol).coefficients


def strip_of(sheet: Sheet, spring: float) -> Strip:
    """The same without width."""
    return Strip(sheet.thickness**3 / 12, spring, WEIGHT, sheet.thickness)


# ---- one dimension, exactly


def test_strip_on_soft_ground() -> None:
    """Deviations are of first order in s/B."""
    rigidity, off = 2e-6, []
    for spring in (1e-7, 1e-8):
        strip = Strip(rigidity, spring, WEIGHT, 0.03)
        exact = -spring / WEIGHT * (1 - 12 / K**2) / (2 * K**2), -(1 - 144 / K**4) / (4 * K**2)
        off.append([strip.mixed() / exact[0] - 1, strip.bent() / exact[1] - 1])
    assert np.abs(off[1]).max() < 5e-5
    np.testing.assert_allclose(np.divide(*off), 10, rtol=2e-2)


@pytest.mark.parametrize("thickness", [0.0, 0.1])
def test_strip_on_stiff_ground(thickness: float) -> None:
    """Deviations are of second order in the layer for V_ab, of first for V_bb, of fourth for lift-off."""
    rigidity, off = 2e-6, []
    for spring in (1e3, 16e3):  # a layer of half the length
        strip = Strip(rigidity, spring, WEIGHT, thickness)
        length = strip.layer
        exact = (
            -(K**2) * rigidity / (2 * WEIGHT) * (1 - 2 * math.sqrt(2) * length),
            math.sqrt(2) / 8 * K**2 * length**3 * (3 * length**2 - thickness**2),
            WEIGHT / math.sqrt(rigidity * spring),
        )
        found = strip.mixed(), strip.bent(), strip.lift_off
        off.append([f / e - 1 for f, e in zip(found, exact, strict=True)])
    assert np.abs(off[1]).max() < 1e-2
    np.testing.assert_allclose(np.log2(np.divide(*off)), [4, 1, 4], rtol=0.1)
