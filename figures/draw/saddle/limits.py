"""What the page on V over growth and curvature says of soft, stiff and rigid ground.

Formulas are proved in tests/plate/test_derivations_limits.py; numbers are held by
tests/plate/test_plate_limits.py and tests/shell/test_heavy_elastica.py.
"""

STIFF_LIMIT = -0.0658
"""V_ab of the paper's sheet, viscous friction, on ever stiffer ground, L^2/T."""

NEAR_LIMIT = (0.01, 0.25)
"""An edge layer, in L, and how much larger V_ab is there, relatively."""

STRONGEST = 0.06
"""The edge layer, in L, at which its V_ab is largest."""

HEIGHT_ERROR = 5e-4
"""Of the ends of the static shell, relative."""

SHARE = f"{100 * NEAR_LIMIT[1]:g}"

TEXT = f"""**Limits.** Let l = (D/s)^(1/4), over which bending spreads a load. With lengths over L and
times over T a narrow strip under one sine, k = 2π, D = h³/12, has

| | soft ground, l ≫ 1 | stiff ground or thin sheet, l ≪ 1 |
| --- | --- | --- |
| V_ab, viscous friction | −(s/ρg) (1 − 12/k²)/(2k²) | −(D k²/2ρg) (1 − 2√2 l) |
| V_ab, dry friction | twice that | twice that |
| V_bb, dry friction | −(1 − 144/k⁴)/(4k²) | (√2/8) k² l³ (3l² − h²) |
| lift-off | ρg/(s max w), w of the free strip | ρg/√(D s) |

On soft ground the sheet takes its free shape and presses little. On stiff ground, and if it is thin,
it stays flat but for layers of length l at its edges. Away from these s w = −D (1 + ν)∇²c, and in the
weak sense, with its edges, p tends to D (1 + ν)/ρg ∇²c. A sheet with sides comes to this limit slowly:
under viscous friction that of the paper has V_ab = −{-STIFF_LIMIT:g} there, is still {SHARE} % away
at l = {NEAR_LIMIT[0]:g}, and has most at l = {STRONGEST:g}, almost twice as much.

**Rigid ground.** There full contact ends at once: `lift_off` falls like 1/√s. The strip with a natural
curvature κ is the heavy elastica then, beyond this theory. At any slope its end leaves the ground of
eq. 2 at √(8/3) = 1.63 times `lift_off`, since the ground presses with k z² and the theory with the
tangent to it. Then it stands Dκ²/(2ρg) + d/3 above the flat middle, which lies at the depth
d = √(ρg/k). Static shapes of the shell have this height within {100 * HEIGHT_ERROR:g} %, up to slopes
of 2/3."""
