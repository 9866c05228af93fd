"""The explorer without a browser: numbers and pictures of slider values, the newest question wins."""

import contextlib
import importlib
import io
import math
import queue
import re
import shlex
import socket
import threading
import time

import numpy as np
import pytest

from fem_check import predict
from fem_check.command import MISSED, main, screens
from fem_check.explorer import drawing, server, small_strain, text
from fem_check.explorer.latest import Latest
from fem_check.explorer.nonlinear import Nonlinear, Predicted, predicted
from fem_check.explorer.question import SMALL_STRAIN_RTOL, Question
from linear_theory import SineWave, airy_series, crawl_speed, friction_field, pulse_wave
from linear_theory.common.estimate import Estimate
from linear_theory.common.progress import Progress, track

QUESTIONS = {
    "sine": Question(alpha=0.2, rtol=0.2),
    "pulse": Question(pulse=0.7, width=0.3, poisson=0.3, alpha=0.1, load="grown", friction="viscous"),
    "tanh": Question(length=2.0, count=2, alpha=-0.15, friction="tanh", slip_speed=0.02, rtol=0.1),
}


@pytest.fixture(params=QUESTIONS)
def question(request):
    return QUESTIONS[request.param]


def test_lines_of_python_print_the_same(question):
    printed = io.StringIO()
    assert question.python.count("\n") == 4
    with contextlib.redirect_stdout(printed):
        exec(question.python, {})
    small = small_strain.first_order(question)
    assert printed.getvalue().splitlines()[0] == str(Estimate(small.mean, small.error))
    found = predict(question.scene, rtol=question.rtol)
    untimed = re.compile(r"took .*")
    assert untimed.sub("", str(found)) in untimed.sub("", printed.getvalue())


def test_the_command_asks_the_same(question, capsys):
    with pytest.raises(SystemExit) as end:
        main([*shlex.split(question.command)[1:], "--csv"])
    last = capsys.readouterr().out.split()[-1].split(",")[1]
    assert end.value.code in (0, MISSED)
    assert float(last) == predict(question.scene, rtol=question.rtol).speed.velocity[-1]


def test_small_strain_is_that_of_crawl_speed(question):
    found = crawl_speed(question.scene, rtol=SMALL_STRAIN_RTOL)
    shown = small_strain.first_order(question)
    assert (shown.mean, shown.error) == (found.mean, found.error)
    narrow = predict(question.scene, rtol=question.rtol, level="strip").speed
    assert small_strain.strip(question).mean == narrow.mean
    assert small_strain.strip(question).error == narrow.error


def test_parts_come_in_order_and_the_curve_is_that_of_crawl_speed():
    asked = Question(alpha=-0.1)
    parts = list(small_strain.answers(asked, phase=0.3))
    kinds = [(type(part).__name__, getattr(part, "level", "")) for part in parts]
    assert kinds[:4] == [
        ("Picture", ""),
        ("Answer", "strip"),
        ("Curve", "strip"),
        ("Answer", "first order"),
    ]
    assert set(kinds[4:]) == {("Curve", "first order")}
    curve = parts[-1]
    assert curve.alphas[-1] == 0.0
    assert min(curve.alphas) < -0.3
    for alpha, mean in zip(curve.alphas, curve.means, strict=True):
        assert mean == crawl_speed(asked.but(alpha).scene, rtol=SMALL_STRAIN_RTOL).mean


def test_the_picture_is_that_of_the_field():
    asked = Question(alpha=0.2, pulse=0.3, width=0.4)
    sheet, t = asked.scene.sheet, 0.3
    found = small_strain.picture(asked, t)
    field = airy_series(sheet, pulse_wave(0.3), rtol=1e-3)
    corner = [-sheet.width / 2, -sheet.length / 2]
    moved = corner + 0.2 * field.displacement(*corner, t)
    np.testing.assert_allclose(found.corners[0, :, 0], moved, atol=1e-12)
    assert 0 < found.growth.max() <= 1
    across, along = small_strain.ARROWS
    centre = across * along // 2
    force = friction_field(field, 0.2, 0.0, 0.0, t, rtol=1e-2).force
    np.testing.assert_allclose(found.force[:, centre], force, atol=1e-12)
    assert np.hypot(*found.force).max() < 2


def test_the_picture_without_friction_beyond_reach():
    asked = Question(alpha=0.8)
    assert small_strain.picture(asked, 0.0).force.size == 0
    answer = small_strain.first_order(asked)
    assert math.isnan(answer.mean)
    assert "area element" in answer.problem
    assert "area element" in text.messages({"first order": answer})
    assert "no answer" in text.table({"first order": answer})


def test_questions_out_of_range_are_sentences():
    asked = Question(pulse=1.5)
    with pytest.raises(ValueError, match=r"width = 1.5: must be in") as problem:
        list(small_strain.answers(asked, 0.0))
    assert "width = 1.5: must be in [0.02, 1), in wavelengths." in text.refused(problem.value)
    assert predicted(asked).problem.startswith("width = 1.5: must be in")


def test_the_table_shows_value_error_and_cost():
    answer = small_strain.Answer("first order", 0.1, 0.02257, 0.0003, 0.0002, 0.027)
    shown = text.table({"first order": answer, "nonlinear": Progress("cycle", 0.25, 3.0, 9.0)})
    assert "<b>0.0226 ± 0.0006</b>" in shown  # 0.0005, and what rounding adds
    assert "27 ms" in shown
    assert "cycle, 25%; 3 s so far" in shown
    assert "data-mean='0.02257'" in shown
    unknown = answer._replace(model_error=math.nan)
    assert "<b>0.0226</b>" in text.table({"first order": unknown})
    assert "unknown" in text.table({"first order": unknown})
    assert "0.0226 ± 0.0006" in text.headline({"first order": answer})
    best = Predicted(0.0185, 1e-4, 0.0, "cycle", True, 0.3)
    assert "0.0185" in text.headline({"first order": answer, "nonlinear": best})
    assert "the tolerance is not met" in text.headline({"nonlinear": best._replace(converged=False)})
    none = Predicted(problem="the sheet wrinkles")
    assert "No answer" in text.headline({"first order": answer, "nonlinear": none})


def test_lines_go_through_their_points():
    curve = small_strain.Curve("first order", [0.0, 0.1, 0.4], [0.0, 0.01, 0.2], [0.0, 1e-3, math.nan])
    data = drawing.curve_data(curve)
    line, points = data["first order line"], data["first order"]
    np.testing.assert_allclose(np.interp(0.1, line["alpha"], line["mean"]), 0.01, atol=1e-3)
    np.testing.assert_allclose(points["upper"] - points["mean"], [0, 1e-3, 0], atol=1e-15)
    assert set(data) <= set(drawing.EMPTY)


def test_a_newer_question_ends_the_older_one():
    started, seen = threading.Event(), queue.Queue()

    def solve(n):
        for _ in track("rounds", range(10_000 if n == 1 else 2)):
            started.set()
            time.sleep(0.01)
        yield n
        raise ValueError("no more")

    latest = Latest(solve, lambda n, part: seen.put((n, part)))
    latest.ask(1)
    assert started.wait(10)
    latest.ask(2)
    assert seen.get(timeout=10) == (2, 2)
    asked, problem = seen.get(timeout=10)
    assert (asked, str(problem)) == (2, "no more")
    assert seen.empty()
    latest.close()


def test_the_second_process_answers_the_newest_and_comes_back():
    answers = queue.Queue()
    nonlinear = Nonlinear(lambda question, part: answers.put((question, part)))
    slow, quick = Question(pulse=0.1, rtol=0.01), Question(alpha=0.2, rtol=0.2)
    try:
        nonlinear.ask(slow)
        time.sleep(0.5)
        nonlinear.ask(quick)
        expected = predict(quick.scene, rtol=0.2)
        assert _answer(answers, quick).mean == expected.mean
        nonlinear._process.kill()
        assert "has died" in _answer(answers, quick).problem
        nonlinear.ask(quick)
        assert _answer(answers, quick).total == expected.error
    finally:
        nonlinear.close()
    assert not nonlinear._process.is_alive()


def _answer(answers, question):
    while True:
        asked, part = answers.get(timeout=60)
        if asked == question and isinstance(part, Predicted):
            return part


def run(capsys, *arguments):
    with pytest.raises(SystemExit) as end:
        main(arguments)
    return end.value.code, capsys.readouterr()


def test_a_missing_framework_is_one_line(capsys, monkeypatch):
    real = importlib.import_module

    def without(name, *more):
        if name == "panel":
            raise ModuleNotFoundError("No module named 'panel'", name="panel")
        return real(name, *more)

    monkeypatch.setattr(importlib, "import_module", without)
    status, printed = run(capsys, "explore", "--no-browser")
    assert status == MISSED
    assert printed.err.count("\n") == 1
    assert "pip install 'sheetcrawl[explorer]'" in printed.err


def test_a_port_in_use_is_one_line(capsys):
    with socket.socket() as other:
        other.bind((server.HOST, 0))
        other.listen()
        port = other.getsockname()[1]
        status, printed = run(capsys, "explore", "--no-browser", "--port", str(port))
    assert status == MISSED
    assert printed.err.startswith(f"sheetcrawl: port {port}: ")
    assert printed.err.count("\n") == 1
    assert printed.out == ""


@pytest.mark.parametrize("port", ["0", "70000"])
def test_a_bad_port_is_named(capsys, port):
    status, printed = run(capsys, "explore", "--port", port)
    assert status == 2
    assert printed.err == f"sheetcrawl: --port {port}: must be from 1 to 65535\n"


def test_the_example_of_the_help_serves_the_page(capsys, monkeypatch):
    """Up to the moment when the address is printed; the browser's test goes on from there."""
    asked = []
    monkeypatch.setattr(server, "serve", lambda port, browser: asked.append((port, browser)))
    status, _ = run(capsys, *shlex.split(screens.EXPLORE)[1:])
    assert (status, asked) == (0, [(8800, False)])
    assert screens.EXPLORE in screens.EXPLORE_HELP


def test_figures_take_the_data():
    pytest.importorskip("bokeh")
    figures = drawing.figures()
    for name, data in drawing.sheet_data(small_strain.picture(Question(), 0.0)).items():
        figures.sources[name].data = data
    curve = small_strain.Curve("nonlinear").with_point(0.1, 0.02, 1e-4)
    for name, data in drawing.curve_data(curve).items():
        figures.sources[name].data = data
    assert SineWave().value(0.0, 0.25, 0.0) == pytest.approx(
        figures.sources["cells"].data["c"].max(), 0.01
    )
