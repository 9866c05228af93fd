"""The wave and the growth of a scene file."""

from pathlib import Path
from typing import Any

import numpy as np

from fem_check.answer.growth import alpha_of
from fem_check.files.parts.excitable import excitable_of
from fem_check.files.parts.ways import way_of
from fem_check.files.system import System
from fem_check.files.tables import GrowthTable, WaveTable
from linear_theory.growth.bilayer import bilayer
from linear_theory.growth.growth import Growth, Reference
from linear_theory.growth.laws import growth_law
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.measured import SampledWave
from linear_theory.wave.protocol import Wave
from linear_theory.wave.pulse import pulse_wave
from linear_theory.wave.travelling import SineWave, TravellingWave

MEASURED = ("period", "harmonics", "degree")
"""Keys of a measured wave beside its samples."""

ONLY = {
    **{"width": "pulse", "cosine": "harmonics", "sine": "harmonics", "mean": "harmonics"},
    **dict.fromkeys(("equation", "until", "rtol", "orbit"), "excitable"),
}
"""Keys of a wave that only one kind has."""

WAYS = ("alpha", "swelling", "bilayer")
"""To say how much c grows the sheet."""


def wave_of(
    table: WaveTable, system: System, folder: Path, sheet: Sheet | None, cut: bool = False
) -> Wave:
    """The wave on a sheet. Raises ValueError for keys that do not go together.

    sheet: needed by an equation only. cut: whether the body is an outline within that rectangle.
    """
    if table.csv is not None or table.samples is not None:
        return _measured(table, system, folder)
    for name in MEASURED[1:]:
        if name in table.model_fields_set:
            raise ValueError(f"{name}: must be left out, only a measured wave has it")
    kind = table.kind or "sine"
    for name, owner in ONLY.items():
        if name in table.model_fields_set and kind != owner:
            raise ValueError(f"{name}: must be left out, only a wave of kind = {owner!r} has it")
    if kind == "excitable":
        return _excitable(table, system, sheet, cut)
    period = system.number(table.period, 1.0)
    if kind == "sine":
        return SineWave(table.count, period)
    if kind == "pulse":
        if table.width is None:
            raise ValueError("width: must be given for a pulse, such as '20 %' of a wavelength")
        return pulse_wave(system.number(table.width), table.count, period)
    cosine, sine = table.cosine or [], table.sine or []
    size = max(len(cosine), len(sine))
    even, odd = (np.pad(np.array(part, float), (0, size - len(part))) for part in (cosine, sine))
    return TravellingWave(even, odd, table.count, period, table.mean)


def _excitable(table: WaveTable, system: System, sheet: Sheet | None, cut: bool) -> Wave:
    if table.equation is None or sheet is None:
        raise ValueError("equation: must be given for kind = 'excitable', as { preset = 'printed' }")
    for name in ("period", "count"):
        if name in table.model_fields_set:
            raise ValueError(f"{name}: must be left out, the equation makes its own waves")
    if cut:
        raise ValueError(
            "kind = 'excitable': must be another beside [outline]; in Python, equation.on(Outline(...))"
        )
    return excitable_of(table, system, sheet)


def _measured(table: WaveTable, system: System, folder: Path) -> Wave:
    """A wave from samples, in this file or in another one."""
    way = "csv" if table.samples is None else "samples"
    others = sorted(table.model_fields_set - {way, *MEASURED})
    if others:
        raise ValueError(f"{way}: must not be combined with {', '.join(others)}")
    period = None if table.period is None else system.number(table.period)
    degree = tuple(table.degree) if isinstance(table.degree, list) else table.degree
    options: dict[str, Any] = {"period": period, "harmonics": table.harmonics, "degree": degree}
    if table.samples is not None:
        named = (getattr(table.samples, name) for name in ("x", "y", "t", "c"))
        return SampledWave(*(values for values in named if values is not None), **options)
    path = folder / str(table.csv)
    if not path.is_file():
        raise ValueError(f"csv = {table.csv!r}: there is no such file")
    return SampledWave.from_csv(path, **options)


def growth_of(table: GrowthTable, system: System, sheet: Sheet, wave: Wave) -> Growth:
    """How c grows the sheet. Raises ValueError unless it is said in one of the WAYS."""
    way_of(table, WAYS)
    alpha = 0.0 if table.alpha is None else table.alpha
    coupling = system.number(table.curvature_coupling)
    if table.swelling is not None:
        alpha = alpha_of(_swelling(table, system), wave, sheet, table.law)
    if table.bilayer is not None:
        if table.curvature_coupling is not None:
            raise ValueError("curvature_coupling: must be left out, it follows from the two layers")
        alpha, coupling = _two_layers(table, system, sheet)
    curvature, area = Reference(table.curvature), Reference(table.area)
    return Growth(alpha, growth_law(table.law), coupling, curvature, area)


def _swelling(table: GrowthTable, system: System) -> float:
    """As a share; a plain number of 1 or more was surely meant in per cent."""
    assert table.swelling is not None
    share = system.number(table.swelling)
    if table.swelling.unit is None and share >= 1:
        raise ValueError(
            f"swelling = {share:g}: a plain number is a share, this one {share:g} times the length; "
            f"must be < 1, or in per cent, as in '{share:g} %'"
        )
    return share


def _two_layers(table: GrowthTable, system: System, sheet: Sheet) -> tuple[float, float]:
    """alpha and curvature coupling."""
    layers = table.bilayer
    assert layers is not None
    found = bilayer(
        system.number(layers.growth), sheet.thickness, layers.thickness_ratio, layers.modulus_ratio
    )
    return found.alpha, found.curvature if layers.side == "upper" else -found.curvature
