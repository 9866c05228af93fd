"""The speed of a nonlinear sheet to second order in the growth coupling, V = V_1 alpha + V_2 alpha^2.

With v = alpha v_1 + alpha^2 v_2 from `second_field`, load 1 + alpha e and V = alpha q_0 + alpha^2 q_1
the friction balance is, at first and second order,

    int f(|w|) w/|w| . R dA = 0,                                   w = v_1 + q_0,
    int [D(w) (v_2 + q_1) + e f(|w|) w/|w|] . R dA = 0,             D(w) = d(f(|w|) w/|w|)/dw.

For waves without mirror symmetry in x, q stands for V_x, V_y and Omega, and the displaced points
rotate: R = (-y - alpha u_y, x + alpha u_x) for the rotation about the centre of mass, so that
Omega_0 (-u_y, u_x) is added to v_2, and the first-order force times that arm to the moment.

V_x and V_y are the velocity of the centre of mass (of the undeformed area) along the axes of the body,
Omega the rate at which these axes rotate, with the mean deformation gradient: see `second_field`, and
`fem_check/shell/cycle/frame.py` for the same frame of a nonlinear sheet. Another choice of axes would
change V_x and V_y at order alpha^2. Because the axes rotate with Omega, the means of V_x and V_y are
not the drift over the ground.

For dry friction D(w) is of order 1/|w|, an integrable singularity in the plane at the few stagnation
points w = 0. The cells are halved towards these points until the error, proportional to the square root
of the area of the last cell, is below the tolerance (`period.first_resolution`); V_1 and V_2 are the
means of q_0 and q_1.
"""

import math
import time
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.course import Course
from linear_theory.balance.period import Period
from linear_theory.common import validation
from linear_theory.common.errors import NotConvergedError
from linear_theory.common.shown import Shown, with_error
from linear_theory.common.threads import one_blas_thread
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.second.field import SecondOrderField, second_order_field
from linear_theory.energy.energy import Energy
from linear_theory.friction.contact import Contact
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.load import Load
from linear_theory.growth.growth import Reference
from linear_theory.growth.laws import GrowthLaw
from linear_theory.motion.rigid import RigidNorm
from linear_theory.scene.dragged import mean_map_of
from linear_theory.scene.level import PLATE, THEORY
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.expansion import (
    POINTS,
    SMALLEST,
    TINY_ALPHA,
    at_coupling,
    field_errors,
    field_tolerance,
    leading_motion,
    leading_period,
)
from linear_theory.speed.plate.quadratic_form import NOTHING, QuadraticForm
from linear_theory.speed.plate.speed import FIELD_SHARES, WORDS, mixed_coefficients, plate_speed
from linear_theory.speed.plate.terms import PlateTerms
from linear_theory.speed.reach import judged, too_large_growth, too_large_rotation, too_large_term
from linear_theory.speed.result import CrawlSpeed, Estimate, RigidSpeed
from linear_theory.speed.words import model_words
from linear_theory.wave.protocol import Wave

Array = NDArray[np.float64]


class _Orders(NamedTuple):
    first: float
    second: float
    first_error: float
    second_error: float
    seconds: float
    model: str
    rigid_first: Array
    rigid_second: Array
    rigid_first_error: Array
    rigid_second_error: Array
    mixed: Estimate = NOTHING
    bending: Estimate = NOTHING
    lift_off: tuple[float, float] = (-math.inf, math.inf)
    converged: bool = False


class SecondOrder(Shown, _Orders):
    """Coefficients in V = first alpha + second alpha^2 + ..., length/time, and their absolute errors.

    first is 0 if c(t + T/2) = -c(t). second is NaN, with infinite error, if part of the sheet is at
    rest at some time, since V is then not smooth in alpha.
    seconds: computing time; model: assumptions, in words.
    rigid_first, rigid_second (3,): coefficients of the means of V_x, V_y (equal to first and second)
    and of Omega (1/time, anticlockwise), in the frame of the body, see the module docstring;
    rigid_first_error, rigid_second_error (3,): their errors. For mirror-symmetric motions V_x and Omega
    are 0.
    mixed, bending: V_ab and V_bb of a sheet that bends on its ground; lift_off: the curvature couplings
    at which it lifts off. `coefficients` has all four as estimates. V_ab and V_bb are NaN for friction
    on the lower face that is not viscous: V is then no quadratic form, see `crawl_speed`.
    converged: whether the errors of all coefficients of second degree meet the tolerance. Where V_ab
    and V_bb do not exist, and where a sheet sticks, they do not.

    >>> from linear_theory import Sheet, SineWave, second_order
    >>> found = second_order(Sheet(), SineWave(), rtol=1e-2)
    >>> print(f"V = {found.first:.0f} alpha + {found.second:.2f} alpha^2, in L/T", found.converged)
    V = 0 alpha + 1.53 alpha^2, in L/T True
    """

    def _title(self) -> str:
        first = with_error(self.first, self.first_error)
        second = with_error(self.second, self.second_error)
        return f"SecondOrder: V = ({first}) alpha + ({second}) alpha^2, length/time, {self.met}"

    @property
    def met(self) -> str:
        """Whether the tolerance is met, in words."""
        return "converged" if self.converged else "NOT converged"

    @property
    def coefficients(self) -> QuadraticForm:
        """V as a quadratic form of alpha and the curvature coupling beta."""
        first = Estimate(self.first, self.first_error)
        second = Estimate(self.second, self.second_error)
        return QuadraticForm(first, second, self.mixed, self.bending, self.lift_off, self.converged)

    def rigid_mean(self, alpha: float) -> Array:
        """Means of V_x, V_y, Omega at a given alpha, (3,)."""
        return np.asarray(alpha * self.rigid_first + alpha**2 * self.rigid_second)

    def rigid_error(self, alpha: float) -> Array:
        """Errors of `rigid_mean`, (3,)."""
        return np.asarray(abs(alpha) * self.rigid_first_error + alpha**2 * self.rigid_second_error)


@one_blas_thread
def second_order(
    sheet: Sheet | Scene,
    wave: Wave | None = None,
    growth_law: GrowthLaw | str | None = None,
    area: Reference | str | None = None,
    load: Load | str | None = None,
    friction: FrictionLaw | str | None = None,
    slip_speed: float | None = None,
    rtol: float = 1e-3,
) -> SecondOrder:
    """Leading coefficients of the mean speed of a stiff, planar, nonlinear sheet for small growth.

    They are those of the planar Koiter membrane (eq. 1a), not of a linear theory: for a sine wave,
    first = 0 and second is the limit of V/alpha^2. They carry no information on the range of validity
    in alpha.

    sheet, wave: any wave; or a planar `Scene`, whose alpha only converts its slip speed. growth_law:
    the stretch, "exp" exp(alpha c) by default, "linear" 1 + alpha c or "metric" (1 + 2 alpha c)^(1/2);
    area: reference area of the elastic energy density, "grown" by default, or "undeformed"; load:
    normal load, "current" by default, "grown" or "material" (see `Load`); friction: "coulomb" by
    default, "viscous", or "tanh" with slip_speed. slip_speed: length per time *and unit |alpha|*, since
    its ratio to the speeds stays fixed as alpha -> 0. `crawl_speed(order=2, alpha=a, slip_speed=s)`
    takes a speed and uses s/|a| here. rtol: tolerance for `second`, whose error should be below
    max(rtol |second|, 0.01 rtol L/T); without mirror symmetry, for the norm of rigid_second (see
    `rigid.RigidNorm`). V_ab and V_bb of a sheet on its ground: rtol times their own size, or that of
    `PlateTerms.smallest`; their deformation is computed more accurately where that helps. `converged`
    says whether all of these are met, which they are not on very stiff ground, (D/s)^(1/4) below some
    0.005 L. The other coefficients are computed with the same cells and times.

    Raises ValueError for bad input, and NotConvergedError where rtol needs more memory than there is.

    >>> from linear_theory import Sheet, SineWave, second_order
    >>> for growth_law in ("exp", "metric"):
    ...     found = second_order(Sheet(), SineWave(), growth_law, rtol=3e-2)
    ...     print(f"{growth_law}: V = {found.second:.1f} alpha^2 L/T", found.second_error < 0.05)
    exp: V = 1.5 alpha^2 L/T True
    metric: V = 2.1 alpha^2 L/T True
    """
    start = time.perf_counter()
    alpha = None if isinstance(sheet, Scene) else 0.0
    scene = Scene.stated(
        sheet, wave, alpha, load, friction, slip_speed, growth_law=growth_law, area=area
    )
    (THEORY if scene.planar else PLATE).require(scene)
    rtol = validation.tolerance(rtol)
    own = isinstance(sheet, Scene) and friction is None and slip_speed is None
    contact = _per_alpha(scene) if own else scene.contact
    if not scene.planar:
        return _of_plate(scene, contact, rtol, start)
    field = second_order_field(scene.sheet, scene.wave, scene.growth, field_tolerance(rtol))
    return coefficients(field, leading_period(field, contact, rtol), contact, start, rtol)


class _OfFields(NamedTuple):
    """Coefficients, and the largest of their errors over what the tolerance allows."""

    found: SecondOrder
    missed: float


def _of_plate(scene: Scene, contact: Contact, rtol: float, start: float) -> SecondOrder:
    """All coefficients of a bending scene; contact: with a friction law per unit alpha.

    Once more with finer fields if these can meet the tolerance, within the memory.
    """
    first = _with_fields(scene, contact, rtol, 1.0)
    found, missed = first
    if 1 < missed < 1 / FIELD_SHARES[-1]:
        share = max(FIELD_SHARES[1] / missed, FIELD_SHARES[-1])
        try:
            finer = _with_fields(scene, contact, rtol, share)
        except NotConvergedError:  # the errors of the first say what is missed
            finer = first
        found, missed = min(first, finer, key=lambda one: one.missed)
    model = model_words(WORDS, scene.growth, contact)
    seconds = time.perf_counter() - start
    return found._replace(seconds=seconds, model=model, converged=found.converged and missed <= 1)


def _with_fields(scene: Scene, contact: Contact, rtol: float, share: float) -> _OfFields:
    """All coefficients with fields to a share of the tolerance."""
    terms = PlateTerms.of(scene, max(share * rtol, validation.SMALLEST_RTOL))
    contact = replace(contact, load=terms.plate.foundation.load)
    period = leading_period(terms.plane, contact, rtol)
    found = coefficients(terms.plane, period, contact, 0.0, rtol)
    second, fastest = Estimate(found.second, found.second_error), period.fastest / TINY_ALPHA
    both = mixed_coefficients(terms, second, fastest, contact, rtol)
    sizes = (max(abs(one.value), size) for one, size in zip(both, terms.smallest, strict=True))
    missed = [
        one.error / (rtol * size) if one.error else 0.0 for one, size in zip(both, sizes, strict=True)
    ]
    found = found._replace(mixed=both[0], bending=both[1], lift_off=terms.lift_off)
    return _OfFields(found, math.inf if any(map(math.isnan, missed)) else max(missed))


def _per_alpha(scene: Scene) -> Contact:
    """The contact with its friction law for speeds per unit |alpha|.

    Raises ValueError for a law that has a slip speed where alpha = 0: there is no such ratio then.
    """
    law = scene.contact.friction
    if scene.alpha == 0 and law.regularised:
        raise ValueError(
            f"alpha = 0: must not be 0 for {law.words}, whose slip speed counts per unit |alpha|"
        )
    return replace(scene.contact, friction=law.per(scene.alpha))


def coefficients(
    field: SecondOrderField, period: Period, contact: Contact, start: float, rtol: float
) -> SecondOrder:
    """Means of q_0 and q_1 and their errors; start: time at which the computation began."""
    first, second = period.means
    first_error, second_error = period.mean_errors + field_errors(field, period, contact)
    if period.sticks:
        second, second_error = np.full(3, math.nan), np.full(3, math.inf)
    norm = RigidNorm(field.gyration, field.mirrored and contact.friction.mirrored)
    smallest = SMALLEST * field.sheet.length / field.drive.period
    return SecondOrder(
        first=float(first[1]),
        second=float(second[1]),
        first_error=float(first_error[1]),
        second_error=float(second_error[1]),
        seconds=time.perf_counter() - start,
        model=model_words("second order in alpha", field.growth, contact),
        rigid_first=first,
        rigid_second=second,
        rigid_first_error=first_error,
        rigid_second_error=second_error,
        converged=norm.meets(second, second_error, Tolerance(rtol, rtol * smallest)),
    )


@one_blas_thread
def second_order_speed(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    """V_1 alpha + V_2 alpha^2 for a planar scene, with terms in beta for one that bends on its ground;
    result and errors as in `crawl_speed`."""
    return plane_motion(scene, tolerance).speed if scene.planar else plate_speed(scene, tolerance)


class PlaneMotion(NamedTuple):
    """The speed of a planar scene, and its course."""

    speed: CrawlSpeed
    course: Course


def plane_motion(scene: Scene, tolerance: Tolerance) -> PlaneMotion:
    """`second_order_speed` of a planar scene with the motion that it is of."""
    start, alpha, contact = time.perf_counter(), scene.alpha, scene.contact
    tolerance, law = tolerance.of_speed(alpha, scene.unit), contact.friction
    per_alpha = replace(contact, friction=law.per(alpha))
    rtol = tolerance.rtol
    field = second_order_field(scene.sheet, scene.wave, scene.growth, field_tolerance(rtol))
    scene.growth.law.check(alpha, scene.drive.growths(*_points(scene.sheet)))
    # of a law without a direction V_2 alone is resolved, as by `second_order`
    coupling = 0.0 if law.reversible else alpha
    motion = leading_motion(field, per_alpha, rtol, coupling)
    period = motion.period()
    both = coefficients(field, period, contact, start, rtol)
    turning = at_coupling(alpha, period)
    if not coupling:
        turning = replace(turning, mean=both.rigid_mean(alpha), error=both.rigid_error(alpha))
    mirrored = field.mirrored and law.mirrored
    norm = RigidNorm(field.gyration, mirrored)
    fastest = abs(alpha) * period.fastest / TINY_ALPHA
    found = replace(
        speed_at(turning, both, period, mirrored),
        converged=norm.meets(turning.mean, turning.error, tolerance),
        slip_ratio=law.slip_ratio(fastest),
        energy=Energy(*period.works.at(alpha), law, mean_map_of(scene)),
        seconds=time.perf_counter() - start,
    )
    growth = too_large_growth(scene.drive, alpha, *_points(scene.sheet))
    beyond = growth or too_large_rotation(scene.drive, alpha)
    speed = judged(found, beyond or too_large_term(alpha**2 * both.second, fastest))
    return PlaneMotion(speed, motion.course)


def speed_at(turning: RigidSpeed, found: SecondOrder, period: Period, mirrored: bool) -> CrawlSpeed:
    """The speed from the motion and the coefficients, without a check of its validity."""
    return CrawlSpeed(
        estimate=turning.along,
        model_error=math.nan,
        converged=False,
        times=period.times,
        velocity=turning.velocity[1],
        seconds=found.seconds,
        model=found.model,
        slip_ratio=math.nan,
        first_order=found.first,
        second_order=found.second,
        sticks=period.sticks,
        turning=None if mirrored else turning,
    )


def _points(sheet: Sheet) -> tuple[Array, Array]:
    """x and y of a grid over the sheet, edges included, (n,) each."""
    x, y = (s * np.linspace(-0.5, 0.5, POINTS) for s in (sheet.width, sheet.length))
    return np.repeat(x, POINTS), np.tile(y, POINTS)
