"""BLAS is held at one thread inside of what the package computes, and at the user's number after it."""

import multiprocessing
import os
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator

import numpy as np
import pytest
from threadpoolctl import ThreadpoolController, threadpool_limits

from fem_check import (
    Friction,
    Gravity,
    Material,
    Membrane,
    Scene,
    cycle_speed,
    plane_stress_field,
    predict,
    simulate,
)
from fem_check.shell.cycle.shapes import cycle_of_shapes
from linear_theory import (
    FieldWave,
    Sheet,
    SineWave,
    crawl_speed,
    field_speed,
    friction_field,
    line_balance,
    ritz_field,
    second_order,
)
from linear_theory.common.threads import OneBlasThread, one_blas_thread

BLAS = ThreadpoolController().select(user_api="blas")
USER = 2
"""Threads that the user of these tests asks for, whatever the environment says."""

SHEET, MATERIAL = Sheet(), Material(0.03, 0.5)


def threads() -> set[int]:
    return {library.num_threads for library in BLAS.lib_controllers}


@pytest.fixture(autouse=True)
def _user() -> Iterator[None]:
    with threadpool_limits(limits=USER, user_api="blas"):
        assert threads() == {USER}
        yield
        assert threads() == {USER}


def witness(seen: set[int]) -> FieldWave:
    """A sine wave that notes at how many threads it is asked for its values."""

    def value(x, y, t):
        seen.update(threads())
        return np.sin(2 * np.pi * (y - t)) + 0 * x

    return FieldWave(value, 1.0)


def scene(wave: FieldWave | SineWave, *more: object) -> Scene:
    return Scene(SHEET, wave, 0.1, effects=(Membrane(MATERIAL), *more), cells=(1, 2))


ENTRANCES: dict[str, Callable[[FieldWave], object]] = {
    "ritz_field": lambda wave: ritz_field(SHEET, wave, degree=5),
    "plane_stress_field": lambda wave: plane_stress_field(SHEET, wave, size=0.4),
    "crawl_speed": lambda wave: crawl_speed(SHEET, wave, 0.1, rtol=0.3),
    "second_order": lambda wave: second_order(SHEET, wave, rtol=0.3),
    "line_balance": lambda wave: line_balance(wave, 0.1, rtol=0.1, length=1),
    "predict": lambda wave: predict(SHEET, wave, 0.1, rtol=0.3, level="first order"),
}


@pytest.mark.parametrize("name", ENTRANCES)
def test_waves_are_asked_at_one_thread(name):
    seen: set[int] = set()
    ENTRANCES[name](witness(seen))
    assert seen - {USER} == {1}
    if name in ("ritz_field", "line_balance", "second_order"):  # no look at the wave before it starts
        assert seen == {1}


def test_shapes_and_steps_are_found_at_one_thread():
    # a scene looks at its wave when it is made, at the user's threads
    seen: set[int] = set()
    still, moving = scene(witness(seen)), scene(witness(seen), Gravity(3e-6), Friction(1.0, 5e-3))
    for call in (
        lambda: cycle_of_shapes(still, 4),
        lambda: cycle_speed(still, rtol=0.3),
        lambda: simulate(moving, periods=1, rtol=0.3, ramp=0.0),
    ):
        seen.clear()
        call()
        assert 1 in seen


def test_speeds_and_friction_of_a_known_field_are_found_at_one_thread():
    seen: set[int] = set()
    field = ritz_field(SHEET, witness(seen), degree=5)
    for call in (
        lambda: field_speed(field, 0.1, rtol=0.3),
        lambda: friction_field(field, 0.1, 0.1, 0.1, 0.0),
        lambda: field.displacement(0.1, 0.1, 0.0),
        lambda: field.strain(0.1, 0.1, 0.0),
        lambda: field.velocity(0.1, 0.1, 0.0),
    ):
        seen.clear()
        call()
        assert 1 in seen


def test_the_blas_of_scipy_is_limited_where_it_was_not_loaded_before():
    code = (
        "import linear_theory; from linear_theory.common.threads import one_blas_thread\n"
        "with one_blas_thread:\n"
        "    import scipy.linalg, threadpoolctl\n"
        "    blas = threadpoolctl.ThreadpoolController().select(user_api='blas').info()\n"
        "    print({library['num_threads'] for library in blas})"
    )
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "2", "MKL_NUM_THREADS": "2"}
    environment.pop("OMP_NUM_THREADS", None)
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True, env=environment
    )
    assert done.stdout == "{1}\n"


def test_nested_use_and_exceptions_restore():
    with one_blas_thread:
        assert threads() == {1}
        with pytest.raises(ValueError, match="alpha"):
            crawl_speed(SHEET, SineWave(), 5.0, rtol=0.1)  # refused within the balance
        assert threads() == {1}
    assert threads() == {USER}
    with pytest.raises(ValueError, match="alpha"):
        crawl_speed(SHEET, SineWave(), 5.0, rtol=0.1)


def test_a_generator_that_is_left_restores():
    def values() -> Iterator[int]:
        with one_blas_thread:
            yield 1
            yield 2

    some = values()
    next(some)
    assert threads() == {1}
    some.close()
    assert threads() == {USER}


def test_a_decorated_function_keeps_its_name_arguments_and_result():
    @one_blas_thread
    def twice(number: int, *, plus: int = 0) -> tuple[int, set[int]]:
        """Doc."""
        return 2 * number + plus, threads()

    assert (twice.__name__, twice.__doc__) == ("twice", "Doc.")
    assert twice(3, plus=1) == (7, {1})


def test_the_last_of_several_threads_restores():
    """In an order in which the first caller leaves before the second one."""
    first_in, second_in, first_out = (threading.Event() for _ in range(3))
    seen: list[set[int]] = []

    def first() -> None:
        with one_blas_thread:
            first_in.set()
            second_in.wait(10)
        first_out.set()

    def second() -> None:
        first_in.wait(10)
        with one_blas_thread:
            second_in.set()
            first_out.wait(10)
            seen.append(threads())

    both = [threading.Thread(target=call) for call in (first, second)]
    for thread in both:
        thread.start()
    for thread in both:
        thread.join()
    assert seen == [{1}]
    assert threads() == {USER}


def test_four_threads_find_the_same_speed_and_restore():
    expected = crawl_speed(SHEET, SineWave(), 0.1, rtol=1e-2).mean
    found: list[float] = []

    def ask() -> None:
        found.extend(crawl_speed(SHEET, SineWave(), 0.1, rtol=1e-2).mean for _ in range(3))

    asking = [threading.Thread(target=ask) for _ in range(4)]
    for thread in asking:
        thread.start()
    for thread in asking:
        thread.join()
    assert found == [expected] * 12


def in_child(answers: multiprocessing.SimpleQueue) -> None:
    before = threads()
    with one_blas_thread:
        answers.put((before, threads()))


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="no fork here")
@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")  # of forks beside threads
def test_a_forked_process_is_not_left_at_one_thread():
    """Forked while another thread, which the child does not have, holds BLAS at one."""
    context = multiprocessing.get_context("fork")
    answers = context.SimpleQueue()
    inside, done = threading.Event(), threading.Event()

    def hold() -> None:
        with one_blas_thread:
            inside.set()
            done.wait(30)

    holder = threading.Thread(target=hold)
    holder.start()
    inside.wait(10)
    child = context.Process(target=in_child, args=(answers,))
    child.start()
    child.join(30)
    done.set()
    holder.join()
    assert child.exitcode == 0
    assert answers.get() == ({USER}, {1})


class Library:
    """Stands for a BLAS of `number` threads, for each thread of Python its own where it says openmp."""

    internal_api = "openblas"

    def __init__(self, number: int, threading_layer: str) -> None:
        self.threading_layer, self.numbers, self.first, self.calls = threading_layer, {}, number, 0

    @property
    def num_threads(self) -> int:
        return self.numbers.get(self._key(), self.first)

    def set_num_threads(self, number: int) -> None:
        self.calls += 1
        self.numbers[self._key()] = number

    def _key(self) -> int:
        return threading.get_ident() if self.threading_layer == "openmp" else 0


def test_libraries_with_a_number_for_each_thread_are_limited_in_each():
    library = Library(8, "openmp")
    limit = OneBlasThread([library])
    seen: list[int] = []

    def other() -> None:
        with limit:
            seen.append(library.num_threads)
        seen.append(library.num_threads)

    with limit:
        thread = threading.Thread(target=other)
        thread.start()
        thread.join()
        assert library.num_threads == 1
    assert seen == [1, 8]
    assert library.num_threads == 8


def test_libraries_at_one_thread_are_left_alone():
    library = Library(1, "pthreads")
    with OneBlasThread([library]):
        pass
    assert library.calls == 0
