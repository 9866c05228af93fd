"""The numbers that the text of the write-up names: computed here, printed there.

    python -m paper.numbers [--out FILE]

Writes paper/generated/numbers.json: a minute of computing. A number has a key, a value and an
origin, the call or the rule that made it. Tables that take longer have their own programs
(`figures.measure.second_order`, `figures.measure.model_error`, `paper.numbers.shell`) and are read by
the text as they are. Lengths are in L, times in T, unless the key says otherwise.
"""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from figures.common import output
from figures.common.command import parser
from paper.numbers import effects as numbers_effects
from paper.numbers import field as numbers_field
from paper.numbers import limits as numbers_limits
from paper.numbers import original as numbers_print
from paper.numbers import speed as numbers_speed
from paper.numbers.number import Number, Numbers

PATH = Path(__file__).parents[1] / "generated" / "numbers.json"

DIGITS = 7
"""Significant digits written: more than the text shows, fewer than roundoff changes."""

GROUPS: dict[str, Callable[[], Numbers]] = {
    "line": numbers_field.line,
    "corner": numbers_field.corner,
    "series": numbers_field.truncation,
    "agree": numbers_field.agreement,
    "sheet": numbers_speed.sheet,
    "pulse": numbers_speed.pulses,
    "reach": numbers_speed.reach,
    "regime": numbers_limits.shown_regimes,
    "boundary": numbers_limits.boundaries,
    "turn": numbers_limits.turning,
    "cat": numbers_limits.cat,
    "shape": numbers_limits.shapes,
    "step": numbers_speed.stepping,
    "ground": numbers_print.ground,
    "reaction": numbers_print.reaction,
    "wave": numbers_effects.oscillation,
    "direction": numbers_effects.direction,
    "best": numbers_effects.best,
}


def compute(groups: Sequence[str] = tuple(GROUPS)) -> Numbers:
    """The numbers of some groups, or of all."""
    found: Numbers = {}
    for name in output.tracked("numbers of the text", groups):
        found |= GROUPS[name]()
    return found


def write(numbers: Mapping[str, Number], path: Path = PATH) -> Path:
    """Value and origin of every key, as JSON."""
    return output.write_json(path, {key: n._asdict() for key, n in numbers.items()}, DIGITS)


def main(arguments: Sequence[str] | None = None) -> None:
    """Compute and write all numbers."""
    options = parser("python -m paper.numbers", __doc__, PATH).parse_args(arguments)
    print(write(compute(), options.out))
