"""Derivations: displacements of the terms."""

import pytest
import sympy as sp

from tests.theory.derivations.sheet import (
    ALPHA,
    HALF,
    NU,
    WAVENUMBER,
    X,
    Y,
    differs,
    even_profile,
    hooke,
    odd_profile,
    strain_of,
    stresses,
    vanishes,
)

# --- displacements ---------------------------------------------------------------------------------


def even_functions(k, half):
    z = k * Y
    scale, trace = sp.cosh(k * half), k * half * sp.coth(k * half)
    return (
        sp.cosh(z) / scale,
        (z * sp.sinh(z) - trace * sp.cosh(z)) / scale,
        sp.sinh(z) / scale,
        (z * sp.cosh(z) - trace * sp.sinh(z)) / scale,
    )


def odd_functions(k, half):
    z = k * Y
    scale, trace = sp.sinh(k * half), k * half * sp.tanh(k * half)
    return (
        sp.sinh(z) / scale,
        (z * sp.cosh(z) - trace * sp.sinh(z)) / scale,
        sp.cosh(z) / scale,
        (z * sp.sinh(z) - trace * sp.cosh(z)) / scale,
    )


@pytest.mark.parametrize(
    ("functions", "profile"), [(even_functions, even_profile), (odd_functions, odd_profile)]
)
def test_displacement_of_a_term(functions, profile):
    """For chi = cos(kx)/k^2 (p1 - p0) the displacement is, up to a rigid motion,

    u_x = sin(kx)/k [2 p0 + (1 + nu)(p1 - p0)], u_y = cos(kx)/k [2 s0 - (1 + nu) q1]:
    Hooke's law of plane stress, Young modulus 1, even and odd kind; 1 - nu in place of 1 + nu fails.
    """
    k, half = WAVENUMBER, HALF
    p0, p1, s0, q1 = functions(k, half)
    chi = sp.cos(k * X) / k**2 * (p1 - p0)
    assert vanishes(chi - sp.cos(k * X) * profile(k, half, Y))

    def residuals(factor):
        u_x = sp.sin(k * X) / k * (2 * p0 + factor * (p1 - p0))
        u_y = sp.cos(k * X) / k * (2 * s0 - factor * q1)
        return [a - b for a, b in zip(strain_of((u_x, u_y)), hooke(stresses(chi), 0), strict=True)]

    assert all(vanishes(residual) for residual in residuals(1 + NU))
    assert differs(residuals(1 - NU)[0])


def test_displacement_of_the_particular_solution():
    """Chi = alpha c/q^2, c = cos(q y): u = alpha (0, (1+nu) sin(q y)/q): eps_xx = 0 there."""
    q = sp.Symbol("q", positive=True)
    growth = sp.cos(q * Y)
    u = (sp.Integer(0), ALPHA * (1 + NU) * sp.sin(q * Y) / q)
    strain = hooke(stresses(ALPHA * growth / q**2), growth)
    assert [sp.expand(a - b) for a, b in zip(strain_of(u), strain, strict=True)] == [0, 0, 0]
