"""Wrong types at every entrance: a ValueError or TypeError that names the argument, or they work."""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

import fem_check
import linear_theory
from fem_check import Bending, Gravity, Material, Membrane, Outline, Scene, predict
from linear_theory import (
    FieldWave,
    Sheet,
    SineWave,
    TravellingWave,
    airy_series,
    crawl_speed,
    friction_field,
    line_balance,
    line_speed,
    ritz_field,
)
from linear_theory.common import validation

SHEET, WAVE, MATERIAL = Sheet(), SineWave(), Material(0.03, 0.5)
OUTLINE = Outline.trapezoid(0.6, 0.4, 1.0)
FIELD = ritz_field(SHEET, WAVE, degree=5)
SCENE = Scene(SHEET, WAVE, 0.1, effects=[Membrane(MATERIAL)], cells=(1, 2))


def growth(x, y, t):
    return np.sin(2 * np.pi * (y - t)) + 0 * x


GOOD: dict[str, dict[str, Any]] = {
    "crawl_speed": {"sheet": SHEET, "wave": WAVE, "alpha": 0.1, "rtol": 0.1},
    "field_speed": {"field": FIELD, "alpha": 0.1, "rtol": 0.1},
    "friction_field": {"field": FIELD, "alpha": 0.1, "x": 0.1, "y": 0.1, "t": 0.0, "rtol": 0.1},
    "second_order": {"sheet": SHEET, "wave": WAVE, "rtol": 0.1},
    "airy_series": {"sheet": SHEET, "wave": WAVE, "rtol": 0.1},
    "ritz_field": {"sheet": SHEET, "wave": WAVE, "rtol": 0.1},
    "line_balance": {"wave": WAVE, "alpha": 0.1, "rtol": 0.1},
    "rigid_path": {"speed": crawl_speed(SHEET, WAVE, 0.1, rtol=0.1)},
    "predict": {"sheet": SHEET, "wave": WAVE, "alpha": 0.1, "rtol": 0.1, "level": "strip"},
    "plane_stress_field": {"outline": SHEET, "wave": WAVE, "size": 0.4},
    "Scene": {
        "sheet": SHEET,
        "wave": WAVE,
        "alpha": 0.1,
        "effects": [Membrane(MATERIAL)],
        "cells": (1, 2),
    },
    "cycle_speed": {"scene": SCENE, "rtol": 0.1},
    "simulate": {"scene": SCENE, "periods": 1},
    "Membrane": {"material": MATERIAL},
    "Bending": {"material": MATERIAL},
    "Inertia": {"density": 1.0, "material": MATERIAL},
}
"""Arguments that each entrance takes; simulate refuses this scene, which has no motion in time."""

WRONG: dict[str, tuple[Any, ...]] = {
    "sheet": (WAVE, OUTLINE, Sheet, None, 1.0, "paper", MATERIAL, growth),
    "wave": (SHEET, growth, SineWave, FieldWave, None, 1.0, "sine", MATERIAL, np.sin, FIELD),
    "field": (SHEET, WAVE, None, 0.1, type(FIELD), SCENE),
    "scene": (SHEET, Scene, None, FIELD, "scene"),
    "speed": (0.1, None, FIELD, np.ones(3)),
    "outline": (WAVE, Outline, None, OUTLINE.corners, "square", growth),
    "material": (0.03, Material, None, SHEET),
    "effects": (
        *(None, 1.0, "Membrane", Membrane, [Membrane], [MATERIAL], [Membrane(MATERIAL), Gravity]),
        {"membrane": Membrane(MATERIAL)},
    ),
    "cells": (2, (2,), (2, 4, 6), "24", (2.0, 4.0), np.array([2.0, 4.0]), [[2], [4]], {2, 4}, (0, 1)),
    "alpha": (None, "0.1", [0.1], np.ones(1), 1j, True, np.ma.masked, Sheet, growth, 10**400),
    "rtol": (None, "1e-2", 0.0, 2.0, [1e-2], np.nan),
    "x": ("0", None, 1j, np.ma.array([0.1, 0.2], mask=[0, 1]), np.nan),
    "y": ("0", None, 1j, np.ma.masked, 0.6),
    "t": ("0", None, [0.0], np.inf),
    "periods": (None, 0, 1.5, "2", True),
    "density": (None, "1", 0.0, [1.0]),
    "level": (None, 1, "best", growth),
    "size": ("0.1", 0.0, [0.1], np.nan),
}
NONE_IS_THE_DEFAULT = {("ritz_field", "rtol")}


def entrance(name: str) -> Callable[..., Any]:
    found = getattr(fem_check, name, None) or getattr(linear_theory, name)
    assert callable(found)
    return found


CASES = [
    pytest.param(name, argument, value, id=f"{name}-{argument}-{i}")
    for name, arguments in GOOD.items()
    for argument in arguments
    for i, value in enumerate(WRONG[argument])
    if value is not None or (name, argument) not in NONE_IS_THE_DEFAULT
]


@pytest.mark.parametrize(("name", "argument", "value"), CASES)
def test_wrong_values_are_refused_by_name(name, argument, value):
    with pytest.raises((ValueError, TypeError)) as refusal:
        entrance(name)(**(GOOD[name] | {argument: value}))
    assert argument in str(refusal.value)
    assert len(str(refusal.value)) < 400


@pytest.mark.parametrize("name", sorted(GOOD.keys() - {"simulate"}))
def test_good_values_are_taken(name):
    """Else the refusals above would show nothing."""
    assert entrance(name)(**GOOD[name]) is not None


@pytest.mark.parametrize(
    ("call", "hint"),
    [
        (lambda: crawl_speed(WAVE, SHEET, 0.1), "the arguments are sheet, wave, alpha"),
        (lambda: predict(SHEET, growth, 0.1), r"FieldWave\(function, period\)"),
        (lambda: predict(SHEET, SineWave, 0.1), r"SineWave\(\.\.\.\)"),
        (lambda: predict(Sheet, WAVE, 0.1), r"write Sheet\(\)"),
        (lambda: crawl_speed(OUTLINE, WAVE, 0.1), "plane_stress_field"),
        (lambda: Scene(OUTLINE, WAVE, 0.1), r"Scene\(\.\.\., mesh=outline\.mesh\(size\)\)"),
        (
            lambda: Scene(SHEET, WAVE, 0.1, effects=[Membrane(MATERIAL), Gravity]),
            r"effects\[1\] = the cl",
        ),
        (
            lambda: Scene(SHEET, WAVE, 0.1, effects=[Membrane(MATERIAL)], mesh=OUTLINE),
            r"mesh = Outline.*mesh\(si",
        ),
        (
            lambda: Scene(SHEET, WAVE, 0.1, effects=[Membrane(MATERIAL)], element=int),
            "element = the class int",
        ),
        (lambda: ritz_field(SHEET, SimpleNamespace(value=growth, rate=growth)), r"\(no period\)"),
        (
            lambda: ritz_field(SHEET, SimpleNamespace(value=growth, rate=growth, period=0.0)),
            "wave.period = 0",
        ),
        (lambda: airy_series(SHEET, FieldWave(growth, 1.0)), "ritz_field"),
    ],
)
def test_refusals_say_what_to_do(call, hint):
    with pytest.raises(ValueError, match=hint):
        call()


def test_one_effect_alone_and_integers_of_numpy_are_taken():
    one = Scene(SHEET, WAVE, np.array(0.1), effects=Membrane(MATERIAL), cells=np.array([2, 4]))
    assert one.effects == (Membrane(MATERIAL),)
    assert one.cells == (2, 4)
    assert [type(count) for count in one.cells] == [int, int]
    assert type(one.alpha) is float
    assert (
        Scene(SHEET, WAVE, 0.1, effects=iter([Membrane(MATERIAL), Bending(MATERIAL)])).components == 3
    )
    assert ritz_field(SHEET, WAVE, degree=np.array([5, 7])).degree == (5, 7)
    assert ritz_field(SHEET, WAVE, degree=np.int64(5)).degree == (5, 5)
    expected = crawl_speed(SHEET, WAVE, 0.1, rtol=0.1).mean
    assert crawl_speed(SHEET, WAVE, np.array(0.1), rtol=np.float64(0.1)).mean == expected


# ---- arrays that are more than numbers ----


class Quantity:
    """As arrays with units of pint (units, magnitude) and astropy (unit) look from outside."""

    def __init__(self, magnitude, **unit):
        self.magnitude = magnitude
        self.__dict__.update(unit)

    def __array__(self, dtype=None, copy=None):
        return np.asarray(self.magnitude, dtype)


class Column:
    """As a column of pandas that can miss values: objects, unless asked for floats."""

    def __init__(self, values):
        self.values = values

    def __array__(self, dtype=None, copy=None):
        return np.array(self.values, object)

    def to_numpy(self, dtype):
        return np.array([np.nan if v is None else v for v in self.values], dtype)


MASKED = np.ma.array([0.25, 0.1], mask=[False, True])


@pytest.mark.parametrize(
    ("value", "message"),
    [
        (MASKED, "y has 1 masked elements.*compressed"),
        ([MASKED, MASKED], "y has 1 masked"),
        ([0.1, np.ma.masked], "y has 1 masked"),
        (Quantity([0.1, 0.2], units="meter"), "unit meter.*convert"),
        (Quantity([0.1, 0.2], unit="mm"), "unit mm.*convert"),
        ([Quantity(0.1, units="meter")], "unit meter"),
        (Quantity(10.0, units="percent"), "unit percent"),
        (Column([0.1, None]), "y contains nan"),
        (Column(["0.1"]), "y = .*not dtype object"),
        ([[0.1], [0.1, 0.2]], "y = .*real numbers"),
        (np.array([0.1 + 0j]), "not dtype complex"),
        ({0.1, 0.2}, "not dtype object"),
    ],
)
def test_masks_units_and_other_wrappings_are_refused(value, message):
    """Wherever arrays go in: a wave, a field, a closed form, and the check that they share."""
    for call in (
        lambda: WAVE.value(0.0, value, 0.0),
        lambda: WAVE.rate(0.0, value, 0.0),
        lambda: FieldWave(growth, 1.0).value(0.0, value, 0.0),
        lambda: FIELD.displacement(0.0, value, 0.0),
        lambda: friction_field(FIELD, 0.1, 0.0, value, 0.0),
        lambda: validation.real_array("y", value),
    ):
        with pytest.raises(ValueError, match=message):
            call()
    with pytest.raises(ValueError, match=message.replace("y ", "alpha ")):
        line_speed(value)


def test_a_wave_of_masked_values_is_refused():
    wave = FieldWave(lambda x, y, t: np.ma.masked_greater(growth(x, y, t), 0.9), 1.0)
    with pytest.raises(ValueError, match="masked"):
        line_balance(wave, 0.1, length=1)


@pytest.mark.parametrize(
    "value",
    [
        np.ma.array([0.25, 0.1]),
        Quantity([0.25, 0.1], units="dimensionless"),
        Quantity([0.25, 0.1], unit=""),
        Column([0.25, 0.1]),
        [np.float32(0.25), 0.1],
        (0.25, 0.1),
    ],
)
def test_wrappings_that_change_nothing_are_taken(value):
    expected = np.sin(2 * np.pi * np.array([0.25, 0.1]))
    found = WAVE.value(0.0, value, 0.0)
    np.testing.assert_allclose(found, expected, rtol=1e-15)
    assert type(found) is np.ndarray


def test_a_wave_of_a_masked_series_is_refused():
    with pytest.raises(ValueError, match="cosine has 1 masked"):
        TravellingWave(MASKED, [0.0, 0.0])
    with pytest.raises(ValueError, match="samples has 1 masked"):
        TravellingWave.from_samples(np.ma.array([0.0, 1.0, 0.0], mask=[0, 1, 0]))


def test_messages_are_short():
    with pytest.raises(ValueError, match="level") as refusal:
        predict(SHEET, WAVE, 0.1, level=np.zeros(10**5).tolist())
    assert len(str(refusal.value)) < 200
