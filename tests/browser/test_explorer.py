"""`sheetcrawl explore` in a real browser: sliders move, the numbers are those of Python."""

import os
import signal
import subprocess
import sys
import time
import urllib.parse
import warnings

import pytest

from fem_check import predict
from fem_check.answer.block import LEVEL_WORDS
from linear_theory import Sheet, SineWave, crawl_speed, pulse_wave
from tests.browser.webdriver import browser, until
from tests.runs.processes import interruptible

MARGIN = 1.0
"""Seconds from a move to the picture that are allowed on a busy machine; usual are 0.1."""

DEEP = """
function deep(root, selector, found) {
  found.push(...root.querySelectorAll(selector));
  root.querySelectorAll('*').forEach(e => { if (e.shadowRoot) deep(e.shadowRoot, selector, found) });
  return found }
function slider(name) {
  const title = deep(document, '.bk-slider-title', []).find(e => e.textContent.startsWith(name));
  return title.getRootNode().querySelector('.noUi-handle') }
function press(name, key) {
  const handle = slider(name); handle.focus();
  for (const kind of ['keydown', 'keyup'])
    handle.dispatchEvent(new KeyboardEvent(kind, {key, bubbles: true, cancelable: true})) }
function row(level) { return deep(document, `tr[data-level="${level}"][data-mean]`, [])[0] }
"""

TIMED = """
const [name, key] = arguments, start = performance.now(); window.drawn = window.told = 0;
const before = row('first order').dataset.mean;
const source = Bokeh.documents[0].get_model_by_name('cells');
const seen = () => { source.change.disconnect(seen); requestAnimationFrame(() => setTimeout(() => {
  window.drawn = performance.now() - start })) };
source.change.connect(seen);
(function watch() { const now = row('first order');
  if (now && now.dataset.mean !== before) window.told = performance.now() - start;
  else requestAnimationFrame(watch) })();
press(name, key)
"""


@pytest.fixture(scope="module")
def address():
    command = [sys.executable, "-m", "fem_check", "explore", "--no-browser"]
    server = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, preexec_fn=interruptible
    )
    try:
        yield server.stdout.readline().split()[0]
    finally:
        server.send_signal(signal.SIGINT)
        _, complaints = server.communicate(timeout=20)
    assert server.returncode == 0
    assert complaints == ""


@pytest.fixture(scope="module")
def window(address):
    with browser() as window:
        window.size(1280, 900)
        window.open(address)
        yield window


@pytest.fixture
def page(window, address):
    """The page as it is first seen, with all its answers."""
    window.open(address)
    until(lambda: mean(window, "nonlinear"), 30)
    until(lambda: mean(window, "first order"), 30)
    return window


def mean(window, level):
    """V of a row of the table, to the last digit; None while there is none."""
    found = window.run(f"{DEEP} const found = row('{level}'); return found && found.dataset.mean")
    return found and float(found)


def words(window, selector):
    return window.run(f"{DEEP} return deep(document, '{selector}', []).map(e => e.textContent).join()")


def press(window, name, key="ArrowRight"):
    window.run(f"{DEEP} press(arguments[0], arguments[1])", name, key)


def choose(window, name, value):
    script = """
    const label = deep(document, 'label', []).find(e => e.textContent.startsWith(arguments[0]));
    const list = label.getRootNode().querySelector('select');
    list.value = arguments[1]; list.dispatchEvent(new Event('change'))"""
    window.run(DEEP + script, name, value)


def test_loads_without_error_and_without_network(page):
    assert not [said for said in page.complaints() if "WebGL" not in said]
    asked = [urllib.parse.urlsplit(url) for url in page.requests()]
    ours = [url for url in asked if url.scheme in ("http", "https", "ws", "wss")]
    assert len(ours) > 10
    assert {url.hostname for url in ours} == {"127.0.0.1"}


def test_numbers_are_those_of_python(page):
    sheet, wave = Sheet(), SineWave()
    assert mean(page, "strip") == predict(sheet, wave, 0.11, rtol=0.05, level="strip").mean
    assert mean(page, "first order") == crawl_speed(sheet, wave, 0.11, rtol=0.02).mean
    assert mean(page, "nonlinear") == predict(sheet, wave, 0.11, rtol=0.05).mean
    assert "alpha=0.11, rtol=0.05" in words(page, "pre")
    assert "--alpha 0.11 --rtol 0.05" in words(page, "pre")


def test_a_slider_moves_and_the_numbers_follow(page):
    press(page, "width")
    expected = predict(Sheet(width=0.55), SineWave(), 0.11, rtol=0.05)
    until(lambda: mean(page, "nonlinear") == expected.mean)
    assert f"by {LEVEL_WORDS[expected.level]}" in words(page, "tr")
    small = crawl_speed(Sheet(width=0.55), SineWave(), 0.11, rtol=0.02).mean
    until(lambda: mean(page, "first order") == small)
    assert "width=0.55" in words(page, "pre")


def test_friction_load_and_pulse_are_asked(page):
    page.run(f"{DEEP} deep(document, 'button', []).find(e => e.textContent === 'pulse').click()")
    choose(page, "friction", "tanh")
    choose(page, "load", "grown")
    asked = {"load": "grown", "friction": "tanh", "slip_speed": 0.01, "rtol": 0.02}
    expected = crawl_speed(Sheet(), pulse_wave(0.3), 0.11, **asked).mean
    assert until(lambda: mean(page, "first order") == expected)


def test_growth_beyond_reach_is_a_sentence(page):
    press(page, "growth coupling", "End")
    with warnings.catch_warnings(action="ignore"), pytest.raises(ValueError, match="area element"):
        crawl_speed(Sheet(), SineWave(), 0.8, rtol=0.02)
    until(lambda: "the area element 1 + alpha tr(strain) would be" in words(page, ".messages"))
    assert "Traceback" not in words(page, "body")


def test_the_newest_of_many_moves_is_answered(page):
    for _ in range(15):
        press(page, "growth coupling")
    expected = predict(Sheet(), SineWave(), 0.26, rtol=0.05).mean
    until(lambda: mean(page, "nonlinear") == expected)
    assert "alpha=0.26" in words(page, "pre")


@pytest.mark.parametrize("name", ["growth coupling", "Poisson", "length"])
def test_a_move_is_drawn_at_once(page, name):
    times = []
    for _ in range(3):
        time.sleep(1)  # the curve of the question before is drawn
        page.run(DEEP + TIMED, name, "ArrowLeft")
        drawn = until(lambda: page.run("return window.drawn"))
        told = until(lambda: page.run("return window.told"))
        times.append((drawn, told))
    shown = "; ".join(f"picture {drawn:.0f} ms, numbers {told:.0f} ms" for drawn, told in times)
    print(f"{name}: {shown}")
    if os.getloadavg()[0] > 2 * (os.cpu_count() or 1):
        pytest.skip(f"the machine is busy with other work, which these times measure: {shown}")
    assert min(drawn for drawn, _ in times) < 1e3 * MARGIN


@pytest.mark.parametrize(("width", "height"), [(390, 844), (1280, 900)])
def test_fits_the_window(page, width, height):
    page.size(width, height)
    assert until(lambda: page.run("return document.documentElement.scrollWidth") <= width)
    page.size(1280, 900)
