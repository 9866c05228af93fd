"""The best scene: known answers, honest certificates, refusals by name, and runs that are stopped."""

import json
import math
import re

import numpy as np
import pytest
from scipy.optimize import minimize_scalar

import fem_check.optimisation.kept as kept_answers
from fem_check import Bound, Harmonics, Scene, optimise
from fem_check.choice.settings import RunSettings
from fem_check.optimisation.finding import NothingFound
from fem_check.optimisation.kept import Kept, KeptError
from fem_check.optimisation.objectives import Speed, objective_of
from fem_check.optimisation.unknowns import Unknowns
from fem_check.optimisation.values import Question
from figures.measure.optimise.one_arc import best_of_one_arc
from linear_theory import Sheet, SineWave, TravellingWave, line_balance
from linear_theory.common.estimate import Estimate
from linear_theory.line.best.dry import dry_bound, size_of
from linear_theory.optimisation.certificate import certificate
from linear_theory.optimisation.search import Ascent

ALPHA = 1e-3
WAVE = TravellingWave(np.array([1.0, 0.2]), np.zeros(2))
STRIP = Scene(Sheet(width=0.1), WAVE, alpha=ALPHA)
LARGEST = {"wave": Harmonics(2, largest=1.0)}


@pytest.fixture(scope="module")
def best():
    return optimise(STRIP, LARGEST, level="strip", starts=2)


def test_the_best_wave_on_dry_ground_is_found_from_random_starts(best):
    """Between what a wave of a linear program has, less the margin of |c|, and the bound."""
    value = best.value.value / ALPHA
    assert 0.994 * best_of_one_arc(2).reached < value < dry_bound(2)
    assert best.agreed == len(best.starts) == 2
    wave = best.scene.wave
    assert 0.99 < size_of(wave) < 1 + 1e-4
    assert line_balance(wave, ALPHA, body="strip", growth_law="exp").mean == best.value.value
    assert best.start.value < 0 < best.value.value


def test_its_certificate_holds_and_that_of_other_waves_does_not(best):
    assert best.converged
    assert "|c| <= 1" in best.certificate.held
    unknowns = Unknowns(STRIP, LARGEST)
    question = Question(unknowns, RunSettings("strip"), Speed(), Kept())
    random = np.random.default_rng(0)
    for _ in range(3):
        away = unknowns.region.towards_centre(random.normal(size=5) * unknowns.harmonics.spread)
        proof = certificate(question.proof(), unknowns.region, away, unknowns.names)
        if proof.value < 0.9 * best.certificate.value:
            assert not proof.holds(0.02)


def test_it_is_checked_by_the_next_level(best):
    assert best.check.level == "first order"
    assert best.check.best.value > 0 > best.check.start.value
    said = str(best)
    for words in (
        "best      speed 0.000443",
        "held by   |c| <= 1",
        "2 of 2",
        "check",
        "small-strain theory",
    ):
        assert words in said
    assert "converged" in repr(best)


def test_on_viscous_ground_every_wave_of_one_energy_is_as_good():
    """V = 2 alpha^2 (mean square) L/T of a strip to leading order, the mean of c being 0."""
    scene = STRIP.resting(friction="viscous")
    over = {"wave": Harmonics(2, mean_square=0.3)}
    found = optimise(scene, over, level="strip", starts=2, check=False)
    assert found.value.value == pytest.approx(2 * ALPHA**2 * 0.3, rel=2e-3)
    assert found.agreed == 2
    assert abs(found.values["wave.mean"]) < 0.02


def test_a_coupling_between_bounds():
    """The fastest against the wave by a search without gradients; at a bound, the slope."""
    scene = Scene(Sheet(width=0.1), WAVE, alpha=0.2)

    def speed(alpha):
        return line_balance(scene.wave, alpha, body="strip", growth_law="exp").mean

    over = {"growth.alpha": (0.01, 0.3)}
    found = optimise(scene, over, "speed towards -y", level="strip", starts=1, check=False)
    inner = minimize_scalar(speed, bounds=(0.01, 0.3), method="bounded", options={"xatol": 1e-4})
    assert found.value.value == pytest.approx(-inner.fun, rel=1e-4)
    assert found.values["growth.alpha"] == pytest.approx(inner.x, rel=1e-2)
    assert found.converged
    held = optimise(scene, over, level="strip", starts=1, check=False)
    assert held.certificate.held == ("upper bound of growth.alpha",)
    numeric = (speed(0.3 + 1e-6) - speed(0.3 - 1e-6)) / 2e-6
    assert held.sensitivities["growth.alpha"] == pytest.approx(numeric, rel=1e-2)


def test_the_adjoint_is_the_gradient_of_differences():
    scene = Scene(Sheet(), TravellingWave(np.array([1.0, 0.2]), np.array([0.0, 0.1])), alpha=0.2)
    unknowns = Unknowns(scene, {"sheet.width": (0.3, 0.7)})
    question = Question(unknowns, RunSettings("first order", 1e-2), Speed(), Kept())
    one = question.by_adjoint()(unknowns.present)
    other = question.by_differences(careful=True)(unknowns.present)
    assert abs(one.value - other.value) <= one.error + other.error
    assert np.all(abs(one.gradient - other.gradient) <= one.doubt + other.doubt)
    assert question.proof()(unknowns.present).gradient == pytest.approx(one.gradient)


def test_any_function_by_differences():
    def closeness(speed):
        return -((speed.mean - 0.02) ** 2)

    over = {"growth.alpha": (0.05, 0.4)}
    scene = Scene(Sheet(width=0.1), SineWave(), alpha=0.1)
    found = optimise(scene, over, closeness, level="strip", starts=1, check=False)
    reached = line_balance(SineWave(), found.values["growth.alpha"], body="strip", growth_law="exp")
    assert reached.mean == pytest.approx(0.02, rel=1e-2)


def nan(speed):
    return math.nan


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"over": {}}, "over = {}: must map fields to bounds"),
        ({"over": {"growth.alhpa": (0, 1)}}, "'growth.alhpa': is not a field of a scene"),
        ({"over": {"growth.alpha": (0.2, 0.1)}}, "over: growth.alpha = from 0.2 to 0.1"),
        ({"over": {"growth.alpha": 0.2}}, "over: growth.alpha = 0.2: must be"),
        ({"over": {"wave.count": (1, 3)}}, "over: wave.count: takes whole numbers"),
        ({"over": {"wave": 3}}, "over: wave = 3: must be Harmonics"),
        ({"over": {**LARGEST, "growth.swelling": (0.1, 0.2)}}, "must be growth.alpha beside harmonics"),
        ({"objective": "beauty"}, "objective = 'beauty': must be one of"),
        ({"objective": nan}, "objective: returned nan: must be a finite number"),
        ({"level": "best"}, "level = 'best': must be one of"),
        ({"starts": 0}, "starts = 0: must be >= 1"),
        ({"rtol": 2.0}, "rtol = 2: must be in"),
    ],
)
def test_bad_input_is_refused_by_name(arguments, words):
    given = {"over": LARGEST, "level": "strip", "starts": 1, **arguments}
    with pytest.raises(ValueError, match=words.replace("{}", r"\{\}").replace("(", r"\(")):
        optimise(STRIP, given.pop("over"), **given)


def test_harmonics_have_one_size():
    with pytest.raises(ValueError, match="largest, mean_square: one of them must be given"):
        Harmonics(3)
    with pytest.raises(ValueError, match="largest = -1: must be > 0"):
        Harmonics(3, largest=-1.0)
    with pytest.raises(ValueError, match="method = 'x': must be one of 'SLSQP'"):
        Ascent("x")
    assert objective_of("cost of transport").sign == -1


def test_beyond_the_reach_there_is_nothing():
    scene = Scene(Sheet(), SineWave(), alpha=0.1)
    with pytest.raises(NothingFound, match=r"no start has an answer; the first: alpha = 0.7"):
        optimise(scene, {"growth.alpha": (0.7, 0.8)}, level="first order", starts=1)


def test_a_search_that_is_stopped_goes_on(tmp_path):
    """After Ctrl-C, and after a kill that cut the last line, with all answers that were kept."""
    file, scene = tmp_path / "a.jsonl", Scene(Sheet(width=0.1), SineWave(), alpha=0.1)
    over, asked = {"growth.alpha": (0.05, 0.4)}, {"level": "strip", "starts": 2, "check": False}
    whole = optimise(scene, over, **asked)
    heard = []

    def stop(progress):
        heard.append(progress)
        if len(heard) == 7:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt, match=r"interrupted; \d+ answers are in .*; the same call"):
        optimise(scene, over, **asked, file=file, progress=stop)
    kept = len(file.read_text().splitlines()) - 1
    assert kept > 3
    assert heard[0].task.startswith("start 1 of 2, ")
    assert re.fullmatch(r"start 1 of 2, \d+ answers, speed \S+ length/time now", heard[-1].task)
    with file.open("a") as end:
        end.write('{"key": "cut off')
    again = optimise(scene, over, **asked, file=file)
    assert again.value == whole.value
    assert again.answers == whole.answers - kept
    assert optimise(scene, over, **asked, file=file).answers == 0
    with pytest.raises(KeptError, match="holds answers to another question"):
        optimise(scene, {"growth.alpha": (0.05, 0.3)}, **asked, file=file)
    file.write_text(json.dumps([1]) + "\n")
    with pytest.raises(KeptError, match=r"a\.jsonl, line 1: is no answer of an optimisation"):
        optimise(scene, over, **asked, file=file)


def test_an_answer_whose_digits_were_damaged_is_refused(tmp_path):
    path = tmp_path / "a.jsonl"
    with Kept(path, {"of": 1}) as kept:
        kept.value("value", np.array([0.5]), lambda: Estimate(0.25, 1e-3))
    with Kept(path, {"of": 1}) as kept:
        assert kept.value("value", np.array([0.5]), lambda: None).value == 0.25
    path.write_text(path.read_text().replace("0.25", "9.25"))
    with pytest.raises(KeptError, match="line 2: is no answer"), Kept(path, {"of": 1}):
        pass


def test_answers_of_one_function_are_not_given_for_another(tmp_path):
    """Functions are known by what they compute, as an objective and as a number with a bound."""
    scene, over = Scene(Sheet(width=0.1), SineWave(), alpha=0.1), {"growth.alpha": (0.05, 0.2)}
    asked = {"level": "strip", "starts": 1, "check": False, "how": Ascent(iterations=2)}
    for place, given in enumerate(
        (
            lambda factor: {"objective": lambda speed: factor * speed.mean},
            lambda factor: {"constraints": {"p": Bound(at_most=9, of=lambda s: factor * s.mean)}},
        )
    ):
        kept = {"file": tmp_path / f"{place}.jsonl", **asked}
        first = optimise(scene, over, **kept, **given(1.0))
        again = optimise(scene, over, **kept, **given(1.0))
        assert (again.answers, again.value) == (0, first.value)
        with pytest.raises(KeptError, match="holds answers to another question"):
            optimise(scene, over, **kept, **given(-1.0))
    with pytest.raises(ValueError, match="objective"):
        optimise(scene, over, lambda speed: open("x"), **kept)  # noqa: SIM115


def test_opening_a_file_of_answers_never_shortens_it(tmp_path, monkeypatch):
    """A kill, or a full disk, while it is opened leaves all whole lines."""
    file, begun = tmp_path / "a.jsonl", '{"question": 1}\n{"key": "a", "value": 1.0, "error": 0.0}\n'
    file.write_text(begun + '{"key": "cut')

    def full(*args, **keywords):
        opened = open(*args, **keywords)  # noqa: SIM115

        def write(text):
            raise OSError(28, "No space left on device")

        opened.write = write
        return opened

    with monkeypatch.context() as patch:
        patch.setattr(kept_answers, "open", full, raising=False)
        with Kept(file, 1) as answers:
            assert answers.count == 1
    assert file.read_text() == begun


GOOD = {"key": "a 0x1.0p+0", "value": 0.1, "error": 0.01, "gradient": [1.0], "doubt": [0.0], "kink": ""}


@pytest.mark.parametrize(
    "line",
    [
        json.dumps({"question": 1}).encode(),
        b'{"key": "a"}',
        json.dumps({**GOOD, "value": "abc"}).encode(),
        json.dumps({**GOOD, "value": None}).encode(),
        json.dumps({**GOOD, "gradient": "x"}).encode(),
        json.dumps({**GOOD, "key": 3}).encode(),
        json.dumps({**GOOD, "error": -0.01}).encode(),
        json.dumps({**GOOD, "gradient": [7.0, 1.0], "doubt": [0.0, 0.0]}).encode(),
        json.dumps({**GOOD, "crc32": 1}).encode(),
        json.dumps({"key": "a", "unusable": 1}).encode(),
        b"\xff\xfe",
        b"",
    ],
)
def test_a_damaged_answer_is_named_by_its_line(tmp_path, line):
    path = tmp_path / "a.jsonl"
    first = json.dumps({"question": {"of": 1}}).encode()
    path.write_bytes(b"\n".join([first, json.dumps(GOOD).encode(), line, b""]))
    with (
        pytest.raises(KeptError, match=r"a\.jsonl, line 3: is no answer of an optimisation; remove"),
        Kept(path, {"of": 1}),
    ):
        pass
    path.write_bytes(b"\n".join([first, json.dumps(GOOD).encode(), b""]))
    with Kept(path, {"of": 1}) as kept:
        assert kept.count == 1


def test_errors_below_0_and_seeds_below_0_are_refused():
    scene = Scene(Sheet(width=0.1), SineWave(), alpha=0.1)
    asked = {"level": "strip", "starts": 1, "check": False}
    with pytest.raises(ValueError, match=r"objective: returned .*: error must be >= 0"):
        optimise(scene, {"growth.alpha": (0.05, 0.4)}, lambda s: Estimate(s.mean, -1.0), **asked)
    with pytest.raises(ValueError, match=r"seed = -1: must be .*>= 0"):
        optimise(scene, {"growth.alpha": (0.05, 0.4)}, seed=-1, **asked)


def test_a_best_scene_that_does_not_move_is_told_as_such():
    """The sine goes towards +y whatever the sign of its growth."""
    scene = Scene(Sheet(width=0.1), SineWave(), alpha=0.1)
    options = {"level": "strip", "starts": 1, "check": False}
    found = optimise(scene, {"growth.alpha": (0.0, 0.2)}, "speed towards -y", **options)
    assert (found.value.value, found.scene.alpha) == (0.0, 0.0)
    assert "at rest   the best scene does not grow, and so does not move" in str(found)
    with pytest.raises(ValueError, match=r"growth.alpha = 0: must not be 0, or be among what may"):
        optimise(scene.but(alpha=0.0), {"wave.period": (1.0, 2.0)}, **options)
