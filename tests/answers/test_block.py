"""The block: what it says against the numbers of the answer, found independently."""

import math
import re
import warnings
from dataclasses import replace

import numpy as np
import pytest
from scipy import special

from fem_check.answer.block import block
from fem_check.answer.growth import alpha_of, extremes
from fem_check.answer.rounding import measured, rounded_up
from fem_check.answer.units import Units
from fem_check.choice.prediction import predict
from linear_theory import (
    FieldWave,
    Sheet,
    SineWave,
    TravellingWave,
    crawl_speed,
    line_cycle_speed,
    pulse_wave,
)
from linear_theory.growth.laws import GROWTH_LAWS
from linear_theory.scene.scene import Scene
from linear_theory.speed.result import Estimate

MM = Units("mm", "s")
NUMBER = r"([−\d.]+)"
NUMBER_E = r"([\d.e-]+)"


def lines(text):
    """The lines of a block by their label, continuations joined."""
    found = {}
    for line in text.splitlines():
        label, rest = line[:12].strip(), line[12:]
        if label:
            last = label
            found[last] = rest.strip()
        else:
            found[last] += " " + rest.strip()
    return found


def numbers(text, pattern):
    """The numbers in a pattern of it, as floats."""
    (groups,) = re.findall(pattern, text)
    groups = (groups,) if isinstance(groups, str) else groups
    return [float(number.replace("−", "-")) for number in groups]


def test_a_speed_in_mm_per_s_is_that_of_the_strip():
    """Against the closed form of a strip, whose speed is 40 mm/8 s times its number."""
    found = predict(Sheet(40.0, 4.0, 0.5, 0.8), SineWave(1, 8.0), 0.1, level="strip", rtol=0.2)
    said = lines(block(found, MM))
    exact = line_cycle_speed(0.1, body="strip") * 40 / 8
    value, error = numbers(said["speed"], rf"^{NUMBER} ± {NUMBER} mm/s, along the wave;")
    assert abs(value - exact) <= error
    assert error >= found.error
    (way,) = numbers(said["speed"], rf"; {NUMBER} mm per period")
    assert way == pytest.approx(8 * exact, abs=8 * error)
    assert said["wave ──▶"] == "40 × 4 × 0.8 mm, 1 sine wave on the sheet, T = 8 s"


@pytest.mark.parametrize("count", [1, -1])
@pytest.mark.parametrize("pulse", [False, True])
def test_direction_is_the_sign_of_the_speed_and_of_the_wave(count, pulse):
    """A sine crawls along its wave, a pulse of growth against it (first order of its median)."""
    wave = pulse_wave(0.3, count) if pulse else SineWave(count)
    found = predict(Sheet(), wave, 0.05, level="first order")
    expected = crawl_speed(Sheet(), wave, 0.05).mean
    assert np.sign(expected) == (-count if pulse else count)
    text = str(found)
    said = lines(text)
    assert ("against the wave" if pulse else "along the wave") in said["speed"]
    assert ("−" in said["speed"].split("±")[0]) == (expected < 0)
    assert text.splitlines()[0].startswith("  wave ──▶" if count > 0 else "  ◀── wave")
    assert text.splitlines()[1].startswith("  sheet ──▶" if expected > 0 else "  ◀── sheet")


def test_units_of_the_sheet_do_not_depend_on_the_units_of_the_question():
    small = predict(Sheet(1.0, 0.4), SineWave(), 0.1, rtol=0.1)
    large = predict(Sheet(3.0, 1.2, thickness=0.09), SineWave(period=2.0), 0.1, rtol=0.1)
    said, again = lines(str(small)), lines(str(large))
    assert again["speed"] == said["speed"]
    assert again["wave ──▶"] == f"{said['wave ──▶']}, L = 3, T = 2"
    value, error = numbers(said["speed"], rf"^{NUMBER} ± {NUMBER} L/T")
    assert abs(value - large.mean * 2 / 3) <= error
    (share,) = numbers(said["speed"], rf"; {NUMBER} % of L per period")
    assert share == pytest.approx(100 * value)


def test_accuracy_is_both_errors_rounded_up():
    found = predict(Sheet(), SineWave(), 0.1, rtol=0.1)
    share, numerical, model = numbers(
        lines(str(found))["accuracy"], rf"{NUMBER} % \(numerical {NUMBER}, model {NUMBER}, its distance"
    )
    for shown, true in (
        (share, 100 * found.error / abs(found.mean)),
        (numerical, found.speed.error),
        (model, found.speed.model_error),
    ):
        assert true <= shown <= 2 * true


def test_what_is_left_out_is_all_of_what_the_answer_leaves_out():
    found = predict(Sheet(), SineWave(), 0.1, level="strip")
    assert lines(str(found))["left out"] == "; ".join(found.left_out)
    assert len(found.left_out) == 5  # bending, ground, weight, friction that deforms, inertia
    assert not set(found.left_out) - set(lines(block(found, width=60))["left out"].split("; "))


def test_a_tolerance_that_is_missed_and_a_model_that_is_not_known_are_said():
    known = predict(Sheet(), SineWave(), 0.1, level="strip", rtol=1e-3)
    said = lines(str(known))
    asked, error = numbers(
        said["NOT MET"], rf"the tolerance, {NUMBER} %, is not met: the error is {NUMBER} %"
    )
    assert asked == 0.1
    assert error >= 100 * known.error / abs(known.mean)
    unknown = lines(str(predict(Sheet(), SineWave(), 0.1, level="strip", friction="viscous")))
    assert "may not be met" in unknown["NOT MET"]
    assert "model unknown" in unknown["accuracy"]
    assert unknown["friction"].startswith("viscous: force proportional to the sliding velocity")
    met = predict(Sheet(), SineWave(), 0.1, rtol=0.5)
    assert met.converged
    assert "NOT MET" not in lines(str(met))


def test_beyond_reach_is_said():
    with warnings.catch_warnings(action="ignore"):
        found = predict(Sheet(), SineWave(), 0.9, level="second order", rtol=0.5)
    said = lines(str(found))
    assert said["NO ANSWER"] == f"beyond the reach of the theory: {found.speed.beyond_reach}"


def test_nothing_moves_without_growth():
    said = lines(str(predict(Sheet(), SineWave(), 0.0)))
    assert said["speed"].startswith("0 L/T, at rest")
    assert said["accuracy"].startswith("exact: nothing moves")


def test_a_sheet_that_turns():
    """A wave that is stronger on the right turns it: the rate is that of the first-order balance."""
    wave = FieldWave(lambda x, y, t: (1 + 3 * x) * np.sin(2 * np.pi * (y - t)), 1.0)
    found = predict(Sheet(), wave, 0.05, level="first order", rtol=0.05)
    expected = crawl_speed(Sheet(), wave, 0.05, rtol=1e-3)
    said = lines(str(found))
    rate, error = numbers(said["turning"], rf"^{NUMBER} ± {NUMBER} degrees per period, anticlockwise")
    assert abs(rate - math.degrees(expected.rigid_mean[2])) <= error + math.degrees(
        expected.rigid_error[2]
    )
    assert said["wave"].startswith("1 × 0.5 × 0.03 L, a wave c(x, y, t)")
    assert "towards +y" in said["speed"]
    assert "sideways" in said


def test_mixed_friction_names_its_slip_speed_in_the_units_of_the_answer():
    with warnings.catch_warnings(action="ignore"):
        found = predict(
            Sheet(40.0, 20.0),
            SineWave(1, 8.0),
            0.1,
            friction="tanh",
            slip_speed=0.1,
            level="first order",
        )
    slip, share = numbers(lines(block(found, MM))["friction"], rf"slip speed {NUMBER} mm/s, {NUMBER} %")
    assert slip == 0.1
    assert share == pytest.approx(100 * found.speed.slip_ratio, rel=0.05)
    assert lines(block(found, MM))["friction"].startswith("mixed: ")
    (in_sheets,) = numbers(lines(str(found))["friction"], rf"slip speed {NUMBER} L/T")
    assert in_sheets == 0.1 / (40 / 8)


@pytest.mark.parametrize("width", [60, 80, 100])
def test_lines_are_as_long_as_they_may_be(width):
    text = block(predict(Sheet(), SineWave(), 0.1, level="strip"), width=width)
    assert width - 20 < max(map(len, text.splitlines())) <= width
    assert not re.search(r"(=|±|\d)$", text, re.MULTILINE)  # no number is parted from its unit


@pytest.mark.parametrize("law", GROWTH_LAWS)
@pytest.mark.parametrize("wave", [SineWave(), pulse_wave(0.2), TravellingWave([0.5, 0.3], [0.2, 0.1])])
def test_growth_at_the_crest_is_what_was_asked_for(law, wave):
    alpha = alpha_of(0.12, wave, Sheet(), law)
    crest = wave.profile(np.linspace(0, 2 * np.pi, 100_001)).max()
    stretch = {"exp": np.exp(alpha * crest), "linear": 1 + alpha * crest}
    stretch["metric"] = np.sqrt(1 + 2 * alpha * crest)
    assert stretch[law] == pytest.approx(1.12, rel=1e-5)  # the crest falls between phases
    assert extremes(Scene(Sheet(), wave, alpha, growth_law=law)).crest == pytest.approx(0.12, rel=1e-12)


def test_pulse_has_the_width_and_the_harmonics_that_it_says():
    width, phase = 0.2, np.linspace(0, 2 * np.pi, 97)
    steepness = math.log(2) / (1 - math.cos(math.pi * width))
    pulse = pulse_wave(width)
    profile = np.exp(steepness * (np.cos(phase) - 1))
    assert pulse.profile(phase) == pytest.approx(profile, abs=4e-16 * pulse.cosine.size)
    assert pulse.profile([0, math.pi * width]) == pytest.approx([1, 0.5], rel=1e-14)
    beyond = 2 * special.ive(pulse.cosine.size + 1, steepness)
    assert beyond <= np.finfo(float).eps * pulse.cosine[0]
    for bad in (0.01, 1.0, -0.2, math.nan):
        with pytest.raises(ValueError, match="width"):
            pulse_wave(bad)


def test_errors_are_never_shown_smaller_than_they_are():
    """What is shown covers the value and its error, in one digit or two that are not many more."""
    rng = np.random.default_rng(3)
    for power in rng.uniform(-12, 12, 400):
        error = 10**power
        value = float(rng.normal() * error * 10 ** rng.uniform(-1, 5))
        shown = measured(value, error)
        v, e = (float(text.replace("−", "-")) for text in (shown.value, shown.error))
        assert 0 < error <= e <= 2.6 * error
        assert abs(v - value) + error <= e * (1 + 1e-12)
        assert 1 <= len(shown.error.split("e")[0].replace(".", "").strip("0")) <= 2
        assert error <= float(rounded_up(error)) <= 2 * error
    assert "±" not in measured(0.0, 0.0).with_unit("L/T")


def test_a_tolerance_is_told_as_a_speed_where_that_is_what_counts():
    """Of a speed of nearly zero: 1e-3 rtol alpha^2 L/T, which is no meaningful share of it."""
    found = predict(Sheet(), SineWave(), 0.1, level="strip", rtol=1e-3)
    still = Estimate(1e-16, 3e-3)
    found = replace(found, speed=replace(found.speed, estimate=still, model_error=0.0), converged=False)
    said = lines(block(found, Units("mm", "s", 40.0, 8.0)))["NOT MET"]
    asked, error = numbers(
        said, rf"the tolerance, {NUMBER_E} mm/s, is not met: the error is {NUMBER} mm/s"
    )
    assert asked == pytest.approx(1e-3 * 1e-3 * 0.1**2 * 40 / 8)
    assert 3e-3 * 40 / 8 <= error < 2 * 3e-3 * 40 / 8


def test_a_tolerance_that_is_met_is_never_said_to_be_missed():
    """What else is wrong with the answer has a line of its own, and so does nothing else."""
    found = predict(Sheet(), SineWave(), 0.1, level="strip", rtol=0.5)
    wrong = replace(found, converged=False, caution="the sheet snaps over")
    said = lines(str(wrong))
    assert said["CAUTION"] == "the sheet snaps over"
    assert "NOT MET" not in said
    unasked = replace(found, tolerance=None)
    assert not {"NOT MET", "CAUTION"} & lines(str(unasked)).keys()
