"""The API reference, from the docstrings, by pdoc."""

import re
from pathlib import Path

import pdoc
import pdoc.render

from docs.site.contents import API, ROOT

TEMPLATES = Path(__file__).parent / "templates"


def modules() -> list[str]:
    """What is documented: the list, and the modules of the names in the index of equations."""
    text = (ROOT / "docs" / "equations.md").read_text()
    named = re.findall(r"`((?:linear_theory|fem_check)\.[\w.]+)`", text)
    return sorted({*API, *filter(None, map(_module, named))})


def write(folder: Path) -> None:
    """All pages of the reference into the folder."""
    pdoc.render.configure(docformat="markdown", template_directory=TEMPLATES)
    pdoc.pdoc(*modules(), output_directory=folder)
    for path in folder.rglob("*.html"):
        path.write_text(without_dead_anchors(path.read_text()))


def without_dead_anchors(text: str) -> str:
    """A page whose links to members that it does not show, inherited ones, are plain text."""
    known = set(re.findall(r'id="([^"]+)"', text))
    return re.sub(r'<a href="#([^"]+)">(.*?)</a>', lambda m: m[0] if m[1] in known else m[2], text)


def page(module: str) -> str:
    """Its path in the folder of the reference."""
    return f"{module.replace('.', '/')}.html"


def _module(name: str) -> str:
    """The longest beginning of a dotted name that is a module; "" for a public name of a package."""
    parts = name.split(".")
    for count in range(len(parts) - 1, 1, -1):
        if ROOT.joinpath(*parts[:count]).with_suffix(".py").is_file():
            return ".".join(parts[:count])
    return ""
