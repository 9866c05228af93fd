"""An example as a page: its question, its cells, what it prints and what it draws."""

import ast
import contextlib
import io
import re
import runpy
from collections.abc import Sequence
from pathlib import Path

from docs.site.markup import code, html_of
from figures.common import style

CELL = re.compile(r"^# %% (.*)\n", re.MULTILINE)


def rendered(path: Path, pictures: Path) -> str:
    """The body of its page; runs the script and writes its picture into `pictures`, beside the page."""
    question, text, cells = parts(path.read_text())
    output, picture = run(path, pictures)
    shown = "".join(f"<p>{_plain(title)}</p>{code(source, 'python')}" for title, source in cells)
    return (
        f"<h1>{_inline(question)}</h1>{_plain(text)}{shown}"
        f'<h2 id="output">What it prints</h2>{code(output, "text")}'
        f'<h2 id="figure">What it draws</h2><img src="{picture.name}" alt="{_text(question)}">'
        f"<p>Run it with <code>python -m figures.examples.{path.stem}</code>.</p>"
    )


def overview(scripts: Sequence[Path]) -> str:
    """The body of the page of all examples: their questions and pictures."""
    cells = []
    for path in scripts:
        question, _, _ = parts(path.read_text())
        picture = f'<img src="{path.stem}.png" alt="">'
        cells.append(f'<a href="{path.stem}.html">{picture}{_inline(question)}</a>')
    return f'<h1>Examples</h1><div class="gallery">{"".join(cells)}</div>'


def parts(source: str) -> tuple[str, str, list[tuple[str, str]]]:
    """The question, the rest of the docstring, and the cells: title and code of each."""
    question, _, text = (ast.get_docstring(ast.parse(source)) or "").partition("\n")
    titles = CELL.split(source)[1:]
    body = [part.split('\nif __name__ == "__main__":')[0].strip() for part in titles[1::2]]
    return question, text.strip(), list(zip(titles[::2], body, strict=True))


def run(path: Path, pictures: Path) -> tuple[str, Path]:
    """What the script prints, and its picture."""
    output = io.StringIO()
    with contextlib.redirect_stdout(output):
        names = runpy.run_path(str(path), run_name="example")
    (picture,) = style.save(names["draw"](), path.stem, pictures, formats=("png",))
    return output.getvalue(), picture


def _plain(text: str) -> str:
    """Markdown without links."""
    return html_of(text, link=lambda name: name, api=lambda name: "")


def _inline(text: str) -> str:
    return _plain(text).strip().removeprefix("<p>").removesuffix("</p>")


def _text(text: str) -> str:
    return re.sub(r'[<>&"]', "", text)
