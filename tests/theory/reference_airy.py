"""A slow, literal second implementation of the paper's amplitude systems and of eq. 15.

Written term by term from appendix A.1 with the corrections E6, E8, E10-E12; no scaling, no tails.
"""

import numpy as np


def amplitudes(sheet, modes, r0):
    """A, C for c = cos(2 pi r0 y/L) and B, D for c = sin(2 pi r0 y/L), full linear systems."""
    length, width = sheet.length, sheet.width
    alpha = 2 * np.pi * np.arange(1, modes + 1) / width
    gamma = 2 * np.pi * np.arange(1, modes + 1) / length
    s = np.arange(1, 2 * modes, 2)
    delta = np.pi * s / length
    m = np.arange(1, modes + 1)[:, None]
    sign_mr = (-1.0) ** (m + np.arange(1, modes + 1))
    sign_ms = (-1.0) ** (m + (s - 1) // 2)
    a, g, d = alpha[:, None], gamma[None], delta[None]

    upper = sign_mr * 8 / width * a**2 * g * np.tanh(g * width / 2) / (a**2 + g**2) ** 2
    lower = sign_mr * 8 / length * a * g**2 * np.tanh(a * length / 2) / (a**2 + g**2) ** 2
    load = np.zeros(2 * modes)
    load[modes + r0 - 1] = 1
    even = np.block(
        [
            [np.diag(1 + alpha * length / np.sinh(alpha * length)), upper],
            [lower.T, np.diag(1 + gamma * width / np.sinh(gamma * width))],
        ]
    )
    a_c = np.linalg.solve(even, load)

    upper = sign_ms * 8 / width * a**2 * d * np.tanh(d * width / 2) / (a**2 + d**2) ** 2
    lower = sign_ms * 8 / length * a * d**2 / np.tanh(a * length / 2) / (a**2 + d**2) ** 2
    y, weights = np.polynomial.legendre.leggauss(40 + 4 * modes)
    y = y * length / 2
    b = np.array([(np.sin(2 * np.pi * r0 * y / length) * np.sin(k * y)) @ weights for k in delta])
    odd = np.block(
        [
            [np.diag(1 - alpha * length / np.sinh(alpha * length)), upper],
            [lower.T, np.diag(1 + delta * width / np.sinh(delta * width))],
        ]
    )
    b_d = np.linalg.solve(odd, np.concatenate([np.zeros(modes), b]))
    return a_c[:modes], b_d[:modes], a_c[modes:], b_d[modes:]


def stress_xx_even(sheet, a_m, c_r, r0, x, y):
    """sigma_xx = d^2 chi/dy^2 of eq. 15 for c = cos(2 pi r0 y/L) at one point."""
    length, width = sheet.length, sheet.width
    total = -np.cos(2 * np.pi * r0 * y / length)
    for m, amplitude in enumerate(a_m, 1):
        k = 2 * np.pi * m / width
        h = k * length / 2
        bracket = k * y * np.sinh(k * y) + (1 - h / np.tanh(h)) * np.cosh(k * y)
        total += amplitude * np.cos(k * x) / np.cosh(h) * bracket
    for r, amplitude in enumerate(c_r, 1):
        k = 2 * np.pi * r / length
        h = k * width / 2
        bracket = k * x * np.sinh(k * x) - (1 + h / np.tanh(h)) * np.cosh(k * x)
        total -= amplitude * np.cos(k * y) / np.cosh(h) * bracket
    return total
