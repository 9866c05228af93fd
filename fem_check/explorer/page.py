"""The page: sliders, figures, numbers, and the same question in Python and as a command."""

import html
from collections import deque
from collections.abc import Callable
from functools import partial
from typing import Any

from fem_check.explorer import drawing, text
from fem_check.explorer.controls import Controls
from fem_check.explorer.latest import Latest
from fem_check.explorer.nonlinear import Nonlinear, Predicted
from fem_check.explorer.question import Question
from fem_check.explorer.small_strain import Answer, Curve, Picture, answers
from linear_theory.common.extras import optional
from linear_theory.common.progress import Progress

STYLE = """
h2 { margin: 4px 0 0 0; }
.speeds { border-collapse: collapse; width: 100%; font-size: 14px; }
.speeds th, .speeds td { text-align: left; padding: 4px 8px 4px 0; border-bottom: 1px solid #ddd;
  vertical-align: top; }
@media (max-width: 600px) {
  .speeds { font-size: 11px; }
  .speeds th, .speeds td { padding-right: 4px; }
}
.speeds small, .waiting { color: #555; font-weight: normal; }
.messages { background: #fff4e5; border-left: 4px solid #D55E00; padding: 2px 12px; font-size: 14px; }
.messages p { margin: 6px 0; overflow-wrap: anywhere; }
pre { background: #f5f5f5; padding: 8px; margin: 4px 0; font-size: 12px; overflow-x: auto; }
pre.code { white-space: pre-wrap; user-select: all; }
"""


STICKY = {"position": "sticky", "top": "0", "z-index": "10", "background": "white"}
"""Of the headline, which stays in sight while the page is scrolled: on a phone it is long."""

SHEET_HEADING = (
    "Shape at small strain, coloured by the growth c; arrows: friction on the sheet. "
    "The wave runs to the right"
)
CURVE_HEADING = "Speed against growth; bars: error, for small strain the numerical one"


class Page:
    """One page in one browser window; `close` ends its thread and its process."""

    def __init__(self) -> None:
        self._panel = optional("panel", "explorer", "sheetcrawl explore")
        self._document = self._panel.state.curdoc
        self._waiting: deque[Callable[[], None]] = deque()
        self._figures = drawing.figures()
        self._found: dict[str, text.Found] = {}
        self._curve, self._asked = Curve(text.PREDICTED), (Question(), 0.0)
        self._controls = Controls(self._ask)
        pane = partial(self._panel.pane.HTML, sizing_mode="stretch_width", stylesheets=[STYLE])
        self._messages, self._table, self._block = pane(), pane(), pane()
        self._python, self._command = pane(), pane()
        self._headline = pane(styles=STICKY)
        self._latest: Latest[tuple[Question, float], Any] = Latest(
            lambda asked: answers(*asked), self._in_page(self._small_strain)
        )
        self._nonlinear = Nonlinear(self._in_page(self._predicted))
        self._panel.state.onload(self._ask)  # what other threads say before that could be lost

    def close(self) -> None:
        """End what computes for this page."""
        self._latest.close()
        self._nonlinear.close()

    def layout(self) -> Any:
        """All of it, for the framework; columns below each other where the window is narrow."""
        column, figures = self._panel.Column, self._figures
        left = column(*self._controls.widgets, styles={"flex": "1 1 280px"})
        answer = column(
            self._heading(SHEET_HEADING), figures.sheet, self._heading(CURVE_HEADING), figures.curve,
            self._table, self._messages, self._block,
            self._heading("The same in Python"), self._python,
            self._heading("The same as a command"), self._command,
            styles={"flex": "3 1 340px", "min-width": "0"},
        )  # fmt: skip
        below = self._panel.FlexBox(left, answer, gap="16px", sizing_mode="stretch_width")
        return column(self._headline, below, sizing_mode="stretch_width")

    def _heading(self, words: str) -> Any:
        return self._panel.pane.HTML(
            f"<b>{words}</b>", sizing_mode="stretch_width", margin=(8, 10, 0, 10)
        )

    def _in_page(self, show: Callable[[Any, Any], None]) -> Callable[[Any, Any], None]:
        """The function, to be called by another thread and run by the page's own.

        The framework does not keep the order of calls that are waiting, hence the queue.
        """

        def later(question: Any, part: Any) -> None:
            self._waiting.append(partial(show, question, part))
            self._document.add_next_tick_callback(self._show_waiting)

        return later

    def _show_waiting(self) -> None:
        """In one message, so that the browser lays the page out and draws once."""
        with self._panel.io.hold(self._document):
            while self._waiting:
                self._waiting.popleft()()

    def _ask(self) -> None:
        """A slider has moved: start on the new question, show what is known of it without work."""
        question, phase = self._controls.question(), self._controls.phase()
        before, self._asked = self._asked[0], (question, phase)
        if question != before or not self._found:
            self._found = {}
            if question.but(0.0) != before.but(0.0):
                self._curve = Curve(text.PREDICTED)
            self._nonlinear.ask(question)
        self._latest.ask(self._asked)

    def _small_strain(self, asked: tuple[Question, float], part: Any) -> None:
        if asked != self._asked:
            return
        if isinstance(part, Picture):
            known, now = drawing.curve_data(self._curve), {"now": {"alpha": [asked[0].alpha]}}
            self._draw({**drawing.sheet_data(part), **known, **now})
        if isinstance(part, Exception | Picture):
            self._write_down(asked[0])
        if isinstance(part, Exception):
            self._found, self._block.object = {}, ""
            self._headline.object, self._table.object = text.headline({}), text.table({})
            self._messages.object = text.refused(part)
        elif isinstance(part, Answer):
            self._show(part.level, part)
        elif isinstance(part, Curve):
            self._draw(drawing.curve_data(part))

    def _predicted(self, question: Question, part: Predicted | Progress) -> None:
        if question != self._asked[0]:
            return
        self._show(text.PREDICTED, part)
        if isinstance(part, Predicted):
            self._block.object = f"<pre>{html.escape(part.block)}</pre>" if part.block else ""
            self._curve = self._curve.with_point(question.alpha, part.mean, part.total)
            self._draw(drawing.curve_data(self._curve))

    def _write_down(self, question: Question) -> None:
        """The question in Python and as a command, and no answer to another one.

        After the picture: the browser lays the page out anew for it, which takes it as long as the
        drawing.
        """
        self._python.object, self._command.object = map(_code, (question.python, question.command))
        if not isinstance(self._found.get(text.PREDICTED), Predicted):
            self._block.object = ""

    def _show(self, level: str, found: text.Found) -> None:
        self._found[level] = found
        self._headline.object = text.headline(self._found)
        self._table.object, self._messages.object = text.table(self._found), text.messages(self._found)

    def _draw(self, sources: dict[str, dict[str, Any]]) -> None:
        for name, data in sources.items():
            self._figures.sources[name].data = data


def _code(lines: str) -> str:
    """Lines to copy: one click selects all of them."""
    return f"<pre class='code' title='a click selects all'>{html.escape(lines)}</pre>"
