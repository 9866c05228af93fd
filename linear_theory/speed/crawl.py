"""Speed of a crawling sheet for small growth: first-order theory, or to second order in alpha."""

import math
import time
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.crawl import Crawl
from linear_theory.balance.period import Resolved, resolved
from linear_theory.common import validation
from linear_theory.common.estimate import Estimate
from linear_theory.common.progress import Report, watched
from linear_theory.common.threads import one_blas_thread
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.airy import airy_series
from linear_theory.deformation.field import LinearField, checked_field
from linear_theory.deformation.plate import foundation, plate_field
from linear_theory.deformation.ritz import ritz_field
from linear_theory.energy.energy import Energy
from linear_theory.friction.contact import Contact
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.load import Load
from linear_theory.friction.mean_map import UNKNOWN, mean_map
from linear_theory.friction.regime import warn_if_viscous
from linear_theory.growth.growth import Reference
from linear_theory.growth.laws import GrowthLaw
from linear_theory.motion.motion import CellGrid
from linear_theory.scene.level import PLATE, THEORY
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.drawn import LinearDeformation
from linear_theory.speed.model_error import LEVELS, model_error
from linear_theory.speed.plate.drawn import BentDeformation
from linear_theory.speed.plate.error import plate_error
from linear_theory.speed.power_error import with_power_error
from linear_theory.speed.reach import judged, too_large_growth, too_large_rotation, warn_if_beyond
from linear_theory.speed.result import CrawlSpeed, RigidSpeed
from linear_theory.speed.second_order import second_order_speed
from linear_theory.speed.wave_error import with_wave_error
from linear_theory.speed.words import model_words
from linear_theory.wave.protocol import Wave

Array = NDArray[np.float64]

METHODS = ("auto", "airy", "ritz")

ORDERS = (1, 2)
"""Orders of theory offered by `crawl_speed`."""

BEYOND_RTOL = 1e-2
"""Smallest relative error sought of a speed that means nothing, see `too_large_rotation`."""

SHOWN_RTOL = 1e-3
"""Relative error of a deformation used for drawing only: below the width of a line."""


def crawl_speed(
    sheet: Sheet | Scene,
    wave: Wave | None = None,
    alpha: float | None = None,
    load: Load | str | None = None,
    friction: FrictionLaw | str | None = None,
    slip_speed: float | None = None,
    rtol: float = 1e-4,
    atol: float | None = None,
    method: str = "auto",
    order: int = 1,
    growth_law: GrowthLaw | str | None = None,
    area: Reference | str | None = None,
    *,
    progress: bool | Report | None = None,
) -> CrawlSpeed:
    """Mean speed of a rectangular sheet in small-strain theory (eqs 10 and 11), or to second order.

    sheet, wave, alpha: the sheet, the wave of growth and the growth coupling; or, instead of all three,
    a planar `Scene`, whose load and friction must agree with any given here; for order = 2 also one
    that bends on level ground, in full contact with it.
    load: normal load, "current" by default, "grown" or "material", see `Load`; friction: "coulomb" by
    default, "tanh" with its slip_speed (length per time), or "viscous"; rtol, atol: see `Tolerance`;
    for a motion without mirror symmetry they apply to the norms of rigid_error and rigid_mean (all
    three components, see `rigid.RigidNorm`);
    method: "airy" for waves c(y, t), "ritz" for any wave, or "auto".

    order = 1 is the paper's theory: first-order strains in a friction balance that is not expanded. It
    is accurate, with a relative error of order alpha, for waves whose speed is of order alpha (pulses,
    c(t + T/2) != -c(t)). For a sine wave, whose speed is of order alpha^2, it is the speed of the
    stated model, not the leading term (25 % too fast for the default sheet). order = 2 is V_1 alpha +
    V_2 alpha^2 of the nonlinear sheet with that growth_law ("exp" by default) and area ("grown" by
    default; see `second_order`), with an error of order alpha^3, for a sine alpha^4; for any wave, by
    Ritz; not valid for large alpha. order = 1 depends on growth_law and area only through its
    `model_error`: the distance to the nonlinear sheet with that growth_law, area and load where it was
    measured (`model_error.model_error`), of a sheet that bends to a cycle of its shapes
    (`plate.error`), else NaN.
    progress: True prints on stderr, a function is called with a `progress.Progress`.

    Raises ValueError for bad input, including an alpha so large that the area element
    1 + alpha tr(strain) is not positive somewhere (order 1) or that lengths vanish (order 2), and
    NotConvergedError if the deformation by a discontinuous wave needs more memory than is available.
    Warns (ViscousRegimeWarning) if friction = "tanh" acts as viscous, see `CrawlSpeed.regime`, and
    (BeyondReachWarning) if growth is too large for the theory, |alpha c| > 1/2 or less, or turns the
    ends of a wide sheet by more than 1/2 rad, see `reach`: such a speed is never converged, and
    `CrawlSpeed.beyond_reach` says why.

    >>> from linear_theory import Sheet, SineWave, crawl_speed
    >>> for order in (1, 2):  # of the theory, for the sheet of the paper
    ...     speed = crawl_speed(Sheet(), SineWave(), alpha=0.05, order=order, rtol=1e-2)
    ...     print(f"V = {speed.mean:.4f} L/T, nonlinear sheet within {speed.model_error:.0e}")
    V = 0.0048 L/T, nonlinear sheet within 1e-03
    V = 0.0038 L/T, nonlinear sheet within 1e-05
    """
    scene = Scene.stated(
        sheet, wave, alpha, load, friction, slip_speed, growth_law=growth_law, area=area
    )
    with watched(progress, "crawl_speed"):
        found = theory_speed(scene, Tolerance(rtol, atol), order, method)
    warn_if_viscous(scene.contact.friction, found.slip_ratio)
    warn_if_beyond(scene.alpha, found.beyond_reach)
    return found


def theory_speed(
    scene: Scene, tolerance: Tolerance, order: int = 1, method: str = "auto"
) -> CrawlSpeed:
    """`crawl_speed` for a scene, without its warnings."""
    (PLATE if order == 2 and not scene.planar else THEORY).require(scene)
    if validation.integer("order", order) not in ORDERS:
        raise ValueError(f"order = {order}: must be one of {', '.join(map(str, ORDERS))}")
    validation.choice("method", method, METHODS if order == 1 else ("auto", "ritz"))
    method = method if order == 1 else "ritz"
    solve = partial(second_order_speed, scene) if order == 2 else partial(_first, scene, method)
    return completed(with_wave_error(scene, tolerance, solve), scene, order, method)


def completed(found: CrawlSpeed, scene: Scene, order: int, method: str) -> CrawlSpeed:
    """The speed of a scene with its distance to the nonlinear sheet and the shape to draw."""
    # Computed again for drawing, so that a speed does not keep a solution and its tables in memory.
    deformation = drawn_deformation(scene, method)
    distance = model_error(LEVELS[order], scene) if scene.planar else plate_error(scene)
    found = with_power_error(found, LEVELS[order], scene) if scene.planar else found
    return replace(found, model_error=distance, deformation=deformation)


def _first(scene: Scene, method: str, tolerance: Tolerance) -> CrawlSpeed:
    field = _field(scene, tolerance.rtol, method)
    return _field_speed(field, scene.alpha, scene.contact, tolerance)


def drawn_deformation(scene: Scene, method: str = "ritz") -> LinearDeformation:
    """The small-strain deformation of the sheet of a scene, for pictures."""
    find, contact = partial(_field, scene, SHOWN_RTOL, method), scene.contact
    if scene.planar:
        return LinearDeformation(find, scene.alpha, contact)
    ground = foundation(scene.effects)
    plate = partial(plate_field, scene.sheet, scene.wave, ground, SHOWN_RTOL)
    couplings = scene.alpha, scene.curvature_coupling
    return BentDeformation(find, plate, couplings, replace(contact, load=ground.load))


def field_speed(
    field: LinearField,
    alpha: float,
    load: Load | str | None = None,
    friction: FrictionLaw | str | None = None,
    slip_speed: float | None = None,
    rtol: float = 1e-4,
    atol: float | None = None,
) -> CrawlSpeed:
    """`crawl_speed` for a given deformation: series, Ritz or finite elements.

    Raises ValueError and warns as `crawl_speed` does.

    >>> from linear_theory import Sheet, SineWave, field_speed, ritz_field
    >>> field = ritz_field(Sheet(), SineWave(), rtol=1e-4)
    >>> for friction in ("coulomb", "viscous"):
    ...     speed = field_speed(field, alpha=0.25, friction=friction, rtol=1e-3)
    ...     print(f"V = {speed.mean:.3f} L/T, friction is {speed.regime}")
    V = 0.106 L/T, friction is dry
    V = 0.064 L/T, friction is viscous
    """
    field, alpha = checked_field(field), validation.real("alpha", alpha)
    contact = Contact.named(load, friction, slip_speed)
    found = _field_speed(field, alpha, contact, Tolerance(rtol, atol))
    warn_if_viscous(contact.friction, found.slip_ratio)
    warn_if_beyond(alpha, found.beyond_reach)
    return found


def _field(scene: Scene, rtol: float, method: str) -> LinearField:
    """First-order deformation, accurate enough for a speed to rtol."""
    sheet, wave, series = scene.sheet, scene.wave, scene.drive.series
    if method == "airy" and series is None:
        raise ValueError("method = 'airy': must be 'ritz' for a wave that depends on x")
    field_rtol = max(0.1 * rtol, validation.SMALLEST_RTOL)
    if method != "ritz" and series is not None:
        return airy_series(sheet, series, rtol=field_rtol)
    return ritz_field(sheet, wave, rtol=field_rtol)


@one_blas_thread
def _field_speed(
    field: LinearField, alpha: float, contact: Contact, tolerance: Tolerance
) -> CrawlSpeed:
    """`field_speed`, without its warnings."""
    start, law = time.perf_counter(), contact.friction
    tolerance = tolerance.of_speed(alpha, field.sheet.length / field.drive.period)
    if alpha == 0:
        still = CrawlSpeed.steady(0.0, _words(field, contact), law.slip_ratio(0.0), field.seconds)
        deformation = LinearDeformation(lambda: field, alpha, contact)
        return replace(still, deformation=deformation, energy=Energy.at_rest(law))
    if field.rectangular and too_large_rotation(field.drive, alpha):
        # else half a minute of work for a number that means nothing, as `beyond_reach` says
        tolerance = replace(tolerance, rtol=max(tolerance.rtol, BEYOND_RTOL), atol=None)
        tolerance = tolerance.of_speed(alpha, field.sheet.length / field.drive.period)
    found = speed_of(resolved(Crawl.to(tolerance.rtol, field, alpha, contact), tolerance), tolerance)
    return replace(found, seconds=field.seconds + time.perf_counter() - start)


def speed_of(found: Resolved, tolerance: Tolerance) -> CrawlSpeed:
    """The speed from a motion over a period; its seconds are those of the deformation."""
    crawl, period = found.course.crawl, found.period()
    field, alpha, law = crawl.field, crawl.alpha, crawl.contact.friction
    turning = RigidSpeed(period.rigid, period.rigid_mean, period.rigid_error)
    speed = CrawlSpeed(
        estimate=Estimate(period.mean, period.error),
        model_error=math.nan,
        converged=crawl.norm.meets(turning.mean, turning.error, tolerance),
        times=period.times,
        velocity=period.rigid[1],
        seconds=field.seconds,
        model=_words(field, crawl.contact),
        slip_ratio=law.slip_ratio(period.fastest),
        first_order=period.first_order,
        sticks=period.sticks,
        turning=None if crawl.mirrored else turning,
        energy=Energy(*period.works.at(alpha), law, _mean_map(field, law)),
        deformation=LinearDeformation(lambda: field, alpha, crawl.contact),
    )
    return judged(speed, beyond_reach(field, alpha))


def _words(field: LinearField, contact: Contact) -> str:
    return model_words(f"small strain ({type(field).__name__})", None, contact)


def _mean_map(field: LinearField, law: FrictionLaw) -> Estimate:
    """Of the map of friction over the sheet; not computed for another outline than a rectangle."""
    sheet = field.sheet
    if law.map is not None and not field.rectangular:
        return UNKNOWN
    return mean_map(law, sheet.width, sheet.length, field.drive.period)


def beyond_reach(field: LinearField, alpha: float) -> str:
    """Why small-strain theory is not valid at this alpha, in words; empty if it is."""
    x = y = np.zeros(1)  # a series goes through all its phases at any point
    if alpha and field.drive.series is None:
        grid = CellGrid.uniform(field.sheet, 4, 8, half=False)
        x, y = field.motion(np.zeros(1), grid, order=5).position
    growth = too_large_growth(field.drive, alpha, x, y)
    return growth or (too_large_rotation(field.drive, alpha) if field.rectangular else "")
