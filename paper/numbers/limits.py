"""Numbers about friction regimes, turning sheets and the loss of shape of wide sheets (F3, F4)."""

import warnings

import numpy as np
from scipy.interpolate import CubicSpline

from fem_check import cycle_speed
from fem_check.shell.statics.ellipticity import edge_limit
from figures.common.scenes import smooth_scene
from figures.draw import regimes
from figures.measure import regimes as regimes_table
from figures.measure import turning as turning_table
from figures.measure.reach import LIMIT_STEP, largest_alpha
from linear_theory import Sheet, SineWave, ViscousRegimeWarning, crawl_speed, rigid_path
from linear_theory.friction.regime import DRY_RATIO, VISCOUS_RATIO
from paper.numbers.number import SHEET, SHOWN_ALPHA, WAVE, Number, Numbers

MESHES = (8, 16)
"""Elements each way on the square sheet whose loss of shape is looked for."""

CAT_ALPHA = 0.02
"""Small enough for the turn to be of second order, to some alpha^2."""


def shown_regimes() -> Numbers:
    """What v0 = 1 means (F4): the ratio of slip speed to largest speed, and the crawling speed."""
    periods = (1.0, 10.0)
    with warnings.catch_warnings():  # that these are viscous is the finding
        warnings.simplefilter("ignore", ViscousRegimeWarning)
        speeds = [
            crawl_speed(
                SHEET, SineWave(period=t), SHOWN_ALPHA, friction="tanh", slip_speed=1.0, rtol=1e-3
            )
            for t in periods
        ]
    origin = "crawl_speed(alpha=0.25, friction='tanh', slip_speed=1)"
    dry = crawl_speed(SHEET, WAVE, SHOWN_ALPHA, rtol=1e-4).mean
    viscous = crawl_speed(SHEET, WAVE, SHOWN_ALPHA, friction="viscous", rtol=1e-4).mean
    return {
        "regime.period": Number(list(periods), "periods, in L/v0"),
        "regime.slip_ratio": Number([s.slip_ratio for s in speeds], f"{origin}.slip_ratio"),
        "regime.mean": Number(
            [s.mean * t / dry for s, t in zip(speeds, periods, strict=True)], f"{origin}.mean over dry"
        ),
        "regime.viscous": Number(viscous / dry, "viscous over dry speed at alpha = 0.25, eq. 11"),
    }


def boundaries() -> Numbers:
    """Where friction is dry and viscous, and how much of the difference in speed is gone there."""
    table = regimes_table.TABLE.read()
    ends = regimes.boundaries(table)
    sheet = regimes.select(table, "nonlinear")
    limits = regimes.limits(table, "nonlinear")
    at = CubicSpline(np.log(sheet["slip"]), sheet["coefficient"])(np.log(ends))
    gone = (limits["dry"] - at) / (limits["dry"] - limits["viscous"])
    origin = "figures.draw.regimes.boundaries, nonlinear sheet, alpha = 0.1, over alpha L/T"
    small, large = regimes.limits(table, "linear"), regimes.limits(table, "line")
    return {
        "regime.ratio_dry": Number(DRY_RATIO, "linear_theory.friction.regime.DRY_RATIO"),
        "regime.ratio_viscous": Number(VISCOUS_RATIO, "linear_theory.friction.regime.VISCOUS_RATIO"),
        "regime.dry_up_to": Number(ends[0], origin),
        "regime.viscous_from": Number(ends[1], origin),
        "regime.gone_dry": Number(float(gone[0]), "share of dry - viscous lost at dry_up_to"),
        "regime.gone_viscous": Number(float(gone[1]), "the same at viscous_from"),
        "regime.left_sheet": Number(limits["viscous"] / limits["dry"], "viscous over dry, nonlinear"),
        "regime.left_line": Number(large["viscous"] / large["dry"], "viscous over dry, line"),
        "regime.off_dry": Number(small["dry"] / limits["dry"] - 1, "eq. 11 over nonlinear - 1, dry"),
        "regime.off_viscous": Number(
            small["viscous"] / limits["viscous"] - 1, "eq. 11 over nonlinear - 1, viscous"
        ),
    }


def turning() -> Numbers:
    """The waves of `figures.measure.turning` in linear theory of both orders."""
    alpha = turning_table.ALPHA
    numbers = {"turn.alpha": Number(alpha, "figures.measure.turning.ALPHA")}
    for order, suffix in ((1, ""), (2, "_second")):
        for name, wave in turning_table.WAVES.items():
            path = rigid_path(crawl_speed(SHEET, wave, alpha, rtol=1e-3, order=order))
            origin = f"rigid_path(crawl_speed({name} wave, order={order}))"
            way = float(np.hypot(*path.step))
            key = f"turn.{name}{suffix}"
            numbers[f"{key}_way"] = Number(way, f"length of a period's step, {origin}")
            numbers[f"{key}_turn"] = Number(_small(path.turn), f"turn of a period, {origin}")
            if name == "unequal":
                numbers[f"{key}_radius"] = Number(way / path.turn, "the one over the other")
    return numbers


def _small(x: float) -> float:
    """x, or 0 where it is within what the speeds are asked for."""
    return float(x) if abs(x) > 1e-5 else 0.0


def cat() -> Numbers:
    """The turn by viscous friction under a load that does not change, over alpha^2."""
    wave, alpha = turning_table.WAVES["unequal"], CAT_ALPHA
    numbers = {}
    for order, name in ((1, "first"), (2, "second")):
        speed = crawl_speed(SHEET, wave, alpha, "material", "viscous", rtol=1e-3, order=order)
        origin = f'rigid_path(crawl_speed(unequal, "material", "viscous", order={order})).turn/alpha^2'
        numbers[f"cat.{name}"] = Number(_small(rigid_path(speed).turn / alpha**2), origin)
    scene = smooth_scene(SHEET, wave, alpha, (4, 8))
    found = cycle_speed(scene, "material", "viscous", rtol=3e-3, atol=1e-8)
    numbers["cat.sheet"] = Number(
        rigid_path(found).turn / alpha**2, "the same of cycle_speed, alpha = 0.02, 4 by 8 elements"
    )
    return numbers


def shapes() -> Numbers:
    """Where a square sheet is found to lose its static shape, on two meshes."""
    found = [_last_shape((n, n)) for n in MESHES]
    origin = f"last alpha with cycle_of_shapes, W = L, nu = 1/2, to {LIMIT_STEP:g}"
    return {
        "shape.meshes": Number([float(n) for n in MESHES], "MESHES"),
        "shape.alpha": Number(found, origin),
        "shape.edge": Number(edge_limit(SHEET.poisson), "ellipticity.edge_limit(1/2)"),
        "shape.bar": Number(1 / 3**0.5, "root of 3 stretch^2 = 1"),
    }


def _last_shape(cells: tuple[int, int]) -> float:
    """Largest alpha at which a square sheet has static shapes, to LIMIT_STEP."""
    return largest_alpha(lambda a: smooth_scene(Sheet(width=1.0), WAVE, a, cells), 0.1, 0.3)
