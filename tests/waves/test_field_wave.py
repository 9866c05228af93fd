"""A wave given by a function."""

import numpy as np
import pytest

from linear_theory import FieldWave, Scene, Sheet


def test_values_broadcast_and_constants_are_spread():
    wave = FieldWave(lambda x, y, t: x + 10 * y + 100 * t, period=2.0)
    x, y, t = np.arange(3)[:, None], np.arange(4), np.arange(2)[:, None, None]
    assert wave.value(x, y, t).shape == (2, 3, 4)
    assert wave.value(1, 2, 3) == 321
    assert FieldWave(lambda x, y, t: 1.5, period=1.0).value(x, y, t).shape == (2, 3, 4)


@pytest.mark.parametrize(("harmonic", "bound"), [(1, 1e-13), (5, 1e-12), (10, 1e-10)])
def test_rate_without_a_function_is_a_difference_of_eighth_order(harmonic, bound):
    # bound: (2 pi k/512)**8/630 relative, plus the roundoff 512 * 1e-16/(2 pi k)
    w = 2 * np.pi * harmonic / 3
    wave = FieldWave(lambda x, y, t: np.sin(w * t + x), period=3.0)
    t = np.linspace(0, 3, 50)
    assert abs(wave.rate(0.1, 0, t) / w - np.cos(w * t + 0.1)).max() < bound


def test_rate_that_is_given_is_used():
    wave = FieldWave(lambda x, y, t: x, period=1.0, rate=lambda x, y, t: y)
    assert wave.rate(1, 7, 0.0) == 7


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((3, 1.0), "value = 3: must be a function"),
        ((lambda x, y, t: x, 0.0), "period = 0: must be > 0"),
        ((lambda x, y, t: x, np.inf), "period contains inf: must be finite"),
        ((lambda x, y, t: x, 1.0, 2), "rate = 2: must be a function"),
        ((lambda y, t: y, 1.0), r"value has the signature \(y, t\): must be \(x, y, t\)"),
        ((lambda a, b, c, d: a, 1.0), r"value has the signature \(a, b, c, d\): must be"),
        ((lambda x, y, t, *, c: x, 1.0), r"value has the signature .*: must be \(x, y, t\)"),
        ((np.sin, 1.0), "value has the signature of 1 arguments: must be"),
        ((lambda x, y, t: x, 1.0, lambda t: t), r"rate has the signature \(t\): must be"),
    ],
)
def test_bad_arguments(arguments, message):
    with pytest.raises(ValueError, match=message):
        FieldWave(*arguments)


def test_functions_that_take_more_than_they_need():
    for function in (lambda *points: points[0], lambda x, y, t, scale=1.0: scale * x):
        assert FieldWave(function, 1.0).value(3.0, 0, 0) == 3.0
    assert FieldWave(np.frompyfunc(lambda x, y, t: float(x), 3, 1), 1.0).period == 1.0


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda x, y, t: np.full(3, np.nan), r"value\(x, y, t\) contains nan: must be finite"),
        (lambda x, y, t: np.zeros(5), r"shape \(5,\): must broadcast to that of the points, \(3,\)"),
        (lambda x, y, t: np.zeros(3, complex), "must be real numbers, not dtype complex128"),
    ],
)
def test_bad_results(function, message):
    with pytest.raises(ValueError, match=message):
        FieldWave(function, 1.0).value(np.zeros(3), 0, 0)


def wave(scale=1.0, period=2.0, **arguments):
    return FieldWave(lambda x, y, t: scale * np.sin(y - np.pi * t) + 0 * x, period, **arguments)


def still(x, y, t):
    return 0 * x


def test_waves_of_the_same_content_are_equal():
    assert wave() == wave()
    assert hash(wave()) == hash(wave())
    assert len({wave(), wave(), wave(2.0)}) == 2
    assert Sheet() != wave() != "wave"
    others = wave(2.0), wave(period=1.0), wave(rate=still), wave(name="a")
    assert all(wave() != other for other in others)
    assert wave(1.0, name="a") == wave(2.0, name="a")  # a name stands for the functions
    assert wave(rate=still) == wave(rate=still)
    assert Scene(Sheet(), wave(), 0.1) == Scene(Sheet(), wave(), 0.1)


def test_a_wave_whose_content_is_not_known_equals_itself_alone():
    numbers = iter(range(3))

    def made():
        return FieldWave(lambda x, y, t: next(numbers) + 0 * x, 1.0)

    one = made()
    assert one == one
    assert one != made()
    assert one in {one}
