"""Equations by name: the paper's numbers, two readings of them that give waves, a paced pulse
train, a spiral and one that breaks up."""

from dataclasses import dataclass

from fem_check.excitable.equation import FitzHughNagumo
from fem_check.excitable.starts import CrossedStart, Pacing, RationalStart, Start, UniformStart
from linear_theory.common.shown import Value
from linear_theory.common.validation import choice


@dataclass(frozen=True)
class Preset(Value):
    """An equation with a name, what it does in a sentence, and a time that shows it."""

    name: str
    words: str
    equation: FitzHughNagumo
    until: float

    def __str__(self) -> str:
        return f"{self.name}: {self.words}"


def _oscillating(threshold: float, start: Start | None = None) -> FitzHughNagumo:
    return FitzHughNagumo(threshold, 1e-4, 0.05, 0.02, RationalStart() if start is None else start)


PRESETS = {
    preset.name: preset
    for preset in (
        Preset(
            "printed",
            "the printed numbers, just beyond a Hopf bifurcation: an oscillation of amplitude 0.12 and "
            "period 29 whose phase lags by two thirds of a cycle along the sheet for some ten cycles; "
            "the lag decays, and in the end the whole sheet oscillates in phase.",
            _oscillating(-0.01),
            8 * 30.0,
        ),
        Preset(
            "nu = -0.1",
            "c from -0.48 to 0.77 with a period of 43, a phase wave towards +y of half a cycle along "
            "the sheet from the first cycle on, which decays over about 20 cycles to an oscillation in "
            "phase.",
            _oscillating(-0.1),
            8 * 45.0,
        ),
        Preset(
            "nu = -0.05",
            "c from -0.38 to 0.5 with a period of 40; a lag of a whole cycle along the sheet at first, "
            "half a cycle after six; to oscillate in phase is unstable here, and after some 150 cycles "
            "the middle of the sheet lags behind both ends.",
            _oscillating(-0.05),
            8 * 42.0,
        ),
        Preset(
            "pulse train",
            "excitable, at rest unless paced at the rear end: one pulse per stimulus runs along the "
            "sheet towards +y, the only one of the presets that travels for ever.",
            FitzHughNagumo(0.1, 1.0, 0.01, 0.02, UniformStart(), Pacing(150.0)),
            6 * 150.0,
        ),
        Preset(
            "spiral",
            "the numbers of nu = -0.1 from a crossed start, for a sheet as wide as long: the phase "
            "winds once around a core near the centre, so that a single spiral turns about it, once in "
            "42 and for seven turns at least; the core wanders, and the pattern does not repeat.",
            _oscillating(-0.1, CrossedStart()),
            8 * 42.0,
        ),
        Preset(
            "turbulent",
            "on a sheet as wide as long, 100 diffusion lengths each way: a spiral forms, breaks up by "
            "t = 700, and 1 to 10 cores come and go for ever; solutions that are all but equal part by "
            "a factor of e in 80 to 100 units of time, so that c has an error that is known for the "
            "first some hundred only, and statistics are what can be said beyond.",
            FitzHughNagumo(-0.05, 1e-4, 0.03, 0.01, CrossedStart()),
            300.0,
        ),
    )
}
"""By name."""


def excitable_preset(name: str) -> FitzHughNagumo:
    """The equation "printed", "nu = -0.1", "nu = -0.05", "pulse train", "spiral" or "turbulent".

    printed: an oscillation of amplitude 0.12 and period 29 that ends in phase. nu = -0.1, nu = -0.05:
    phase waves towards +y of amplitude about one. pulse train: one pulse per stimulus at the rear end.
    spiral: one spiral on a square sheet; turbulent: one that breaks up. `PRESETS` says more of each in
    a sentence, and how long to look.

    Raises ValueError for other names.

    >>> from fem_check import excitable_preset
    >>> print(excitable_preset("nu = -0.1").threshold)
    -0.1
    """
    return PRESETS[choice("name", name, tuple(PRESETS))].equation
