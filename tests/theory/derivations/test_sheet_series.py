"""Derivations: the whole series frees the ends of traction, and its slow tails."""

from itertools import pairwise

import mpmath
import numpy as np
import pytest
import sympy as sp

from tests.theory.derivations.sheet import L, W, tail_factor, vanishes, wedge_matrix

# --- the whole series ------------------------------------------------------------------------------


def amplitudes(modes, width=0.5, odd=False, printed=False, tail=0):
    """Wave numbers, A_m and C_r (or B_m and D_s) and K on a sheet of L = 1; m <= modes, r <= 2 modes.

    Load: cos(2 pi y), or odd: sin(2 pi y) less its stress-free linear part, as in E10.
    tail > modes: (-1)^m K/m and the balancing tail of the other family are carried up to that mode,
    with K = (-1)^M M A_M at the last; otherwise K means nothing.
    """

    def family(r):  # wave numbers, signs, partner of the tail 1/m
        if odd:
            return (2 * r - 1) * np.pi, (-1.0) ** (r - 1), -2 / (2 * r - 1)
        return 2 * r * np.pi, (-1.0) ** r, -1 / r

    def own(z, sign=1):
        return np.diag(1 + sign * 2 * z / np.sinh(np.minimum(2 * z, 600)))

    def ends(k, g):
        strength, side = (8, k / 4) if printed else (8 / width, g * width / 2)
        return strength * k**2 * g * np.tanh(side) / (k**2 + g**2) ** 2

    def sides(k, g):
        return 8 * k * g**2 * np.tanh(k / 2) ** (-1 if odd else 1) / (k**2 + g**2) ** 2

    m, r = np.arange(1, modes + 1), np.arange(1, 2 * modes + 1)
    k, sign_m = 2 * np.pi * m[:, None] / width, (-1.0) ** m
    g, sign_r, _ = family(r)
    size = 3 * modes
    matrix = np.zeros((size + 1, size + 1))
    matrix[:modes, :modes] = own(k[:, 0] / 2, -1 if odd else 1)
    matrix[:modes, modes:size] = sign_m[:, None] * sign_r * ends(k, g)
    matrix[modes:size, :modes] = (sign_m[:, None] * sign_r * sides(k, g)).T
    matrix[modes:size, modes:size] = own(g * width / 2)
    matrix[size, [modes - 1, size]] = sign_m[-1] * modes, -1
    if tail:
        far_m = np.arange(modes + 1, tail + 1)
        far_g, _, partner = family(np.arange(2 * modes + 1, tail + 1))
        matrix[:modes, size] = sign_m * (ends(k, far_g) @ partner)
        matrix[modes:size, size] = sign_r * (1 / far_m @ sides(2 * np.pi * far_m[:, None] / width, g))
    load = np.zeros(size + 1)
    a = 2 * np.pi
    load[modes:size] = -4 * a**3 * sign_r / (g**2 * (g**2 - a**2)) if odd else r == 1
    solution = np.linalg.solve(matrix, load)
    return k[:, 0], g, solution[:modes], solution[modes:size], solution[size]


def end_traction(x, k, g, a, c, width, odd):
    """sigma_yy on y = L/2 = 1/2, differentiated from eq. 15 without any projection."""
    r = np.arange(1, g.size + 1)
    signs = (-1.0) ** (r - 1) if odd else (-1.0) ** r
    own = 1 + (-1 if odd else 1) * k / np.sinh(np.minimum(k, 600))
    h, z = g * width / 2, np.outer(x, g)
    cosh = (np.exp(z - h) + np.exp(-z - h)) / (1 + np.exp(-2 * h))
    sinh = (np.exp(z - h) - np.exp(-z - h)) / (1 + np.exp(-2 * h))
    return np.cos(np.outer(x, k)) @ (a * own) + ((1 - h / np.tanh(h)) * cosh + z * sinh) @ (c * signs)


def central_stress(k, g, a, c, _tail, width=0.5):
    """sigma_xx at the centre for the even load (the tails of A and C are negligible there)."""

    def cosh(z):
        return np.cosh(np.minimum(z, 600))

    h, w = k / 2, g * width / 2
    return -1 + a @ ((1 - h / np.tanh(h)) / cosh(h)) + c @ ((1 + w / np.tanh(w)) / cosh(w))


@pytest.mark.parametrize("odd", [False, True], ids=["A and C", "B and D"])
@pytest.mark.parametrize("width", [0.5, 0.8])
def test_corrected_amplitudes_free_the_ends(width, odd):
    """E11, E12 as a whole: sigma_yy on y = L/2 tends to 0 with more modes; with the print it does not.

    Measured on the middle 80 % of the edge, away from the slow convergence at the corners (E13).
    """
    nodes, weights = np.polynomial.legendre.leggauss(60)
    x = 0.8 * nodes * width / 2

    def traction(modes, printed=False):
        k, g, a, c, _ = amplitudes(modes, width, odd, printed)
        return np.sqrt(weights @ end_traction(x, k, g, a, c, width, odd) ** 2 / 2)

    coarse, fine = traction(10), traction(40)
    assert fine < 0.3 * coarse
    if width == 0.5:  # the print is for W = L/2 only
        coarse_print, fine_print = traction(10, printed=True), traction(40, printed=True)
        assert fine_print > 0.99 * coarse_print
        assert fine_print > 10 * fine


# --- E13: the slow tails ---------------------------------------------------------------------------


def test_integral_of_the_tail_balance():
    """E13: int_0^inf t^-s/(1 + t^2)^2 dt = (pi/4)(1 + s)/cos(pi s/2), -3 < s < 1."""
    s, t = sp.symbols("s t", positive=True)
    integral = sp.integrate(t ** (-s) / (1 + t**2) ** 2, (t, 0, sp.oo), conds="none")
    assert sp.simplify(integral - sp.pi / 4 * (1 + s) / sp.cos(sp.pi * s / 2)) == 0
    for value in (-1.5, 0.0, 0.4):
        numeric = mpmath.quad(lambda z, v=value: z**-v / (1 + z * z) ** 2, [0, 1, mpmath.inf])
        assert numeric == pytest.approx(np.pi / 4 * (1 + value) / np.cos(np.pi * value / 2), rel=1e-6)


def test_exponents_of_the_tails():
    """E13: A ~ (-1)^m a k^-lam, C ~ (-1)^r c g^-lam balance for sin(pi lam/2) = +-lam, any L and W."""
    lam, a, c = sp.symbols("lambda a c", nonzero=True)
    step_k, step_g = 2 * sp.pi / W, 2 * sp.pi / L
    first = a + tail_factor(W, c, step_g, lam)
    second = c + tail_factor(L, a, step_k, lam)
    determinant = sp.Matrix([[1, first.coeff(c)], [second.coeff(a), 1]]).det()
    f = lam / sp.sin(sp.pi * lam / 2)
    assert sp.simplify((determinant - (1 - f**2)).rewrite(sp.sin)) == 0

    k_at_one = {lam: 1}  # lam = 1: A = (-1)^m K/m and C = -(-1)^r K/r with one K
    tail = sp.Symbol("K")
    common = {a: tail * step_k, c: -tail * step_g}
    assert sp.simplify(first.subs(k_at_one).subs(common)) == 0
    assert sp.simplify(second.subs(k_at_one).subs(common)) == 0
    opposite = {a: tail * step_k, c: tail * step_g}
    assert sp.simplify(first.subs(k_at_one).subs(opposite)) != 0


def test_odd_tail_is_twice_as_strong():
    """E13, odd pair: B = (-1)^m K/m goes with D = -2 (-1)^((s-1)/2) K/s (d_s is spaced by 2 pi/L)."""
    tail, s = sp.symbols("K s", positive=True)
    b, d = sp.symbols("b d")
    step_k, step_d = 2 * sp.pi / W, 2 * sp.pi / L
    balances = [b + tail_factor(W, d, step_d, 1), d + tail_factor(L, b, step_k, 1)]
    (ratio,) = {sp.simplify(sp.solve(balance, d)[0]) for balance in balances}
    mode_d = (ratio / (s * sp.pi / L)).subs(b, tail * step_k)
    assert sp.simplify(mode_d + 2 * tail / s) == 0


def test_exponents_are_those_of_a_free_right_angled_corner():
    """E13: free wedge of 90 degrees: sin(pi lam/2) = -lam (symmetric) or +lam (antisymmetric)."""
    lam = sp.Symbol("lambda")
    r, theta = sp.symbols("r theta", positive=True)
    for part in (lam + 1, lam - 1):  # Williams' functions are biharmonic
        chi = r ** (lam + 1) * sp.cos(part * theta)
        for _ in range(2):
            chi = sp.diff(chi, r, 2) + sp.diff(chi, r) / r + sp.diff(chi, theta, 2) / r**2
        assert sp.simplify(chi) == 0
    for symmetric, sign in ((True, 1), (False, -1)):
        determinant = wedge_matrix(lam, symmetric).det()
        expected = sp.sin(sp.pi * lam / 2) + sign * lam
        factor = sp.simplify((determinant / expected).subs(lam, sp.Rational(1, 3)))
        assert factor**2 == 1
        assert vanishes(determinant - factor * expected)


def test_next_exponents():
    """E13: the roots after lam = 1 are 2.7396 + 1.1190 i (symmetric) and 4.8083 + 1.4639 i."""
    for sign, start, expected in (
        (-1, 2.7 + 1.1j, 2.739593 + 1.119025j),
        (1, 4.8 + 1.5j, 4.808251 + 1.463928j),
    ):
        root = mpmath.findroot(lambda z, a=sign: mpmath.sin(mpmath.pi * z / 2) - a * z, start)
        assert complex(root) == pytest.approx(expected, abs=1e-6)
        inside = winding(lambda z, a=sign: mpmath.sin(mpmath.pi * z / 2) - a * z, 1.5, root.real + 0.5)
        assert inside == 2  # the pair of conjugates: no other root with 1.5 < Re lam
    assert mpmath.sin(mpmath.pi / 2) == 1


def winding(function, left, right, height=6.0, points=4000):
    """Number of zeros in left < Re z < right, |Im z| < height, by the argument principle."""
    corners = [complex(left, -height), complex(right, -height), complex(right, height)]
    corners += [complex(left, height), corners[0]]
    side = np.linspace(0, 1, points // 4)
    path = np.concatenate([p + (q - p) * side for p, q in pairwise(corners)])
    values = np.array([complex(function(z)) for z in path])
    return round(float(np.sum(np.angle(values[1:] / values[:-1]))) / (2 * np.pi))


@pytest.mark.parametrize(("odd", "partner"), [(False, -1), (True, -2)])
def test_computed_amplitudes_have_the_tails(odd, partner):
    """E13: (-1)^m m A_m tends to K and (-1)^r r C_r to -K, (-1)^m m B_m to K and sigma_s s D_s to -2K.

    So the amplitudes of fig. 7 decay like 1/m, not rapidly. The tails are not put in here.
    """
    _, _, a, c, _ = amplitudes(250, odd=odd)
    m, r = np.arange(1, a.size + 1), np.arange(1, c.size + 1)
    first = (-1.0) ** m * m * a
    second = (-1.0) ** (r - 1) * (2 * r - 1) * c if odd else (-1.0) ** r * r * c
    tail = amplitudes(40, odd=odd, tail=6000)[-1]
    assert first[29:40] == pytest.approx(tail, rel=0.01)
    assert second[29:40] == pytest.approx(partner * tail, rel=0.01)
    assert abs(tail) > 0.2


def test_carrying_the_tail_beats_plain_truncation():
    """E13: error of sigma_xx at the centre 1.4e-5 at M = 20, of order M^-2; < 1e-7 with the tail."""
    exact = central_stress(*amplitudes(40, tail=6000))
    plain = {n: abs(central_stress(*amplitudes(n)) - exact) for n in (10, 20, 40)}
    assert plain[20] == pytest.approx(1.36e-5, rel=0.03)
    assert plain[10] / plain[20] == pytest.approx(4, rel=0.1)
    assert plain[20] / plain[40] == pytest.approx(4, rel=0.1)
    carried = abs(central_stress(*amplitudes(20, tail=6000)) - exact)
    assert carried < plain[20] / 100
