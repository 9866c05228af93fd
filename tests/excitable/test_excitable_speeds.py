"""Speeds under excitable waves: cycle by cycle, and on periodic orbits."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from fem_check import Friction, Gravity, Material, Membrane, predict, simulate
from fem_check.choice.answers import noise
from fem_check.excitable import (
    Excitation,
    FitzHughNagumo,
    Pacing,
    PeriodicExcitation,
    RationalStart,
    UniformStart,
    excitable_preset,
    speeds,
)
from linear_theory import Contact, Scene, Sheet, SineWave, line_balance
from linear_theory.wave.uncertain import error_words

Array = NDArray[np.float64]

SHEET = Sheet()


def scene(wave: object, friction: str, alpha: float = 0.1) -> Scene:
    contact = Contact.named("current", friction, None)
    return Scene(SHEET, wave, alpha, contact=contact, growth_law="linear")  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def phase_wave() -> Excitation:
    return excitable_preset("nu = -0.1").on(SHEET, 220.0, 1e-2)


PACED = FitzHughNagumo(0.05, 0.5, 0.015, 0.05, UniformStart(), Pacing(110.0, reach=0.15))
"""A pulse train that is cheaper than the preset: its pulses are longer than the sheet."""


@pytest.fixture(scope="module")
def train() -> PeriodicExcitation:
    return PACED.on(SHEET, 240.0, 3e-2).periodic()


@cache
def excited(name: str, rtol: float) -> Excitation:
    return excitable_preset(name).on(SHEET, 170.0, rtol)


def viscous_mean(wave: Excitation, alpha: float, start: float, period: float) -> float:
    """Literal: v = V + alpha g, g the integral of dc/dt less its mean, and no net force on 1 + alpha
    c."""
    y, t = np.linspace(-0.5, 0.5, 801), start + period * np.linspace(0, 1, 801)[:, None]
    c, rate = wave.value(0.0, y, t), wave.rate(0.0, y, t)
    g = np.zeros_like(rate)
    g[:, 1:] = np.cumsum((rate[:, 1:] + rate[:, :-1]) / 2, axis=1) / 800
    g -= np.trapezoid(g, y, axis=1)[:, None]
    stretch = 1 + alpha * c
    velocity = -alpha * np.trapezoid(stretch * g, y, axis=1) / np.trapezoid(stretch, y, axis=1)
    return float(np.trapezoid(velocity, t[:, 0]) / period)


def test_viscous_speed_of_each_cycle_against_a_literal_balance(phase_wave: Excitation) -> None:
    found = speeds(scene(phase_wave, "viscous"), body="line", rtol=1e-3)
    for mean, error, start, period in zip(
        found.mean, found.error, found.start, found.period, strict=True
    ):
        literal = viscous_mean(phase_wave, 0.1, start, period)
        assert mean == pytest.approx(literal, abs=max(2e-3 * abs(literal), error))


@pytest.mark.parametrize("friction", ["coulomb", "viscous"])
@pytest.mark.parametrize("name", ["nu = -0.1", "nu = -0.05"])
def test_errors_of_cycles_are_honest(name: str, friction: str) -> None:
    """They include that of the wave: against a wave and means that are five times as accurate."""
    rough, good = (
        speeds(scene(excited(name, rtol), friction), rtol=rtol, body="line") for rtol in (1e-2, 2e-3)
    )
    assert np.all(abs(rough.mean - good.mean) <= rough.error + good.error)
    assert np.all(rough.error <= 0.02 * abs(rough.mean).max())
    assert not rough.settled
    assert "NOT settled" in repr(rough)


def test_a_symmetric_wave_moves_nothing() -> None:
    equation = excitable_preset("nu = -0.1").but(start=RationalStart(origin=0.0))
    found = speeds(scene(equation.on(SHEET, 150.0, 3e-2), "viscous"), body="line")
    assert abs(found.displacement).max() < 1e-8


def test_a_narrow_sheet_is_near_the_line(phase_wave: Excitation) -> None:
    """Both are of order alpha, where the width does not count: dry friction, small growth."""
    dry = scene(phase_wave, "coulomb", 0.02)
    line, sheet = (speeds(dry, [1], 2e-2, body) for body in ("line", "sheet"))
    assert sheet.mean[0] == pytest.approx(line.mean[0], rel=0.2)
    assert sheet.mean[0] < 0


def test_the_pulse_train_settles_on_its_orbit(train: PeriodicExcitation) -> None:
    wave = PACED.on(SHEET, 480.0, 3e-2)
    cycles = speeds(scene(wave, "coulomb"), [-2, -1], body="line", rtol=2e-2)
    orbit = line_balance(train, 0.1, length=1.0, rtol=2e-2)
    assert cycles.settled
    assert abs(cycles.mean[-1] - orbit.mean) <= cycles.error[-1] + orbit.error
    assert wave.repeats


def test_the_error_of_an_orbit_is_honest(train: PeriodicExcitation) -> None:
    finer = PACED.on(SHEET, 240.0, 6e-3).periodic()
    y, t = np.linspace(-0.5, 0.5, 60), np.linspace(0, 110, 80)[:, None]
    assert abs(train.value(0.0, y, t) - finer.value(0.0, y, t)).max() <= train.error + finer.error
    assert train.converged
    assert train.attracts
    one, other = (line_balance(wave, 0.1, length=1.0, rtol=1e-2) for wave in (train, finer))
    assert abs(one.mean - other.mean) <= one.error + other.error
    assert one.wave_error > 0


@pytest.mark.filterwarnings("ignore::linear_theory.BeyondReachWarning")
def test_answers_call_the_wave_and_its_error_what_they_are(train: PeriodicExcitation) -> None:
    found = predict(SHEET, train, 0.1, rtol=0.3, level="strip")
    said = " ".join(str(found).split())
    assert f"an excitable wave of period {train.period:.4g}" in said
    assert "numerical error of the excitable wave" in said
    assert "measured wave" not in said
    assert noise(replace(found.speed, wave_error=0.0), found.scene) == [error_words(train)]
    assert error_words(train) == "numerical error of the excitable wave"


def test_the_stepped_sheet_follows_a_wave_that_does_not_repeat(phase_wave: Excitation) -> None:
    effects = (Membrane(Material(0.03, 0.5)), Gravity(3e-6, "current"), Friction(1.0, 1e-3))
    stepped = Scene(SHEET, phase_wave, alpha=0.05, effects=effects, cells=(1, 3))
    found = simulate(stepped, periods=2, steps=40)
    assert found.period_speeds.shape == (2,)
    assert not found.speed.converged
    with pytest.raises(ValueError, match="until = 220: must be >= "):
        simulate(stepped, periods=9)


def test_speeds_refuses_what_it_cannot_answer(phase_wave: Excitation) -> None:
    with pytest.raises(ValueError, match="must be an Excitation"):
        speeds(Scene(SHEET, SineWave(), alpha=0.1))
    with pytest.raises(ValueError, match="k = 7: must be one of the 3 cycles"):
        speeds(scene(phase_wave, "viscous"), [7])
    with pytest.raises(ValueError, match="body = 'rod'"):
        speeds(scene(phase_wave, "viscous"), body="rod")
