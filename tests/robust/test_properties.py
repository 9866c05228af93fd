"""Scenes nobody thought of: a finite answer with an honest error, or an error that names its cause.

Inputs are drawn by hypothesis, always the same ones (derandomize), small ones first. A solver may
refuse with ValueError (the input) or with the errors that it documents for a missed tolerance; it may
not return NaN, claim more than it has, raise anything else, or go on without bound.
"""

import math
import sys
import types
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from fem_check.shell.cycle.motion import UnresolvedError
from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.material import Material
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.stepping.simulation import simulate
from linear_theory import (
    CrawlSpeed,
    NotConvergedError,
    Sheet,
    SineWave,
    TravellingWave,
    airy_series,
    crawl_speed,
    line_balance,
    ritz_field,
)
from linear_theory.balance.crawl import Crawl
from linear_theory.common.errors import BeyondReachWarning, ViscousRegimeWarning
from linear_theory.scene.scene import Scene
from tests.line import reference_line
from tests.robust.drawn_examples import examples

LIMITS = (NotConvergedError, ConvergenceError, UnresolvedError)
"""What solvers raise where they miss a tolerance, by their documentation."""

NAMED = ("alpha", "rtol", "modes", "degree", "slip_speed", "growth", "poisson", "cells")
"""Arguments of which a refusal must name one."""

MOST_TIMES = 4 * 4097
"""Balances of one mean over a period: twice the most times, and those that choose cells."""


def powers(low: float, high: float) -> st.SearchStrategy[float]:
    """Numbers between 10^low and 10^high, evenly by magnitude."""
    return st.floats(low, high).map(lambda p: 10.0**p)


def sheets(widest: float = 2.0) -> st.SearchStrategy[Sheet]:
    """Widths from L/100 to 10^widest L."""
    return st.builds(
        lambda w, nu: Sheet(width=w, poisson=nu), powers(-2, widest), st.floats(-0.99, 0.5)
    )


def signs() -> st.SearchStrategy[int]:
    return st.sampled_from([1, -1])


def waves(most: int = 10, harmonics: int = 3) -> st.SearchStrategy[TravellingWave]:
    """Sines, and profiles of a few harmonics of which the first is 1."""
    amplitude = st.floats(-1, 1).map(lambda a: round(a, 3))
    counts = st.builds(lambda n, sign: n * sign, st.integers(1, most), signs())
    rest = st.lists(st.tuples(amplitude, amplitude), max_size=harmonics - 1)

    def general(count: int, pairs: list[tuple[float, float]], mean: float) -> TravellingWave:
        cosine, sine = zip((0.0, 1.0), *pairs, strict=True)
        return TravellingWave(np.array(cosine), np.array(sine), count, 1.0, mean)

    return st.one_of(st.builds(SineWave, counts), st.builds(general, counts, rest, amplitude))


def alphas(low: float = -12, high: float = math.log10(2)) -> st.SearchStrategy[float]:
    return st.builds(lambda size, sign: size * sign, powers(low, high), signs())


LOADS = st.sampled_from(["current", "grown", "material"])
LAWS = st.one_of(
    st.just({}),
    st.just({"friction": "viscous"}),
    powers(-6, 3).map(lambda v: {"friction": "tanh", "slip_speed": v}),
)
TOLERANCES = powers(-4, -2)


@contextmanager
def refusals() -> Iterator[None]:
    """What solvers may raise; that friction acts as viscous is a remark, any other warning an error."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for remark in (ViscousRegimeWarning, BeyondReachWarning):
            warnings.simplefilter("ignore", remark)
        yield


def answer(solve: Callable[[], CrawlSpeed]) -> CrawlSpeed | None:
    """The result, checked for what every result must be; None after a clear refusal."""
    with refusals():
        try:
            speed = solve()
        except LIMITS as limit:
            assert str(limit)  # noqa: PT017
            return None
        except ValueError as refusal:
            assert any(name in str(refusal) for name in NAMED), refusal  # noqa: PT017
            return None
    assert math.isfinite(speed.mean)
    assert speed.error >= 0
    assert not (speed.converged and math.isinf(speed.error))
    assert np.isfinite(speed.velocity).all()
    assert abs(speed.mean) <= abs(speed.velocity).max() * (1 + 1e-9) + speed.error
    return speed


def kept(speed: CrawlSpeed, rtol: float, atol: float) -> bool:
    return speed.error <= max(rtol * abs(speed.mean), atol) * (1 + 1e-12)


@examples(150)
@given(waves(), alphas(), LOADS, LAWS, TOLERANCES)
def test_any_line_balances(
    wave: TravellingWave, alpha: float, load: str, law: dict[str, object], rtol: float
) -> None:
    speed = answer(lambda: line_balance(wave, alpha, load, rtol=rtol, **law))
    phases = np.linspace(0, 2 * np.pi, 4096, endpoint=False)
    smallest = 1 + (alpha * wave.profile(phases)).min()
    if speed is None:
        assert smallest < 1e-3  # refused where lengths vanish, and nowhere else
        return
    assert smallest > 0
    assert speed.converged == kept(speed, rtol, 1e-3 * rtol * alpha**2)
    back = TravellingWave(wave.cosine, wave.sine, -wave.count, wave.period, wave.mean)
    with refusals():
        assert line_balance(back, alpha, load, rtol=rtol, **law).mean == -speed.mean


@examples(60)
@given(waves(3), alphas(-3, -0.01))
def test_dry_friction_on_any_line_turns_round_at_its_speed(wave: TravellingWave, alpha: float) -> None:
    """The force of eq. 7 as printed, on a grid: it holds back above V and pushes below."""
    speed = answer(lambda: line_balance(wave, alpha))
    if speed is None or speed.sticks:
        return
    # neighbours on the grid of 40000 differ by less than this in velocity, and twice for the rule
    step = 2 * abs(alpha) * 2 * np.pi * wave.harmonics[-1] * 4 / 40000
    above, below = (reference_line.force(wave, alpha, speed.mean + d) for d in (step, -step))
    assert above < 0 < below


@examples(60)
@given(sheets(), waves(), TOLERANCES)
def test_two_solvers_of_any_field_agree_within_their_claims(
    sheet: Sheet, wave: TravellingWave, rtol: float
) -> None:
    with refusals():
        try:
            fields = airy_series(sheet, wave, rtol), ritz_field(sheet, wave, rtol=rtol)
        except NotConvergedError as limit:
            assert "rtol" in str(limit)  # noqa: PT017
            return
    x, weights_x = np.polynomial.legendre.leggauss(16)
    y, weights_y = np.polynomial.legendre.leggauss(24 + 4 * int(wave.orders[-1]))
    x, y = x[:, None] * sheet.width / 2, y * sheet.length / 2
    weights = np.multiply.outer(weights_x, weights_y)
    for t in (0.0, 0.3):
        u, v = (field.displacement(x, y, t) for field in fields)
        difference, size = (np.sqrt(np.sum(weights * w**2)) for w in (u - v, v))
        assert size > 0
        assert difference <= sum(field.error for field in fields) * size
    assert all(field.error <= rtol for field in fields)


@examples(15)
@given(sheets(0.7), waves(2, 2), alphas(), LOADS, LAWS, powers(-2.5, -1.5))
def test_any_sheet_crawls_or_says_why_not(
    monkeypatch: pytest.MonkeyPatch,
    sheet: Sheet,
    wave: TravellingWave,
    alpha: float,
    load: str,
    law: dict[str, object],
    rtol: float,
) -> None:
    """In small strain; the work is bounded, and the other field's speed lies within the claims."""
    times = 0
    original = Crawl.balance

    def counted(self: Crawl, some: np.ndarray, *known: object) -> object:
        nonlocal times
        times += some.size
        return original(self, some, *known)

    with monkeypatch.context() as patch:
        patch.setattr(Crawl, "balance", counted)
        speed = answer(lambda: crawl_speed(sheet, wave, alpha, load, rtol=rtol, **law))
    assert times < MOST_TIMES
    if speed is None:
        assert abs(alpha) > 0.1  # the smallest limit of any of these waves
        return
    within_reach = not speed.beyond_reach
    assert speed.converged == (within_reach and kept(speed, rtol, 1e-3 * rtol * alpha**2))
    other = answer(lambda: crawl_speed(sheet, wave, alpha, load, rtol=rtol / 3, method="ritz", **law))
    assert other is not None
    assert abs(speed.mean - other.mean) <= speed.error + other.error


def planar(sheet: Sheet, wave: TravellingWave, alpha: float, cells: tuple[int, int]) -> Scene:
    effects = (Membrane(Material(sheet.thickness, sheet.poisson)),)
    return Scene(sheet, wave, alpha, effects=effects, cells=cells)


@examples(10)
@given(sheets(0.3), waves(1, 2), alphas(-4), LOADS, LAWS)
def test_any_nonlinear_sheet_crawls_or_says_why_not(
    sheet: Sheet, wave: TravellingWave, alpha: float, load: str, law: dict[str, object]
) -> None:
    """On few elements of degree 5; finer ones lie within the claim."""
    coarse, fine = (
        answer(lambda c=c: cycle_speed(planar(sheet, wave, alpha, c), load, rtol=3e-2, **law))
        for c in ((1, 2), (2, 4))
    )
    if coarse is None or fine is None:
        assert abs(alpha) > 0.1
        return
    assert abs(coarse.mean - fine.mean) <= coarse.error + fine.error


@examples(4)
@given(sheets(0.3), waves(1, 1), alphas(-4, -0.3), powers(-6, 0), powers(-6, 3))
def test_any_scene_steps_or_says_why_not(
    monkeypatch: pytest.MonkeyPatch,
    sheet: Sheet,
    wave: TravellingWave,
    alpha: float,
    weight: float,
    slip: float,
) -> None:
    """Friction from 1e-6 of the stiffness to more than all of it, in bounded minimisations."""
    scene = planar(sheet, wave, alpha, (1, 2))
    load = weight * sheet.thickness
    scene = Scene(
        sheet,
        wave,
        alpha,
        effects=(*scene.effects, Gravity(load), Friction(1.0, slip)),
        cells=(1, 2),
    )
    calls = 0
    original = Minimiser.minimise

    def counted(self: Minimiser, *args: object) -> object:
        nonlocal calls
        calls += 1
        return original(self, *args)

    with monkeypatch.context() as patch:
        patch.setattr(Minimiser, "minimise", counted)
        speed = answer(lambda: simulate(scene, periods=1, steps=8, ramp=0.5).speed)
    assert calls < 500
    if speed is not None:
        # steps of an eighth do not claim what they have not
        assert speed.error > 0


def test_examples_are_the_same_whatever_modules_are_loaded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def drawn() -> list[str]:
        found = []

        @examples(120)
        @given(st.floats())
        def example(number: float) -> None:
            found.append(repr(number))

        example()
        return found

    before = drawn()
    other = types.ModuleType("numbers_of_the_project")
    other.__file__ = str(tmp_path / "numbers_of_the_project.py")
    Path(other.__file__).write_text(f"A = {[k + 0.3217 for k in range(50)]}")
    monkeypatch.setitem(sys.modules, other.__name__, other)
    assert drawn() == before


ODD = st.one_of(
    st.floats(),
    st.sampled_from([0.0, -1.0, 1e-320, 1e-290, 1e150, 1e308, math.nan, math.inf, None, "1", 1j, True]),
)


@examples(120)
@given(st.sampled_from(["length", "width", "poisson", "thickness"]), ODD)
def test_any_number_makes_a_sheet_or_is_named(name: str, value: object) -> None:
    try:
        sheet = Sheet(**{name: value})
    except ValueError as refusal:
        assert name in str(refusal)  # noqa: PT017
        return
    assert math.isfinite(getattr(sheet, name))
    assert sheet.length > 0


@examples(150)
@given(st.sampled_from(["alpha", "rtol", "atol", "slip_speed"]), ODD)
def test_any_number_makes_a_speed_or_is_named(name: str, value: object) -> None:
    options = {"alpha": 0.1, "rtol": 1e-2, "friction": "tanh", "slip_speed": 0.01, name: value}
    with refusals():
        try:
            speed = line_balance(SineWave(), **options)
        except ValueError as refusal:
            assert name in str(refusal)  # noqa: PT017
            return
    assert math.isfinite(speed.mean)
    assert math.isfinite(speed.error)
