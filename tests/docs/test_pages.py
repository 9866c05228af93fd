"""The pages of docs/ name what is there: equations, functions, tests, figures, numbers of tables."""

import ast
import importlib
import re
from functools import cache
from pathlib import Path

import pytest

import fem_check
import linear_theory
from figures.draw import regimes
from figures.measure import reach as reach_table
from figures.measure import regimes as regimes_table

ROOT = Path(__file__).parents[2]
EQUATIONS = ROOT / "docs" / "equations.md"
CONVENTIONS = ROOT / "docs" / "conventions.md"

PAPER = {
    *("1a", "1b", "2", "3", "4", "5", "6", "7", "8", "9", "10a", "10b", "11", "12a", "12b"),
    *("13", "14", "15", "16"),
}
"""Numbers of its equations."""

AMPLITUDES = {"a_r, b_s", "A_m, C_r", "B_m, D_s"}
"""Of appendix A.1, without numbers."""

UNSOLVED = {"12b"}
"""Equations for which there is nothing here."""


def rows():
    """Cells of the table of equations, without its head."""
    lines = [line for line in EQUATIONS.read_text().splitlines() if line.startswith("| ")]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def quoted(text):
    return re.findall(r"`([^`]+)`", text)


def found(name):
    """The value of a dotted name of our packages."""
    parts = name.split(".")
    for length in range(len(parts), 0, -1):
        try:
            value = importlib.import_module(".".join(parts[:length]))
        except ModuleNotFoundError:
            continue
        for part in parts[length:]:
            value = getattr(value, part)
        return value
    raise AttributeError(name)


@cache
def functions_of(path):
    return {node.name for node in ast.parse(path.read_text()).body if isinstance(node, ast.FunctionDef)}


def check_path(text):
    """A file of the project, with the test in it where one is named."""
    path, _, test = text.partition("::")
    assert (ROOT / path).is_file(), text
    assert not test or test in functions_of(ROOT / path), text


def test_every_equation_of_the_paper_has_one_row():
    names = [row[0] for row in rows()]
    assert len(names) == len(set(names))
    assert set(names) >= PAPER | AMPLITUDES
    assert all(len(row) == 5 for row in rows())


@pytest.mark.parametrize("row", rows(), ids=lambda row: row[0])
def test_row_names_code_and_tests_that_exist(row):
    equation, _, code, tests, figure = row
    assert equation in UNSOLVED or (quoted(code) and quoted(tests))
    for name in quoted(code):
        assert callable(found(name)) or isinstance(found(name), property)
    for test in (*quoted(tests), *quoted(figure)):
        check_path(test)


@pytest.mark.parametrize("page", [EQUATIONS, CONVENTIONS])
def test_links_and_paths_lead_somewhere(page):
    text = page.read_text()
    links = re.findall(r"\]\(([^)]+)\)", text)
    assert links
    for link in links:
        assert (page.parent / link).is_file(), link
    for name in quoted(text):
        if re.match(r"(tests|figures)/", name):
            check_path(name)
        if re.match(r"(linear_theory|fem_check)\.", name):
            assert found(name) is not None


def test_names_that_are_not_there_are_noticed():
    with pytest.raises(AttributeError):
        found("linear_theory.line_sped")
    with pytest.raises(AssertionError):
        check_path("tests/line/test_line.py::test_nothing")


def test_symbols_are_names_of_the_code():
    table = CONVENTIONS.read_text().split("| paper | code | meaning |")[1].split("\n\n")[0]
    named = quoted(table)
    fields = {
        name
        for kind in (linear_theory.Sheet, linear_theory.SineWave, fem_check.Scene, fem_check.Friction)
        for name in kind.__dataclass_fields__
    } | {*linear_theory.Growth.__dataclass_fields__, *linear_theory.Tanh.__dataclass_fields__}
    kinds = {name: getattr(fem_check, name) for name in fem_check.__all__}
    kinds |= {"RestState": found("fem_check.shell.kinematics.rest_state.RestState")}
    assert len(named) == 18
    for name in named:
        kind, _, field = name.rpartition(".")
        assert field in (kinds[kind].__dataclass_fields__ if kind else fields), name


def test_numbers_of_the_conventions_are_those_of_the_tables():
    text = " ".join(CONVENTIONS.read_text().split())
    (reach,) = (r for r in reach_table.REACHES.read() if (r.width, r.poisson) == (0.5, 0.5))
    assert f"with growth exp(alpha c) 1.75, {reach.second:.2f} and 0.75" in text
    _, viscous = regimes.boundaries(regimes_table.TABLE.read())
    assert f"for periods above {viscous:.2f} alpha L/v0" in text
    near = linear_theory.crawl_speed(linear_theory.Sheet(), linear_theory.SineWave(), 1e-3, rtol=1e-3)
    near = near.mean / 1e-6
    assert f"the paper's sheet {near:.2f}, a 1D body 1" in text
    assert f"{near / reach.second - 1:.0%} too fast".replace("%", " %") in text
