"""Keys of content: the same for the same content in every process, another one for any other."""

import functools
import itertools
import os
import random
import subprocess
import sys
import threading
import types
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
import scipy.interpolate as si
import skfem
import sympy
from scipy import special

from fem_check import Friction, Gravity, Material, Membrane
from linear_theory import FieldWave, Sheet, SineWave, TravellingWave
from linear_theory.common.errors import Unidentifiable
from linear_theory.identity.content import content_key


def run(source: str, **names: Any) -> dict[str, Any]:
    """The global names after some source text, as of a script of its own."""
    space: dict[str, Any] = {"__name__": "script", "np": np, **names}
    exec(compile(source, "script.py", "exec"), space)
    return space


def function(source: str, name: str = "f", **names: Any) -> Any:
    return run(source, **names)[name]


SAME: dict[str, Callable[[], Any]] = {
    "numbers": lambda: [1, 2.5, 3 + 1j, True, None, "a", b"a", 10**30, -0.5],
    "containers": lambda: ({"a": 1, "b": (2, 3)}, {3, "x", 2.0}, range(4), slice(1, 2)),
    "arrays": lambda: np.arange(10000.0).reshape(100, 100)[::2],
    "structured array": lambda: np.zeros(3, [("a", "f8"), ("b", "i4")]),
    "wave": lambda: TravellingWave([1.0, 0.5], [0.0, 0.1]),
    "effects": lambda: (Membrane(Material(0.03, 0.5)), Gravity(3e-6), Friction(1.0, 5e-4)),
    "lambda": lambda: function("f = lambda x: np.sin(2 * x) + len(x)"),
    "closure": lambda: function("def make(a):\n return lambda x: a * x\nf = make(np.arange(5.))"),
    "two functions": lambda: function("def g(x): return f(x - 1)\ndef f(x): return g(x) if x else 0"),
    "partial": lambda: functools.partial(function("def f(a, x, b=2): return a * x + b"), 2.0, b=3),
    "method": lambda: function(
        "class P:\n def __init__(s, a): s.a = a\n def value(s, x): return s.a * x\nf = P(3.).value"
    ),
    "cubic spline": lambda: si.CubicSpline(np.arange(9.0), np.cos(np.arange(9.0))),
    "periodic spline": lambda: si.make_interp_spline(np.arange(9.0), np.cos(np.arange(9.0))),
    "surface spline": lambda: si.RectBivariateSpline(np.arange(6.0), np.arange(7.0), np.eye(6, 7)),
    "grid": lambda: si.RegularGridInterpolator((np.arange(3.0), np.arange(4.0)), np.eye(3, 4)),
    "polynomial": lambda: np.polynomial.Polynomial([1.0, 2.0, 3.0]),
    "vectorised": lambda: np.vectorize(function("def f(x): return x if x > 0 else 0.")),
    "cached": lambda: functools.cache(function("def f(x): return x + 1")),
    "sympy": lambda: sympy.sin(2 * sympy.Symbol("x")) + sympy.Rational(1, 3),
    "lambdified": lambda: sympy.lambdify(sympy.symbols("x y"), sympy.sympify("sin(x) + y**2")),
    "library functions": lambda: (np.sin, np.sum, special.erf, max, np.float64, SineWave),
    "recursion": lambda: function("def f(n): return n * f(n - 1) if n else 1"),
    "element": lambda: skfem.ElementQuadP(4),
}


@pytest.mark.parametrize("name", SAME)
def test_equal_content_has_one_key(name: str) -> None:
    first, second = SAME[name](), SAME[name]()
    assert content_key(first) == content_key(second)
    assert content_key(first) == content_key(first)


def test_no_two_of_them_have_the_same_key() -> None:
    keys = [content_key(make()) for make in SAME.values()]
    assert len(set(keys)) == len(keys)


CHILD = """
import sys
sys.path.insert(0, {root!r})
from linear_theory.identity import content_key
from tests.scenes.test_identity import SAME
for name, make in SAME.items():
    print(content_key(make()), name)
"""


def test_keys_are_the_same_in_another_process() -> None:
    """They depend on no address, and on no hash of text, which has a seed in each process."""
    source = CHILD.format(root=str(Path(__file__).parents[2]))
    found = subprocess.run(
        [sys.executable, "-c", source],
        env={**os.environ, "PYTHONHASHSEED": "12345"},
        capture_output=True,
        text=True,
        check=True,
    )
    assert found.stdout.splitlines() == [f"{content_key(make())} {name}" for name, make in SAME.items()]


class Pair(NamedTuple):
    a: float
    b: float


@dataclass(frozen=True)
class Frozen:
    a: float


@dataclass(frozen=True)
class Other:
    a: float


spline = si.CubicSpline
LONG = np.zeros(5000)
BENT = LONG.copy()
BENT[2500] = 1e-300
POINTS = np.arange(9.0)

DIFFERENT: dict[str, tuple[Any, Any]] = {
    "long arrays whose repr is the same": (LONG, BENT),
    "shapes": (np.zeros((2, 3)), np.zeros((3, 2))),
    "types of arrays": (np.zeros(2), np.zeros(2, int)),
    "grouping": ([1, [2, 3]], [[1, 2], 3]),
    "text and bytes": ("a", b"a"),
    "number and text": (1, "1"),
    "classes": (Frozen(1.0), Other(1.0)),
    "tuples": (Pair(1, 2), (1, 2)),
    "masks": (np.ma.array([1.0, 2.0], mask=[0, 1]), np.ma.array([1.0, 2.0], mask=[1, 0])),
    "constants of code": (function("f = lambda x: 2 * x"), function("f = lambda x: 3 * x")),
    "types of constants": (function("f = lambda x: x ** 2"), function("f = lambda x: x ** 2.0")),
    "operations": (function("f = lambda x, y: x + y"), function("f = lambda x, y: x - y")),
    "names": (function("f = lambda x: np.sin(x)"), function("f = lambda x: np.cos(x)")),
    "defaults": (function("def f(x, a=1.): 0"), function("def f(x, a=2.): 0")),
    "keywords": (function("def f(x, *, a=1.): 0"), function("def f(x, *, a=2.): 0")),
    "inner functions": (
        function("def f(x):\n g = lambda z: z + 1\n return g(x)"),
        function("def f(x):\n g = lambda z: z + 2\n return g(x)"),
    ),
    "global numbers": (function("f = lambda x: a * x", a=1.0), function("f = lambda x: a * x", a=1.1)),
    "global arrays": (
        function("f = lambda x: a * x", a=LONG),
        function("f = lambda x: a * x", a=BENT),
    ),
    "global functions": (
        function("g = lambda x: x\nf = lambda x: g(x)"),
        function("g = lambda x: -x\nf = lambda x: g(x)"),
    ),
    "arguments of partial": (functools.partial(pow, 2), functools.partial(pow, 3)),
    "objects of methods": (Frozen(1.0).__eq__, Frozen(2.0).__eq__),
    "other methods of the class": (
        function("class P:\n def a(s): return s.b()\n def b(s): return 1\nf = P().a"),
        function("class P:\n def a(s): return s.b()\n def b(s): return 2\nf = P().a"),
    ),
    "splines": (spline(POINTS, POINTS), spline(POINTS, POINTS + 1e-15)),
    "sympy": (sympy.Symbol("x") ** 2, sympy.Symbol("x") ** 3),
    "attributes": (
        function("def f(x): return f.a * x\nf.a = 1."),
        function("def f(x): return f.a * x\nf.a = 2."),
    ),
}


@pytest.mark.parametrize("name", DIFFERENT)
def test_other_content_has_another_key(name: str) -> None:
    first, second = DIFFERENT[name]
    assert content_key(first) != content_key(second)


def test_functions_of_a_module_of_the_user_are_followed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Also through a module inside a module."""

    def module(source: str) -> types.ModuleType:
        inner, outer = types.ModuleType("helper.inner"), types.ModuleType("helper")
        exec(source, inner.__dict__)
        outer.inner = inner
        return outer

    keys = {
        content_key(function("f = lambda x: helper.inner.g(x)", helper=module(source)))
        for source in ("def g(x): return x", "def g(x): return 2 * x", "def g(x): return 2 * x")
    }
    assert len(keys) == 2


def test_a_global_name_that_changes_changes_the_key() -> None:
    space = run("a = 1.0\nf = lambda x: a * x")
    before = content_key(space["f"])
    space["a"] = 2.0
    assert content_key(space["f"]) != before
    space["a"] = 1.0
    assert content_key(space["f"]) == before


def test_numbers_are_known_by_value() -> None:
    """np.int64(3), 3 and 3.0 are one argument."""
    assert len({content_key(n) for n in (3, 3.0, np.int64(3), np.float64(3))}) == 1
    assert content_key(2**53 + 1) != content_key(2.0**53)
    assert content_key(Friction(1, np.float64(5e-4))) == content_key(Friction(1.0, 5e-4))
    assert content_key(Material(0.03, 0.5)) == content_key(Material(np.float64(0.03), 0.5))


def test_where_a_function_stands_does_not_count() -> None:
    first = function("def f(x):\n return x + 1")
    assert content_key(first) == content_key(function("\n\n\ndef g(z): 0\ndef f(x):\n\n return x + 1"))


def test_what_a_property_keeps_does_not_count() -> None:
    source = (
        "import functools\n"
        "class P:\n"
        " @functools.cached_property\n"
        " def table(s): return [1]\n"
        " def value(s, x): return s.table\n"
        "p = P()"
    )
    pulse = function(source, "p")
    before = content_key(pulse)
    assert pulse.value(0) == [1]
    assert content_key(pulse) == before
    vectorised = np.vectorize(function("def f(x): return x"), otypes=[float])
    before = content_key(vectorised)
    vectorised(np.zeros(3))
    assert content_key(vectorised) == before


def test_lists_and_objects_inside_themselves() -> None:
    nested: list[Any] = [1]
    nested.append(nested)
    other: list[Any] = [2]
    other.append(other)
    assert content_key(nested) != content_key(other)


def counter() -> Callable[[float], float]:
    count = 0

    def value(x: float) -> float:
        nonlocal count
        count += 1
        return count * x

    return value


REFUSED: dict[str, tuple[Any, str]] = {
    "a generator": ((i for i in range(3)), "generator"),
    "a file": (sys.stdout, "cannot be identified"),
    "a lock": (threading.Lock(), "lock"),
    "a counter": (counter(), "assigns to count"),
    "random numbers": (np.random.default_rng(0), "not reproducible"),
    "random numbers of Python": (random.Random(0), "not reproducible"),
    "a function of them": (function("f = lambda x: np.random.rand() * x"), "random"),
    "a function with them": (
        function("f = lambda x: rng.normal() * x", rng=np.random.default_rng(0)),
        "global rng",
    ),
    "the clock": (function("import time\nf = lambda x: time.time() * x"), "time reads"),
    "the clock by name": (function("from time import time\nf = lambda x: time() * x"), "time reads"),
    "a file that is read": (function("f = lambda x: np.loadtxt('c.txt')"), "loadtxt"),
    "a file that is opened": (function("f = lambda x: open('c.txt').read()"), "global open"),
    "names made at run time": (function("f = lambda x: eval('x + 1')"), "global eval"),
    "a global that is written": (
        function("n = 0\ndef f(x):\n global n\n n += 1\n return n"),
        "assigns to the global name n",
    ),
    "an import": (function("def f(x):\n import conftest\n return conftest.g(x)"), "imports conftest"),
    "a dummy symbol": (sympy.Dummy("x") + 1, "dummy"),
    "a ufunc of Python": (np.frompyfunc(lambda x: x, 1, 1), "ufunc"),
    "an iterator": (itertools.count(), "not reproducible"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_has_no_content_is_refused(name: str) -> None:
    value, message = REFUSED[name]
    with pytest.raises(Unidentifiable, match=message) as raised:
        content_key(value, "thing")
    assert str(raised.value).startswith("thing")


def test_a_name_stands_for_a_function() -> None:
    """What cannot be identified, or shall not be, is what the user calls it."""
    rng = np.random.default_rng(0)
    noisy = lambda x, y, t: rng.normal() + 0 * x  # noqa: E731
    with pytest.raises(Unidentifiable, match=r"wave.*rng"):
        content_key(FieldWave(noisy, 1.0), "wave")
    named = [FieldWave(noisy, period, name=name) for period in (1.0, 2.0) for name in ("a", "b")]
    assert len({content_key(wave) for wave in named}) == 4
    assert content_key(named[0]) == content_key(FieldWave(lambda x, y, t: x, 1.0, name="a"))
    for bad in ("", 3):
        with pytest.raises(ValueError, match="name = "):
            FieldWave(noisy, 1.0, name=bad)


def test_fields_and_sheets() -> None:
    waves = [FieldWave(lambda x, y, t, k=k: np.sin(k * (y - t)) + 0 * x, 1.0) for k in (1.0, 2.0, 1.0)]
    keys = [content_key(wave) for wave in waves]
    assert keys[0] == keys[2] != keys[1]
    assert content_key(Sheet(width=0.4)) != content_key(Sheet(width=0.5))
