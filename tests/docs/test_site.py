"""The site: its links lead somewhere, nothing is left out, its examples print what it says."""

import contextlib
import io
import re
from pathlib import Path
from types import ModuleType

import pytest

import fem_check
import linear_theory
from docs.site import api, links, markup, pictures
from docs.site.build import build
from docs.site.contents import ROOT, Page, pages, scripts
from docs.site.examples import parts
from docs.site.groups import GROUPS
from fem_check.output.look import CM_PER_INCH, COLUMN_CM

ONE = "against_the_paper"
"""The example that is run here; `tests/docs/test_examples.py` runs them all."""

WRITTEN = [page for page in pages() if page.source.suffix == ".md"]
GUIDES = [page for page in WRITTEN if page.target.startswith(("howto/", "tutorial"))]


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built with one example."""
    folder = tmp_path_factory.mktemp("site")
    with contextlib.redirect_stderr(io.StringIO()):
        build(folder, only=(ONE,))
    return folder


def test_every_link_leads_somewhere_and_nothing_is_fetched_from_outside(site: Path) -> None:
    left_out = {f"{name}.html" for name in scripts().keys() - {ONE}}
    faults = [fault for fault in links.broken(site) if fault.split("/")[-1] not in left_out]
    assert not faults
    assert len(list(site.rglob("*.html"))) > 25
    assert "http" not in (site / "style.css").read_text()


def test_every_page_has_the_navigation(site: Path) -> None:
    for path in site.rglob("*.html"):
        text = path.read_text()
        depth = len(path.relative_to(site).parents) - 1
        home = "../" * depth + "index.html"
        assert f'href="{home}"' in text, path
        assert "width=device-width" in text, path


def test_an_example_has_its_question_code_output_and_picture(site: Path) -> None:
    text = (site / "examples" / f"{ONE}.html").read_text()
    question, _, cells = parts(scripts()[ONE].read_text())
    assert f"<h1>{question}</h1>" in text
    plain = re.sub("<[^>]+>", "", text)
    assert cells
    assert all(title.replace("`", "") in plain for title, _ in cells)
    assert "line, alpha = 0.2: V = 0.038982 L/T exactly" in text
    assert f'src="{ONE}.png"' in text
    assert (site / "examples" / f"{ONE}.png").stat().st_size > 10_000


def test_names_of_the_code_lead_to_the_reference(site: Path) -> None:
    text = (site / "equations.html").read_text()
    assert 'href="api/fem_check.html#Membrane"' in text
    assert 'href="api/linear_theory/sheet/hooke.html#strain"' in text
    assert markup.found("linear_theory.nothing", api.modules()) == ""


@pytest.mark.parametrize("package", [linear_theory, fem_check], ids=lambda package: package.__name__)
def test_the_reference_opens_with_all_public_names_by_group(package: ModuleType) -> None:
    listed = [name for names in GROUPS[package.__name__].values() for name in names]
    assert len(listed) == len(set(listed))
    assert set(listed) <= set(package.__all__)
    shown = [row for rows in api.overview(package.__name__).values() for row in rows]
    assert sorted(name for name, _ in shown) == sorted(package.__all__)
    assert all(len(what) > 3 for _, what in shown)


def test_the_reference_names_arrays_as_the_source_does(site: Path) -> None:
    for name in ("linear_theory", "fem_check"):
        text = re.sub(r"<[^>]+>", "", (site / "api" / f"{name}.html").read_text())
        signatures = re.sub(r"View Source.*?\n\n\n", "", text, flags=re.DOTALL)
        assert "numpy._typing" not in signatures
        assert "ArrayLike" in signatures or name == "fem_check"


def test_pictures_are_as_wide_as_in_print(site: Path) -> None:
    column = ROOT / "figures" / "gallery" / "reach.png"
    assert pictures.print_width(column) == pytest.approx(COLUMN_CM / CM_PER_INCH, rel=5e-3)
    assert pictures.print_width(ROOT / "README.md") == 0.0
    shown = re.search(r'reach\.png" width="(\d+)"', (site / "levels.html").read_text())
    assert shown
    assert int(shown[1]) == pytest.approx(COLUMN_CM / CM_PER_INCH * 96 * pictures.SCALE, rel=5e-3)
    assert re.search(r'crawl\.gif" alt', (site / "index.html").read_text())


def test_numbers_stay_on_one_line_and_long_names_break_at_their_parts() -> None:
    row = "| (4.0e-16) | 12 words | `tests/a/test_of_a_long_name.py` |"
    html = markup.html_of(f"| a | b | c |\n| --- | --- | --- |\n{row}", str, lambda name: "")
    assert '<td class="short">(4.0e-16)</td>' in html
    assert "<td>12 words</td>" in html
    assert "<code>tests/<wbr>a/<wbr>test_<wbr>of_<wbr>a_<wbr>long_<wbr>name.<wbr>py</code>" in html


def test_links_that_lead_nowhere_are_noticed(tmp_path: Path) -> None:
    (tmp_path / "a.html").write_text(
        '<a href="b.html">1</a><a href="#there">2</a><h1 id="here"></h1><a href="#here">3</a>'
        '<img src="https://example.org/x.png"><a href="https://example.org">4</a>'
    )
    faults = ["a.html: b.html", "a.html: #there", "a.html: https://example.org/x.png"]
    assert links.broken(tmp_path) == faults


def test_a_link_of_a_page_must_be_in_the_site(tmp_path: Path) -> None:
    from docs.site.build import body

    path = tmp_path / "page.md"
    path.write_text("[a](nothing.md)")
    with pytest.raises(ValueError, match=r"link 'nothing\.md': must lead to a page or a picture"):
        body(Page("Start", "Page", path, "page.html"), tmp_path, [])


def test_every_markdown_file_is_a_page() -> None:
    found = {ROOT / "README.md", *(ROOT / "docs").rglob("*.md")}
    assert {page.source for page in WRITTEN} == found
    targets = [page.target for page in pages()]
    assert len(targets) == len(set(targets))


@pytest.mark.parametrize("page", GUIDES, ids=lambda page: page.source.stem)
def test_code_prints_what_the_page_says(
    page: Page, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(
        r"```python\n(.*?)```(?:\n\n```\n(.*?)```)?", page.source.read_text(), re.DOTALL
    )
    assert blocks
    names: dict[str, object] = {"__name__": "guide"}
    for code, expected in blocks:
        output = io.StringIO()
        with contextlib.redirect_stdout(output):
            exec(compile(code, str(page.source), "exec"), names)
        assert output.getvalue() == expected
