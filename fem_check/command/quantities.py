"""The question that the options ask, in the units that their quantities are in."""

from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from fem_check.answer.growth import alpha_of
from fem_check.answer.units import Units
from fem_check.command.options import Options
from fem_check.command.typed import angle, option, quantity, share
from fem_check.files.quantities import KINDS, Quantity
from linear_theory.friction.contact import Contact
from linear_theory.friction.directional import Directional
from linear_theory.friction.isotropic import Isotropic
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.laws import Tanh, friction_law
from linear_theory.friction.maps import FixedTo
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.measured import SampledWave
from linear_theory.wave.protocol import Wave
from linear_theory.wave.pulse import NARROWEST, pulse_wave
from linear_theory.wave.travelling import SineWave, TravellingWave

if TYPE_CHECKING:
    import pint

    from fem_check.excitable.presets import Preset

OPTIONS = {
    "length": "length",
    "width": "length",
    "thickness": "length",
    "period": "time",
    "slip_speed": "speed",
    "atol": "speed",
}
"""Dimension of each option that has one."""

WAVE_RTOL = 1e-2
"""Of c of an excitable wave, whose error is counted in that of the speed."""
DIRECTION = ("forward", "backward", "sideways", "heading", "fixed_to")
"""Options of friction with a direction."""

FORMULAS = ("count", "pulse", "sine", "cosine")
"""Options of a wave by a formula."""


class Asked(NamedTuple):
    """A scene, the tolerance, and the units of the numbers given.

    units: None for plain numbers, which are in units of the sheet.
    """

    scene: Scene
    rtol: float
    atol: float | None
    units: Units | None


def asked(options: Options) -> Asked:
    """The question posed by the options. Raises ValueError with the option, its value and a remedy."""
    given = {
        name: quantity(name, text, kind)
        for name, kind in OPTIONS.items()
        if (text := getattr(options, name)) is not None
    }
    preset = None if options.wave is None else _preset(options, [*given.values()])
    names = _common_units(given)
    numbers = {name: _in(names, OPTIONS[name], one) for name, one in given.items()}
    sheet = _sheet(numbers, names is not None, options.poisson)
    wave = _wave(options, numbers.get("period")) if preset is None else _orbit(preset, sheet)
    alpha, law = _alpha(options, wave, sheet), options.growth_law
    contact = Contact(options.load, _friction(options, numbers.get("slip_speed")))
    scene = Scene(sheet, wave, alpha, growth_law=law, area=options.area, contact=contact)
    units = None if names is None else Units(f"{names[0]:~P}", f"{names[1]:~P}")
    return Asked(scene, share("rtol", options.rtol), numbers.get("atol"), units)


def _friction(options: Options, slip_speed: float | None) -> FrictionLaw:
    """The law, with a direction where the options give one."""
    form = _form(options, slip_speed)
    forward, backward, default = options.forward, options.backward, Options()
    given = [name for name in DIRECTION if getattr(options, name) != getattr(default, name)]
    if not given:
        return form
    if forward is None or backward is None:
        lacking = "--forward" if forward is None else "--backward"
        raise ValueError(f"{lacking}: must be given beside {option(given[0])}")
    assert isinstance(form, Isotropic)
    heading = 0.0 if options.heading is None else angle("heading", options.heading)
    fixed_to = FixedTo.named(options.fixed_to)
    return Directional(forward, backward, options.sideways, heading, fixed_to, form)


def _form(options: Options, slip_speed: float | None) -> FrictionLaw:
    """The law without a direction. Raises ValueError unless it has a slip speed where it needs one."""
    needed = options.friction == Tanh.name
    if needed and slip_speed is None:
        example = f"'{KINDS['speed'].example}'"
        raise ValueError(f"--slip-speed: must be given beside --friction tanh, such as {example}")
    if not needed and slip_speed is not None:
        raise ValueError(
            f"--slip-speed {options.slip_speed!r}: must be left out, only --friction tanh has one"
        )
    if slip_speed is not None and not slip_speed > 0:
        raise ValueError(f"--slip-speed {options.slip_speed!r}: must be > 0")
    return friction_law(options.friction, slip_speed)


def _common_units(given: dict[str, Quantity]) -> "tuple[pint.Unit, pint.Unit] | None":
    """Units of length and time of the question; None if all numbers are plain.

    Raises ValueError if some are plain and others are not.
    """
    named = [(name, one) for name, one in given.items() if one.unit is not None]
    if not named:
        return None
    first = f"{option(named[0][0])} {named[0][1].text!r}"
    for name, kind in OPTIONS.items():
        needed, one = name in ("length", "period"), given.get(name)
        if (one is None and needed) or (one is not None and one.unit is None):
            said = option(name)
            what = said if one is None else f"{said} {one.text!r}"
            raise ValueError(
                f"{what}: needs a unit beside {first}, as in {said} '{KINDS[kind].example}'; or give "
                "plain numbers only, in units of the sheet"
            )
    length, period = given["length"].unit, given["period"].unit
    assert length is not None
    assert period is not None
    return length, period


def _in(names: "tuple[pint.Unit, pint.Unit] | None", kind: str, one: Quantity) -> float:
    if names is None:
        return one.number
    length, time = names
    return one.into({"length": length, "time": time, "speed": length / time}[kind])


def _sheet(numbers: dict[str, float], with_units: bool, poisson: float) -> Sheet:
    """The sheet; by default that of the paper, scaled in proportion if lengths have a unit."""
    sizes = {name: numbers[name] for name in ("length", "width", "thickness") if name in numbers}
    if with_units:
        paper = Sheet()
        for name in ("width", "thickness"):
            sizes.setdefault(name, getattr(paper, name) * sizes["length"])
    return Sheet(**sizes, poisson=poisson)


def _wave(options: Options, period: float | None) -> Wave:
    """Raises ValueError for options of different waves."""
    if options.wave_csv is None:
        return _series(options, 1.0 if period is None else period)
    default = Options()
    for name in FORMULAS:
        if getattr(options, name) != getattr(default, name):
            raise ValueError(
                f"--wave-csv {options.wave_csv!r}: must not be combined with {option(name)}"
            )
    if options.length is None:
        raise ValueError("--length: must be given beside --wave-csv, whose y is in its unit")
    if not Path(options.wave_csv).is_file():
        raise ValueError(f"--wave-csv {options.wave_csv!r}: there is no such file")
    return SampledWave.from_csv(options.wave_csv, period=period)


def _preset(options: Options, given: list[Quantity]) -> "Preset":
    """The equation named by --wave. Raises ValueError for one that does not repeat, and for units."""
    from fem_check.excitable.presets import PRESETS  # here: it loads finite elements

    said = f"--wave {options.wave!r}"
    named = {f"excitable:{n.replace(' = ', '=').replace(' ', '-')}": one for n, one in PRESETS.items()}
    repeating = " or ".join(w for w, one in named.items() if one.equation.pacing is not None)
    if options.wave not in named:
        raise ValueError(f"{said}: must be {repeating}")
    found = named[options.wave]
    if found.equation.pacing is None:
        raise ValueError(
            f"{said}: does not repeat, so that it has no single speed; must be {repeating}, or be in a "
            "scene file that is stepped through time, by sheetcrawl new excitable"
        )
    default = Options()
    for name in ("wave_csv", "period", *FORMULAS):
        if getattr(options, name) != getattr(default, name):
            raise ValueError(f"{said}: must not be combined with {option(name)}")
    if any(one.unit is not None for one in given):
        raise ValueError(
            f"{said}: must have plain numbers beside it, its unit of time is that of the reaction; "
            "units may stand in a scene file, by sheetcrawl new excitable"
        )
    return found


def _orbit(preset: "Preset", sheet: Sheet) -> Wave:
    """The wave on the sheet that repeats."""
    equation = preset.equation.scaled(sheet.length)
    return equation.on(sheet, preset.until, WAVE_RTOL).periodic()


def _series(options: Options, period: float) -> TravellingWave:
    """A wave by a formula."""
    harmonics = bool(options.sine or options.cosine)
    if options.pulse is not None:
        if harmonics:
            raise ValueError(f"--pulse {options.pulse:g}: must not be combined with --sine or --cosine")
        if not NARROWEST <= options.pulse < 1:
            raise ValueError(
                f"--pulse {options.pulse:g}: must be in [{NARROWEST:g}, 1), in wavelengths"
            )
        return pulse_wave(options.pulse, options.count, period)
    if not harmonics:
        return SineWave(options.count, period)
    size = max(len(options.sine), len(options.cosine))
    cosine, sine = (
        np.pad(np.array(part, float), (0, size - len(part))) for part in (options.cosine, options.sine)
    )
    return TravellingWave(cosine, sine, options.count, period)


def _alpha(options: Options, wave: Wave, sheet: Sheet) -> float:
    """alpha as given, or from the growth at the crest."""
    if options.growth is None:
        if options.alpha is None:
            raise ValueError("--growth: must be given, such as '12 %' of length, or --alpha instead")
        return options.alpha
    if options.alpha is not None:
        raise ValueError(
            f"--growth {options.growth!r}: must not be combined with --alpha {options.alpha:g}"
        )
    crest = quantity("growth", options.growth, "share")
    value = crest.into("dimensionless")
    if crest.unit is None and value >= 1:
        raise ValueError(
            f"--growth {options.growth!r}: a plain number is a fraction, here {value:g} times the "
            f"length; must be < 1, or in per cent, as in '{value:g} %'"
        )
    if not value > 0:
        raise ValueError(
            f"--growth {options.growth!r}: must be > 0 at the crest of the wave, as in '12 %'; for a "
            "wave that contracts the sheet give a negative --alpha"
        )
    return alpha_of(value, wave, sheet, options.growth_law)
