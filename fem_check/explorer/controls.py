"""The sliders and choices of the page."""

from collections.abc import Callable
from typing import Any

from fem_check.explorer.question import Question
from linear_theory.common.extras import optional
from linear_theory.friction.laws import FRICTION_LAWS, Tanh
from linear_theory.friction.load import WEIGHTS

SINE, PULSE = "sine", "pulse"

TOLERANCES = {"10 %": 0.1, "5 %": 0.05, "2 %": 0.02, "1 %": 0.01}

SOON = 1
"""Milliseconds in which the framework gathers moves, instead of its 50: `Latest` drops old ones."""

FIRST = Question()
"""What the page asks first."""


class Controls:
    """Widgets, and the question that they ask. changed: called after each move."""

    def __init__(self, changed: Callable[[], None]) -> None:
        widgets = optional("panel", "explorer", "sheetcrawl explore").widgets
        slider, select = widgets.FloatSlider, widgets.Select
        self.length = slider(name="length", value=FIRST.length, start=0.5, end=4.0, step=0.1)
        self.width = slider(name="width", value=FIRST.width, start=0.1, end=4.0, step=0.05)
        self.poisson = slider(
            name="Poisson ratio nu", value=FIRST.poisson, start=0.0, end=0.5, step=0.05
        )
        self.alpha = slider(
            name="growth coupling alpha", value=FIRST.alpha, start=-0.8, end=0.8, step=0.01
        )
        self.form = widgets.RadioButtonGroup(name="wave", options=[SINE, PULSE], value=SINE)
        self.count = widgets.IntSlider(name="waves on the sheet", value=FIRST.count, start=1, end=4)
        self.pulse = slider(
            name="pulse width, wavelengths", value=0.3, start=0.05, end=0.9, step=0.01, visible=False
        )
        self.load = select(name="load", options=[str(load) for load in WEIGHTS], value=FIRST.load)
        self.friction = select(name="friction", options=list(FRICTION_LAWS), value=FIRST.friction)
        self.slip_speed = slider(
            name="slip speed, length/period", value=FIRST.slip_speed, start=0.001, end=0.1,
            step=0.001, format="0.000", visible=False,
        )  # fmt: skip
        self.tolerance = select(
            name="tolerance of the nonlinear answer", options=TOLERANCES, value=FIRST.rtol
        )
        self.time = slider(
            name="time of the picture, periods", value=0.0, start=0.0, end=1.0, step=0.02
        )
        self._changed = changed
        for widget in self.widgets:
            widget.sizing_mode = "stretch_width"
            widget._debounce = SOON
            widget.param.watch(self._moved, "value")

    @property
    def widgets(self) -> list[Any]:
        """From top to bottom."""
        return [
            self.form, self.count, self.pulse, self.alpha, self.length, self.width, self.poisson,
            self.load, self.friction, self.slip_speed, self.tolerance, self.time,
        ]  # fmt: skip

    def question(self) -> Question:
        """What the widgets say."""
        return Question(
            length=_rounded(self.length.value),
            width=_rounded(self.width.value),
            poisson=_rounded(self.poisson.value),
            alpha=_rounded(self.alpha.value),
            count=self.count.value,
            pulse=_rounded(self.pulse.value) if self.form.value == PULSE else None,
            load=self.load.value,
            friction=self.friction.value,
            slip_speed=_rounded(self.slip_speed.value),
            rtol=self.tolerance.value,
        )

    def phase(self) -> float:
        """Time of the picture in periods."""
        return _rounded(self.time.value)

    def _moved(self, _: Any) -> None:
        self.pulse.visible = self.form.value == PULSE
        self.slip_speed.visible = self.friction.value == Tanh.name
        self._changed()


def _rounded(value: float) -> float:
    """As the slider shows it, without the rounding errors of its steps."""
    return round(float(value), 4)
