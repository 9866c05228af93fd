"""Slow, literal balances of friction: eq. 11 on one fine grid, and the convex function itself."""

from functools import lru_cache

import numpy as np
from scipy.optimize import brentq


def grid(sheet, across, along):
    """Midpoints of a grid of cells, x (across, 1) and y (along,)."""
    x = ((np.arange(across) + 0.5) / across - 0.5) * sheet.width
    y = ((np.arange(along) + 0.5) / along - 0.5) * sheet.length
    return x[:, None], y


@lru_cache(maxsize=2)
def on_grid(field, t, points):
    """Velocity per unit alpha and strain at one time, which takes most of the time of a balance."""
    x, y = grid(field.sheet, *points)
    return field.velocity(x, y, t), field.strain(x, y, t)


def speed_at(field, alpha, t, load="current", force=lambda r: 1 / r, points=(400, 800)):
    """V_y at one time: eq. 11 by the midpoint rule and bisection. force: f(r)/r."""
    x, y = grid(field.sheet, *points)
    velocity, strain = on_grid(field, t, points)
    v = alpha * velocity
    rate = {
        "current": strain[0] + strain[1],
        "grown": 2 * field.wave.value(x, y, t, field.sheet.length),
        "material": 0 * strain[0],
    }[load]

    def balance(speed):
        r = np.hypot(v[0], v[1] + speed)
        return np.mean((1 + alpha * rate) * force(r) * (v[1] + speed))

    return brentq(balance, -v[1].max() - 1e-9, -v[1].min() + 1e-9, xtol=1e-14)


def dissipation(field, alpha, t, motion, points=(200, 400)):
    """Integral of (1 + alpha tr eps) |v + V + Omega x r| over the sheet, which the motion minimises."""
    x, y = np.broadcast_arrays(*grid(field.sheet, *points))
    velocity, strain = on_grid(field, t, points)
    v = alpha * velocity
    v_x, v_y, omega = motion
    speed = np.hypot(v[0] + v_x - omega * y, v[1] + v_y + omega * x)
    return float(np.mean((1 + alpha * (strain[0] + strain[1])) * speed))


def gauge(law, v_x, v_y):
    """phi(v) of forward, backward, sideways friction whose forward axis is turned by `heading`."""
    cosine, sine = np.cos(law.heading), np.sin(law.heading)
    aside, ahead = cosine * v_x + sine * v_y, cosine * v_y - sine * v_x
    own = np.where(ahead < 0, law.backward, law.forward)
    return np.sqrt((law.sideways * aside) ** 2 + (own * ahead) ** 2)


def directional_dissipation(field, alpha, t, law, motion, points=(200, 400), share=None):
    """Integral of mu(x, y, t) (1 + alpha tr eps) phi(v + V + Omega x r) over the sheet."""
    x, y = np.broadcast_arrays(*grid(field.sheet, *points))
    v = alpha * field.velocity(x, y, t)
    strain = field.strain(x, y, t)
    v_x, v_y, omega = motion
    phi = gauge(law, v[0] + v_x - omega * y, v[1] + v_y + omega * x)
    weight = 1.0 if share is None else share(x, y, t)
    return float(np.mean(weight * (1 + alpha * (strain[0] + strain[1])) * phi))
