"""Errors and results survive the way to another process and back; all errors have one base."""

import copy
import dataclasses
import importlib
import inspect
import multiprocessing
import pickle
import pkgutil
from collections.abc import Iterator

import numpy as np
import pytest

import fem_check
import linear_theory
from fem_check import (
    Bending,
    Friction,
    Gravity,
    Ground,
    Material,
    Membrane,
    Outline,
    Scene,
    cycle_speed,
    plane_stress_field,
    predict,
    simulate,
)
from fem_check.plane_stress.factor import SparseFactor
from fem_check.shell.cycle.speed import Cycle
from fem_check.shell.model import ShellModel
from linear_theory import (
    FieldWave,
    NotConvergedError,
    Sheet,
    SheetcrawlError,
    SineWave,
    TravellingWave,
    airy_series,
    crawl_speed,
    field_speed,
    rigid_path,
    ritz_field,
    second_order,
)
from linear_theory.common.tolerance import Tolerance

PATIENCE = 60
"""Seconds after which a process is taken as lost; the work is none."""

STATE = np.arange(3.0)


def modules() -> Iterator[object]:
    for package in (linear_theory, fem_check):
        yield package
        for found in pkgutil.walk_packages(package.__path__, f"{package.__name__}."):
            if not found.name.endswith("__main__"):
                yield importlib.import_module(found.name)


def defined(kind: type) -> list[type]:
    """All subclasses of Exception in the packages that are (kind) or are not warnings."""
    found = {
        value
        for module in modules()
        for value in vars(module).values()
        if inspect.isclass(value)
        and issubclass(value, kind)
        and value.__module__.startswith(("linear_theory", "fem_check"))
    }
    return sorted(found, key=lambda value: value.__name__)


ERRORS = [error for error in defined(Exception) if not issubclass(error, Warning)]


def made(kind: type) -> Exception:
    """An error of that class, with something in each of its arguments."""
    names = list(inspect.signature(kind.__init__).parameters)[1:]
    values = {"message": "a message", "best": {"mean": 0.5}, "state": STATE, "parameter": 0.25}
    return (
        kind(**{n: values[n] for n in names if n in values})
        if "message" in names
        else kind("a message")
    )


def fail(name: str) -> None:
    raise made(next(kind for kind in ERRORS if kind.__name__ == name))


def test_all_are_found():
    names = {kind.__name__ for kind in ERRORS}
    assert {"NotConvergedError", "ConvergenceError", "UnstableError", "SnapshotError"} <= names
    assert len(ERRORS) >= 7


@pytest.mark.parametrize("kind", ERRORS, ids=lambda kind: kind.__name__)
def test_has_the_base_and_is_listed(kind):
    assert issubclass(kind, SheetcrawlError)
    assert kind.__name__ in linear_theory.common.errors.__doc__


@pytest.mark.parametrize("kind", ERRORS, ids=lambda kind: kind.__name__)
@pytest.mark.parametrize("way", [lambda e: pickle.loads(pickle.dumps(e)), copy.deepcopy, copy.copy])
def test_copies_keep_everything(kind, way):
    error = made(kind)
    error.add_note("while testing")
    found = way(error)
    assert type(found) is kind
    assert (str(found), found.args, found.__notes__) == (str(error), error.args, ["while testing"])
    assert found.__dict__.keys() == error.__dict__.keys()
    for name in ("best", "parameter"):
        assert getattr(found, name, None) == getattr(error, name, None)
    if hasattr(error, "state"):
        np.testing.assert_array_equal(found.state, STATE)


def test_a_pool_returns_every_error():
    """A worker whose error cannot be read in the parent would be waited for without end."""
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        for kind in ERRORS:
            with pytest.raises(kind, match="a message") as failure:
                pool.map_async(fail, [kind.__name__]).get(PATIENCE)
            assert type(failure.value) is kind


def test_an_error_with_a_result_that_cannot_be_sent_is_still_an_error():
    best = ritz_field(Sheet(), FieldWave(lambda x, y, t: np.sin(y - t) + 0 * x, 2 * np.pi), degree=3)
    with pytest.raises((pickle.PicklingError, AttributeError), match="lambda"):
        pickle.dumps(NotConvergedError("a message", best))


# ---- results ----


def oblique(x, y, t):
    return np.sin(2 * np.pi * (x + y - t))


def same(one: object, other: object) -> bool:
    """Whether two results hold the same numbers."""
    if isinstance(one, np.ndarray):
        return np.array_equal(one, other, equal_nan=True)
    if dataclasses.is_dataclass(one):
        names = [f.name for f in dataclasses.fields(one) if f.compare]
        return all(same(getattr(one, n), getattr(other, n)) for n in names)
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, float) and np.isnan(one):
        return bool(np.isnan(other))
    return one == other if isinstance(one, int | float | str | None) else type(one) is type(other)


SHEET, MATERIAL = Sheet(), Material(0.03, 0.5)
OBLIQUE = FieldWave(oblique, 1.0)

FIELDS = {
    "airy": lambda: airy_series(SHEET, SineWave(), modes=5),
    "ritz": lambda: ritz_field(SHEET, OBLIQUE, degree=5),
    "plane stress": lambda: plane_stress_field(SHEET, SineWave(), size=0.4),
    "outline": lambda: plane_stress_field(Outline.trapezoid(0.6, 0.4, 1.0), OBLIQUE, size=0.4),
}
WAYS = {"pickle": lambda v: pickle.loads(pickle.dumps(v)), "deepcopy": copy.deepcopy}


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("name", FIELDS)
def test_copied_fields_give_the_same_values_and_speeds(name, way):
    field = FIELDS[name]()
    before = field.displacement(0.1, [-0.2, 0.3], 0.3), field.error
    found = WAYS[way](field)
    np.testing.assert_array_equal(found.displacement(0.1, [-0.2, 0.3], 0.3), before[0])
    assert found.error == before[1]
    assert field_speed(found, 0.1, rtol=0.3).mean == field_speed(field, 0.1, rtol=0.3).mean


def planar(*more: object) -> Scene:
    return Scene(SHEET, SineWave(), 0.1, effects=(Membrane(MATERIAL), *more), cells=(1, 2))


RESULTS = {
    "crawl_speed": lambda: crawl_speed(SHEET, SineWave(), 0.1, rtol=0.1),
    "cycle_speed": lambda: cycle_speed(planar(), rtol=0.1),
    "second_order": lambda: second_order(SHEET, SineWave(), rtol=0.1),
    "predict": lambda: predict(SHEET, SineWave(), 0.1, rtol=0.3),
    "rigid_path": lambda: rigid_path(crawl_speed(SHEET, SineWave(), 0.1, rtol=0.1)),
    "simulate": lambda: simulate(
        planar(Gravity(3e-6), Friction(1.0, 5e-3)), periods=1, rtol=0.3, ramp=0.0
    ),
}


@pytest.mark.parametrize("name", RESULTS)
def test_results_are_copied_whole(name):
    result = RESULTS[name]()
    for way in WAYS.values():
        assert same(result, way(result))


@pytest.mark.parametrize("way", WAYS)
def test_scenes_and_cycles_are_copied_with_what_they_keep(way):
    effects = [Membrane(MATERIAL), Bending(MATERIAL), Gravity(2.5e-4), Ground(0.5)]
    space = Scene(SHEET, SineWave(), 0.02, effects=effects, cells=(2, 4))
    model = ShellModel(space)
    nodes = model.discretisation.mesh.p
    assert WAYS[way](space) == space
    np.testing.assert_array_equal(WAYS[way](model).discretisation.mesh.p, nodes)
    cycle = Cycle(planar())
    before = cycle.speed(Tolerance(0.1))
    assert WAYS[way](cycle).speed(Tolerance(0.1)).mean == before.mean


def test_a_copied_factor_is_made_again_when_it_solves():
    matrix = np.array([[2.0, 1.0], [1.0, 3.0]])
    factor = SparseFactor(matrix)
    right = np.array([1.0, 2.0])
    expected = np.linalg.solve(matrix, right)
    np.testing.assert_allclose(factor.solve(right), expected, rtol=1e-15)
    for found in (copy.deepcopy(factor), pickle.loads(pickle.dumps(factor))):
        assert "lu" not in vars(found)
        np.testing.assert_array_equal(found.solve(right), factor.solve(right))
    assert factor.is_definite
    assert not SparseFactor(np.array([[1.0, 2.0], [2.0, 1.0]])).is_definite  # eigenvalues 3 and -1


def test_copied_waves_stay_as_fixed_as_they_were():
    wave = TravellingWave([1.0], [2.0])
    for way in WAYS.values():
        found = way(wave)
        assert found == wave
        with pytest.raises(ValueError, match="read-only"):
            found.sine[0] = 3.0
