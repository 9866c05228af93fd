"""What the sliders ask, as a scene, as lines of Python and as a command."""

from dataclasses import dataclass, replace

from linear_theory.friction.contact import Contact
from linear_theory.friction.laws import Tanh
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.pulse import pulse_wave
from linear_theory.wave.travelling import SineWave, TravellingWave

SMALL_STRAIN_RTOL = 2e-2
"""Tolerance of the small-strain speed: its distance to the nonlinear sheet is mostly larger."""


@dataclass(frozen=True, kw_only=True)
class Question:
    """Values of the sliders; the period of the wave is the unit of time.

    length, width: in any one unit; poisson; alpha: growth coupling; count: waves on the sheet; pulse:
    width of the pulse in wavelengths, None for a sine; load, friction: names as in `crawl_speed`;
    slip_speed: of tanh friction, length per period, ignored for other laws; rtol: tolerance of
    `predict`. Values are checked when they are used: `scene` raises ValueError.

    >>> from fem_check.explorer.question import Question
    >>> print(Question(alpha=0.2, pulse=0.3, friction="viscous").python)
    from fem_check import predict
    from linear_theory import Sheet, crawl_speed, pulse_wave
    sheet, wave = Sheet(length=1.0, width=0.5, poisson=0.5), pulse_wave(0.3, count=1)
    print(crawl_speed(sheet, wave, alpha=0.2, friction='viscous', rtol=0.02).estimate)
    print(predict(sheet, wave, alpha=0.2, friction='viscous', rtol=0.05))
    """

    length: float = 1.0
    width: float = 0.5
    poisson: float = 0.5
    alpha: float = 0.11
    count: int = 1
    pulse: float | None = None
    load: str = "current"
    friction: str = "coulomb"
    slip_speed: float = 0.01
    rtol: float = 5e-2

    def but(self, alpha: float) -> "Question":
        """A copy with another alpha."""
        return replace(self, alpha=alpha)

    @property
    def wave(self) -> TravellingWave:
        """The wave. Raises ValueError for a pulse or a count out of range."""
        return SineWave(self.count) if self.pulse is None else pulse_wave(self.pulse, self.count)

    @property
    def contact(self) -> Contact:
        """Load and friction. Raises ValueError for unknown names."""
        return Contact.named(self.load, self.friction, self._slip_speed)

    @property
    def scene(self) -> Scene:
        """The scene. Raises ValueError for values out of range."""
        sheet = Sheet(self.length, self.width, self.poisson)
        return Scene(sheet, self.wave, self.alpha, contact=self.contact)

    @property
    def _slip_speed(self) -> float | None:
        return self.slip_speed if self.friction == Tanh.name else None

    @property
    def python(self) -> str:
        """Five lines of Python that print the small-strain and the nonlinear answer."""
        if self.pulse is None:
            names, wave = "Sheet, SineWave, crawl_speed", f"SineWave(count={self.count})"
        else:
            names, wave = (
                "Sheet, crawl_speed, pulse_wave",
                f"pulse_wave({self.pulse}, count={self.count})",
            )
        size = f"length={self.length}, width={self.width}, poisson={self.poisson}"
        contact = "".join(f", {name}={value!r}" for name, value in self._contact_given())
        asked = f"sheet, wave, alpha={self.alpha}{contact}"
        return "\n".join(
            (
                "from fem_check import predict",
                f"from linear_theory import {names}",
                f"sheet, wave = Sheet({size}), {wave}",
                f"print(crawl_speed({asked}, rtol={SMALL_STRAIN_RTOL}).estimate)",
                f"print(predict({asked}, rtol={self.rtol}))",
            )
        )

    @property
    def command(self) -> str:
        """The command that prints the nonlinear answer.

        >>> from fem_check.explorer.question import Question
        >>> print(Question(alpha=-0.1, friction="tanh").command)
        sheetcrawl speed --length 1.0 --width 0.5 --poisson 0.5 --count 1 --alpha -0.1 --friction tanh --slip-speed 0.01 --rtol 0.05
        """  # noqa: E501 - one line to paste
        words = [
            f"sheetcrawl speed --length {self.length} --width {self.width} --poisson {self.poisson}",
            f"--count {self.count}",
        ]
        words += [] if self.pulse is None else [f"--pulse {self.pulse}"]
        words += [f"--alpha {self.alpha}"]
        words += [f"--{name.replace('_', '-')} {value}" for name, value in self._contact_given()]
        return " ".join([*words, f"--rtol {self.rtol}"])

    def _contact_given(self) -> list[tuple[str, object]]:
        """Load and friction where they are not the default."""
        usual = Question()
        named: list[tuple[str, object]] = [
            (name, getattr(self, name))
            for name in ("load", "friction")
            if getattr(self, name) != getattr(usual, name)
        ]
        slip = self._slip_speed
        return named if slip is None else [*named, ("slip_speed", slip)]
