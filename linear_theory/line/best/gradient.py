"""Gradient of speed and power of a travelling wave on a line, in closed form up to quadrature.

With e = alpha c, stretch s(e), weight w = s^p, U = L/(nT) and the mean <.> over a period of the wave,
points slip by U (s_m - s), s_m the stretch at which the body is at rest, and V = U (s_m - <s>). A
change de of the growth strain (alpha cos k phi for an amplitude, c for alpha) changes it by

    dV = U (ds_m - <s' de>).

Dry friction: m is the value of e with a share q of the weight below, <w (1(e < m) - q)> = 0. The set
below gains where the wave crosses m, so that by the implicit function

    de_m = [sum_i w de/|e'| - 2 pi <w' de (1(e < m) - q)>] / sum_i w/|e'|,    ds_m = s'(m) de_m,

summed over the crossings phi_i. Where e' = 0 at a crossing (m is an extremum, or an inflection) the
weight 1/|e'| is infinite: V has a kink there, and what is returned on either side is far from constant.
A law with a width, f smooth, <w f> = 0:

    ds_m = [U <w f' s' de> - <w' f de>] / (U <w f'>).

The period enters by U alone: V is proportional to 1/T for dry and viscous friction, and for other laws

    T dV/dT = -U [<w f' (s - <s>)>/<w f'> ] ,    as w f' (dV - dU (s - <s>)) has the mean 0.
"""

import math
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.shown import Shown
from linear_theory.common.tolerance import Tolerance
from linear_theory.common.validation import shown
from linear_theory.friction.contact import Contact
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.load import Load
from linear_theory.growth.laws import GrowthLaw
from linear_theory.line.balance import line_crawl
from linear_theory.line.best.weights import Weights, weights_of
from linear_theory.line.body import Body
from linear_theory.line.piece import Piece
from linear_theory.line.profile import Profile
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.result import CrawlSpeed
from linear_theory.wave.travelling import TravellingWave

Array = NDArray[np.float64]

KINK = 1e-6
"""Distance of the value at rest from a turning value of the wave, over the range of the wave, below
which the speed is said to have a kink. Speeds change there by the square root of a change of the
wave."""

ANY = Tolerance(1e-4)
"""Travelling waves are solved to rounding whatever is asked for."""


@dataclass(frozen=True)
class LineSlopes(Shown):
    """Derivatives of a number: cosine, sine (harmonics,): with respect to the amplitudes of the wave;
    mean, alpha, period: likewise."""

    cosine: Array
    sine: Array
    mean: float
    alpha: float
    period: float


@dataclass(frozen=True)
class LineGradient(LineSlopes):
    """Derivatives of the mean speed V, and V itself.

    speed: the `CrawlSpeed`. power: derivatives of its power over mu and the weight. kink: why V is not
    differentiable here, in words, so that the numbers are a derivative from one side at the most; empty
    if it is. seconds: of the gradient, without the speed.
    """

    speed: CrawlSpeed
    power: LineSlopes
    kink: str
    seconds: float


def line_gradient(
    wave: TravellingWave,
    alpha: float,
    load: Load | str = "current",
    friction: FrictionLaw | str = "coulomb",
    slip_speed: float | None = None,
    growth_law: GrowthLaw | str = "linear",
    body: str = "line",
    *,
    length: float = 1.0,
) -> LineGradient:
    """Gradient of `line_balance` of a travelling wave, exact but for quadrature and rounding.

    Arguments as in `line_balance`. Speeds in length/time; alpha = 0 has no gradient of dry friction and
    is refused. Raises ValueError for it, for other waves, for friction with a map, and as
    `line_balance` does.

    >>> from linear_theory import TravellingWave, line_balance
    >>> from linear_theory.line.best.gradient import line_gradient
    >>> wave = TravellingWave(cosine=[1.0, 0.3], sine=[0.0, 0.1])
    >>> found = line_gradient(wave, alpha=0.1)
    >>> more = line_balance(TravellingWave([1.0, 0.3 + 1e-5], [0.0, 0.1]), alpha=0.1)
    >>> print(f"{found.cosine[1]:.4f} {(more.mean - found.speed.mean) / 1e-5:.4f}")
    -0.0966 -0.0966
    """
    contact = Contact.named(load, friction, slip_speed)
    sheet = Sheet(length=validation.positive("length", length))
    return scene_gradient(Scene(sheet, wave, alpha, growth_law=growth_law, contact=contact), body)


def scene_gradient(scene: Scene, body: str) -> LineGradient:
    """`line_gradient` of a body as long as the sheet of a scene, a "line" or a "strip"."""
    wave = _travelling(scene)
    law = scene.contact.friction
    if law.map is not None:
        raise ValueError(f"friction = {shown(law)}: must have no map for the gradient on a line")
    if scene.alpha == 0:
        raise ValueError("alpha = 0: must not be 0 for the gradient of a speed")
    speed = line_crawl(scene, ANY, body)
    start = time.perf_counter()
    length = scene.sheet.length
    piece = Piece.of(scene.growth.law, scene.contact.load, body)
    carried = Body.of(wave, scene.alpha, piece)
    unit = 1 / (wave.count * wave.period)
    law = law.scaled(length)
    level, found = weights_of(carried, speed.mean / length, law, unit)
    strains = _strains(scene.alpha, wave, found.speed.phases)
    along, power = (_slopes(one, strains, wave, length) for one in found)
    return LineGradient(
        **vars(along),
        speed=speed,
        power=power,
        kink=_kink(carried.profile, level, speed) if law.width == 0 else "",
        seconds=time.perf_counter() - start,
    )


def _slopes(weights: Weights, strains: Array, wave: TravellingWave, length: float) -> LineSlopes:
    changes, harmonics = length * weights.against(strains), wave.harmonics.size
    return LineSlopes(
        cosine=changes[:harmonics],
        sine=changes[harmonics : 2 * harmonics],
        mean=float(changes[-2]),
        alpha=float(changes[-1]),
        period=-weights.rate * length / wave.period,
    )


def _travelling(scene: Scene) -> TravellingWave:
    wave = scene.drive.series
    if wave is None:
        raise ValueError(f"wave = {shown(scene.wave)}: must be a TravellingWave for this gradient")
    return wave


def _strains(alpha: float, wave: TravellingWave, phases: Array) -> Array:
    """Changes of e with the amplitudes of cosine and sine, the mean and alpha, at phases."""
    angle = np.multiply.outer(wave.harmonics, phases)
    cosine, sine = np.cos(angle), np.sin(angle)
    c = wave.mean + wave.cosine @ cosine + wave.sine @ sine
    return np.concatenate([alpha * cosine, alpha * sine, np.full((1, phases.size), alpha), c[None]])


def _kink(profile: Profile, level: float, speed: CrawlSpeed) -> str:
    """Why dry friction has a kink here, in words."""
    if speed.sticks:
        return "part of the body is at rest: dry friction has a kink"
    turning = profile.values[:-1][_turns(profile)]
    near = np.min(abs(turning - level), initial=math.inf)
    if near <= KINK * np.ptp(profile.values):
        return "what is at rest is a turning value of the wave: dry friction has a kink"
    return ""


def _turns(profile: Profile) -> NDArray[np.bool_]:
    """Nodes at which the wave turns, but for the last one, which is the first."""
    slope = abs(profile.taylor[1, :-1])
    return np.asarray(slope <= 1e-9 * abs(profile.taylor[1]).max())
