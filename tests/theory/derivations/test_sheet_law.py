"""Derivations: constitutive law, compatibility, shear and free edges (paper eqs 1a, 4, 10, 14)."""

import pytest
import sympy as sp

from tests.theory.derivations.sheet import ALPHA, NU, X, Y, biharmonic, hooke, stresses

# --- E5: constitutive law ------------------------------------------------------------------------


@pytest.mark.parametrize("raised", [True, False], ids=["indices raised by abar", "as printed"])
def test_plane_stress_law_follows_from_the_koiter_energy(raised):
    """E5: eq. 1a with abar = exp(2 alpha c), linearised, is eq. 10b with + alpha c (no factor 1+nu)."""
    small, c = sp.symbols("e c", real=True)
    xx, yy, xy = strain = sp.symbols("exx eyy exy", real=True)
    metric = sp.eye(2) + 2 * small * sp.Matrix([[xx, xy], [xy, yy]])
    rest = sp.exp(2 * small * ALPHA * c)
    change = metric - rest * sp.eye(2)
    change = change / rest if raised else change
    area = rest if raised else 1
    density = area / (8 * (1 - NU**2)) * ((1 - NU) * (change**2).trace() + NU * change.trace() ** 2)
    energy = sp.expand(sp.diff(density, small, 2).subs(small, 0)) / 2
    stress = [sp.diff(energy, xx), sp.diff(energy, yy), sp.diff(energy, xy) / 2]

    def residuals(factor):
        return [sp.simplify(a - b) for a, b in zip(hooke(stress, c, factor), strain, strict=True)]

    assert residuals(1) == [0, 0, 0]
    assert residuals(1 + NU) == [ALPHA * NU * c, ALPHA * NU * c, 0]


def test_printed_thermal_term_is_that_of_plane_strain():
    """E5: three-dimensional Hooke gives alpha c if sigma_zz = 0 and (1+nu) alpha c if eps_zz = 0."""
    c, xx, yy, zz = sp.symbols("c sxx syy szz", real=True)
    strain_x = xx - NU * (yy + zz) + ALPHA * c
    strain_z = zz - NU * (xx + yy) + ALPHA * c
    (constrained,) = sp.solve(strain_z, zz)
    thermal = {"plane stress": strain_x.subs(zz, 0), "plane strain": strain_x.subs(zz, constrained)}
    at_rest = {name: sp.factor(value.subs({xx: 0, yy: 0})) for name, value in thermal.items()}
    assert at_rest == {"plane stress": ALPHA * c, "plane strain": sp.factor((1 + NU) * ALPHA * c)}
    # and the rest of eq. 10b is plane stress, so that the print mixes the two:
    assert sp.expand(thermal["plane stress"] - ((1 + NU) * xx - NU * (xx + yy) + ALPHA * c)) == 0
    assert sp.expand(thermal["plane strain"] - ((1 + NU) * xx - NU * (xx + yy))).coeff(xx) != 0


def test_compatibility_gives_equation_14():
    """E5: with + alpha c, compatibility is eq. 14 (Y = 1); with (1+nu) alpha c it is not."""
    chi, c = sp.Function("chi")(X, Y), sp.Function("c")(X, Y)
    laplacian = sp.diff(c, X, 2) + sp.diff(c, Y, 2)

    def residual(factor):
        xx, yy, xy = hooke(stresses(chi), c, factor)
        incompatibility = sp.diff(xx, Y, 2) + sp.diff(yy, X, 2) - 2 * sp.diff(xy, X, Y)
        return sp.simplify(incompatibility - (biharmonic(chi) + ALPHA * laplacian))

    assert residual(1) == 0
    assert sp.simplify(residual(1 + NU) - NU * ALPHA * laplacian) == 0


# --- E6, E7: shear and free edges ------------------------------------------------------------------


def test_equilibrium_fixes_the_shear():
    """E6: d_i sigma_ij = 0 holds for sigma_xy = -d_xy chi, and not for the printed -2 d_xy chi."""
    chi = sp.Function("chi")(X, Y)
    xx, yy, xy = stresses(chi)

    def force(shear):
        return sp.diff(xx, X) + sp.diff(shear, Y), sp.diff(shear, X) + sp.diff(yy, Y)

    assert force(xy) == (0, 0)
    assert force(2 * xy) == (-sp.diff(chi, X, Y, 2), -sp.diff(chi, X, 2, Y))


def test_free_edges_also_need_the_mixed_derivative():
    """E7: sigma n = 0 is d_yy chi = d_xy chi = 0 on x = +-W/2 and d_xx chi = d_xy chi = 0 on y = +-L/2.

    chi = x y meets both printed conditions everywhere and still pulls at every edge.
    """
    chi = sp.Function("chi")(X, Y)
    xx, yy, xy = stresses(chi)
    tensor = sp.Matrix([[xx, xy], [xy, yy]])
    side, end = tensor * sp.Matrix([1, 0]), tensor * sp.Matrix([0, 1])
    assert list(side) == [sp.diff(chi, Y, 2), -sp.diff(chi, X, Y)]
    assert list(end) == [-sp.diff(chi, X, Y), sp.diff(chi, X, 2)]
    assert stresses(X * Y) == (0, 0, -1)
