"""Whether every link of the site leads somewhere, and no page asks for anything from outside."""

import re
from html import unescape
from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote, urlsplit

OUTSIDE = ("http", "https", "mailto", "data")

FETCHED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src")}
"""What a browser asks for by itself."""


SCRIPT = re.compile(r"(<script\b[^>]*>).*?</script>", re.DOTALL)
"""Whose inside holds templates of links."""

LINK = re.compile(r"<([a-z]+)\b[^>]*?\b(href|src)=\"([^\"]*)\"")

ANCHOR = re.compile(r"<[^>]*?\b(?:id|name)=\"([^\"]+)\"")


class _Page(NamedTuple):
    """Links of one page, (tag, attribute, link), and its anchors."""

    links: list[tuple[str, str, str]]
    anchors: set[str]


def _read(path: Path) -> _Page:
    text = SCRIPT.sub(r"\1", path.read_text())
    links = [(tag, name, unescape(link)) for tag, name, link in LINK.findall(text)]
    return _Page(links, set(ANCHOR.findall(text)))


def broken(site: Path) -> list[str]:
    """Links of its pages that lead nowhere, or that are fetched from outside: "page: link"."""
    pages = {path.resolve(): _read(path) for path in sorted(site.rglob("*.html"))}
    return [
        f"{path.relative_to(site.resolve())}: {link}"
        for path, page in pages.items()
        for tag, name, link in page.links
        if not _leads(path, tag, name, link, pages)
    ]


def _leads(path: Path, tag: str, name: str, link: str, pages: dict[Path, _Page]) -> bool:
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return parts.scheme == "data" or (parts.scheme in OUTSIDE and (tag, name) not in FETCHED)
    target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if not target.is_file():
        return False
    return not parts.fragment or target not in pages or unquote(parts.fragment) in pages[target].anchors
