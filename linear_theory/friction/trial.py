"""The trial of a law of friction that a user wrote: its methods must describe one and the same law.

A wrong method would not stop a solver: it would find a plausible number. The methods are compared with
each other and with differences, at fixed velocities in all directions around the width of the law.
"""

import functools
import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.pairs import PAIRS, product
from linear_theory.friction.law import FrictionLaw

Array = NDArray[np.float64]

SPEEDS = np.array([0.05, 0.3, 1.0, 2.0, 20.0])
"""Speeds of a trial in widths of the law, or as they are where it has no width."""

DIRECTIONS, SEED = 6, 5

STEPS = 1e-3, 5e-4
"""Of central differences, in speeds."""

AGREES, RIGHT = 1e-4, 1e-3
"""Difference of quotients of several steps up to which they are compared (elsewhere the law has a
kink), and of a derivative from them up to which it is right, relative to the force."""

EXACT = 1e-8
"""Relative difference of numbers that should be the same but for rounding."""

TINY_STEP, UNCANCELLED = 1e-15, 0.05
"""A step at which differences of forces cancel, and the relative error at which they have not."""

SHARE = 0.25
"""Of the load, at which the speed is asked for."""

SMALLEST, LARGEST = 1e-100, 1e100
"""Widths beyond which a law is tried at speeds of these sizes."""


class Fault(SheetcrawlError, ValueError):
    """What is wrong with a law, in words."""


@contextmanager
def _asking(demand: str) -> Iterator[None]:
    """Methods of a user's law: whatever they raise is a fault of the law, told with what was asked.

    Any exception is caught here and nowhere else: such a method is code that is not known.
    """
    try:
        yield
    except Exception as error:
        raise Fault(f"{demand}, and failed: {error!r}") from error


def check_law(law: FrictionLaw, components: int, argument: str = "friction") -> None:
    """Raise ValueError, with the method and its numbers, if the methods of a law contradict each other.

    components: of velocities, for which the law is tried, once. argument: its name, for the message.
    """
    try:
        fault = _kept_fault(law, type(law), components)
    except TypeError:  # it has no hash
        fault = _fault(law, components)
    if fault:
        raise ValueError(f"{argument} = {validation.shown(law)}: {fault}")


@functools.lru_cache(maxsize=256)
def _kept_fault(law: FrictionLaw, kind: type, components: int) -> str:
    return _fault(law, components)


def _fault(law: FrictionLaw, components: int) -> str:
    """The first fault; empty if there is none."""
    try:
        with np.errstate(all="ignore"):
            trial = Trial(law, components)
            for check in CHECKS:
                check(trial)
    except Fault as fault:
        return str(fault)
    return ""


class Trial:
    """A law, and velocities (components, 5, 6) at which it is tried, each with a change of its size."""

    def __init__(self, law: FrictionLaw, components: int) -> None:
        self.law, self.components = law, components
        if not isinstance(getattr(law, "name", None), str):
            raise Fault("name must be text, by which the law is called")
        self.width = _width(law)
        unit = self.width if 0 < self.width < math.inf else 1.0
        self.unit = min(max(unit, SMALLEST), LARGEST)
        random = np.random.default_rng(SEED)
        self.v, self.change = (self._spread(random) for _ in range(2))
        self.force = self.asked("force", self.v)
        self.tangent = self.asked("tangent", self.v)
        self.size = np.sqrt((self.force**2).sum(0))  # |f|, which is also that of tangent times v

    def _spread(self, random: np.random.Generator) -> Array:
        """Vectors of random directions, of SPEEDS."""
        v = random.normal(size=(self.components, 1, DIRECTIONS))
        return np.asarray(self.unit * SPEEDS[:, None] * v / np.sqrt((v**2).sum(0)))

    def asked(self, method: str, v: Array, *more: Any, of: Any = None) -> Array:
        """What a method of the law, or of one made of it, answers, of the right shape."""
        shapes = {"potential": (), "tangent": (len(PAIRS[len(v)][0]),)}
        shape = (*shapes.get(method, v.shape[:1]), *v.shape[1:])
        call = f"{method} of v with shape {v.shape}"
        with _asking(f"{call} must be an array of shape {shape}"):
            found = np.asarray(getattr(self.law if of is None else of, method)(v, *more))
        if found.shape != shape or found.dtype.kind not in "iuf":
            raise Fault(
                f"{call} has shape {found.shape} and dtype {found.dtype}: must be real, {shape}"
            )
        if not np.all(np.isfinite(found)):
            where = np.argwhere(~np.isfinite(found))[0][-(v.ndim - 1) :]
            raise Fault(f"{method} is not finite at v = {_vector(v, where)}")
        return found.astype(float)

    def compare(
        self, method: str, found: Array, wanted: Array, why: str, allowed: float, sure: Any = True
    ) -> None:
        """Raise Fault where two answers differ by more than is allowed, in sizes of the force.

        sure: where they are compared.
        """
        size = np.broadcast_to(self.size, found.shape) + 1e-3 * self.size.max()
        apart = np.where(sure, abs(found - wanted), 0.0) / size
        worst = np.unravel_index(apart.argmax(), apart.shape)
        if apart[worst] > allowed:
            raise Fault(
                f"{method} = {found[worst]:.6g} at v = {_vector(self.v, worst[-2:])}: must be "
                f"{wanted[worst]:.6g}, {why}"
            )


def _width(law: FrictionLaw) -> float:
    with _asking("width must be a number"):
        width = float(law.width)
    if not width >= 0:
        raise Fault(f"width = {width:g}: must be >= 0")
    return width


def _vector(v: Array, place: Any) -> str:
    return f"({', '.join(f'{x:.6g}' for x in v[(slice(None), *place)])})"


def _rests(trial: Trial) -> None:
    """No potential and no force at rest; a finite tangent of a law that has a width."""
    still = np.zeros((trial.components, 1, 1))
    for method in ("potential", "force", *(["tangent"] if trial.width else [])):
        found = trial.asked(method, still)
        if method != "tangent" and np.any(found):
            raise Fault(f"{method} = {abs(found).max():.6g} at rest: must be 0")


def _quotients(trial: Trial, method: str, unit: Any = 1.0) -> tuple[Array, NDArray[np.bool_]]:
    """The derivative along the change by differences, over a unit, and where they can be relied on."""
    found = []
    for step in STEPS:
        ends = (trial.asked(method, trial.v + s * step * trial.change) for s in (1, -1))
        ahead, behind = ends
        found.append((ahead - behind) / (2 * step * unit))
    return found[-1], abs(found[0] - found[1]) <= AGREES * trial.size


def _has_potential(trial: Trial) -> None:
    """The force is the gradient of the potential."""
    speed = np.sqrt((trial.v**2).sum(0))
    slope, sure = _quotients(trial, "potential", speed)
    along = (trial.force * trial.change).sum(0) / speed
    why = "as differences of the potential give it"
    trial.compare("force along a change of v", along, slope, why, RIGHT, sure)


def _has_tangent(trial: Trial) -> None:
    """The tangent is the derivative of the force."""
    slope, sure = _quotients(trial, "force")
    found = product(trial.tangent, trial.change)
    why = "as differences of the force give it"
    trial.compare("tangent times a change of v", found, slope, why, RIGHT, sure)


def _is_convex(trial: Trial) -> None:
    """The tangent has no negative eigenvalues: else a balance may have several solutions."""
    n = trial.components
    full = np.empty((*trial.size.shape, n, n))
    for entry, c, d in zip(trial.tangent, *PAIRS[n], strict=True):
        full[..., c, d] = full[..., d, c] = entry
    lowest = np.linalg.eigvalsh(full)[..., 0]
    speed = np.sqrt((trial.v**2).sum(0))
    worst = np.unravel_index((lowest * speed / trial.size.max()).argmin(), lowest.shape)
    if lowest[worst] * speed[worst] < -RIGHT * trial.size.max():
        raise Fault(
            f"tangent has the eigenvalue {lowest[worst]:.6g} at v = {_vector(trial.v, worst)}: must "
            "have none < 0, the potential of a law being convex"
        )


def _has_differences(trial: Trial) -> None:
    """force_difference is that of the force, and does not cancel."""
    for step in (0.5, 1e-3, -1e-3):
        found = trial.asked("force_difference", trial.v, trial.change, step)
        after = trial.asked("force", trial.v + step * trial.change)
        why = f"(force(v + step change) - force(v))/step at the step {step:g}"
        trial.compare("force_difference", found, (after - trial.force) / step, why, EXACT / abs(step))
    found = trial.asked("force_difference", trial.v, trial.change, TINY_STEP)
    why = f"the tangent times the change at the step {TINY_STEP:g}; it must not cancel there"
    trial.compare("force_difference", found, product(trial.tangent, trial.change), why, UNCANCELLED)


def _scales(trial: Trial) -> None:
    """The force of the scaled law at v/factor is that of this one at v, and its width is scaled."""
    for factor in (0.25, 3.0):
        with _asking(f"scaled({factor:g}) must be a law"):
            other = trial.law.scaled(factor)
        if not isinstance(other, FrictionLaw):
            raise Fault(f"scaled({factor:g}) = {validation.shown(other)}: must be a law")
        found = trial.asked("force", trial.v / factor, of=other)
        why = "the force at v of the law that is not scaled"
        trial.compare(f"scaled({factor:g}).force(v/{factor:g})", found, trial.force, why, EXACT)
        if not math.isclose(other.width, trial.width / factor, rel_tol=EXACT):
            raise Fault(
                f"scaled({factor:g}).width = {other.width:.6g}: must be width/{factor:g} = "
                f"{trial.width / factor:.6g}"
            )


def _is_symmetric(trial: Trial) -> None:
    """A law that says so has the same potential for (+-v_x, +-v_y), (-v_x, v_y) or -v."""
    law, flips = trial.law, []
    if law.even:
        flips += [(f"mirrored in component {c}", "even", [c]) for c in range(trial.components)]
    if law.mirrored and trial.components > 1:
        flips += [("mirrored in component 0", "mirrored", [0])]
    if law.reversible:
        flips += [("reversed", "reversible", list(range(trial.components)))]
    potential = trial.asked("potential", trial.v)
    speed = np.sqrt((trial.v**2).sum(0))
    for words, name, components in flips:
        other = trial.v.copy()
        other[components] *= -1
        found = trial.asked("potential", other) / speed
        why = f"as at the v {words}, for a law that says that it is {name}"
        trial.compare("potential/|v|", found, potential / speed, why, EXACT)


def _has_that_width(trial: Trial) -> None:
    """Well within the width of a law the force is smaller than at it."""
    if not 0 < trial.width < math.inf or trial.unit != trial.width:
        return
    v = trial.v[:, 2:3]  # of speed 1 width
    far, near = (np.sqrt((trial.asked("force", v * s) ** 2).sum(0)).max() for s in (1.0, 1e-3))
    if near > far / 2:
        raise Fault(
            f"width = {trial.width:g}: must be the least speed over which the force changes sign, but "
            f"at a thousandth of it the force is still {near / far:.3g} times as large"
        )


def _has_speeds(trial: Trial) -> None:
    """The speed along y at a share of the load is where the force is that share, if y is an axis."""
    if not trial.law.even or trial.unit not in (trial.width, 1.0):
        return
    with _asking(f"speed_at({SHARE}) must be a speed"):
        speed = float(trial.law.speed_at(SHARE))
    if not trial.width or not 0 < speed < math.inf:
        return
    v = np.zeros((trial.components, 1, 1))
    y = 0 if trial.components == 1 else 1
    v[y] = speed
    found = float(trial.asked("force", v)[y, 0, 0])
    if abs(found - SHARE) > RIGHT * SHARE:
        raise Fault(
            f"speed_at({SHARE}) = {speed:.6g}: must be the speed along y at which the force is "
            f"{SHARE}, but it is {found:.6g} there"
        )


def _responds(trial: Trial) -> None:
    """What `at` returns agrees with the methods, also of the components that are kept."""
    last = slice(trial.components - 1, trial.components)
    for kept in (slice(None), last):
        with _asking(f"at(v, {kept}) must be a response with force, tangent and moved"):
            met = trial.law.at(trial.v, kept)
            force, tangent = np.asarray(met.force), np.asarray(met.tangent)
            moved = np.asarray(met.moved(trial.change, 1e-3)[1])
        wanted = trial.asked("force_difference", trial.v, trial.change, 1e-3)
        whole = kept == slice(None)
        pairs = trial.tangent if whole else trial.tangent[-1:]
        speed = np.sqrt((trial.v**2).sum(0))
        for name, found, right in (
            ("force", force, trial.force[kept]),
            ("tangent", tangent * speed, pairs * speed),
            ("moved(change, step)[1]", moved, wanted[kept]),
        ):
            if found.shape != right.shape:
                raise Fault(f"at(v, {kept}).{name} has shape {found.shape}: must be {right.shape}")
            trial.compare(f"at(v, {kept}).{name}", found, right, "as the method of the law", EXACT)


CHECKS: tuple[Callable[[Trial], None], ...] = (
    *(_rests, _has_potential, _has_tangent, _is_convex, _has_differences),
    *(_scales, _is_symmetric, _has_that_width, _has_speeds, _responds),
)
