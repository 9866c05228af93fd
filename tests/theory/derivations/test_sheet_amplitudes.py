"""Derivations: the amplitude equations of appendix A.1, with what the print has wrong."""

import mpmath
import pytest
import sympy as sp

from tests.theory.derivations.sheet import (
    FAMILIES,
    HALF,
    SIGN_S,
    WAVENUMBER,
    D,
    G,
    K,
    L,
    M,
    R,
    W,
    X,
    Y,
    differs,
    even_profile,
    even_projection,
    odd_profile,
    odd_projection,
    stresses,
    vanishes,
)

# --- E11, E12: the amplitude equations --------------------------------------------------------------


def test_own_terms_of_the_amplitude_equations():
    """Brackets of all four equations: 1 + 2kH/sinh(2kH) (A, C, D) and 1 - 2kH/sinh(2kH) (B).

    They are the normal stress of a term on its own pair of edges: k = k_m and H = L/2 (A, B), or
    k = g_r, d_s and H = W/2 (C, D). For W = L/2 these are the printed ones.
    """
    k, half, wave = WAVENUMBER, HALF, sp.cos(WAVENUMBER * X)
    for profile, sign in ((even_profile, 1), (odd_profile, -1)):
        own = stresses(wave * profile(k, half, Y))[1].subs(Y, half)
        assert vanishes(own - wave * (1 + sign * 2 * k * half / sp.sinh(2 * k * half)))
    own = stresses(sp.sin(k * Y) * even_profile(k, half, X))[0].subs(X, half)
    assert vanishes(own - sp.sin(k * Y) * (1 + 2 * k * half / sp.sinh(2 * k * half)))


@pytest.mark.parametrize(("family", "wavenumber"), [("C", G), ("D", D)])
def test_stress_of_c_and_d_terms_on_the_ends(family, wavenumber):
    """E11, E12: sigma_yy on y = L/2 is sign * [(1 - h coth h) cosh + gx sinh]/cosh h, h = g W/2.

    sign = (-1)^r for C and (-1)^((s-1)/2) for D.
    """
    sign = {"C": (-1) ** R, "D": SIGN_S}[family]
    g, h = wavenumber, wavenumber * W / 2
    stress = stresses(FAMILIES[family])[1].subs(Y, L / 2)
    bracket = (1 - h * sp.coth(h)) * sp.cosh(g * X) + g * X * sp.sinh(g * X)
    difference = sp.expand_trig(sp.expand(stress - sign * bracket / sp.cosh(h)))
    assert vanishes(difference)


def test_coupling_of_c_and_d_into_the_a_and_b_equations():
    """E11, E12: (-1)^m (8/W) k^2 g tanh(g W/2)/(k^2 + g^2)^2, g = g_r or d_s, times the sign above."""
    g, k = sp.symbols("g k", positive=True)
    integral, turn = even_projection(g, W / 2, k)
    derived = integral / sp.cosh(g * W / 2)
    corrected = turn * 8 / W * k**2 * g * sp.tanh(g * W / 2) / (k**2 + g**2) ** 2
    assert vanishes(derived - corrected)
    assert sp.cos(K * W / 2) == (-1) ** M
    assert sp.sin(K * W / 2) == 0
    assert corrected.subs(k, 0) == 0  # no resultant: m = 0 needs no equation

    printed = turn * 8 / L * k**2 * g * sp.tanh(k * L / 4) / (k**2 + g**2) ** 2
    assert differs((derived - printed).subs(W, L / 2))
    ratio = sp.simplify((corrected / printed).subs(W, L / 2))
    assert vanishes(ratio - 2 * sp.tanh(g * L / 4) / sp.tanh(k * L / 4))


def test_no_mode_saves_the_printed_a_and_b_equations():
    """E11, E12: corrected/printed = 2 tanh(g L/4)/tanh(k L/4) lies in (1.3, 2.01) for all modes.

    g L/4 >= pi/4 (s = 1), where tanh = 0.6558; k L/4 = pi m >= pi, where 0.99627 <= tanh < 1.
    """
    lowest = 2 * mpmath.tanh(mpmath.pi / 4)
    highest = 2 / mpmath.tanh(mpmath.pi)
    assert lowest > 1.3
    assert highest < 2.01
    assert 2 * mpmath.tanh(mpmath.pi / 2) / mpmath.tanh(mpmath.pi) > 1.8  # A-equation, r = m = 1


def test_coupling_of_a_into_the_c_equation():
    """C-equation, as printed: (-1)^(m+r) (8/L) k g^2 tanh(k L/2)/(k^2 + g^2)^2."""
    h = K * L / 2
    stress = stresses(FAMILIES["A"])[0].subs(X, W / 2)
    bracket = (1 - h * sp.coth(h)) * sp.cosh(K * Y) + K * Y * sp.sinh(K * Y)
    assert vanishes(sp.expand_trig(sp.expand(stress - (-1) ** M * bracket / sp.cosh(h))))
    g, k = sp.symbols("g k", positive=True)
    integral, turn = even_projection(k, L / 2, g)
    printed = turn * 8 / L * k * g**2 * sp.tanh(k * L / 2) / (k**2 + g**2) ** 2
    assert vanishes(integral / sp.cosh(k * L / 2) - printed)
    assert sp.cos(G * L / 2) == (-1) ** R


def test_coupling_of_b_into_the_d_equation():
    """D-equation, as printed: (-1)^(m+(s-1)/2) (8/L) k d^2 coth(k L/2)/(k^2 + d^2)^2."""
    h = K * L / 2
    stress = stresses(FAMILIES["B"])[0].subs(X, W / 2)
    bracket = (1 - h * sp.tanh(h)) * sp.sinh(K * Y) + K * Y * sp.cosh(K * Y)
    assert vanishes(sp.expand_trig(sp.expand(stress - (-1) ** M * bracket / sp.sinh(h))))
    d, k = sp.symbols("d k", positive=True)
    integral, turn = odd_projection(k, L / 2, d)
    printed = turn * 8 / L * k * d**2 * sp.coth(k * L / 2) / (k**2 + d**2) ** 2
    assert vanishes(integral / sp.sinh(k * L / 2) - printed)
    assert sp.simplify(sp.expand_trig(sp.sin(D * L / 2)) - SIGN_S) == 0


def test_narrow_sheet_stretches_freely_both_ways():
    """W -> 0 with the C-equation's C = alpha a/2: sigma = 0, so eps_xx = eps_yy = alpha c (see F1)."""
    g, xi, half = sp.symbols("g xi h", positive=True)  # half = g W/2, x = xi W/2
    profile = even_profile(g, half / g, X)
    own = 1 + 2 * half / sp.sinh(2 * half)

    def narrow(expression):  # sympy 1.14 loses h coth(h) in this limit: write it with sinh and cosh
        expression = expression.replace(sp.coth, lambda z: sp.cosh(z) / sp.sinh(z))
        return sp.series(expression.subs(X, xi * half / g), half, 0, 1).removeO()

    assert narrow(own) == 2
    xx, yy, xy = stresses(sp.cos(g * Y) * profile)
    particular, _, _ = stresses(sp.cos(g * Y) / g**2)
    terms = [sp.expand(narrow(sp.simplify(z / w))) for z, w in ((xx, particular), (yy, particular))]
    assert terms == [-2, 0]  # particular + (1/2) C-term: no sigma_xx, no sigma_yy
    assert narrow(sp.simplify(xy / sp.sin(g * Y))) == 0
