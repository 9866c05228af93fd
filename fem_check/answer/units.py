"""Units in which an answer is told: those of its question, or lengths and periods of the sheet."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from fem_check.levels import Question


@dataclass(frozen=True)
class Units:
    """Names of a unit of length and one of time, and how large they are in those of the question.

    >>> from fem_check.answer.units import Units
    >>> print(Units("mm", "s").speed, Units("L", "T", 2.0, 4.0).of_speed(0.1))
    mm/s 0.2
    """

    length: str
    time: str
    length_size: float = 1.0
    time_size: float = 1.0

    @classmethod
    def of_sheet(cls, question: "Question") -> "Units":
        """L, the length of the sheet, and T, the period of the wave."""
        return cls("L", "T", question.sheet.length, question.wave.period)

    @property
    def speed(self) -> str:
        """Name of the unit of speed."""
        return f"{self.length}/{self.time}"

    def of_length(self, length: float) -> float:
        """A length of the question in this unit."""
        return length / self.length_size

    def of_time(self, time: float) -> float:
        """A time of the question in this unit."""
        return time / self.time_size

    def of_speed(self, speed: float) -> float:
        """A speed of the question in this unit."""
        return speed * (self.time_size / self.length_size)
