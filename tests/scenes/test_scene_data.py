"""Scenes from data: whatever is damaged is refused with its place, nothing is filled in or ignored."""

import copy
import json
import math
import random
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
import pytest
import sympy

from fem_check import Friction, Gravity, Ground, Inertia, Material, Membrane, Terrain
from linear_theory import (
    Contact,
    FieldWave,
    GrowthLaw,
    SampledWave,
    Scene,
    Sheet,
    SineWave,
    Tanh,
    TravellingWave,
)
from tests.friction.test_friction_laws import ElliptTanh
from tests.scenes.test_scene import PLANE, SCENES, SPACE, TRIANGLES

MATERIAL = Material(0.03, 0.5)
X, Y = sympy.symbols("x y")
BUMPS = 0.01 * sympy.cos(6 * X) * sympy.sin(sympy.pi * Y / 3) + 0.02 * sympy.exp(-(Y**2))


def measured() -> SampledWave:
    y, t = np.linspace(-0.5, 0.5, 9), np.arange(8) / 8
    noise = 0.02 * np.random.default_rng(1).normal(size=(9, 8))
    c = np.sin(2 * np.pi * (y[:, None] - t)) + noise
    return SampledWave(y, t, c, period=1.0, harmonics=1, degree=5)


KINDS = {
    "laws": SCENES["pulse, laws"],
    "incline": SCENES["incline"],
    "ground": Scene(
        Sheet(), SineWave(), 0.1, effects=(*SPACE[:3], Ground(0.5, height=BUMPS), SPACE[4])
    ),
    "mesh": Scene(Sheet(), SineWave(), 0.1, effects=PLANE, mesh=TRIANGLES),
    "cells": Scene(
        Sheet(), SineWave(2), 0.1, effects=(*PLANE, Inertia(1e-3, MATERIAL)), cells=(2, 4)
    ).but(contact=Contact("grown", Tanh(5e-3))),
    "measured": Scene(Sheet(), measured(), 0.1, contact=Contact("material", "viscous")),
}
DATA = {name: json.loads(json.dumps(scene.to_dict())) for name, scene in KINDS.items()}

ODD = (
    *(None, True, False, 0, 1, -1, 2, 1.5, -0.0, 1e308, 5e-324, 10**18, 10**400, -(10**5000)),
    *(math.nan, math.inf, "", "exp", "inf", "coulomb", "Tanh", "0", [], {}, [1, 2], [[]]),
    *({"type": "Tanh"}, {"type": None}, {"type": "Sheet"}, {"type": "os", "x": 1}, {"type": []}),
)


def places(data: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Of all values inside, but for most of long lists."""
    if isinstance(data, dict):
        inner = list(data.items())
    elif isinstance(data, list):
        inner = list(enumerate(data))[:3]
    else:
        return [path] if path else []
    found = [path] if path else []
    return found + [p for key, value in inner for p in places(value, (*path, key))]


def damaged(data: dict[str, Any], dice: random.Random) -> tuple[str, dict[str, Any]]:
    """What was done, and a copy with one random damage."""
    data = copy.deepcopy(data)
    *path, last = dice.choice(places(data))
    owner: Any = data
    for key in path:
        owner = owner[key]
    value = owner[last]
    deeds = ["replace", "replace", "replace", "delete", "add", "nudge", "rename", "wrap", "repeat"]
    deed = dice.choice(deeds)
    if deed == "nudge" and isinstance(value, int | float) and not isinstance(value, bool):
        owner[last] = dice.choice([value + 1, -value, value * (1 + 1e-3), value / 7, str(value)])
    elif deed == "delete":
        del owner[last]
    elif deed == "add" and isinstance(owner, dict):
        owner[f"{last}s"] = value
    elif deed == "rename" and isinstance(owner, dict):
        owner[f"{last}_"] = owner.pop(last)
    elif deed == "wrap":
        owner[last] = [value]
    elif deed == "repeat" and isinstance(owner, list):
        owner.insert(0, copy.deepcopy(value))
    else:
        owner[last] = dice.choice(ODD)
    return f"{deed} at {[*path, last]}, of {value!r:.60}", data


def exactly(data: Any) -> Any:
    """The data with kinds told apart that Python takes as equal, but for whole floats and integers."""
    if isinstance(data, dict):
        return {key: exactly(value) for key, value in data.items()}
    if isinstance(data, list | tuple):
        return [exactly(value) for value in data]
    if isinstance(data, bool) or data is None:
        return repr(data)
    return str(data) if isinstance(data, str) else data


def computed(data: dict[str, Any]) -> dict[str, Any]:
    """The data without the numbers of a fit, which are compared to six digits."""
    wave = data["wave"]
    if wave["type"] != "SampledWave":
        return data
    fit = {name: wave[name] for name in ("noise", "dropped")}
    assert fit["noise"] == pytest.approx(DATA["measured"]["wave"]["noise"], rel=0.5)
    return {**data, "wave": {k: v for k, v in wave.items() if k not in fit}}


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_damaged_is_refused(kind: str) -> None:
    """Or it makes no difference: the scene read is written as it was given."""
    assert Scene.from_dict(DATA[kind]) == KINDS[kind]
    dice, refused = random.Random(f"damage {kind}"), 0
    for _ in range(90):
        deed, data = damaged(DATA[kind], dice)
        try:
            read = Scene.from_dict(data)
        except ValueError as error:
            refused += len(str(error)) < 700
        except Exception as error:
            raise AssertionError(f"{deed}: {error!r}") from error
        else:
            assert exactly(computed(read.to_dict())) == exactly(computed(data)), deed
    assert refused > 30


LEFT_OUT = {
    "contact": "data: a Scene must have contact",
    "mesh": "data: a Scene must have mesh",
    "element": "data: a Scene must have element",
    "growth.law": "growth: a Growth must have law",
    "wave.period": "wave: a SineWave must have period",
    "contact.friction": "contact: a Contact must have friction",
    "sheet.length": "sheet: a Sheet must have length",
    "effects.2.incline": r"effects\[2\]: a Gravity must have incline",
}
ADDED = {
    "sheets": (1, "sheets: a Scene has no such key, the nearest is 'sheet'"),
    "mesh.kind": (1, "mesh = .*: must have vertices, elements and the type 'MeshShown', and no other"),
    "wave.perod": (1.0, "wave.perod: a SineWave has no such key, the nearest is 'period'"),
    "effects.1.slip_speed": (1.0, r"effects\[1\].slip_speed: a Friction has no such key"),
}
REPLACED = {
    "effects": ({}, "effects = {}: must be a list"),
    "mesh": ({}, "mesh = {}: must have vertices, elements"),
    "mesh.type": ("Mesh", "mesh = .*: must have vertices"),
    "mesh.vertices": (True, "mesh.vertices = True: must be real numbers"),
    "mesh.elements": ({}, "mesh.elements = {}: must be real numbers"),
    "mesh.elements.0.0": (None, "mesh.elements = .*: must be real numbers"),
    "mesh.elements.0.1": (1.5, "mesh.elements contains 1.5: must be indices of the 23 vertices"),
    "mesh.elements.1.0": (True, r"mesh.elements\[1\]\[0\] = True: is read as 1"),
    "mesh.vertices.0.0": (math.nan, "mesh.vertices contains nan: must be finite"),
    "wave.count": (10**400, "wave.count = 10+...0+: must be at most"),
    "sheet": ({}, "sheet = {}: must have the key 'type'"),
    "sheet.length": (True, "sheet.length = True: must be a single real number"),
    "contact.friction": ("coulomb", "contact.friction = 'coulomb': is read as {'type': 'Coulomb'}"),
    "contact.slope": (0.1, r"contact\b.*0.1"),
    "growth.law.type": ("Expp", "growth.law: a Expp cannot be restored .* unless 'Exp' is meant"),
    "element": ("ElementQuadP(03)", r"element = 'ElementQuadP\(03\)': is read as 'ElementQuadP\(3\)'"),
}


def owner_of(place: str) -> tuple[dict[str, Any], Any, Any]:
    """Data of a scene with a mesh, the part in which that place is, and its key there."""
    data = copy.deepcopy(DATA["mesh"])
    *path, last = (int(key) if key.isdigit() else key for key in place.split("."))
    owner: Any = data
    for key in path:
        owner = owner[key]
    return data, owner, last


@pytest.mark.parametrize("place", LEFT_OUT)
def test_what_is_left_out_is_missed(place: str) -> None:
    data, owner, last = owner_of(place)
    del owner[last]
    with pytest.raises(ValueError, match=f"^{LEFT_OUT[place]}"):
        Scene.from_dict(data)


@pytest.mark.parametrize(("place", "value", "words"), [(k, *v) for k, v in ADDED.items()])
def test_what_is_not_known_is_refused(place: str, value: Any, words: str) -> None:
    data, owner, last = owner_of(place)
    owner[last] = value
    with pytest.raises(ValueError, match=f"^{words}"):
        Scene.from_dict(data)


@pytest.mark.parametrize("place", REPLACED)
def test_a_wrong_value_is_refused_with_its_place(place: str) -> None:
    value, words = REPLACED[place]
    data, owner, last = owner_of(place)
    owner[last] = value
    with pytest.raises(ValueError, match=f"^{words}"):
        Scene.from_dict(data)


@pytest.mark.parametrize("cells", [5, True, [1.5, 4], [True, 4], [2], {}, "24", [10**400, 1]])
def test_cells_are_two_integers(cells: Any) -> None:
    with pytest.raises(ValueError, match=r"^cells = .*must be (two integers|an integer|at most)"):
        Scene.from_dict({**DATA["cells"], "cells": cells})


def test_a_vertex_too_few_is_refused() -> None:
    data, owner, _ = owner_of("mesh.vertices")
    owner["vertices"].pop()
    with pytest.raises(
        ValueError, match=r"mesh.elements contains 22: must be indices of the 22 vertic"
    ):
        Scene.from_dict(data)


@dataclass(frozen=True)
class Steep(GrowthLaw):
    """The law of `Exp` under another name."""

    name: ClassVar[str] = "steep"


OWN = ElliptTanh(0.01, 0.7, 1.0)


def hill(x: Any, y: Any) -> Any:
    return 0.01 * np.cos(3 * y) + 0 * x


WAVE = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y - t)) + 0 * x, 1.0)
RUBBED = (*PLANE[:2], Friction(1.0, law=OWN))
HILLY = (*SPACE[:3], Ground(0.5, height=hill), SPACE[4])

GIVEN = {
    "wave": (Scene(Sheet(), WAVE, 0.1), {"wave": WAVE}),
    "law": (
        Scene(Sheet(), SineWave(), 0.1, contact=Contact("grown", OWN)),
        {"contact": Contact("grown", OWN)},
    ),
    "effect with a law": (Scene(Sheet(), SineWave(), 0.1, effects=RUBBED), {"effects": RUBBED}),
    "ground": (Scene(Sheet(), SineWave(), 0.1, effects=HILLY), {"effects": HILLY}),
    "two of them": (
        Scene(Sheet(), WAVE, 0.1, effects=RUBBED),
        {"wave": WAVE, "effects": RUBBED},
    ),
}


@pytest.mark.parametrize("name", GIVEN)
def test_the_hint_can_be_followed(name: str) -> None:
    """The call in the message, with the names that it names, gives the scene."""
    scene, parts = GIVEN[name]
    data = json.loads(json.dumps(scene.to_dict()))
    with pytest.raises(ValueError, match="cannot be restored") as refused:
        Scene.from_dict(data)
    call = str(refused.value).partition("again: ")[2]
    again = eval(call, {"Scene": Scene, "data": data}, dict(parts))
    assert again == scene
    assert again.contact == scene.contact


def test_given_effects_leave_the_rest_of_the_contact() -> None:
    scene = Scene(Sheet(), SineWave(), 0.1, contact=Contact("material", Tanh(0.1)))
    effects = (Membrane(MATERIAL), Gravity(3e-6, "grown"))
    again = Scene.from_dict(scene.to_dict(), effects=effects)
    assert again.contact == Contact("grown", Tanh(0.1))
    assert Scene.from_dict(scene.to_dict(), effects=PLANE).contact == SCENES["plane"].contact


@pytest.mark.parametrize("real", [None, True])
def test_a_ground_given_by_an_expression_comes_back(real: bool | None) -> None:
    x, y = sympy.symbols("x y", real=real)
    height = BUMPS.subs({X: x, Y: y}) + x / sympy.Integer(3) ** 5
    effects = (*SPACE[:3], Ground(0.5, height=height), SPACE[4])
    scene = Scene(Sheet(), SineWave(), 0.1, effects=effects)
    again = Scene.from_dict(json.loads(json.dumps(scene.to_dict())))
    assert again == scene
    place = np.random.default_rng(0).uniform(-0.5, 0.5, (2, 20))
    found, expected = (s.find(Ground).height(*place) for s in (again, scene))
    assert np.array_equal(found, expected)


def test_a_height_that_is_no_formula_must_be_given() -> None:
    terrain = Terrain(sympy.log(X + 2), length=1.0)
    effects = (*SPACE[:3], Ground(0.5, height=terrain), SPACE[4])
    scene = Scene(Sheet(), SineWave(), 0.1, effects=effects)
    with pytest.raises(ValueError, match=r"height = 'log\(x \+ 2\)' .*not understood.*effects=eff"):
        Scene.from_dict(scene.to_dict())
    assert Scene.from_dict(scene.to_dict(), effects=effects) == scene
    data = copy.deepcopy(DATA["ground"])
    ground = next(effect for effect in data["effects"] if effect["type"] == "Ground")
    ground["height"]["height"] = "__import__('os').getcwd()"
    with pytest.raises(ValueError, match="is not understood"):
        Scene.from_dict(data)


def test_waves_are_counted_in_integers_that_machines_have() -> None:
    for make in (SineWave, lambda count: TravellingWave([1.0], [0.5], count)):
        with pytest.raises(ValueError, match=r"count = 10+...0+: must be at most 90071992"):
            make(10**400)
        with pytest.raises(ValueError, match="count = 1000000001: must be from -1000000000 to 1000000"):
            make(10**9 + 1)
        with pytest.raises(ValueError, match="count = an integer too long to be shown"):
            make(10**5000)
        assert make(-(10**9)).orders[-1] == 10**9
