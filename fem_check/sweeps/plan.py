"""What a sweep asks: its scenes, how they are answered, and for how long at the most."""

import hashlib
import json
from abc import abstractmethod
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

from fem_check.answer.units import Units
from fem_check.choice.asked import way_for
from fem_check.choice.settings import RunSettings
from fem_check.choice.ways import ANSWERS
from fem_check.files.mistakes import Place
from fem_check.sweeps.points.axes import Axis, axes_of
from fem_check.sweeps.points.designs import Design
from fem_check.sweeps.variation import Variation
from linear_theory.common import validation
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.shown import Shown, plain
from linear_theory.scene.scene import Scene

LIMIT = 600.0
"""Seconds to a scene, unless it is given."""

DESIGNS: Any = Design
"""What a design must be, checked where a call may have given anything."""


class Question(NamedTuple):
    """One scene and how it is to be answered."""

    scene: Scene
    settings: RunSettings

    def key(self) -> str:
        """64 hexadecimal digits, the same for the same question in every process."""
        said = [self.scene.key(), plain(self.settings)]
        return hashlib.sha256(json.dumps(said, sort_keys=True).encode()).hexdigest()

    def check(self) -> None:
        """Raise ValueError where the level that is asked for cannot answer the scene."""
        way_for(self.scene, self.settings)


class Refused(SheetcrawlError, ValueError):
    """A scene of a sweep that cannot be; found: the place of each mistake, and words."""

    def __init__(self, message: str, found: Sequence[tuple[Place, str]] = ()) -> None:
        super().__init__(message)
        self.found = tuple(found)

    @classmethod
    def by(cls, found: Sequence[tuple[Place, str]]) -> "Refused":
        """For these mistakes."""
        return cls("; ".join(words for _, words in found), found)


class Plan(Shown):
    """The scenes of a sweep by their places 0, 1, 2, ...

    seconds: after which a scene is given up. axes: the fields that differ.
    """

    axes: tuple[Axis, ...]
    seconds: float

    @property
    @abstractmethod
    def size(self) -> int:
        """How many scenes."""

    @abstractmethod
    def points(self) -> Iterator[tuple[Any, ...]]:
        """What differs between them, one after the other."""

    @abstractmethod
    def question(self, point: Sequence[Any]) -> Question:
        """The scene of a point. Raises Refused where there is none."""

    @abstractmethod
    def definition(self) -> dict[str, Any]:
        """All of it as plain data, from which it is known again."""

    @property
    def units(self) -> Units | None:
        """Of the numbers; None for those of the sheet."""
        return None

    def told(self, place: Place, words: str) -> str:
        """What is wrong, with where it was said."""
        return words

    def key(self) -> str:
        """64 hexadecimal digits, the same for the same sweep."""
        return hashlib.sha256(json.dumps(self.definition(), sort_keys=True).encode()).hexdigest()


@dataclass(frozen=True, eq=False)
class Varied(Plan):
    """One scene with other values in some of its fields.

    level: of ANSWERS, None for that of the scene file.
    """

    base: Variation
    axes: tuple[Axis, ...]
    design: Design
    level: str | None = None
    seconds: float = LIMIT

    def __post_init__(self) -> None:
        _check(self.level, self.seconds)
        self.base.check_axes(self.axes)
        self.design.size(self.axes)

    @property
    def size(self) -> int:
        """By its design."""
        return self.design.size(self.axes)

    @property
    def units(self) -> Units | None:
        """Of the scene."""
        return self.base.units

    def points(self) -> Iterator[tuple[Any, ...]]:
        """Of its design."""
        return self.design.points(self.axes)

    def question(self, point: Sequence[Any]) -> Question:
        """The scene with the values of a point."""
        found, mistakes = self.base.scene_of(
            {axis.path: axis.said(value) for axis, value in zip(self.axes, point, strict=True)}
        )
        if found is None:
            raise Refused.by(mistakes.found)
        settings = found.run if self.level is None else replace(found.run, level=self.level)
        return _checked(Question(found.scene, settings))

    def told(self, place: Place, words: str) -> str:
        """With file and line."""
        return self.base.told(place, words)

    def definition(self) -> dict[str, Any]:
        """Scene, fields, design and level."""
        axes = [{"path": a.path, "unit": a.unit, **_said(a)} for a in self.axes]
        design = self.design.to_dict()
        return {**self.base.definition(), "over": axes, "design": design, "level": self.level}

    def _title(self) -> str:
        return f"Plan: {self.size} scenes over {', '.join(axis.path for axis in self.axes)}"


@dataclass(frozen=True, eq=False)
class Given(Plan):
    """Scenes one by one, all answered in the same way."""

    scenes: tuple[Scene, ...]
    settings: RunSettings
    seconds: float = LIMIT
    axes: tuple[Axis, ...] = ()

    def __post_init__(self) -> None:
        _check(self.settings.level, self.seconds)

    @property
    def size(self) -> int:
        """As they are given."""
        return len(self.scenes)

    def points(self) -> Iterator[tuple[Any, ...]]:
        """Their numbers."""
        return ((place,) for place in range(self.size))

    def question(self, point: Sequence[Any]) -> Question:
        """The scene of a number."""
        return _checked(Question(self.scenes[point[0]], self.settings))

    def definition(self) -> dict[str, Any]:
        """Their keys, and how they are answered."""
        keys = [scene.key() for scene in self.scenes]
        return {"scenes": keys, "settings": plain(self.settings)}

    def _title(self) -> str:
        return f"Plan: {self.size} scenes"


def _said(axis: Axis) -> dict[str, Any]:
    data = axis.to_dict()
    return {"given": data.get("given", data.get("said_as"))}


def _check(level: str | None, seconds: float) -> None:
    if level is not None:
        validation.choice("level", level, ANSWERS)
    validation.positive("seconds", seconds)


def _checked(question: Question) -> Question:
    try:
        question.check()
    except ValueError as problem:
        raise Refused.by([((), " ".join(str(problem).split()))]) from None
    return question


def plan_of(
    scene: Scene | Sequence[Scene],
    over: Any,
    design: Design,
    settings: RunSettings,
    seconds: float = LIMIT,
) -> Plan:
    """The plan of a call in Python. Raises ValueError for what does not fit together."""
    if isinstance(scene, Scene):
        if over is None:
            raise ValueError("over = None: must be given, as in {'growth.alpha': [0.1, 0.2]}")
        if not isinstance(design, DESIGNS):
            shown = validation.shown(design)
            raise ValueError(f"design = {shown}: must be a Grid, Paired, Random or LatinHypercube")
        validation.choice("level", settings.level, ANSWERS)
        validation.choice("level", settings.level, ANSWERS)
        return Varied(Variation.of(scene, settings), axes_of(over), design, None, seconds)
    if over is not None:
        raise ValueError("over: must be left out where the scenes are given one by one")
    if isinstance(scene, str | bytes | Path) or not isinstance(scene, Sequence) or not scene:
        raise ValueError(f"scene = {validation.shown(scene)}: must be a Scene, or a list of scenes")
    for i, one in enumerate(scene):
        validation.instance(f"scene[{i}]", one, Scene)
    return Given(tuple(scene), settings, seconds)
