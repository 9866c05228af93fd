"""Markdown to HTML: headings with anchors, links into the site, names of the code to the API."""

import importlib
import inspect
import re
from collections.abc import Callable, MutableMapping, Sequence
from html import escape
from itertools import pairwise
from typing import Any

from markdown_it import MarkdownIt
from markdown_it.renderer import RendererHTML
from markdown_it.token import Token
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_by_name

Link = Callable[[str], str]
"""From a link as it stands in the source to one that works in the site."""

CODE = HtmlFormatter(cssclass="code")

SHORT = 30
"""Characters of code in the text below which it is kept on one line."""

NUMBER = re.compile(r"(?=.{1,12}$)\(?[+−-]?\d[^A-DF-Za-df-z]*( ?[a-zµ%]{1,3})?\)?")
"""A cell of a table with a short number and its unit, kept on one line."""

BREAKS = re.compile(r"(::|[/_.](?=\w))")
"""After which a long name in the text may go on in the next line."""

LANGUAGES = {"python", "bash", "toml", "bibtex"}


def html_of(text: str, link: Link, api: Link) -> str:
    """The body of a page. link: of files; api: of dotted names of the code, "" for none."""
    markdown = MarkdownIt("commonmark", {"html": False}).enable("table")
    markdown.add_render_rule("heading_open", _heading)
    markdown.add_render_rule("table_open", lambda *_: '<div class="wide"><table>')
    markdown.add_render_rule("table_close", lambda *_: "</table></div>")
    for rule in ("fence", "code_block"):
        markdown.add_render_rule(rule, _fence)
    tokens = markdown.parse(text)
    for before, token in pairwise(tokens):
        if before.type == "td_open" and NUMBER.fullmatch(token.content):
            before.attrSet("class", "short")
    for token in tokens:
        for child in token.children or ():
            _relink(child, link)
            if child.type == "code_inline":
                if len(child.content) < SHORT:
                    child.attrSet("class", "short")
                _to_api(child, api)
    return str(markdown.renderer.render(tokens, markdown.options, {}))


def code(source: str, language: str) -> str:
    """A block of code, coloured."""
    lexer = get_lexer_by_name(language if language in LANGUAGES else "text")
    return str(highlight(source, lexer, CODE))


def slug(text: str) -> str:
    """The anchor of a heading."""
    return re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")


def found(name: str, modules: Sequence[str]) -> str:
    """The page and anchor of a dotted name, "module#name", among the documented modules; "" if none.

    A public name may be written without its package.
    """
    for module in sorted(modules, key=len, reverse=True):
        if name == module:
            return module
        inside = name.removeprefix(f"{module}.")
        value = importlib.import_module(module)
        public = getattr(value, "__all__", None) or [n for n in vars(value) if not n.startswith("_")]
        here = inside != name or module in ("linear_theory", "fem_check")
        if here and inside.split(".")[0] in public and _own(value, inside):
            return f"{module}#{inside}"
    return ""


def _own(module: Any, name: str) -> bool:
    """Whether the module documents it: one of its public names, or defined there."""
    value = module
    for part in name.split("."):
        fields = getattr(value, "__dataclass_fields__", {})  # those without default are no attributes
        if isinstance(value, type) and part not in {*vars(value), *inspect.get_annotations(value)}:
            return False  # inherited, and documented there
        value = getattr(value, part, fields.get(part))
    listed = getattr(module, "__all__", None)
    return value is not None and bool(listed or getattr(value, "__module__", "") == module.__name__)


def _relink(token: Token, link: Link) -> None:
    for attribute in ("href", "src"):
        old = token.attrGet(attribute)
        if old is not None:
            token.attrSet(attribute, link(str(old)))


def _to_api(token: Token, api: Link) -> None:
    target = api(token.content) if re.fullmatch(r"[A-Za-z_][\w.]*", token.content) else ""
    text = BREAKS.sub(r"\1<wbr>", escape(token.content))
    shown = f"<code>{text}</code>"
    if target:
        token.type, token.content = "html_inline", f'<a href="{escape(target)}">{shown}</a>'
    elif len(token.content) >= SHORT:
        token.type, token.content = "html_inline", shown


def _heading(
    renderer: RendererHTML,
    tokens: Sequence[Token],
    index: int,
    options: Any,
    env: MutableMapping[str, Any],
) -> str:
    return f'<{tokens[index].tag} id="{slug(tokens[index + 1].content)}">'


def _fence(
    renderer: RendererHTML,
    tokens: Sequence[Token],
    index: int,
    options: Any,
    env: MutableMapping[str, Any],
) -> str:
    return code(tokens[index].content, tokens[index].info.strip())
