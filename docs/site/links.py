"""Whether every link of the site leads somewhere, and no page asks for anything from outside."""

from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

OUTSIDE = ("http", "https", "mailto", "data")

FETCHED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src")}
"""What a browser asks for by itself."""


class _Reader(HTMLParser):
    """Links and anchors of one page."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.links: list[tuple[str, str, str]] = []
        self.anchors: set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Collect."""
        for name, value in attrs:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            if name in ("href", "src") and value is not None:
                self.links.append((tag, name, value))


def broken(site: Path) -> list[str]:
    """Links of its pages that lead nowhere, or that are fetched from outside: "page: link"."""
    pages = {path.resolve(): _Reader(path.read_text()) for path in sorted(site.rglob("*.html"))}
    return [
        f"{path.relative_to(site.resolve())}: {link}"
        for path, page in pages.items()
        for tag, name, link in page.links
        if not _leads(path, tag, name, link, pages)
    ]


def _leads(path: Path, tag: str, name: str, link: str, pages: dict[Path, _Reader]) -> bool:
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return parts.scheme == "data" or (parts.scheme in OUTSIDE and (tag, name) not in FETCHED)
    target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if not target.is_file():
        return False
    return not parts.fragment or target not in pages or unquote(parts.fragment) in pages[target].anchors
