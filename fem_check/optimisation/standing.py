"""How a scene as it is given stands to its limits, before any search."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from fem_check.choice.ways import THEORIES
from fem_check.optimisation.asked import Asked
from fem_check.optimisation.kept import Kept
from fem_check.optimisation.objectives import OfScene
from fem_check.optimisation.options.constraints import Side, sums_of
from fem_check.optimisation.task import MET, Task
from fem_check.optimisation.values import Question
from fem_check.optimisation.words import shown
from linear_theory.common.estimate import Estimate
from linear_theory.optimisation.problem import Unusable

LATER = "is asked for as the search begins"
"""What is said of the numbers of other levels."""


class Standing(NamedTuple):
    """Of one limit. met: None where it is not known; words: why, or the number with its unit."""

    name: str
    met: bool | None
    words: str

    def __str__(self) -> str:
        if self.met is None:
            return f"{self.name}: {self.words}"
        kept = "" if self.met else ", beyond it: the search first moves within it"
        return f"{self.name}: {self.words} as given{kept}"


def standings(asked: Asked) -> list[Standing]:
    """Of all limits, in every regime; of sums, which no answer is needed for, first.

    Numbers of answers are asked for where the level is a theory. Raises ValueError, by name, for what
    no scene meets within the bounds, and for no level.

    >>> from fem_check import Bound
    >>> from fem_check.choice.settings import RunSettings
    >>> from fem_check.optimisation.asked import Asked
    >>> from fem_check.optimisation.objectives import Speed
    >>> from fem_check.optimisation.standing import standings
    >>> from fem_check.optimisation.unknowns import Unknowns
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> scene = Scene(Sheet(width=0.1), SineWave(), alpha=0.2)
    >>> unknowns = Unknowns(scene, {"growth.alpha": (0.1, 0.3)})
    >>> limits = {"stretch": Bound(at_most=1.2), "power": Bound(at_most=0.2)}
    >>> for one in standings(Asked(unknowns, Speed(), RunSettings("strip"), limits)):
    ...     print(one)
    stretch <= 1.2: 1.2214 as given, beyond it: the search first moves within it
    power <= 0.2: 0.12811 length/time as given
    """
    asked = asked.with_level()
    task = Task.of(asked, Kept(None, None))
    found = list(_sums(asked))
    for name, question in zip(task.names, task.questions, strict=True):
        for side in task.sides:
            where = f"{side.name} with {name}" if name else side.name
            found.append(_standing(where, side, question))
    return found


def _sums(asked: Asked) -> Iterator[Standing]:
    """At the scene itself; a field that it does not state leaves its sums unknown."""
    present = asked.unknowns.present
    for one in sums_of(asked.constraints, asked.unknowns):
        used = one.matrix.any(axis=0)
        if np.isnan(present[used]).any():
            yield Standing(one.name, None, "the scene as given does not state its fields")
            continue
        over = float(one.excess(np.where(used, present, 0.0)).max())
        yield Standing(one.name, over <= MET, "kept to" if over <= MET else "missed")


def _standing(name: str, side: Side, question: Question) -> Standing:
    quantity, scene = side.quantity, question.unknowns.scene
    try:
        if isinstance(quantity, OfScene):
            value = quantity.of_scene(scene)
        elif question.settings.level in THEORIES:  # within a second or two
            value = quantity.of(question.answer(scene).speed, scene)
        else:
            return Standing(name, None, LATER)
    except Unusable as problem:
        return Standing(name, None, f"not known of the scene as given: {problem}")
    return Standing(name, _within(side, value), f"{shown(value)} {side.unit or quantity.unit}".strip())


def _within(side: Side, value: Estimate) -> bool:
    return side.sign * (value.value - side.bound) <= MET * (abs(side.bound) or 1.0)
