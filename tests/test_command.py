"""The command `sheetcrawl`: answers, formats, exit status."""

import json
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from fem_check.command import BAD_ARGUMENTS, CLOSED_PIPE, INTERRUPTED, MET, MISSED, main
from fem_check.prediction import predict
from linear_theory import Sheet, SineWave, TravellingWave


def run(capsys, *arguments):
    """Exit status and what was printed, (status, out, err)."""
    with pytest.raises(SystemExit) as end:
        main(arguments)
    printed = capsys.readouterr()
    return end.value.code, printed.out, printed.err


def test_json_is_the_answer_of_predict(capsys):
    status, out, _ = run(capsys, "--alpha", "0.2", "--width", "0.3", "--rtol", "0.05", "--json")
    found = json.loads(out)
    expected = predict(Sheet(width=0.3), SineWave(), 0.2, rtol=0.05)
    assert status == MET
    assert found["mean"] == expected.mean
    assert found["error"] == expected.error
    assert (found["level"], found["reason"]) == (expected.level, expected.reason)
    assert found["converged"]
    assert found["seconds"] > 0
    assert tuple(found["left_out"]) == expected.left_out


def test_words_name_speed_level_and_cost(capsys):
    status, out, _ = run(capsys, "--alpha", "0.2", "--rtol", "0.1")
    speed, level, model, left_out, cost = out.splitlines()
    assert status == MET
    assert speed.startswith(f"V = {predict(Sheet(), SineWave(), 0.2, rtol=0.1).mean:.6g} ")
    assert level.startswith("level: ")
    assert model.startswith("model: ")
    for words in ("bending", "thickness", "the ground", "inertia"):
        assert words in left_out
    assert cost.startswith("cost: ")


def test_wave_of_harmonics_and_all_options(capsys):
    options = {
        "--alpha": "-0.1",
        "--length": "2",
        "--poisson": "0.3",
        "--count": "-1",
        "--period": "3",
        "--growth-law": "linear",
        "--area": "undeformed",
        "--load": "grown",
        "--friction": "tanh",
        "--slip-speed": "0.001",
        "--atol": "1e-3",
        "--method": "first order",
    }
    arguments = [word for pair in options.items() for word in pair]
    status, out, _ = run(capsys, *arguments, "--cosine", "0.5", "0.3", "--sine", "0.2", "--json")
    wave = TravellingWave([0.5, 0.3], [0.2, 0.0], -1, 3.0)
    expected = predict(
        Sheet(2.0, poisson=0.3),
        wave,
        -0.1,
        "linear",
        "undeformed",
        "grown",
        "tanh",
        1e-3,
        atol=1e-3,
        method="first order",
    )
    found = json.loads(out)
    assert found["mean"] == expected.mean
    # the distance of this model to the target is unknown: null in JSON, and the tolerance is not met
    assert found["model_error"] is None
    assert status == MISSED


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--alpha", "two"], "--alpha"),
        ([], "--alpha"),
        (["--alpha", "nan"], "alpha"),
        (["--alpha", "0.1", "--width", "-1"], "width = -1: must be > 0"),
        (["--alpha", "0.1", "--load", "heavy"], "--load"),
        (["--alpha", "0.1", "--friction", "tanh"], "slip_speed"),
        (["--alpha", "0.1", "--count", "0"], "count = 0"),
        (["--alpha", "0.1", "--rtol", "2"], "rtol = 2"),
        (["--alpha", "0.1", "--speed"], "--speed"),
        (["--alpha", "1.5", "--growth-law", "linear"], "alpha * growth = -1.5"),
    ],
)
def test_bad_arguments_get_one_line_and_status_2(capsys, arguments, named):
    status, out, err = run(capsys, *arguments)
    assert status == BAD_ARGUMENTS
    assert out == ""
    assert err.startswith("sheetcrawl: ")
    assert err.count("\n") == 1
    assert named in err


def test_a_sheet_without_a_stable_shape_is_no_traceback(capsys):
    status, out, _ = run(capsys, "--alpha", "0.5", "--rtol", "1e-3")
    assert out == ""
    assert status.startswith("sheetcrawl: ")  # as `sys.exit` takes it: printed, and status 1
    assert "stability" in status


@pytest.mark.parametrize("alpha", ["-1e-1", "-.1", "-0.1", "-1.E-1"])
def test_negative_numbers_are_no_options(capsys, alpha):
    status, out, _ = run(capsys, "--alpha", alpha, "--rtol", "0.1", "--json")
    assert status == MET
    assert json.loads(out)["mean"] == predict(Sheet(), SineWave(), -0.1, rtol=0.1).mean
    status, out, _ = run(
        capsys,
        "--alpha",
        alpha,
        "--sine",
        "-1e0",
        "2e-1",
        "--cosine",
        "-3e-1",
        "--method",
        "strip",
        "--json",
    )
    wave = TravellingWave([-0.3, 0.0], [-1.0, 0.2])
    assert json.loads(out)["mean"] == predict(Sheet(), wave, -0.1, method="strip").mean


def test_a_negative_infinity_is_refused_as_a_number(capsys):
    status, _, err = run(capsys, "--alpha", "-inf")
    assert (status, err) == (BAD_ARGUMENTS, "sheetcrawl: alpha contains -inf: must be finite\n")


def test_a_speed_beyond_reach_says_so(capsys):
    arguments = ("--alpha", "12", "--method", "second order")
    status, out, err = run(capsys, *arguments)
    assert status == MISSED
    assert "beyond the reach of the theory: growth |alpha c| reaches 12" in out
    assert err.startswith("sheetcrawl: warning: alpha = 12 is beyond the reach")
    assert err.count("\n") == 1
    status, out, _ = run(capsys, *arguments, "--json")
    assert status == MISSED
    assert not json.loads(out)["converged"]
    assert "beyond the reach" in json.loads(out)["reach"]


COMMAND = [sys.executable, "-m", "fem_check", "--alpha"]


def test_a_closed_pipe_is_no_traceback():
    """The reader has gone before there is an answer."""
    program = subprocess.Popen([*COMMAND, "0"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    program.stdout.close()
    assert program.stderr.read() == b""
    assert program.wait() == CLOSED_PIPE
    program.stderr.close()


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is always full")
def test_an_answer_that_cannot_be_written_is_one_line():
    with open("/dev/full", "w") as full:
        done = subprocess.run([*COMMAND, "0"], stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == MISSED
    assert done.stderr.startswith("sheetcrawl: cannot write the answer")
    assert done.stderr.count("\n") == 1


def test_ctrl_c_is_one_line(monkeypatch, capsys):
    def interrupted(*arguments, **options):
        raise KeyboardInterrupt

    monkeypatch.setattr("fem_check.command.predict", interrupted)
    status, out, err = run(capsys, "--alpha", "0.1")
    assert (status, out, err) == (INTERRUPTED, "", "sheetcrawl: interrupted\n")


def test_a_signal_ends_the_program_with_one_line():
    """The signal is sent as soon as the level that takes minutes has begun."""
    code = (
        "import sys, fem_check.command as c; answer = c.answer\n"
        "def told(options): print('begun', file=sys.stderr, flush=True); return answer(options)\n"
        "c.answer = told; c.main(['--alpha', '0.3', '--rtol', '1e-9'])"
    )
    program = subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    assert program.stderr.readline() == "begun\n"
    time.sleep(0.5)
    program.send_signal(signal.SIGINT)
    out, err = program.communicate(timeout=60)
    assert (program.returncode, out, err) == (INTERRUPTED, "", "sheetcrawl: interrupted\n")


def test_runs_as_a_program():
    done = subprocess.run(
        [sys.executable, "-m", "fem_check", "--alpha", "0", "--json"], capture_output=True, text=True
    )
    assert done.returncode == MET, done.stderr
    assert json.loads(done.stdout)["mean"] == 0
