"""Several regimes in which a scene must do well: other friction, couplings, or whole other scenes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from fem_check.choice.settings import RunSettings
from fem_check.optimisation.over import ANSWERING
from fem_check.optimisation.unknowns import Unknowns
from fem_check.sweeps.points.axes import axes_of
from fem_check.sweeps.points.designs import Grid, Paired
from fem_check.sweeps.variation import Variation
from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.scene.scene import Scene

WORST, MEAN = "worst", "mean"

MOST = 32
"""Regimes."""


@dataclass(frozen=True)
class Robust(Value):
    """The objective over several regimes instead of in one.

    regimes: fields, each with a list of values or a `Between` with a count, every value with every
    other one, or side by side if `paired`; or a list of scenes, in each of which the unknowns change
    alike. by: "worst", the smallest of them is to be as large as it can be, or "mean". weights: of the
    mean, one to a regime, > 0; equal ones unless given. Constraints hold in every regime.
    Raises ValueError for others.

    >>> from fem_check import Robust
    >>> print(Robust({"friction.law": ["dry", "viscous"]}).by)
    worst
    """

    regimes: Mapping[str, Any] | Sequence[Scene]
    by: str = WORST
    weights: tuple[float, ...] | None = None
    paired: bool = False

    def __post_init__(self) -> None:
        validation.choice("by", self.by, (WORST, MEAN))
        validation.flag("paired", self.paired)
        _check_regimes(self.regimes)
        if self.weights is not None:
            if self.by == WORST:
                raise ValueError("weights: must be left out for by = 'worst'")
            object.__setattr__(self, "weights", _weights(self.weights))

    def of_each(self, count: int) -> tuple[float, ...]:
        """Weights of that many regimes, whose sum is 1."""
        weights = self.weights or (1.0,) * count
        return tuple(weight / sum(weights) for weight in weights)

    def definition(self) -> dict[str, Any]:
        """As plain data, but for the regimes."""
        return {"by": self.by, "weights": self.weights}


def _weights(given: object) -> tuple[float, ...]:
    if not isinstance(given, list | tuple):
        raise ValueError(f"weights = {validation.shown(given)}: must be a list of numbers")
    return tuple(validation.positive("weights", weight) for weight in given)


def _check_regimes(given: object) -> None:
    """Raise ValueError for what is neither fields nor two scenes."""
    if isinstance(given, Mapping):
        return
    if not isinstance(given, list | tuple) or not all(isinstance(one, Scene) for one in given):
        shown = validation.shown(given)
        raise ValueError(f"regimes = {shown}: must map fields to lists of values, or be scenes")
    if len(given) < 2:
        raise ValueError(f"regimes: {len(given)} scenes: must be two or more")


def _axes(regimes: Any, over: Mapping[str, Any]) -> Any:
    try:
        axes = axes_of(regimes)
    except ValueError as problem:
        raise ValueError(str(problem).replace("over", "regimes", 1)) from None
    for axis in axes:
        if axis.path.startswith(ANSWERING):
            raise ValueError(f"regimes: {axis.path}: says how a scene is answered, not what it is")
        if axis.path in over:
            raise ValueError(f"regimes: {axis.path}: must not be among what may change, too")
    return axes


def unknowns_of(
    robust: Robust, scene: Scene, over: Mapping[str, Any], base: Variation | None
) -> list[tuple[str, Unknowns]]:
    """Those of every regime, with its name. Raises ValueError, by name, for what is no regime."""
    if isinstance(robust.regimes, Mapping):
        found = _by_fields(robust, scene, over, base)
    else:
        found = [(f"scene {place}", Unknowns(one, over)) for place, one in enumerate(robust.regimes, 1)]
    if not 1 < len(found) <= MOST:
        raise ValueError(f"regimes: {len(found)}: must be from 2 to {MOST}")
    if robust.weights is not None and len(robust.weights) != len(found):
        raise ValueError(f"weights: {len(robust.weights)}: must be {len(found)}, one to a regime")
    return found


def _named(axis: Any, value: Any) -> str:
    """A field with its value, in twelve digits: a tenth times three is 0.3."""
    said = f"{value:.12g} {axis.unit or ''}".rstrip() if isinstance(value, float) else axis.said(value)
    return f"{axis.path} = {said}"


def _by_fields(
    robust: Robust, scene: Scene, over: Mapping[str, Any], base: Variation | None
) -> list[tuple[str, Unknowns]]:
    axes = _axes(robust.regimes, over)
    design = Paired() if robust.paired else Grid()
    try:
        size = design.size(axes)
    except ValueError as problem:
        raise ValueError(f"regimes: {str(problem).removeprefix('over: ')}") from None
    if size > MOST:
        raise ValueError(f"regimes: {size}: must be from 2 to {MOST}")
    base, found = base or Variation.of(scene, RunSettings()), []
    for values in design.points(axes):
        fixed = {axis.path: axis.said(v) for axis, v in zip(axes, values, strict=True)}
        made, mistakes = base.scene_of(fixed)
        if made is None:
            raise ValueError(f"regimes: {'; '.join(words for _, words in mistakes.found)}")
        name = ", ".join(_named(axis, v) for axis, v in zip(axes, values, strict=True))
        found.append((name, Unknowns(made.scene, over, base, fixed)))
    return found
