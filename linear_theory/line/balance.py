"""Speed of a one-dimensional body driven by any wave (paper eqs 5-7)."""

import time

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.threads import one_blas_thread
from linear_theory.common.tolerance import Tolerance
from linear_theory.common.validation import shown
from linear_theory.energy.energy import Energy
from linear_theory.friction.contact import Contact
from linear_theory.friction.directional import Directional
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.laws import FRICTION_LAWS
from linear_theory.friction.load import Load
from linear_theory.friction.maps import Mapped
from linear_theory.friction.mean_map import mean_map
from linear_theory.friction.regime import warn_if_viscous
from linear_theory.growth.laws import GrowthLaw
from linear_theory.line.piece import Piece
from linear_theory.line.result import LineMotion
from linear_theory.line.samples import coarse_means, sampled_balance
from linear_theory.line.travelling import travelling_balance
from linear_theory.motion.rigid import RigidNorm
from linear_theory.scene.level import map_on_ground
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.result import CrawlSpeed, Estimate
from linear_theory.speed.wave_error import WaveError, doubted, equidistant_times, wave_error
from linear_theory.speed.words import model_words
from linear_theory.wave import arguments
from linear_theory.wave.places import on_axis
from linear_theory.wave.protocol import Wave
from linear_theory.wave.sampled import drive
from linear_theory.wave.uncertain import uncertainty_of

ALONG = RigidNorm(gyration=1.0, mirrored=True)
"""Of a body on a line: V_y alone counts."""


def line_balance(
    wave: Wave,
    alpha: float,
    load: Load | str = "current",
    friction: FrictionLaw | str = "coulomb",
    slip_speed: float | None = None,
    rtol: float = 1e-4,
    atol: float | None = None,
    growth_law: GrowthLaw | str = "linear",
    body: str = "line",
    *,
    length: float | None = None,
) -> CrawlSpeed:
    """Speed of a one-dimensional body |y| <= length/2 driven by any wave c(y, t).

    wave: a `TravellingWave` (solved to rounding, V is constant) or anything with `period`, `value`
    and `rate` as in `protocol.Wave`, evaluated at x = 0 (sampled until the error meets rtol).
    length: of the body, which also sets the unit of all speeds; 1 by default for a TravellingWave,
    which is a function of y/length; required for any other wave, which is a function of y.
    alpha: dimensionless growth coupling; growth_law: the stretch, "exp" exp(alpha c), "linear"
    1 + alpha c (eq. 5) or "metric" (1 + 2 alpha c)^(1/2), without expansion in alpha.
    body: "line", with the weight per length, or "strip", narrow and growing in both directions, with
    the weight per area; load: "current", "grown" (the same here) or "material" (weight conserved).
    friction: "coulomb", "tanh" with its `slip_speed` in length/time, "viscous", or a `Directional`.
    rtol, atol: `converged` says whether error <= max(rtol |mean|, atol), atol =
    1e-3 rtol alpha^2 length/period unless given (length/time).

    Returns a `CrawlSpeed`, whose first_order and second_order are the limits for small alpha: for dry
    friction on a travelling wave (median c - mean c) L/(nT) and [p E|c - median|/(2 f) +
    s_2 (median^2 - E c^2)] L/(nT), with f the density of c at its median, p and s_2 those of the body
    and the growth law (see `travelling`); for tanh at a fixed slip speed they are those of viscous
    friction. Raises ValueError, naming the place, where a length would vanish (1 + alpha c <= 0,
    1 + 2 alpha c <= 0) or |alpha c| >= 100 for "exp", and for other bad arguments. Warns
    (ViscousRegimeWarning) if friction = "tanh" acts as viscous: see `CrawlSpeed.regime`.

    >>> from linear_theory import SineWave, TravellingWave, line_balance, line_speed
    >>> sine = line_balance(SineWave(), alpha=0.25)
    >>> print(f"V = {sine.mean:.5f} L/T", abs(sine.mean - line_speed(0.25)) <= sine.error)
    V = 0.06007 L/T True
    >>> pulse = line_balance(TravellingWave(cosine=[1.0, 0.5], sine=[0.0, 0.0]), alpha=0.05)
    >>> print(f"V = {pulse.mean:.3f} L/T, {pulse.first_order:.1f} alpha L/T for small alpha")
    V = -0.022 L/T, -0.5 alpha L/T for small alpha

    A wave of wavelength 20 mm and period 1 s, on a body of that length and on one twice as long:

    >>> import numpy as np
    >>> from linear_theory import FieldWave
    >>> wave = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y / 20 - t)) + 0 * x, period=1.0)
    >>> for length in (20, 40):
    ...     speed = line_balance(wave, alpha=0.25, rtol=1e-2, length=length)
    ...     print(f"V = {speed.mean:.2f} mm/s")
    V = 1.20 mm/s
    V = 1.20 mm/s
    """
    wave = arguments.wave(wave)
    sheet = Sheet(length=_checked_length(length, wave))
    contact = Contact.named(load, friction, slip_speed)
    scene = Scene(sheet, wave, alpha, growth_law=growth_law, contact=contact)
    found = line_crawl(scene, Tolerance(rtol, atol), body)
    warn_if_viscous(contact.friction, found.slip_ratio)
    return found


@one_blas_thread
def line_crawl(scene: Scene, tolerance: Tolerance, body: str) -> CrawlSpeed:
    """`line_balance` of a body as long as the sheet of a scene, without its warning.

    Raises ValueError for a law of friction of one's own.
    """
    start, law, length = time.perf_counter(), scene.contact.friction, scene.sheet.length
    if not _integrable(law):
        names = ", ".join([*(kind.__name__ for kind in FRICTION_LAWS.values()), "Directional"])
        raise ValueError(f"friction = {shown(law)}: must be one of {names} for a body on a line")
    law.potential(np.ones((1, 1)))  # raises ValueError for a heading, which a line has not
    if map_on_ground(scene):
        raise ValueError(
            f"friction = {shown(law)}: must have no map on the ground for a body on a line"
        )
    piece = Piece.of(scene.growth.law, scene.contact.load, body)
    tolerance = tolerance.of_speed(scene.alpha, scene.unit)
    error = _wave_error(scene, piece)
    numbers = tolerance if error is None else error.leaves(tolerance, ALONG)
    answer = _in_lengths(scene, piece, numbers.scaled(length))
    estimate = Estimate(length * answer.mean, length * answer.error)
    found = CrawlSpeed(
        estimate=estimate,
        model_error=np.nan,
        converged=estimate.error <= numbers.allowed(estimate.value),
        times=answer.times,
        velocity=length * answer.velocity,
        slip_ratio=law.slip_ratio(length * answer.fastest),
        first_order=length * answer.first,
        second_order=length * answer.second,
        sticks=answer.sticks and answer.fastest > 0,
        energy=_energy(answer, law, length, scene.period),
        seconds=time.perf_counter() - start,
        model=_words(scene, body),
    )
    found = found if error is None else error.joins(found, tolerance, ALONG)
    return doubted(found, scene.wave)


def _integrable(law: FrictionLaw) -> bool:
    """Whether a law is one of those here; a subclass may have changed anything."""
    known = tuple(FRICTION_LAWS.values())
    if type(law) is Mapped:
        law = law.law
    return type(law) in known or (type(law) is Directional and type(law.form) in known)


def _wave_error(scene: Scene, piece: Piece) -> WaveError | None:
    """What the error of the wave does to the speed; None for a wave that is exact."""
    uncertainty, length = uncertainty_of(scene.wave), scene.sheet.length
    if uncertainty is None or scene.alpha == 0:
        return None
    scene.drive.check()
    law, shares = scene.contact.friction.scaled(length), equidistant_times(scene) / scene.period

    def mean(wave: Wave) -> NDArray[np.float64]:
        on_line = drive(wave, scene.sheet, on_axis(length))
        speed, power = coarse_means(on_line, scene.alpha, law, piece, shares * on_line.period)
        return length * np.array([0.0, speed, 0.0, power])

    return wave_error(uncertainty, scene.wave, mean)


def _checked_length(length: float | None, wave: Wave) -> float:
    """Length of the body. Raises ValueError if it is not given although the wave depends on it."""
    if length is not None:
        return validation.positive("length", length)
    if drive(wave, Sheet()).series is not None:
        return 1.0
    raise ValueError(
        f"length = None: must be given, > 0, for wave = {shown(wave)}, a function of y in some "
        "unit of length; only a TravellingWave is a function of y/length"
    )


def _in_lengths(scene: Scene, piece: Piece, tolerance: Tolerance) -> LineMotion:
    """The balance in units of the length of the body, as for the tolerance."""
    law, series = scene.contact.friction.scaled(scene.sheet.length), scene.drive.series
    if series is not None and law.map is None:
        return travelling_balance(series, scene.alpha, law, piece)
    on_line = drive(scene.wave, scene.sheet, on_axis(scene.sheet.length))
    return sampled_balance(on_line, scene.alpha, law, piece, tolerance)


def _energy(answer: LineMotion, law: FrictionLaw, length: float, period: float) -> Energy:
    """In units of length, of an answer in lengths of the body."""
    power = Estimate(*(length * v for v in answer.power))
    return Energy(power, length * answer.friction, law, mean_map(law, 0.0, length, period))


def _words(scene: Scene, body: str) -> str:
    shape = {"line": "body on a line", "strip": "narrow strip that grows both ways"}[body]
    stretch = f"stretch {scene.growth.law.words}"
    remarks = stretch, "quasi-static", "shape not deformed by friction"
    return model_words(shape, None, scene.contact, *remarks)
