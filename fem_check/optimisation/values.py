"""The objective at points: by which level, with which gradient, and through which smooth stages.

On a strip with a travelling wave the gradients of speed and power are those of `line.best.gradient`, at
other levels those of `adjoint` where there is one; of what is no function of the two they are found by
differences, twice as many answers as there are unknowns. Dry friction of a strip has kinks wherever a
turning value of the wave is at rest, and the best waves of given size have many of these: the speed is
approached through tanh laws of smaller and smaller slip speed. The power has no kinks there.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fem_check.choice.result import Prediction
from fem_check.choice.settings import RTOL, RunSettings
from fem_check.choice.solving import solve
from fem_check.optimisation.adjoint import Adjoint, Solves
from fem_check.optimisation.kept import Kept
from fem_check.optimisation.objectives import CostOfTransport, Objective, OfScene
from fem_check.optimisation.unknowns import Unknowns
from linear_theory.common.errors import BeyondReachWarning, SheetcrawlError, ViscousRegimeWarning
from linear_theory.common.estimate import Estimate
from linear_theory.friction.contact import Contact
from linear_theory.friction.laws import Coulomb, Tanh
from linear_theory.line.best.gradient import LineSlopes, scene_gradient
from linear_theory.optimisation.differences import Differences
from linear_theory.optimisation.problem import Evaluation, Unusable
from linear_theory.optimisation.problem import Objective as OfPoints
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import CrawlSpeed

Array = NDArray[np.float64]

ON_LINE = "strip"
"""The level that has a gradient of its own."""

ON_LINE_FIELDS = ("growth.alpha", "growth.swelling", "wave.period")
"""Fields that its gradient knows."""

FEW, SOME = 3, 12
"""Unknowns up to which second derivatives are computed, by differences and by an adjoint."""

SMALL = 1e-5
"""Change of an unknown by which alpha and period are differentiated."""

WIDTHS = (0.3, 0.1, 0.03, 0.01, 0.003, 0.001)
"""Slip speeds of the smooth stages, over |alpha| L/(nT), the unit of speeds on a strip."""

EXACT = 1e-9
"""Relative error of gradients on a strip: differences of gradients show no more than rounding, and
tests against differences of speeds 1e-9."""


PERIOD = LineSlopes(np.zeros(0), np.zeros(0), mean=0.0, alpha=0.0, period=1.0)
"""Of the period itself."""

REMEMBERED = 32
"""Speeds of the last points, of which several numbers may be asked for."""


def unheard(value: float) -> None:
    """No one hears of it."""


@dataclass(frozen=True)
class Question:
    """What is asked of every point: level, tolerance and objective, or another number of the answer.

    name: by which its answers are kept; watched: hears of every value of the objective; speeds,
    solves: of the last points, shared by those who ask for other numbers of the same scenes.
    """

    unknowns: Unknowns
    settings: RunSettings
    objective: Objective
    kept: Kept
    name: str = ""
    watched: Callable[[float], None] = unheard
    speeds: dict[bytes, CrawlSpeed] = field(default_factory=dict)
    solves: Solves = field(default_factory=Solves)

    def also(self, objective: Objective, name: str) -> "Question":
        """For another number of the same answers."""
        return replace(self, objective=objective, name=f"{self.name}{name} ", watched=unheard)

    def answer(self, scene: Scene) -> Prediction:
        """Of a scene. Raises `Unusable` beyond the reach of the level, and where it fails."""
        with warnings.catch_warnings():
            for kind in (ViscousRegimeWarning, BeyondReachWarning):
                warnings.simplefilter("ignore", kind)
            try:
                run = self.settings
                found = solve(scene, run.level, run.rtol, periods=run.periods, steps=run.steps)
            except (SheetcrawlError, ValueError, ArithmeticError) as problem:
                raise Unusable(" ".join(str(problem).split())) from None
        if found.speed.beyond_reach or found.caution:
            raise Unusable(found.speed.beyond_reach or found.caution)
        return found

    def value(self, point: Array) -> Estimate:
        """Signed, so that larger is better."""
        if isinstance(self.objective, OfScene):  # costs nothing
            found = self.objective.of_scene(self.unknowns.scene_at(point))
            return Estimate(self.objective.sign * found.value, found.error)
        found = self.kept.value(f"{self.name}value", point, lambda: self._signed(point))
        self.watched(self.objective.sign * found.value)
        return found

    def _signed(self, point: Array) -> Estimate:
        scene, key = self.unknowns.scene_at(point), point.tobytes()
        if key not in self.speeds:
            speed = self.answer(scene).speed
            while len(self.speeds) >= REMEMBERED:
                self.speeds.pop(next(iter(self.speeds)))
            self.speeds[key] = speed
        found = self.objective.of(self.speeds[key], scene)
        return Estimate(self.objective.sign * found.value, found.error)

    def by_differences(self, careful: bool = False) -> OfPoints:
        """With a gradient by differences. careful: and with its error."""
        return Differences(self.value, self.unknowns.region, careful)

    def by_adjoint(self) -> OfPoints | None:
        """With a gradient by an adjoint; None where there is none."""
        adjoint = self._adjoint
        if adjoint is None:
            return None
        return lambda point: self._kept("adjoint", point, lambda: adjoint(point))

    def _kept(self, what: str, point: Array, work: Callable[[], Evaluation]) -> Evaluation:
        """An evaluation from the file, or by the work."""
        found = self.kept.evaluation(f"{self.name}{what}", point, work)
        self.watched(self.objective.sign * found.value)
        return found

    @cached_property
    def _adjoint(self) -> Adjoint | None:
        settings = self.settings
        rtol = settings.rtol or RTOL
        return Adjoint.of(self.unknowns, self.objective, rtol, settings.level, self.solves)

    def along_line(self, width: float | None) -> OfPoints:
        """With the gradient on a strip. width: of a tanh law instead of dry friction, over the unit."""

        return lambda point: self._kept(f"line {width!r}", point, lambda: self._on_line(point, width))

    def _on_line(self, point: Array, width: float | None) -> Evaluation:
        scene, objective = self.unknowns.scene_at(point), self.objective
        if not scene.drive.series or not scene.drive.series.moves or scene.alpha == 0:
            if isinstance(objective, CostOfTransport):
                raise Unusable("cost of transport: the sheet gets nowhere")
            return Evaluation(0.0, 0.0, np.zeros(point.size), np.zeros(point.size))
        if width is not None:
            scene = self._smooth(scene, width)
        try:
            found = scene_gradient(scene, "strip")
        except ValueError as problem:
            raise Unusable(" ".join(str(problem).split())) from None
        value, slopes = objective.of(found.speed, scene), objective.slopes(found.speed, scene)
        gradient = slopes.speed * self._chain(point, found)
        gradient = gradient + slopes.power * self._chain(point, found.power)
        if slopes.period:
            gradient = gradient + slopes.period * self._chain(point, PERIOD)
        doubt = np.full(point.size, EXACT * float(np.linalg.norm(gradient)))
        kink = "" if objective.smooth_if_dry and not found.speed.sticks else found.kink
        sign = objective.sign
        return Evaluation(sign * value.value, value.error, sign * gradient, doubt, kink)

    def _chain(self, point: Array, of: LineSlopes) -> Array:
        """From derivatives by wave and couplings to those by the unknowns."""
        fields = [self._by_field(point, place, of) for place in self._places]
        harmonics = self.unknowns.harmonics
        if harmonics is None:
            return np.array(fields)
        waves, n, found = np.zeros(harmonics.unknowns), harmonics.count, of.cosine.size
        waves[:found], waves[n : n + found] = of.cosine, of.sine
        if harmonics.mean:
            waves[-1] = of.mean
        return np.concatenate([fields, harmonics.unit * waves])

    @property
    def _places(self) -> range:
        """Of the fields among the unknowns."""
        return range(len(self.unknowns.fields))

    def _by_field(self, point: Array, place: int, of: LineSlopes) -> float:
        """Through alpha and the period that a field stands for, which no work is needed for."""
        move = SMALL * np.eye(point.size)[place]
        one, other = (self.unknowns.scene_at(point + sign * move) for sign in (1, -1))
        changes = of.alpha * (one.alpha - other.alpha) + of.period * (one.period - other.period)
        return changes / (2 * SMALL)

    def _smooth(self, scene: Scene, width: float) -> Scene:
        """With a tanh law instead of dry friction."""
        contact, ours = scene.contact, self.unknowns.scene
        wave = ours.drive.series
        assert wave is not None
        slip = width * abs(ours.alpha) * ours.unit / abs(wave.count)
        return scene.but(contact=Contact(contact.load, Tanh(slip), contact.slope))

    @property
    def has_line_gradient(self) -> bool:
        """Whether the level is that of the line, with unknowns and objective that it knows."""
        scene = self.unknowns.scene
        return (
            self.settings.level == ON_LINE
            and self.objective.differentiable
            and scene.drive.series is not None
            and scene.alpha != 0
            and scene.contact.friction.map is None
            and all(one.name in ON_LINE_FIELDS for one in self.unknowns.fields)
        )

    def has_curvature(self) -> bool:
        """Whether second derivatives are worth their gradients, two for each unknown."""
        count = len(self.unknowns.names)
        return self.has_line_gradient or count <= (SOME if self._adjoint is not None else FEW)

    @property
    def is_dry(self) -> bool:
        """Whether the friction of the scene is dry, and the scene leaves it to be smoothed."""
        scene = self.unknowns.scene
        return type(scene.contact.friction) is Coulomb and not scene.effects

    def stages(self, widths: tuple[float, ...] = WIDTHS) -> list[OfPoints]:
        """Objectives to climb, one after the other."""
        if not self.has_line_gradient:
            return [self.by_adjoint() or self.by_differences()]
        if self.is_dry and not self.objective.smooth_if_dry:
            return [self.along_line(width) for width in widths]
        return [self.along_line(None)]

    def truth(self) -> Callable[[Array], Evaluation]:
        """The objective itself, without a gradient."""

        def evaluated(point: Array) -> Evaluation:
            here = self.value(point)
            nothing = np.full(point.size, np.nan)
            return Evaluation(here.value, here.error, nothing, nothing)

        return evaluated

    def proof(self, stage: int = -1) -> OfPoints:
        """What the certificate is of: a stage, by default the last, with errors of its gradient."""
        if self.has_line_gradient:
            return self.stages()[stage]
        return self.by_adjoint() or self.by_differences(careful=True)
