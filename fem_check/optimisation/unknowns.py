"""Scenes as points: which unknowns a scene has, between which bounds, and the scene at each point."""

from collections.abc import Mapping
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.choice.settings import RunSettings
from fem_check.optimisation.over import WIDEST as WIDE
from fem_check.optimisation.over import Field, parts_of, travelling
from fem_check.sweeps.points.measures import in_unit, measured
from fem_check.sweeps.variation import Variation
from linear_theory.common.shown import number
from linear_theory.optimisation.problem import Region, Unusable
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]


ROUNDING = 1e-9
"""Of the unknown of a field at a bound."""


class Unknowns:
    """The unknowns of a scene.

    fields, harmonics: what they are; base: of the fields, None without; fixed: values by which the
    scene differs from that of the base.
    """

    def __init__(
        self,
        scene: Scene,
        over: Mapping[str, Any],
        base: Variation | None = None,
        fixed: Mapping[str, Any] | None = None,
    ) -> None:
        self.fields, self.harmonics = parts_of(over)
        self.scene, self.over = scene, over
        self._like = travelling(scene) if self.harmonics else None
        self._base, self._fixed = base, dict(fixed or {})
        if self.fields and base is None:
            self._base = Variation.of(scene, RunSettings())
        if self._base is not None:
            self._base.check_axes([field.axis for field in self.fields])
            for field in self.fields:
                self._check_ends(field, self._base)
            self._check_scenes(self._base)

    def _check_ends(self, field: Field, base: Variation) -> None:
        """Raise ValueError, naming the bound, for one that the field itself does not allow, and for a
        field that has no numbers at all."""
        for share, which in ((0.0, "lower"), (1.0, "upper")):
            found, mistakes = base.scene_of({**self._fixed, field.name: field.said(share)})
            place = tuple(field.name.split("."))
            wrong = [words for at, words in mistakes.found if at[: len(place)] == place]
            if found is None and wrong:
                words = wrong[0].partition(": ")[2] or wrong[0]
                raise ValueError(f"over: {field.name}: {which} bound {field.said(share)}: {words}")

    def _check_scenes(self, base: Variation) -> None:
        """Raise ValueError, in the words of the scene, where it is none at both bounds and between."""
        wrong = []
        for share in (0.5, 0.0, 1.0):
            said = {field.name: field.said(share) for field in self.fields}
            found, mistakes = base.scene_of({**self._fixed, **said})
            if found is not None:
                return
            wrong.append("; ".join(words for _, words in mistakes.found))
        names = ", ".join(field.name for field in self.fields)
        raise ValueError(f"over: {names}: {wrong[0]}")

    @property
    def base(self) -> Variation | None:
        """The scene of which the fields are; None without fields."""
        return self._base

    @property
    def units(self) -> Units | None:
        """Of the numbers of a scene file; None for plain ones."""
        return None if self._base is None else self._base.units

    @property
    def names(self) -> list[str]:
        """Of all, in the order of points."""
        return [field.name for field in self.fields] + (self.harmonics.names if self.harmonics else [])

    @cached_property
    def region(self) -> Region:
        """Where points may lie; its centre is the middle of the bounds, and no wave at all."""
        fields, waves = len(self.fields), self.harmonics.unknowns if self.harmonics else 0
        low = np.concatenate([np.zeros(fields), np.full(waves, -WIDE)])
        high = np.concatenate([np.ones(fields), np.full(waves, WIDE)])
        centre = np.concatenate([np.full(fields, 0.5), np.zeros(waves)])
        spread = np.full(fields, 0.5)
        if self.harmonics is None:
            return Region(low, high, centre, spread)
        rule = Padded(self.harmonics.constraint, fields)
        return Region(low, high, centre, np.concatenate([spread, self.harmonics.spread]), (rule,))

    def scene_at(self, point: Array) -> Scene:
        """Raises `Unusable`, in the words of the scene, where there is none."""
        shares, waves = point[: len(self.fields)], point[len(self.fields) :]
        scene = self.scene
        if self.fields and self._base is not None:
            said = {f.name: f.said(float(s)) for f, s in zip(self.fields, shares, strict=True)}
            found, mistakes = self._base.scene_of({**self._fixed, **said})
            if found is None:
                raise Unusable("; ".join(words for _, words in mistakes.found))
            scene = found.scene
        if self.harmonics is None:
            return scene
        return scene.but(wave=self.harmonics.wave(waves, travelling(scene)))

    @cached_property
    def present(self) -> Array:
        """The point of the scene itself, which may lie outside; fields that it does not state: NaN."""
        found = [self._share(field) for field in self.fields]
        if self.harmonics is None or self._like is None:
            return np.array(found)
        return np.concatenate([found, self.harmonics.of(self._like)])

    @property
    def bounds(self) -> list[str]:
        """What may change, between which bounds, in words."""
        found = []
        for field in self.fields:
            low, high = (number(end) for end in field.axis.ends)
            found.append(f"{field.name} from {low} to {high} {field.axis.unit or ''}".rstrip())
        if self.harmonics is not None:
            count, rule = self.harmonics.count, self.harmonics.constraint.name
            found.append(f"{count} harmonic{'s' * (count > 1)} of the wave with {rule}")
        return found

    @property
    def outside(self) -> tuple[str, ...]:
        """Where the scene lies outside of the bounds, in words."""
        found, present = [], self.present
        for field, share in zip(self.fields, present[: len(self.fields)], strict=True):
            if not -ROUNDING <= share <= 1 + ROUNDING and not np.isnan(share):
                unit = f" {field.axis.unit}" if field.axis.unit else ""
                said, ends = number(field.at(float(share))), [number(end) for end in field.axis.ends]
                found.append(f"{field.name} = {said}{unit}, not from {ends[0]} to {ends[1]}{unit}")
        if self.harmonics is not None and self._like is not None:
            found += self.harmonics.outside(self._like)
        return tuple(found)

    def _share(self, field: Field) -> float:
        """The unknown of a field as the scene has it."""
        data: Any = self._base.definition()["tables"] if self._base is not None else {}
        for key in field.name.split("."):
            data = data.get(key) if isinstance(data, Mapping) else None
        part = None if data is None else measured(data)
        if part is None:
            return float("nan")
        try:
            return field.share(in_unit(part, field.axis.pint_unit))
        except ValueError:
            return float("nan")

    def values(self, point: Array) -> dict[str, Any]:
        """What fields and amplitudes are at a point, by name: numbers in the units of the bounds."""
        shares, waves = point[: len(self.fields)], point[len(self.fields) :]
        found: dict[str, Any] = {
            f.name: f.at(float(s)) for f, s in zip(self.fields, shares, strict=True)
        }
        if self.harmonics is not None:
            unit = self.harmonics.unit
            found |= dict(zip(self.harmonics.names, (unit * waves).tolist(), strict=True))
        return found

    def slopes(self, point: Array) -> Array:
        """Derivatives of `values` by the unknowns, (unknowns,)."""
        shares = point[: len(self.fields)]
        found = [f.slope(float(s)) for f, s in zip(self.fields, shares, strict=True)]
        waves = self.harmonics.unknowns if self.harmonics else 0
        return np.array(found + [self.harmonics.unit if self.harmonics else 1.0] * waves)

    def definition(self) -> dict[str, Any]:
        """As plain data, by which they are known again."""
        return {
            "scene": self.scene.key(),
            "fields": {
                f.name: [*f.axis.ends, f.axis.unit, f.axis.said_as.spacing] for f in self.fields
            },
            "harmonics": self.harmonics.to_dict() if self.harmonics else None,
        }


class Padded:
    """A constraint on the last unknowns alone; the first `before` do not enter."""

    def __init__(self, inner: Any, before: int) -> None:
        self._inner, self._before = inner, before
        self.name: str = inner.name

    def excess(self, point: Array) -> Array:
        """See Constraint."""
        return np.asarray(self._inner.excess(point[self._before :]))

    def slopes(self, point: Array) -> Array:
        """See Constraint."""
        slopes = self._inner.slopes(point[self._before :])
        return np.hstack([np.zeros((slopes.shape[0], self._before)), slopes])

    def curvature(self, multipliers: Array) -> Array:
        """See Constraint."""
        inner = self._inner.curvature(multipliers)
        size = self._before + inner.shape[0]
        found = np.zeros((size, size))
        found[self._before :, self._before :] = inner
        return found
