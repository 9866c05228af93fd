"""The speed of a bending sheet on its ground to second order in (alpha, beta).

    V = V_a alpha + V_aa alpha^2 + V_ab alpha beta + V_bb beta^2

for a sheet in full contact, see `terms`. Friction acts on the mid-surface, as in the paper, unless its
law says that it does on the lower face: see `lower_face`. Its power is that of the same slip and load,

    P = int (1 + alpha e + beta p) f(w) . w dA,    w = alpha v_1 + alpha^2 v_2 + beta^2 v_b + V,

exact to one order beyond the leading one: for dry friction alpha, alpha^2, alpha beta and beta^2. What
the sheet stores by bending, and on the ground, returns over a period.
"""

import math
import time
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from linear_theory.balance.course import Course
from linear_theory.balance.crawl import first_resolution
from linear_theory.balance.period import Period, Resolved, average, resolved
from linear_theory.common import validation
from linear_theory.common.tolerance import Tolerance
from linear_theory.deformation.plate.lower_face import LowerFace
from linear_theory.energy.energy import Energy
from linear_theory.friction.contact import Contact
from linear_theory.motion.rigid import RigidNorm
from linear_theory.scene.dragged import mean_map_of
from linear_theory.scene.scene import Scene
from linear_theory.speed.expansion import (
    POINTS,
    TINY_ALPHA,
    at_coupling,
    cells,
    field_errors,
    of_second,
    tiny,
)
from linear_theory.speed.plate.lower_face import Ray, face_coefficients, on_ray
from linear_theory.speed.plate.quadratic_form import check_contact
from linear_theory.speed.plate.terms import (
    BendingAlone,
    PlateCoefficients,
    PlateTerms,
    Weights,
    weighted_error,
)
from linear_theory.speed.reach import judged, too_large_growth, too_large_rotation, too_large_term
from linear_theory.speed.result import CrawlSpeed, Estimate, RigidSpeed
from linear_theory.speed.words import model_words

Array = NDArray[np.float64]

FIELD_SHARES = (1.0, 0.1, 0.01)
"""Of the tolerance of the speed, for the fields: more where terms of different sign cancel."""

HELPED = 0.5
"""Finer fields must reduce the error at least to this fraction, else it is that of the balance."""

WORDS = "second order in (alpha, beta), plate on its ground"


def mixed_coefficients(
    terms: PlateTerms, second: Estimate, fastest: float, contact: Contact, rtol: float
) -> tuple[Estimate, Estimate]:
    """V_ab and V_bb. second: V_aa; fastest: largest speed per unit alpha; contact: with friction per
    unit alpha.

    Each source is scaled to the size of those of alpha^2, so that the tolerance means the same.
    """
    if contact.friction.on_lower_face:
        return face_coefficients(terms, second, contact, rtol)
    unit = terms.plane.sheet.length / terms.plane.drive.period
    pressure, bending = 1 / (terms.largest_pressure or 1.0), unit / (terms.stretch.speed or unit)
    found = []
    for scale, weights in (
        (pressure, Weights(pressure=pressure)),
        (bending, Weights(bending=bending)),
    ):
        period = average_of(terms, weights, contact, rtol)
        error = float(period.mean_errors[1, 1]) + weighted_error(terms, weights, fastest)
        value = math.nan if period.sticks else float(period.means[1, 1])
        found.append(Estimate(value / scale, math.inf if period.sticks else error / scale))
    return found[0], found[1]


def average_of(terms: PlateTerms, weights: Weights, contact: Contact, rtol: float) -> Period:
    """A period of motion at TINY_ALPHA with weighted sources of second order."""
    return resolved_at(terms, weights, contact, rtol).period()


def resolved_at(
    terms: PlateTerms, weights: Weights, contact: Contact, rtol: float, coupling: float = 0.0
) -> Resolved:
    """The motion of that period."""
    plane = terms.plane
    fine = cells(rtol, plane, contact, coupling)
    crawl = PlateCoefficients(plane, TINY_ALPHA, tiny(contact), fine, terms, weights, coupling=coupling)
    return resolved(crawl, of_second(rtol, plane))


class _Motion(NamedTuple):
    """Rigid motion at the couplings of a scene: over the period (3, T), mean and error (3,); size: the
    alpha, or beta^2, that its period counts per unit of; course: of `PlateCoefficients`, if that is how
    it was found."""

    period: Period
    size: float
    rigid: Array
    mean: Array
    error: Array
    fastest: float
    first: float
    second: float
    course: Course | None = None


class PlateMotion(NamedTuple):
    """The speed of a bending scene, its deformation and, of growth and friction on the mid-surface, its
    course; else None."""

    speed: CrawlSpeed
    terms: PlateTerms
    course: Course | None


def plate_speed(scene: Scene, tolerance: Tolerance) -> CrawlSpeed:
    """The speed of second order of a bending scene; result and errors as in `crawl_speed`.

    Raises ValueError for a curvature coupling at which the sheet lifts off.
    """
    return plate_motion(scene, tolerance).speed


def plate_motion(scene: Scene, tolerance: Tolerance) -> PlateMotion:
    """`plate_speed` with the motion that it is of."""
    start, law = time.perf_counter(), scene.contact.friction
    scene.growth.law.check(scene.alpha, scene.extremes)
    unit = max(abs(scene.alpha), abs(scene.curvature_coupling) * scene.sheet.length)
    tolerance = tolerance.of_speed(unit, scene.unit)
    terms, found, norm = _fine_enough(scene, tolerance)
    contact, mirrored = terms.contact(scene), norm.mirrored
    turning = RigidSpeed(found.rigid, found.mean, found.error)
    speed = CrawlSpeed(
        estimate=turning.along,
        model_error=math.nan,
        converged=norm.meets(found.mean, found.error, tolerance),
        times=found.period.times,
        velocity=found.rigid[1],
        seconds=time.perf_counter() - start,
        model=model_words(WORDS, scene.growth, contact),
        slip_ratio=law.slip_ratio(found.fastest),
        first_order=found.first,
        second_order=found.second,
        sticks=found.period.sticks,
        turning=None if mirrored else turning,
        energy=Energy(*found.period.works.at(found.size), law, mean_map_of(scene)),
    )
    places = (p.ravel() for p in np.broadcast_arrays(*terms.plane.places(POINTS)))
    growth = too_large_growth(scene.drive, scene.alpha, *places)
    beyond = growth or too_large_rotation(scene.drive, scene.alpha)
    term = scene.alpha**2 * found.second if scene.alpha else 0.0
    speed = judged(speed, beyond or too_large_term(term, found.fastest))
    return PlateMotion(speed, terms, found.course)


def _fine_enough(scene: Scene, tolerance: Tolerance) -> tuple[PlateTerms, _Motion, RigidNorm]:
    """The motion, with finer fields until it meets the tolerance or they do not help."""
    law, before = scene.contact.friction, math.inf
    way = _on_lower_face if law.on_lower_face else _grown if scene.alpha else _bent
    for share in FIELD_SHARES:
        terms = PlateTerms.of(scene, max(share * tolerance.rtol, validation.SMALLEST_RTOL))
        check_contact(scene.curvature_coupling, terms.lift_off)
        found = way(terms, scene, terms.contact(scene), tolerance)
        norm = RigidNorm(terms.plane.gyration, terms.plane.mirrored and law.mirrored)
        error = norm.size(found.error)
        if norm.meets(found.mean, found.error, tolerance) or error > HELPED * before:
            break
        before = error
    return terms, found, norm


def _grown(terms: PlateTerms, scene: Scene, contact: Contact, tolerance: Tolerance) -> _Motion:
    """All sources of second order together, in the proportion of the couplings."""
    alpha, ratio = scene.alpha, scene.curvature_coupling / scene.alpha
    contact = replace(contact, friction=contact.friction.per(alpha))
    weights = Weights(1.0, ratio, ratio**2)
    coupling = 0.0 if contact.friction.reversible else alpha
    motion = resolved_at(terms, weights, contact, tolerance.rtol, coupling)
    period = motion.period()
    turning = at_coupling(alpha, period)
    if not coupling:
        turning = _from_orders(terms, weights, contact, alpha, period)
    return _Motion(
        period,
        alpha,
        rigid=turning.velocity,
        mean=turning.mean,
        error=turning.error,
        fastest=abs(alpha) * period.fastest / TINY_ALPHA,
        first=float(period.means[0, 1]),
        second=math.nan if period.sticks else float(period.means[1, 1]),
        course=motion.course,
    )


def _from_orders(
    terms: PlateTerms, weights: Weights, contact: Contact, alpha: float, period: Period
) -> RigidSpeed:
    """The motion by coefficients that were resolved one by one."""
    first = period.mean_errors[0] + field_errors(terms.plane, period, contact)[0]
    norm = RigidNorm(terms.plane.gyration, terms.plane.mirrored and contact.friction.mirrored)
    own = weighted_error(terms, weights, period.fastest / TINY_ALPHA)
    second = period.mean_errors[1] + norm.each(own)
    return RigidSpeed(
        alpha * period.orders[0] + alpha**2 * period.orders[1],
        alpha * period.means[0] + alpha**2 * period.means[1],
        abs(alpha) * first + alpha**2 * second,
    )


def _bent(terms: PlateTerms, scene: Scene, contact: Contact, tolerance: Tolerance) -> _Motion:
    """The sheet that bends alone, alpha = 0: its slip is of order beta^2."""
    square = scene.curvature_coupling**2
    crawl = BendingAlone(terms.plane, square or 1.0, contact, first_resolution(tolerance.rtol), terms)
    period = average(crawl, tolerance)
    share = 1.0 if square else 0.0
    return _Motion(
        period,
        square,
        rigid=share * period.rigid,
        mean=share * period.rigid_mean,
        error=share * period.rigid_error,
        fastest=share * period.fastest,
        first=0.0,
        second=math.nan,
    )


def _on_lower_face(terms: PlateTerms, scene: Scene, contact: Contact, tolerance: Tolerance) -> _Motion:
    """Both orders on the ray of the couplings."""
    alpha, beta, length = scene.alpha, scene.curvature_coupling, scene.sheet.length
    size = max(abs(alpha), abs(beta) * length) or 1.0
    contact = replace(contact, friction=contact.friction.scaled(size))
    face, ray = LowerFace(terms.plane, terms.plate), Ray(alpha / size, beta / size)
    period, errors = on_ray(terms, face, ray, contact, tolerance.rtol)
    orders, powers = period.orders, np.array([size, size**2])
    means = powers[:, None] * period.means
    known = bool(alpha) and not period.sticks
    return _Motion(
        period,
        size,
        rigid=size * orders[0] + size**2 * orders[1],
        mean=means.sum(0),
        error=powers @ errors,
        fastest=size * period.fastest / TINY_ALPHA,
        first=float(means[0, 1] / alpha) if alpha else math.nan,
        second=float(means[1, 1] / alpha**2) if known else math.nan,
    )
