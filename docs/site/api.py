"""The API reference, from the docstrings, by pdoc."""

import importlib
import inspect
import re
from functools import partial
from html import escape
from pathlib import Path
from typing import Any

import pdoc
import pdoc.render
from numpy.typing import ArrayLike
from pdoc.render_helpers import format_signature

from docs.site.contents import API, ROOT
from docs.site.groups import GROUPS, summary
from linear_theory.common.quadrature import Array

TEMPLATES = Path(__file__).parent / "templates"

SHORTER = {
    repr(ArrayLike): "ArrayLike",  # within another annotation
    inspect.formatannotation(ArrayLike | None): "ArrayLike | None",
    inspect.formatannotation(ArrayLike): "ArrayLike",
    inspect.formatannotation(Array): "Array",
    "numpy.float64": "float",
}
"""Annotations as numpy spells them out, and the names by which the source has them."""


class _Annotation:
    """Text in the place of an annotation."""

    def __init__(self, text: str) -> None:
        self._text = text

    def __repr__(self) -> str:
        return self._text


def modules() -> list[str]:
    """What is documented: the list, and the modules of the names in the index of equations."""
    text = (ROOT / "docs" / "equations.md").read_text()
    named = re.findall(r"`((?:linear_theory|fem_check)\.[\w.]+)`", text)
    return sorted({*API, *filter(None, map(_module, named))})


def write(folder: Path) -> None:
    """All pages of the reference into the folder."""
    pdoc.render.configure(docformat="markdown", template_directory=TEMPLATES)
    pdoc.render.env.filters["format_signature"] = signature
    pdoc.render.env.globals["groups"] = {name: overview(name) for name in GROUPS}
    pdoc.pdoc(*modules(), output_directory=folder)
    for path in folder.rglob("*.html"):
        text = path.read_text()
        for long, short in SHORTER.items():
            text = text.replace(escape(long), short)
        path.write_text(without_dead_anchors(text))


def overview(module: str) -> dict[str, list[tuple[str, str]]]:
    """The public names of a package with what they are, by group; those of no group come last."""
    listed = {name for names in GROUPS[module].values() for name in names}
    others = tuple(n for n in importlib.import_module(module).__all__ if n not in listed)
    groups = {**GROUPS[module], **({"Further names": others} if others else {})}
    return {title: _rows(module, names) for title, names in groups.items()}


def signature(found: inspect.Signature, colon: bool) -> str:
    """The HTML of a signature, with short annotations."""
    changed = [p.replace(annotation=_short(p.annotation)) for p in found.parameters.values()]
    returned = _short(found.return_annotation)
    return str(format_signature(found.replace(parameters=changed, return_annotation=returned), colon))


def without_dead_anchors(text: str) -> str:
    """A page whose links to members that it does not show, inherited ones, are plain text."""
    known = set(re.findall(r'id="([^"]+)"', text))
    return re.sub(r'<a href="#([^"]+)">(.*?)</a>', lambda m: m[0] if m[1] in known else m[2], text)


def page(module: str) -> str:
    """Its path in the folder of the reference."""
    return f"{module.replace('.', '/')}.html"


def _rows(module: str, names: tuple[str, ...]) -> list[tuple[str, str]]:
    """Names and what they are."""
    return list(zip(names, map(partial(summary, importlib.import_module(module)), names), strict=True))


def _short(annotation: Any) -> Any:
    """The annotation, or the text of one with arrays in it."""
    if annotation is inspect.Signature.empty:
        return annotation
    text = inspect.formatannotation(annotation)
    for long, short in SHORTER.items():
        text = text.replace(long, short)
    return annotation if text == inspect.formatannotation(annotation) else _Annotation(text)


def _module(name: str) -> str:
    """The longest beginning of a dotted name that is a module; "" for a public name of a package."""
    parts = name.split(".")
    for count in range(len(parts) - 1, 1, -1):
        if ROOT.joinpath(*parts[:count]).with_suffix(".py").is_file():
            return ".".join(parts[:count])
    return ""
