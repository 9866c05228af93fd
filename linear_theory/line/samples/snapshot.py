"""The balance at given times, on points where the velocity is linear between neighbours."""

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.laws import Viscous
from linear_theory.friction.maps import Mapped
from linear_theory.line.piece import Piece
from linear_theory.line.result import REST_SPEED
from linear_theory.line.samples.coefficients import dry_coefficients, viscous_coefficients
from linear_theory.line.samples.piecewise import Ends, cell_means, less_mean, weighted_quantile
from linear_theory.line.samples.regularised import regularised_speed
from linear_theory.line.share import share_slower
from linear_theory.line.work import sampled_power
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]

BLOCK = 1 << 16
"""Cells times times held at once: few enough to stay in the cache."""


class Snapshot(NamedTuple):
    """Speed, its coefficients of alpha and alpha^2 (nan unless asked for), largest speed, part at rest
    and power of friction over mu times the weight, each (times,)."""

    velocity: Array
    first: Array
    second: Array
    fastest: Array
    rest: Array
    power: Array


def snapshots(
    drive: Drive,
    alpha: float,
    law: FrictionLaw,
    growth: Piece,
    times: Array,
    cells: int,
    coefficients: bool = False,
) -> Snapshot:
    """Speeds at these times (times,) on equal cells, the length of the body being 1."""
    step = max(1, BLOCK // cells)
    parts = [
        _snapshot(drive, alpha, law, growth, times[i : i + step, None], cells, coefficients)
        for i in range(0, times.size, step)
    ]
    return Snapshot(*(np.concatenate(column) for column in zip(*parts, strict=True)))


def _snapshot(
    drive: Drive,
    alpha: float,
    law: FrictionLaw,
    growth: Piece,
    times: Array,
    cells: int,
    coefficients: bool,
) -> Snapshot:
    y = np.linspace(-0.5, 0.5, cells + 1)
    place = drive.sheet.length * y
    c, rate = (_on_grid(f(0.0, place, times), times, y) for f in (drive.value, drive.rate))
    _check_strain(alpha, c, times, y, growth)
    g = less_mean(growth.slope(alpha * c) * rate)
    weight, mu = (1 + cell_means(growth.gain(alpha * c))) / cells, np.ones_like(g)[:, 1:]
    if law.map is not None:
        mu = cell_means(np.broadcast_to(law.map.values(0.0, place, times), g.shape))
        weight = weight * mu
    if law.width == 0:
        share = share_slower(law, alpha)
        level, _ = weighted_quantile(g, weight, share)
        velocity = -alpha * level
    else:
        velocity = -alpha * np.sum(weight * cell_means(g), axis=1) / weight.sum(axis=1)
        if not _is_viscous(law):
            velocity = regularised_speed(alpha * g, weight, law, velocity)
    first = second = np.full(times.size, math.nan)
    if coefficients and law.width == 0:
        first, second = dry_coefficients(c, rate, growth, share, mu)
    elif coefficients and _point_law(law).reversible:
        first, second = viscous_coefficients(c, rate, growth, mu)
    slip = velocity[:, None] + alpha * g
    tolerance = REST_SPEED * np.ptp(slip, axis=1, keepdims=True)
    ends = Ends.of(slip)
    rest = np.mean(ends.part_below(tolerance) - ends.part_below(-tolerance), axis=1)
    power = sampled_power(slip, weight, law)
    return Snapshot(velocity, first, second, abs(slip).max(axis=1), rest, power)


def _is_viscous(law: FrictionLaw) -> bool:
    """Whether it is linear, so that no equation is to be solved."""
    return type(_point_law(law)) is Viscous


def _point_law(law: FrictionLaw) -> FrictionLaw:
    """That at a point, without its map."""
    return law.law if isinstance(law, Mapped) else law


def _on_grid(values: Array, times: Array, y: Array) -> Array:
    return np.broadcast_to(validation.real_array("wave", values), (times.size, y.size))


def _check_strain(alpha: float, c: Array, times: Array, y: Array, growth: Piece) -> None:
    worst = growth.law.misplaced(alpha * c, extreme=growth.extreme)
    if worst is not None:
        row, column = np.unravel_index(worst, c.shape)
        place = f"S = {y[column] + 0.5:.4g} length, t = {times[row, 0]:.4g}"
        raise growth.law.refusal(alpha, float(alpha * c[row, column]), place, growth.extreme)
