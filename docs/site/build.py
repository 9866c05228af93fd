"""Build the site.

    python -m docs.site [--out FOLDER]

Writes build/docs/index.html and all that it leads to. The pages are the README, the Markdown of docs/
and the examples of figures/, which are run: a minute. Nothing is fetched from outside, neither here nor
by the reader's browser. Ends with status 1 where a link leads nowhere.
"""

import shutil
import sys
from collections.abc import Sequence
from functools import partial
from itertools import groupby
from pathlib import Path

from docs.site import api, examples, links, markup
from docs.site.contents import ROOT, Page, pages
from docs.site.pictures import sized
from figures.common.command import parser
from figures.common.output import tracked

TEMPLATES = Path(__file__).parent / "templates"

PICTURES = "pictures"
"""Folder of the site for the pictures of the pages."""


def build(folder: Path, reference: bool = True, only: Sequence[str] = ()) -> None:
    """Write the site. reference: with that of the API; only: names of the examples, () for all."""
    everything = pages()
    shown = [page for page in everything if not _left_out(page, only)]
    folder.mkdir(parents=True, exist_ok=True)
    style = (TEMPLATES / "style.css").read_text() + str(markup.CODE.get_style_defs(".code"))
    (folder / "style.css").write_text(style)
    if reference:
        api.write(folder / "api")
    for page in tracked("documentation", shown):
        target = folder / page.target
        target.parent.mkdir(parents=True, exist_ok=True)
        content = sized(body(page, folder, shown), target.parent)
        target.write_text(framed(page, content, shown))


def body(page: Page, folder: Path, shown: Sequence[Page]) -> str:
    """The HTML of a page without its frame; its pictures are copied or drawn."""
    if page.source.stem == "__init__":
        return examples.overview([other.source for other in shown if _is_script(other)])
    if page.source.suffix == ".py":
        return examples.rendered(page.source, (folder / page.target).parent)
    link = partial(_link, page, folder)
    return markup.html_of(page.source.read_text(), link, partial(_reference, page))


def framed(page: Page, content: str, shown: Sequence[Page]) -> str:
    """The whole page: the frame with the navigation, and the content."""
    title = "sheetcrawl" if page.target == "index.html" else f"{page.title} · sheetcrawl"
    names = {"title": title, "up": page.up, "navigation": navigation(page, shown), "content": content}
    text = (TEMPLATES / "frame.html").read_text()
    for name, value in names.items():
        text = text.replace(f"{{{{{name}}}}}", value)
    return text


def navigation(page: Page, shown: Sequence[Page]) -> str:
    """Links to all pages by section; the page itself is marked."""
    out = []
    for section, members in groupby(shown, key=lambda other: other.section):
        rows = [(other.target, other.title, other == page) for other in members]
        if section == "Reference":
            rows.append(("api/index.html", "API", False))
        items = "".join(
            f'<li><a href="{page.up}{target}"{" aria-current=page" if here else ""}>{title}</a></li>'
            for target, title, here in rows
        )
        out.append(f"<h2>{section}</h2><ul>{items}</ul>")
    return "".join(out)


def main(arguments: Sequence[str] | None = None) -> None:
    """Build the site and check its links."""
    options = parser("python -m docs.site", __doc__, ROOT / "build" / "docs").parse_args(arguments)
    build(options.out)
    faults = links.broken(options.out)
    print(options.out / "index.html")
    if faults:
        sys.exit("\n".join(["links that lead nowhere:", *faults]))


def _left_out(page: Page, only: Sequence[str]) -> bool:
    return bool(only) and _is_script(page) and page.source.stem not in only


def _is_script(page: Page) -> bool:
    return page.source.suffix == ".py" and page.source.stem != "__init__"


def _link(page: Page, folder: Path, link: str) -> str:
    """A link of a source file as one of the site; pictures are copied into it."""
    path, _, anchor = link.partition("#")
    if "://" in link or not path:
        return link
    source = (page.source.parent / path).resolve()
    if source.is_dir():
        source /= "__init__.py"
    for other in pages():
        if source == other.source:
            return page.up + other.target + (f"#{anchor}" if anchor else "")
    if source.suffix not in (".png", ".gif"):
        raise ValueError(f"{page.source.name}: link {link!r}: must lead to a page or a picture")
    (folder / PICTURES).mkdir(parents=True, exist_ok=True)
    shutil.copyfile(source, folder / PICTURES / source.name)
    return f"{page.up}{PICTURES}/{source.name}"


def _reference(page: Page, name: str) -> str:
    """The place of a name of the code in the API reference; "" if it has none."""
    module, _, anchor = markup.found(name, api.modules()).partition("#")
    return f"{page.up}api/{api.page(module)}" + (f"#{anchor}" if anchor else "") if module else ""
