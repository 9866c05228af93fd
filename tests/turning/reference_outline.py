"""Slow, literal balance of friction on a quadrilateral: the convex function on one fine grid."""

import numpy as np
from scipy.optimize import minimize


def grid(corners, count):
    """Points x, y (n,) of a bilinear grid on a quadrilateral (4, 2), and their shares of its area."""
    s = (np.arange(count) + 0.5) / count
    s, t = (v.ravel() for v in np.meshgrid(s, s, indexing="ij"))
    a, b, c, d = np.asarray(corners)[:, :, None]
    x, y = (1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d
    along_s, along_t = (1 - t) * (b - a) + t * (c - d), (1 - s) * (d - a) + s * (c - b)
    area = along_s[0] * along_t[1] - along_s[1] * along_t[0]
    return x, y, area / area.sum()


def motion(field, corners, t, alpha, count):
    """V_x, V_y, Omega about the centre of mass that make int (1 + alpha tr eps) |w| dA least, (3,)."""
    x, y, area = grid(corners, count)
    rx, ry = x - area @ x, y - area @ y
    v = field.velocity(x, y, t)
    weight = area * (1 + alpha * field.strain(x, y, t)[:2].sum(0))

    def friction(q):
        w = np.stack([v[0] + q[0] - q[2] * ry, v[1] + q[1] + q[2] * rx])
        speed = np.hypot(*w)
        x_force, y_force = weight * w / speed
        moment = (rx * y_force - ry * x_force).sum()
        return weight @ speed, np.array([x_force.sum(), y_force.sum(), moment])

    return alpha * minimize(friction, np.zeros(3), jac=True, method="BFGS").x
