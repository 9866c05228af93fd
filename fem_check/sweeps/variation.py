"""One scene as the tables of its scene file, in which fields are given other values."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from fem_check.answer.units import Units
from fem_check.choice.settings import RunSettings
from fem_check.files.fields import Table
from fem_check.files.mistakes import Mistakes, Place, line_of
from fem_check.files.parts.made import Made
from fem_check.files.parts.scene_file import SceneFile, built, wave_made_of
from fem_check.files.quantities import read
from fem_check.files.reading import tables_of as tables_in
from fem_check.files.system import BASES, system_of
from fem_check.files.tables import TABLES
from fem_check.files.units import unit_named
from fem_check.files.writing import tables_of
from fem_check.sweeps.points.axes import Axis
from fem_check.sweeps.points.fields import with_value, without_rivals
from linear_theory.scene.scene import Scene
from linear_theory.wave.measured import SampledWave
from linear_theory.wave.travelling import SineWave, TravellingWave

WRITTEN = (SineWave, TravellingWave, SampledWave)
"""Waves that a scene file holds; any other is passed on as it is."""


class Variation:
    """data: the tables as plain data. path: of their file, by which those that it names are found.

    text: of that file, for the lines of mistakes. wave: to be used instead of that of the tables, for
    one that they cannot hold. source: path and text of the file in which fields are given values.
    Raises SceneFileError.
    """

    def __init__(
        self,
        data: Mapping[str, Any],
        path: Path,
        text: str = "",
        mistakes: Mistakes | None = None,
        *,
        wave: Any = None,
        source: tuple[Path, str] | None = None,
    ) -> None:
        mistakes = Mistakes() if mistakes is None else mistakes
        self._data, self._path, self._made, self._source = data, path, Made(), source
        self._tables = tables_in(data, mistakes)
        self._given_wave = wave
        if wave is not None:
            system = system_of(self._tables, mistakes)
            self._made.keep("wave", wave_made_of(self._tables, system, None), wave)
        found = built(self._tables, path, mistakes, self._made)
        if found is None or mistakes:
            raise mistakes.error(path, text)
        self.file: SceneFile = found

    @classmethod
    def of(cls, scene: Scene, settings: RunSettings) -> "Variation":
        """Of a scene in Python. Raises ValueError for effects and laws that no scene file holds."""
        known = isinstance(scene.wave, WRITTEN)
        told = scene if known else scene.but(wave=SineWave(period=scene.period))
        try:
            data = tables_of(told, settings)
        except ValueError as problem:
            raise ValueError(f"{problem}; sweep over a list of scenes instead of over fields") from None
        if settings.rtol is not None:
            data.setdefault("run", {})["rtol"] = settings.rtol
        made = cls(data, Path("scene"), wave=scene.wave if not known else None)
        if made.file.scene.key() != scene.key():
            raise ValueError(
                "scene: a scene file cannot say exactly this; sweep over a list of scenes instead of "
                "over fields"
            )
        return made

    @property
    def units(self) -> Units | None:
        """Of the numbers; None for those of the sheet."""
        return self.file.units

    def check_axes(self, axes: Sequence[Axis]) -> None:
        """Raise ValueError for fields of a wave that is not in the tables, and for one field twice."""
        names = [axis.path for axis in axes]
        for i, name in enumerate(names):
            if name in names[:i]:
                raise ValueError(f"over: {name}: is there twice")
            if self._given_wave is not None and name.startswith("wave."):
                kind = type(self._given_wave).__name__
                raise ValueError(
                    f"over: {name}: a {kind} has no fields that a sweep knows; sweep over a list of "
                    "scenes, each with its wave"
                )

    def scene_of(self, values: Mapping[str, Any]) -> tuple[SceneFile | None, Mistakes]:
        """With those values in fields by their paths; None where it is no scene, for the mistakes."""
        mistakes = Mistakes()
        data: Mapping[str, Any] = self._data
        for path in values:
            data = without_rivals(data, path)
        for path, value in values.items():
            data = with_value(data, path, self._in_unit_of_file(path, value))
        changed = {path.partition(".")[0] for path in values}
        tables = {**self._tables, **self._valid(changed, data, mistakes)}
        if mistakes:
            return None, mistakes
        found = built(tables, self._path, mistakes, self._made)
        return (None if mistakes else found), mistakes

    def _valid(
        self, changed: set[str], data: Mapping[str, Any], mistakes: Mistakes
    ) -> dict[str, Table]:
        found = {}
        for name in sorted(changed):
            try:
                found[name] = TABLES[name].model_validate(data[name])
            except ValidationError as problem:
                mistakes.add_refused(name, problem, TABLES[name])
        return found

    def _in_unit_of_file(self, path: str, value: Any) -> Any:
        """Length and period of the base name the units of all numbers, speeds too: they stay."""
        if self.units is None or path not in UNIT_FIELDS or not isinstance(value, str):
            return value
        unit = getattr(self.units, UNIT_FIELDS[path])
        try:
            quantity = read(value, UNIT_FIELDS[path])
        except ValueError:
            return value  # refused, with its words, as in a scene file
        if quantity.unit is None:
            return value
        return f"{quantity.into(unit_named(unit))!r} {unit}"

    def told(self, place: Place, words: str) -> str:
        """With the file and the line where a field is given its values, if there is one."""
        if self._source is None:
            return words
        path, text = self._source
        line = line_of(text, ("over", *place)) if place else 0
        return f"{path}:{line}: {words}" if line else f"{path}: {words}"

    def definition(self) -> dict[str, Any]:
        """As plain data: the tables, and the key of the scene with all that they name."""
        return {"tables": self._data, "scene": self.file.scene.key()}


UNIT_FIELDS = {".".join(map(str, place)): name for name, place in BASES.items()}
"""The fields whose units are those of the file: of lengths, and of times."""
