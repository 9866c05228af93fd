"""One protocol for all waves: what a user must give, and what a wave on a body may know of itself."""

import ast
import math
from pathlib import Path

import numpy as np
import pytest

import fem_check
import linear_theory
from fem_check import Material, Membrane, Scene, cycle_speed
from linear_theory import (
    FieldWave,
    Sheet,
    SineWave,
    TravellingWave,
    airy_series,
    crawl_speed,
    line_balance,
    ritz_field,
)
from linear_theory.wave.protocol import Drive
from linear_theory.wave.sampled import SampledDrive, drive
from linear_theory.wave.spectrum import Spectrum

SHEET, SINE, ALPHA, TURN = Sheet(), SineWave(), 0.1, 2 * np.pi
EFFECTS = [Membrane(Material(SHEET.thickness, SHEET.poisson))]


class Plain:
    """c = sin(2 pi (y - t)) by period, value and rate alone, which leave out x."""

    period = 1

    def __init__(self):
        self.calls = 0

    def value(self, x, y, t, length=1.0):
        self.calls += 1
        return np.sin(TURN * (y / length - t))

    def rate(self, x, y, t, length=1.0):
        return -TURN * np.cos(TURN * (y / length - t))


class Known(Plain):
    """The same wave, which says that it is a travelling one."""

    def on(self, sheet, places=None):
        return SINE.on(sheet)


class Symmetric(Plain):
    """The same wave, which knows its symmetries and scales, though not its series."""

    def on(self, sheet, places=None):
        return Exact(self, sheet)


class Exact(Drive):
    mirrored, reversal_time, changes_sign, depends_on_x = True, 0.5, True, False
    size, rates, short_waves = math.sqrt(0.5), Spectrum(np.array([TURN / math.sqrt(2)]), 0.0), (1, 2)

    def value(self, x, y, t):
        return super().value(x, y, t) + 0 * x

    def rate(self, x, y, t):
        return super().rate(x, y, t) + 0 * x

    def growths(self, x, y):
        return np.array([-1.0, 1.0])

    def check_period(self):
        pass


def scene(wave):
    return Scene(SHEET, wave, ALPHA, effects=EFFECTS, cells=(2, 4))


LEVELS = {
    "sheet": lambda wave: crawl_speed(SHEET, wave, ALPHA, rtol=2e-2),
    "second order": lambda wave: crawl_speed(SHEET, wave, ALPHA, rtol=2e-2, order=2),
    "line": lambda wave: line_balance(wave, ALPHA, rtol=2e-2, length=2.0),
    "cycle": lambda wave: cycle_speed(scene(wave), rtol=2e-2),
}


@pytest.mark.parametrize("level", LEVELS)
@pytest.mark.parametrize("kind", [Plain, Known, Symmetric])
def test_a_wave_without_a_base_class_drives_every_level(kind, level):
    exact, found = (LEVELS[level](wave) for wave in (SINE, kind()))
    assert abs(found.mean - exact.mean) <= found.error + exact.error
    assert found.converged
    if kind is not Plain or level == "line":  # by samples it is not known to be mirrored
        assert found.turning is None


def test_a_wave_that_is_a_series_is_never_asked_for_a_value():
    wave = Known()
    for level in LEVELS.values():
        exact, found = level(SINE), level(wave)
        assert (found.mean, found.error) == (exact.mean, exact.error)
    series = airy_series(SHEET, wave, rtol=1e-3)
    assert np.array_equal(
        series.velocity(0.1, 0.2, 0.3), airy_series(SHEET, SINE, 1e-3).velocity(0.1, 0.2, 0.3)
    )
    assert wave.calls == 0


def test_what_a_wave_knows_is_not_looked_for_in_samples(monkeypatch):
    def refuse(*_):
        raise AssertionError("sampled")

    monkeypatch.setattr(SampledDrive, "__init__", refuse)
    wave = Symmetric()
    known = drive(wave, SHEET)
    known.check()
    assert known.followed() is known  # a wave without a state is the same for all runs
    assert (known.changes_sign, known.depends_on_x, known.short_waves) == (True, False, (1, 2))
    assert known.times_for(0.0) == 5
    assert wave.calls == 0
    field = ritz_field(SHEET, wave, rtol=1e-2)
    assert field.mirrored
    assert field.numbers > 0  # solved for anew at each time: there are no load cases for all times
    for level in LEVELS.values():
        level(wave)
    with pytest.raises(AssertionError, match="sampled"):
        crawl_speed(SHEET, Plain(), ALPHA, rtol=2e-2)


@pytest.mark.parametrize(
    "wave",
    [
        *(SINE, SineWave(-2, 0.7), TravellingWave([0.4, 0.3], [0.0, 0.0], 1, 2.0)),
        *(TravellingWave([0.3, 0.2, 0.0, 0.1], [0.7, 0.0, 0.1, 0.2], 1, 1.3, 0.1),),
    ],
)
def test_samples_tell_what_the_series_knows(wave):
    sheet = Sheet(length=1.7, width=0.6)
    known, seen = wave.on(sheet), SampledDrive(wave, sheet)
    seen.check()
    assert known.changes_sign == seen.changes_sign
    assert not seen.depends_on_x
    assert seen.size == pytest.approx(known.size, rel=0.1)  # random points
    assert seen.short_waves == pytest.approx(known.short_waves, abs=1)
    highest = known.rates.sizes.size
    assert seen.rates.sizes[:highest] == pytest.approx(known.rates.sizes, rel=0.1, abs=1e-12)
    assert seen.rates.beyond(highest) == pytest.approx(0.0, abs=1e-9)
    x, y = (s * np.linspace(-0.5, 0.5, 33) for s in (sheet.width, sheet.length))
    for extreme in (np.min, np.max):
        growths = (extreme(d.growths(np.repeat(x, 33), np.tile(y, 33))) for d in (known, seen))
        assert next(growths) == pytest.approx(next(growths), abs=2e-2)
    points = 0.1, np.array([0.2, 0.3]), np.array([[0.4], [0.5]])
    for one, other in ((known.value, seen.value), (known.rate, seen.rate)):
        assert np.array_equal(one(*points), other(*points))


def test_a_finer_rate_does_not_look_at_the_wave_again():
    calls = []

    def value(x, y, t):
        calls.append(np.size(t))
        return np.sin(TURN * (y - t)) + 0.2 * y * np.sin(TURN * 40 * t) + 0 * x

    rough = FieldWave(value, 1.0).on(SHEET)
    assert rough.rates.highest(0.1) == 40
    assert rough.size > 0.7
    count, fine = len(calls), rough.fine
    assert fine.rates.highest(0.1) == 40
    assert fine.size == rough.size
    assert len(calls) == count
    place = 0.0, 0.5, np.linspace(0, 1, 50)
    exact = -TURN * np.cos(TURN * (0.5 - place[2])) + 4 * TURN * np.cos(TURN * 40 * place[2])
    errors = [abs(d.rate(*place) - exact).max() for d in (rough, fine)]
    assert errors[1] < 1e-8 < errors[0]


WAVES = {"Wave", "TravellingWave", "SineWave", "FieldWave"}


def test_nobody_asks_of_which_class_a_wave_is():
    """Outside of linear_theory/wave: the drive of a wave says what it knows."""
    own = Path(linear_theory.__file__).parent / "wave"
    for package in (linear_theory, fem_check):
        for path in Path(package.__file__).parent.rglob("*.py"):
            if own in path.parents:
                continue
            for node in ast.walk(ast.parse(path.read_text())):
                asks = isinstance(node, ast.Call) and getattr(node.func, "id", "") == "isinstance"
                names = {getattr(part, "id", "") for part in ast.walk(node)} if asks else set()
                assert not names & WAVES, f"{path}:{node.lineno}"
