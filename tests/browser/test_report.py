"""report.html in a real browser: no error, the animation plays and turns, the number is right."""

import json
import os
import time

import pytest

from fem_check.files import read
from fem_check.runs import run
from fem_check.runs.report import shown_speed
from tests.browser.chromium import PROGRAM, Page
from tests.run_cases import PLANE, STEPPED

if not PROGRAM.exists():
    if os.environ.get("CI_BROWSER"):
        raise FileNotFoundError(f"{PROGRAM}: apt-get install chromium")
    pytest.skip(f"{PROGRAM} is not there: apt-get install chromium", allow_module_level=True)

DRIVE = """(async () => {
  const result = {};
  const clock = () => document.getElementById("clock").textContent;
  const frames = async (count) => {
    for (let k = 0; k < count; k++) await new Promise(requestAnimationFrame);
  };
  const picture = () => document.getElementById("view").toDataURL();
  const moved = (change) => { const before = picture(); change(); return picture() !== before; };
  const slide = (id, value) => {
    const input = document.getElementById(id);
    input.value = value;
    input.dispatchEvent(new Event("input"));
  };
  document.getElementById("play").click();
  result.paused = clock();
  result.turned = moved(() => document.getElementById("view").dispatchEvent(
    new KeyboardEvent("keydown", { key: "ArrowLeft", cancelable: true })));
  result.raised = moved(() => slide("factor", 9));
  result.timed = moved(() => slide("time", 777));
  result.stopped = clock();
  await frames(10);
  result.later = clock();
  document.getElementById("play").click();
  await frames(30);
  result.again = clock();
  return result;
})()"""


@pytest.fixture(scope="module", params=["plane", "stepped"])
def made(request, tmp_path_factory):
    """A finished run."""
    folder = tmp_path_factory.mktemp(request.param)
    path = folder / "scene.toml"
    path.write_text(PLANE if request.param == "plane" else STEPPED)
    file = read(path)
    return run(file.scene, folder / "run", file.run, file.units)


@pytest.fixture(scope="module")
def page():
    """A browser."""
    with Page() as started:
        yield started


def report(made):
    return made.folder / "report.html"


def test_the_console_is_listened_to(page, tmp_path):
    bad = tmp_path / "bad.html"
    bad.write_text("<script>nothing.there()</script>")
    page.open(bad)
    assert any("ReferenceError" in str(event) for event in page.complaints)


def test_no_error_no_request_and_the_number_is_that_of_the_result(made, page):
    page.open(report(made))
    assert page.complaints == []
    assert {address.split(":")[0] for address in page.requests} <= {"file", "data"}
    assert sum(address.startswith("file") for address in page.requests) == 1
    result = json.loads((made.folder / "result.json").read_text())
    answer = result["answer"]
    assert page.evaluate('Number(document.getElementById("mean").dataset.value)') == answer["mean"]
    shown = page.evaluate('document.getElementById("mean").textContent')
    assert shown == shown_speed(made)
    number = shown.split(" ± ")[0]
    error = answer["numerical_error"] if answer["error"] is None else answer["error"]
    assert float(number.replace("−", "-").lstrip("(")) == pytest.approx(answer["mean"], abs=error)
    assert f" {number} ±" in result["block"]


def test_the_animation_plays(made, page):
    page.open(report(made))
    before = page.picture()
    time.sleep(0.5)
    after = page.picture()
    assert (abs(before - after).max(-1) > 30).sum() > 1000  # pixels
    assert page.complaints == []


def test_it_can_be_paused_turned_and_moved_in_time(made, page):
    page.open(report(made))
    found = page.evaluate(DRIVE)
    assert found["turned"]
    assert found["timed"]
    assert found["raised"] == (made.recording.components == 3)
    assert found["stopped"] != found["paused"]
    assert found["later"] == found["stopped"]
    assert found["again"] != found["later"]
    assert page.complaints == []


@pytest.mark.parametrize("width", [390, 1280])
def test_no_part_is_wider_than_the_page(width, made, page):
    page.open(report(made), width=width, height=844)
    root = "document.documentElement"
    assert page.evaluate(f"{root}.clientWidth") == width
    assert page.evaluate(f"{root}.scrollWidth") == width
