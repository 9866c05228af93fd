"""Sheets and waves: values, Fourier factors, symmetries, bad input."""

from dataclasses import replace

import numpy as np
import pytest

from linear_theory import Sheet, SineWave, TravellingWave

WAVES = [
    SineWave(),
    SineWave(-2, 0.5),
    TravellingWave(np.array([0.3, 0.2]), np.array([1.0, -0.4]), 3, 2.0, 0.1),
    TravellingWave(np.array([0.3, 0.2]), np.array([1.0, -0.4]), -1, 2.0, 0.1),
]


def test_sine_wave_is_the_papers():
    y, t = np.linspace(-0.5, 0.5, 7), 0.3
    np.testing.assert_allclose(
        SineWave(2, 4.0).value(0.0, y, t), np.sin(4 * np.pi * y - np.pi / 2 * t), atol=1e-15
    )


@pytest.mark.parametrize("wave", WAVES)
def test_factors_rebuild_the_wave_and_its_rate(wave):
    y, t = np.linspace(-0.5, 0.5, 11), np.array([0.1, 0.77])[:, None]
    angle = 2 * np.pi * np.multiply.outer(wave.orders, y)
    for factors, exact, mean in (
        (wave.factors(t), wave.value(0, y, t), wave.mean),
        (wave.factor_rates(t), wave.rate(0, y, t), 0.0),
    ):
        sums = np.einsum("kti,ky->ty", factors.even, np.cos(angle))
        sums += np.einsum("kti,ky->ty", factors.odd, np.sin(angle))
        np.testing.assert_allclose(mean + sums, exact, atol=1e-14 * max(1, abs(exact).max()))


@pytest.mark.parametrize("wave", WAVES)
def test_rate_is_the_time_derivative(wave):
    h = 1e-6
    difference = (wave.value(0, 0.2, 0.3 + h) - wave.value(0, 0.2, 0.3 - h)) / (2 * h)
    assert wave.rate(0, 0.2, 0.3) == pytest.approx(difference, abs=1e-7)  # h^2 omega^3


@pytest.mark.parametrize("wave", WAVES)
def test_wave_travels_count_wavelengths_in_its_time(wave):
    # c(y, t) = f(n y/L - t/T): after dt it has moved by dt L/(n T)
    shifted = wave.value(
        0, 0.1 + 0.02 * wave.period / wave.period / wave.count, 0.3 + 0.02 * wave.period
    )
    assert shifted == pytest.approx(wave.value(0, 0.1, 0.3), abs=1e-13)


@pytest.mark.parametrize("size", [5, 8, 33])
def test_samples_are_interpolated(size):
    samples = np.random.default_rng(size).normal(size=size)
    wave = TravellingWave.from_samples(samples)
    np.testing.assert_allclose(wave.profile(2 * np.pi * np.arange(size) / size), samples, atol=1e-13)


def test_symmetries_are_seen():
    assert SineWave().is_half_period_antisymmetric
    assert SineWave(2, 3.0).reversal_time == 1.5
    pulse = TravellingWave(np.array([0.4, 0.3]), np.zeros(2))
    assert not pulse.is_half_period_antisymmetric
    assert pulse.reversal_time == 0.0
    assert TravellingWave(np.array([0.4]), np.array([0.1])).reversal_time is None
    assert not TravellingWave(np.zeros(1), np.ones(1), mean=0.1).is_half_period_antisymmetric


@pytest.mark.parametrize("wave", [SineWave(3, 0.7), TravellingWave(np.array([0.4, 0.3]), np.zeros(2))])
def test_reversal_time_reverses(wave):
    y, t = np.linspace(-0.5, 0.5, 9), 0.123
    np.testing.assert_allclose(
        wave.value(0, -y, wave.reversal_time - t), wave.value(0, y, t), atol=1e-14
    )


@pytest.mark.parametrize("count", [0, 1.5, True, "1", None])
def test_bad_count(count):
    with pytest.raises(ValueError, match="count"):
        SineWave(count)


@pytest.mark.parametrize("period", [0, -1.0, np.inf, np.nan, 1j, "1"])
def test_bad_period(period):
    with pytest.raises(ValueError, match="period"):
        SineWave(1, period)


@pytest.mark.parametrize("samples", [[1, np.nan, 2], [1, 2], np.ones((3, 3)), np.ones(4, complex)])
def test_bad_samples(samples):
    with pytest.raises(ValueError, match="samples"):
        TravellingWave.from_samples(samples)


@pytest.mark.parametrize(("cosine", "sine"), [([], []), ([1.0], [1.0, 2.0]), ([[1.0]], [[1.0]])])
def test_bad_series(cosine, sine):
    with pytest.raises(ValueError, match="shapes"):
        TravellingWave(np.array(cosine), np.array(sine))


@pytest.mark.parametrize("name", ["length", "width", "thickness"])
@pytest.mark.parametrize("value", [0.0, -1.0, np.nan, np.inf, "1", 1j, None])
def test_bad_sizes(name, value):
    with pytest.raises(ValueError, match=name):
        Sheet(**{name: value})


@pytest.mark.parametrize("poisson", [-1.0, 0.51, np.nan])
def test_bad_poisson(poisson):
    with pytest.raises(ValueError, match="poisson"):
        Sheet(poisson=poisson)


def test_waves_of_the_same_numbers_are_equal():
    sine = TravellingWave([0.0], [1.0], count=2, period=3.0)
    assert SineWave(2, 3.0) == sine
    assert sine == SineWave(2, 3.0)
    assert hash(sine) == hash(SineWave(2, 3.0))
    assert len({SineWave(), SineWave(), TravellingWave([-0.0], [1.0])}) == 1  # -0.0 is 0.0
    others = [
        *(SineWave(1, 3.0), SineWave(2, 2.0), TravellingWave([0.0], [1.0], 2, 3.0, 0.1)),
        *(TravellingWave([1.0], [1.0], 2, 3.0), TravellingWave([0.0, 0.0], [1.0, 1.0], 2, 3.0), "sine"),
    ]
    assert all(sine != other for other in others)


def test_waves_are_replaced_in_part():
    found = replace(SineWave(2), period=3.0)
    assert (type(found), found) == (SineWave, SineWave(2, 3.0))
    pulse = TravellingWave([0.4, 0.3], [0.0, 0.1], -1, 2.0)
    assert replace(pulse, mean=0.1) == TravellingWave([0.4, 0.3], [0.0, 0.1], -1, 2.0, 0.1)
    with pytest.raises(
        (ValueError, TypeError), match="mean"
    ):  # a sine has none; TypeError by Python 3.13
        replace(SineWave(), mean=0.1)


def test_sheet_defaults_are_the_papers():
    assert Sheet() == Sheet(1.0, 0.5, 0.5, 0.03)
    assert Sheet(poisson=0.5).area == 0.5
