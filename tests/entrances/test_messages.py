"""Messages of refusals are one line, whatever object they show."""

import warnings

import numpy as np
import pytest

from fem_check import (
    Bending,
    DeadLoad,
    Friction,
    Gravity,
    Ground,
    Material,
    Membrane,
    Outline,
    Terrain,
    cycle_speed,
    excitable_preset,
    predict,
    simulate,
    speeds,
)
from fem_check.command.actions.remarks import tell
from fem_check.files.writing import toml_of
from linear_theory import (
    Coulomb,
    FieldWave,
    SampledWave,
    Scene,
    Sheet,
    SineWave,
    TravellingWave,
    airy_series,
    crawl_speed,
    line_balance,
    ritz_field,
    second_order,
)

SPEED = crawl_speed(Sheet(), SineWave(), 0.1, rtol=0.1)
Y, T = np.linspace(-0.5, 0.5, 8), np.arange(8) / 8
MEASURED = SampledWave(Y, T, np.sin(2 * np.pi * (Y[:, None] - T)), period=1.0)
EXCITED = excitable_preset("nu = -0.1").on(Sheet(), 90.0, 0.1)
LONG = [SPEED, MEASURED, np.eye(30), "two\nlines", TravellingWave(np.ones(30), np.ones(30)), EXCITED]
"""Objects whose repr has many lines, most of them."""

MATERIAL = Material(0.03, 0.5)
PLANE = (Membrane(MATERIAL), Gravity(1e-6, "current"), Friction(1.0, 1e-2))


def scene(**options):
    return Scene(Sheet(), SineWave(), 0.1, **options)


CALLS = {
    "sheet": lambda one: crawl_speed(one, SineWave(), 0.1),
    "wave": lambda one: crawl_speed(Sheet(), one, 0.1, load="material", friction="sticky"),
    "alpha": lambda one: crawl_speed(Sheet(), SineWave(), one),
    "load": lambda one: crawl_speed(Sheet(), SineWave(), 0.1, load=one),
    "friction": lambda one: crawl_speed(Sheet(), SineWave(), 0.1, friction=one),
    "slip speed": lambda one: crawl_speed(Sheet(), SineWave(), 0.1, friction=Coulomb(), slip_speed=one),
    "slip speed of a name": lambda one: crawl_speed(
        Sheet(), SineWave(), 0.1, friction="viscous", slip_speed=one
    ),
    "rtol": lambda one: crawl_speed(Sheet(), SineWave(), 0.1, rtol=one),
    "method": lambda one: crawl_speed(Sheet(), SineWave(), 0.1, method=one),
    "growth law": lambda one: predict(Sheet(), SineWave(), 0.1, one),
    "line": lambda one: line_balance(one, 0.1, length=one),
    "order two": lambda one: second_order(one, SineWave()),
    "series": lambda one: airy_series(Sheet(), one, rtol=one),
    "ritz": lambda one: ritz_field(Sheet(), SineWave(), degree=one),
    "function": lambda one: FieldWave(one, period=1.0),
    "rate": lambda one: FieldWave(lambda x, y, t: 0 * x, 1.0, one),
    "effects": lambda one: scene(effects=one),
    "an effect": lambda one: scene(effects=[one]),
    "cells": lambda one: scene(effects=PLANE, cells=one),
    "contact": lambda one: scene(contact=one),
    "material": lambda one: Bending(one),
    "height": lambda one: Terrain(one),
    "ground": lambda one: Ground(one),
    "law": lambda one: Friction(1.0, law=one),
    "load on a line": lambda one: DeadLoad(one),
    "outline": lambda one: Outline(one),
    "periods": lambda one: simulate(scene(effects=PLANE), periods=one),
    "steps": lambda one: simulate(scene(effects=PLANE), periods=1, steps=one, rtol=0.1),
    "no steps": lambda one: simulate(scene(effects=PLANE), periods=1, steps=one),
    "velocity": lambda one: simulate(scene(effects=PLANE), periods=1, steps=40, velocity=one),
    "cycle": lambda one: cycle_speed(one),
    "cycles": lambda one: speeds(one),
    "body": lambda one: EXCITED.equation.on(one, 10.0),
    "start": lambda one: EXCITED.equation.but(start=one),
    "preset": lambda one: excitable_preset(one),
    "scene file": lambda one: toml_of(one),
}


@pytest.mark.parametrize("name", CALLS)
def test_a_refusal_is_one_line(name: str) -> None:
    refused = 0
    for one in LONG:
        try:
            CALLS[name](one)
        except ValueError as problem:
            refused += 1
            said = str(problem)
            assert "\n" not in said, said
            assert len(said) < 500, said
        except (TypeError, AttributeError) as problem:
            pytest.fail(f"{type(one).__name__}: {problem!r}")
    assert refused


def test_deprecations_of_libraries_are_not_told(capsys: pytest.CaptureFixture[str]) -> None:
    with warnings.catch_warnings(record=True, action="always") as seen:
        warnings.warn("of the answer", UserWarning, stacklevel=1)
        warnings.warn("between libraries", DeprecationWarning, stacklevel=1)
    tell(seen)
    assert capsys.readouterr().err == "sheetcrawl: warning: of the answer\n"
