"""Numbers in the text of the how-to pages are those of closed forms, tables and constants."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq

from fem_check.excitable.presets import PRESETS
from fem_check.shell.effects.contact.self_contact import GAP
from figures.draw.directional import select
from figures.measure import directional, directional_cost, excitable, saddle, schemes
from linear_theory.friction.regime import DRY_RATIO

HOWTO = Path(__file__).parents[2] / "docs" / "howto"


def text_of(name: str) -> str:
    return " ".join((HOWTO / f"{name}.md").read_text(encoding="utf-8").split())


def wave_on_line(alpha: float, r: float) -> float:
    """V of a sine over alpha L/T, by theta - alpha cos theta = (pi/2) r."""
    theta = brentq(lambda a: a - alpha * math.cos(a) - math.pi / 2 * r, -2, 2)
    return math.sin(float(theta))


def test_wave_and_breath_under_friction_with_a_direction() -> None:
    text, alpha = text_of("friction_direction"), 0.1
    assert f"{wave_on_line(alpha, 0.5) / wave_on_line(alpha, 0.0):.1f} times the speed without" in text
    on_line = brentq(lambda r: wave_on_line(alpha, r) - 2 * r, 0.0, 1.0)
    rows = directional.TABLE.read()
    r, wave = select(rows, "theory", "wave")
    ahead = np.array(select(rows, "theory", "breathing")[1]) - np.array(wave)
    last = int(np.flatnonzero(ahead <= 0)[-1])
    on_sheet = r[last] + (r[last + 1] - r[last]) * ahead[last] / (ahead[last] - ahead[last + 1])
    assert f"up to r = {on_line:.2f} on a line and {on_sheet:.2f} on the 2:1 sheet" in text
    ratios = [2 * r / wave_on_line(alpha, r) for r in np.linspace(0.2, 1.0, 50)]
    assert max(ratios) == pytest.approx(2, abs=0.05)  # "by a factor of up to two"


def test_the_cost_of_a_direction_is_that_of_the_table() -> None:
    rows = directional_cost.TABLE.read()
    page = (HOWTO / "friction_direction.md").read_text(encoding="utf-8")
    assert "\n".join(directional_cost.page(rows)) in page
    assert {r.question for r in rows} == set(directional_cost.QUESTIONS)


def test_numbers_of_bending_sheets() -> None:
    text, paper = text_of("bending"), saddle.PLACES["paper"]
    assert paper.weight == 2.5e-4
    assert paper.stiffness == 0.5
    assert f"{math.sqrt(paper.weight / paper.stiffness):.3f} L with the numbers above" in text
    steps = {row.scheme: row.steps for row in schemes.TABLE.read() if row.sheet == "snapping"}
    assert f"takes {steps['Newmark']} steps instead of {steps['backward differences']}," in text
    assert GAP == 0.5
    assert "than one and a half thicknesses" in text


NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def test_presets_do_what_the_page_says() -> None:
    """Numbers of the page are in the words of each preset, which have tests; periods are measured."""
    page = (HOWTO / "own_wave.md").read_text(encoding="utf-8").replace("\N{MINUS SIGN}", "-")
    told = dict(re.findall(r"^\| `(.*?)` \| (.*?) \|$", page, re.MULTILINE))
    assert told.keys() == PRESETS.keys()
    for name, words in told.items():
        assert set(NUMBER.findall(words)) <= set(NUMBER.findall(PRESETS[name].words)), name
    periods = {row.preset: row.period for row in excitable.TABLE.read()}  # of the last cycle
    for name in ("printed", "nu = -0.1", "nu = -0.05"):
        assert f"period {periods[name]:.0f}" in told[name]


def test_friction_does_not_deform_the_sheet_of_silicone() -> None:
    strain = 0.4 * 1100.0 * 9.81 * 0.08 / 1e6  # mu rho g L/E
    assert f"1 MPa it is {strain:.4f}," in text_of("measurement")
    assert f"at a {round(1 / DRY_RATIO)}th of".replace("20th", "twentieth") in text_of("scene_file")
    assert round(1 / DRY_RATIO) == 20  # "twenty times as fast" in the message about slip_speed
