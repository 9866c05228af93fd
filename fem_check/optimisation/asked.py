"""What is asked of an optimisation: of which unknowns, what is to be best, by which level."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from fem_check.choice.settings import RTOL, RunSettings
from fem_check.choice.solving import solve
from fem_check.choice.ways import ANSWERS, way_of
from fem_check.optimisation.objectives import OBJECTIVES, Objective
from fem_check.optimisation.options.constraints import Bound
from fem_check.optimisation.options.robust import Robust, unknowns_of
from fem_check.optimisation.unknowns import Unknowns
from linear_theory.common import validation
from linear_theory.identity import content_key
from linear_theory.scene.scene import Scene


@dataclass(frozen=True)
class Asked:
    """A question. settings: by which level and to what tolerance speeds are found; constraints: by
    name; robust: None for one regime."""

    unknowns: Unknowns
    objective: Objective
    settings: RunSettings
    constraints: Mapping[str, Bound] = field(default_factory=dict)
    robust: Robust | None = None

    @cached_property
    def regimes(self) -> list[tuple[str, Unknowns]]:
        """With their names; none without. Raises ValueError, by name, for what is no regime."""
        if self.robust is None:
            return []
        unknowns = self.unknowns
        return unknowns_of(self.robust, unknowns.scene, unknowns.over, unknowns.base)

    def check_growth(self) -> None:
        """Raise ValueError where nothing grows or bends, whatever may change: every speed is 0."""
        if any(field.name.startswith("growth.") for field in self.unknowns.fields):
            return
        scenes = [self.unknowns.scene, *(one.scene for _, one in self.regimes)]
        if not any(grows(scene) for scene in scenes):
            raise ValueError(
                "growth.alpha = 0: must not be 0, or be among what may change: nothing grows or bends, "
                "and every speed is 0"
            )

    def with_level(self) -> "Asked":
        """With the level that answers the scene in place of "auto".

        Raises ValueError for none, where nothing grows, and, by name, for a regime that the level does
        not represent.
        """
        self.check_growth()
        settings = _with_level(self.unknowns.scene, self.settings)
        for name, one in self.regimes:
            try:
                way_of(one.scene, settings.level)
            except ValueError as problem:
                raise ValueError(f"regimes: {name}: {problem}") from None
        return replace(self, settings=settings)

    def definition(self) -> dict[str, Any]:
        """As plain data, by which the answers to it are known again."""
        return {
            "unknowns": self.unknowns.definition(),
            "objective": self.objective.to_dict(),
            "settings": self.settings.to_dict(),
            "constraints": {name: bound.definition() for name, bound in self.constraints.items()},
            "robust": None if self.robust is None else self.robust.definition(),
            "regimes": [[name, one.definition()] for name, one in self.regimes],
        }

    def functions(self) -> dict[str, Any]:
        """Keys of the functions in it, whose names say nothing of what they compute.

        Raises Unidentifiable, a ValueError, for a function whose answers cannot be known again.
        """
        functions: dict[str, Any] = {
            f"constraints: {name}": bound.of
            for name, bound in self.constraints.items()
            if callable(bound.of)
        }
        if self.objective not in OBJECTIVES.values():
            functions["objective"] = self.objective
        keys = {name: content_key(one, name) for name, one in functions.items()}
        return {"functions": keys} if keys else {}


def grows(scene: Scene) -> bool:
    """Whether the wave changes a length or a curvature."""
    return bool(scene.growth.alpha or scene.growth.curvature_coupling)


def _with_level(scene: Scene, settings: RunSettings) -> RunSettings:
    level = validation.choice("level", settings.level, ANSWERS)
    if level in ("auto", "predict"):
        way = way_of(scene, level)
        level = solve(scene, level, RTOL).level if way == "predict" else way
    else:
        way_of(scene, level)
    return RunSettings(level, settings.rtol, settings.periods, settings.steps)
