"""The examples of the README print what it says, and its numbers are those of the tables."""

import contextlib
import io
import re
import shlex
from pathlib import Path

import pytest

from fem_check.command import main
from fem_check.shell.statics.ellipticity import edge_limit
from figures.draw import regimes
from figures.measure import nonlinear
from figures.measure import reach as reach_table
from figures.measure import regimes as regimes_table
from linear_theory import Sheet, SineWave, __version__, crawl_speed

ROOT = Path(__file__).parents[2]
README, CONVENTIONS = ROOT / "README.md", ROOT / "docs" / "conventions.md"
COST = re.compile(r"took .*")
"""Of the block, which depends on the machine."""


def test_the_block_is_what_the_command_prints(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "100")
    command, shown = re.search(
        r"\$ sheetcrawl (.*?)\n\n```\n(.*?)```", README.read_text(), re.DOTALL
    ).groups()
    with pytest.raises(SystemExit) as end:
        main(shlex.split(command))
    assert end.value.code == 0
    assert COST.sub("", capsys.readouterr().out).strip() == COST.sub("", shown).strip()


def test_the_citation_is_that_of_the_metadata():
    text, cff = README.read_text(), (ROOT / "CITATION.cff").read_text()
    for found in (re.search(r"^version: (\S+)", cff, re.MULTILINE), re.search(r"doi: (\S+)", cff)):
        assert f"{{{found.group(1)}}}" in text


def test_the_version_is_that_of_the_latest_release():
    latest = re.search(r"^## \[(\d.*?)\] - (\S+)$", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    cff = (ROOT / "CITATION.cff").read_text()
    assert latest
    assert latest.group(1) == __version__
    assert f"\nversion: {__version__}\n" in cff
    assert f'\ndate-released: "{latest.group(2)}"\n' in cff


def test_examples_print_what_is_printed():
    blocks = re.findall(r"```python\n(.*?)```\n\n```\n(.*?)```", README.read_text(), re.DOTALL)
    assert len(blocks) == 2
    names = {}  # the second example goes on where the first ended
    for code, expected in blocks:
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            exec(compile(code, str(README), "exec"), names)
        assert output.getvalue() == expected


def test_gallery_is_there():
    pictures = re.findall(r"!\[.*?\]\((.*?)\)", README.read_text())
    assert pictures
    assert all((README.parent / picture).stat().st_size > 10_000 for picture in pictures)


def test_numbers_in_the_text_are_those_of_the_tables():
    text = " ".join(f"{README.read_text()} {CONVENTIONS.read_text()}".split())
    (reach,) = (r for r in reach_table.REACHES.read() if (r.width, r.poisson) == (0.5, 0.5))
    shares = [f"{alpha:.2f}" for alpha in (reach.second_order_1, reach.second_order_5)]
    assert f"up to alpha = {', '.join(shares)} and {reach.second_order_10:.2f}." in text
    assert f"with growth exp(alpha c) 1.75, {reach.second:.2f} and 0.75" in text
    assert f"compressed to {edge_limit(0.5):.2f} of its grown length" in text
    _, viscous = regimes.boundaries(regimes_table.TABLE.read())
    assert f"for periods above {viscous:.2f} alpha L/v0" in text
    sheet = {
        r.alpha: r.speed for r in nonlinear.TABLE.read() if (r.body, r.friction) == ("sheet", "coulomb")
    }
    far = crawl_speed(Sheet(), SineWave(), 0.25, rtol=1e-3).mean / sheet[0.25] - 1
    near = crawl_speed(Sheet(), SineWave(), 1e-3, rtol=1e-3).mean / 1e-6
    assert f"the paper's sheet {near:.2f}, a 1D body 1" in text
    assert f"{near / reach.second - 1:.0%} too fast".replace("%", " %") in text
    assert f"-> 0 and {far:.0%} at 0.25".replace("%", " %") in text
