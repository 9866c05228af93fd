"""report.html in a real browser: no error, the animation plays and turns, the number is right."""

import json
import time

import numpy as np
import pytest
from PIL import Image

from fem_check.files import read
from fem_check.runs import run
from fem_check.runs.report import shown_speed
from tests.browser.webdriver import browser
from tests.runs.run_cases import PLANE, STEPPED

DRIVE = """return (async () => {
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
    with browser() as started:
        yield started


def shown(page, path, width=1280, height=900):
    """The page shows a file, and its console is empty."""
    page.size(width, height)
    page.complaints()
    page.requests()
    page.open(path.as_uri())


def seen(page, tmp_path):
    """What is seen, (height, width, 3)."""
    page.picture(tmp_path / "seen.png")
    return np.asarray(Image.open(tmp_path / "seen.png").convert("RGB")).astype(int)


def report(made):
    return made.folder / "report.html"


def test_the_console_is_listened_to(page, tmp_path):
    bad = tmp_path / "bad.html"
    bad.write_text("<script>nothing.there()</script>")
    shown(page, bad)
    assert any("ReferenceError" in line for line in page.complaints())


def test_no_error_no_request_and_the_number_is_that_of_the_result(made, page):
    shown(page, report(made))
    assert page.complaints() == []
    asked = page.requests()
    assert {address.split(":")[0] for address in asked} <= {"file", "data"}
    assert sum(address.startswith("file") for address in asked) == 1
    result = json.loads((made.folder / "result.json").read_text())
    answer = result["answer"]
    assert page.run('return Number(document.getElementById("mean").dataset.value)') == answer["mean"]
    told = page.run('return document.getElementById("mean").textContent')
    assert told == shown_speed(made)
    number = told.split(" ± ")[0]
    error = answer["numerical_error"] if answer["error"] is None else answer["error"]
    assert float(number.replace("−", "-").lstrip("(")) == pytest.approx(answer["mean"], abs=error)
    assert f" {number} ±" in result["block"]


def test_the_animation_plays(made, page, tmp_path):
    shown(page, report(made))
    before = seen(page, tmp_path)
    time.sleep(0.5)
    after = seen(page, tmp_path)
    assert (abs(before - after).max(-1) > 30).sum() > 1000  # pixels
    assert page.complaints() == []


def test_it_can_be_paused_turned_and_moved_in_time(made, page):
    shown(page, report(made))
    found = page.run(DRIVE)
    assert found["turned"]
    assert found["timed"]
    assert found["raised"] == (made.recording.components == 3)
    assert found["stopped"] != found["paused"]
    assert found["later"] == found["stopped"]
    assert found["again"] != found["later"]
    assert page.complaints() == []


@pytest.mark.parametrize("width", [390, 1280])
def test_no_part_is_wider_than_the_page(width, made, page):
    shown(page, report(made), width, 844)
    root = "return document.documentElement"
    assert page.run(f"{root}.scrollWidth") <= page.run(f"{root}.clientWidth") <= width
