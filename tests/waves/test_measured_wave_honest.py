"""Measured waves of any kind: nothing is lost in silence, and errors are what they claim."""

import numpy as np
import pytest

from fem_check import predict
from linear_theory import FieldWave, SampledWave, Sheet, SineWave, crawl_speed, line_balance
from linear_theory.wave.measured.misfit import Misfit

W = 2 * np.pi
Y, T = np.linspace(-0.5, 0.5, 40), np.arange(20) / 20
GROWTH = 0.25


def scattered(seed, count):
    random = np.random.default_rng(seed)
    return random.uniform(-0.5, 0.5, count), random.uniform(0, 2, count), random


def breathing(seed, count, noise):
    """Three harmonics, larger at one end than at the other, and samples of them: y, t, c, exact c."""
    y, t, random = scattered(seed, count)
    amplitudes, grows = random.normal(size=(2, 3)) / [1, 2, 4], random.uniform(-1, 1)

    def exact(x, y, t):
        turns = W * np.arange(1, 4) * np.asarray(y - t)[..., None]
        return (1 + grows * y) * (np.sin(turns) @ amplitudes[0] + np.cos(turns) @ amplitudes[1]) + 0 * x

    c = exact(0 * y, y, t)
    scale = abs(c).max()
    return y, t, c / scale + noise * random.normal(size=count), lambda *at: exact(*at) / scale


def random_wave(seed):
    """1 to 4 harmonics, 0 to 10 % noise, polynomials up to degree 3; on a grid or scattered."""
    random = np.random.default_rng(seed)
    harmonics, degree = int(random.integers(1, 5)), int(random.integers(0, 4))
    size = np.maximum(1, np.arange(1, 2 * harmonics + 2) // 2)[:, None] * (1 + np.arange(degree + 1))
    amplitudes, runs = random.normal(size=size.shape) / size, seed % 3 > 0

    def exact(x, y, t):
        y, t, _ = np.broadcast_arrays(y, t, x)
        turns = W * np.arange(1, harmonics + 1) * (runs * y - t)[..., None]
        turning = np.stack([np.cos(turns), np.sin(turns)], axis=-1).reshape(*y.shape, -1)
        turning = np.concatenate([np.ones((*y.shape, 1)), turning], axis=-1)
        powers = (2 * y[..., None]) ** np.arange(degree + 1)
        return np.einsum("...k,...p,kp->...", turning, powers, amplitudes) / scale

    scale = 1.0
    scale = abs(exact(0.0, np.linspace(-0.5, 0.5, 101)[:, None], np.arange(50) / 50)).max()
    count, noise = int(random.integers(40, 500)), random.choice([0.0, 0.01, 0.03, 0.1])
    y, t = random.uniform(-0.5, 0.5, count), random.uniform(0, 2, count)
    y[:2] = -0.5, 0.5
    if seed % 2:
        y, t = (a.ravel() for a in np.meshgrid(np.linspace(-0.5, 0.5, 16), np.arange(count // 16 + 6)))
        t = t / (count // 16 + 6)
    return y, t, exact(0.0, y, t) + noise * random.normal(size=y.size), exact


class TestNothingIsLost:
    @pytest.mark.parametrize("noise", [0.0, 0.02])
    @pytest.mark.parametrize("seed", range(8))
    def test_harmonics_that_pay_only_with_a_degree_are_found(self, seed, noise):
        y, t, c, exact = breathing(seed, 250, noise)
        wave = SampledWave(y, t, c, period=1.0)
        assert wave.harmonics in ((2, 3) if noise else (3,))  # the third may drown in the noise
        off = wave.value(0.0, y, t) - exact(0.0, y, t)
        assert np.sqrt(np.mean(off**2)) < 2 * noise + 1e-3
        assert not wave.doubt

    @pytest.mark.parametrize("copies", [2, 3])
    def test_copies_of_samples_change_nothing(self, copies):
        y, t, c, _ = breathing(1, 300, 0.02)
        once = SampledWave(y, t, c, period=1.0)
        again = SampledWave(*(np.tile(v, copies) for v in (y, t, c)), period=1.0)
        assert (again.harmonics, again.degree, again.noise) == (once.harmonics, once.degree, once.noise)
        assert again.uncertainty.share == once.uncertainty.share
        assert f"{300 * (copies - 1)} samples are copies" in again.remarks
        assert not once.remarks

    @pytest.mark.parametrize("later", [0.0, 3.0], ids=["same time", "periods later"])
    def test_repeats_with_little_noise_of_their_own_do_not_ask_for_more_functions(self, later):
        y, t, c, _ = breathing(2, 300, 0.05)
        once = SampledWave(y, t, c, period=1.0)
        other = c + 1e-4 * np.random.default_rng(0).normal(size=300)
        twice = SampledWave(*map(np.concatenate, ([y, y], [t, t + later], [c, other])), period=1.0)
        assert (twice.harmonics, twice.degree) == (once.harmonics, once.degree)


class TestErrors:
    @pytest.mark.parametrize("seed", [1, 2, 3, 4, 5, 6, 8, 11])
    def test_of_the_speed_of_a_random_wave(self, seed):
        y, t, c, exact = random_wave(seed)
        wave = SampledWave(y, t, c, period=1.0)
        true = line_balance(FieldWave(exact, 1.0), GROWTH, length=1.0, rtol=1e-2)
        found = line_balance(wave, GROWTH, length=1.0, rtol=1e-2)
        assert abs(found.mean - true.mean) <= found.error + true.error

    @pytest.mark.parametrize("count", [60, 90, 120])
    def test_a_wave_that_samples_do_not_resolve_is_in_doubt(self, count):
        y, t, _ = scattered(count, count)
        y[:2] = -0.5, 0.5
        wave = SampledWave(y, t, np.sin(4 * W * (y - t)), period=1.0)
        if wave.noise < 0.1:  # it was resolved
            assert abs(wave.value(0.0, 0.1, 0.2) - np.sin(4 * W * -0.1)) < 0.3
            return
        found = line_balance(wave, 0.1, length=1.0, rtol=0.5)
        assert wave.doubt in found.model
        assert not found.converged
        true = line_balance(SineWave(count=4), 0.1, length=1.0)
        assert abs(found.mean - true.mean) <= found.error + true.error

    def test_what_was_not_asked_for_is_missed(self):
        y, t, random = scattered(3, 600)
        c = np.sin(W * (y - t)) + 0.5 * np.sin(2 * W * (y - t)) + 0.02 * random.normal(size=600)
        wave = SampledWave(y, t, c, period=1.0, harmonics=1, degree=9)
        assert wave.missed == pytest.approx(0.5 / np.sqrt(2), rel=0.1)
        assert "the fit may miss" in wave.doubt

    def test_the_last_harmonic_that_samples_can_tell_is_doubtful(self):
        t = np.arange(5) / 5  # tells two harmonics: the third looks like the second
        wave = SampledWave(Y, t, np.cos(3 * W * t) * (1 + 0 * Y[:, None]), period=1.0)
        assert wave.missed == pytest.approx(1 / np.sqrt(2), rel=1e-6)
        assert wave.doubt

    def test_noise_without_a_wave_is_in_doubt(self):
        c = np.random.default_rng(0).normal(size=(40, 20))
        wave = SampledWave(Y, T, c, period=1.0)
        assert wave.harmonics == 0
        assert "no harmonic in time stands out" in wave.doubt
        assert "MOST of the wave, 100 % of its variance" in wave.dropped
        assert wave.smooth.words == "a measured wave of 0 harmonics in time"

    def test_noise_alone_is_not_taken_for_a_wave(self):
        missed = []
        for seed in range(20):
            c = np.sin(W * (Y[:, None] - T)) + 0.1 * np.random.default_rng(seed).normal(size=(40, 20))
            missed.append(SampledWave(Y, T, c, period=1.0, harmonics=1, degree=8).missed)
        assert np.mean(np.array(missed) < 0.02) >= 0.9

    def test_the_block_says_why(self):
        y, t, _ = scattered(3, 300)
        c = np.sin(W * (y - t)) + 0.5 * np.sin(2 * W * (y - t))
        y[:2] = -0.5, 0.5
        wave = SampledWave(y, t, c, period=1.0, harmonics=1, degree=8)
        text = " ".join(str(predict(Sheet(), wave, 0.05, rtol=0.5, level="cycle")).split())
        assert "the wave is not known well enough: the fit may miss" in text


class TestPeriodAndUnits:
    def test_a_period_of_which_samples_see_nothing(self):
        t = 0.384 * np.arange(21)
        c = np.sin(W * (Y[:, None] - t / 8))
        wrong, right = (SampledWave(Y, t, c, period=period) for period in (0.8, 8.0))
        assert (
            "samples are 0.384 apart in time, less than two in a period above harmonic 1" in wrong.doubt
        )
        assert not line_balance(wrong, 0.1, length=1.0, rtol=0.5).converged
        assert not right.doubt
        assert not right.remarks

    def test_faint_harmonics_that_rest_on_the_period_are_a_remark(self):
        t = 0.3 * np.arange(40)  # 40 phases
        c = np.sin(W * (Y[:, None] - t)) + 0.01 * np.sin(3 * W * (Y[:, None] - t))
        wave = SampledWave(Y, t, c, period=1.0)
        assert "less than two in a period above harmonic 1" in wave.remarks
        assert not wave.doubt

    def test_per_cent(self):
        c = 100 * np.sin(W * (Y[:, None] - T))
        assert "c reaches 100: is it in per cent?" in SampledWave(Y, T, c, period=1.0).remarks

    def test_micrometres_on_a_sheet_in_millimetres(self):
        c = np.sin(W * (Y[:, None] - T))
        wave = SampledWave(1000 * Y, T, c, period=1.0)
        with pytest.raises(
            ValueError, match=r"from -500 to 500, more than 10 times as far .* 0\.5 from"
        ):
            crawl_speed(Sheet(), wave, 0.1)

    @pytest.mark.parametrize("factor", [1e300, 1e-200])
    @pytest.mark.parametrize("name", "ytc")
    def test_numbers_whose_squares_leave_the_range(self, name, factor):
        samples = {"y": Y, "t": T, "c": np.sin(W * (Y[:, None] - T))}
        samples[name] = samples[name] * factor
        with pytest.raises(ValueError, match=rf"{name} reaches .*: must be between 1e-100 and 1e\+100"):
            SampledWave(*samples.values(), period=1.0)


def test_misfit_of_neighbours_is_that_of_the_missing_wave():
    """A smooth wave in dense samples, fitted by a constant: all is missed, and noise is not."""
    from linear_theory.wave.measured.basis import Basis
    from linear_theory.wave.measured.fit import fitted
    from linear_theory.wave.measured.samples import Samples

    y, t, random = scattered(0, 4000)
    c = np.sin(W * (y - t)) + 0.5 * random.normal(size=y.size)
    data = Samples(None, y, t, c)
    fit = fitted(data, Basis.over(data, 1.0, 0, (0, 0)))
    found = Misfit.of(data, fit)
    assert found.missed == pytest.approx(np.sqrt(0.5), rel=0.1)
    assert found.dropped == pytest.approx(1.0, rel=1e-6)
