"""Units in which an answer is printed and drawn."""

from dataclasses import dataclass

from linear_theory.common import validation


@dataclass(frozen=True)
class Units:
    """Names of the units of length and time, and their conversion factors.

    Lengths and times are multiplied by length_factor and time_factor: for a sheet of length 1 that
    is 40 mm long, length = "mm" and length_factor = 40. Raises ValueError for factors that are not
    positive.

    >>> from fem_check.output import Units
    >>> units = Units("mm", "s", length_factor=40.0, time_factor=8.0)
    >>> print(f"{0.02 * units.speed_factor:.2f} {units.speed}")
    0.10 mm/s
    """

    length: str = "L"
    time: str = "T"
    length_factor: float = 1.0
    time_factor: float = 1.0

    def __post_init__(self) -> None:
        for name in ("length_factor", "time_factor"):
            object.__setattr__(self, name, validation.positive(name, getattr(self, name)))

    @classmethod
    def of_sheet(cls, length: float, period: float) -> "Units":
        """Units L, the length of the sheet, and T, the period of the wave."""
        return cls("L", "T", 1 / length, 1 / period)

    @property
    def speed(self) -> str:
        """Name of the unit of speed."""
        return f"{self.length}/{self.time}"

    @property
    def speed_factor(self) -> float:
        """Conversion factor of speeds."""
        return self.length_factor / self.time_factor

    def of_length(self, length: float) -> float:
        """A length in this unit."""
        return length * self.length_factor

    def of_time(self, time: float) -> float:
        """A time in this unit."""
        return time * self.time_factor

    def of_speed(self, speed: float) -> float:
        """A speed in this unit."""
        return speed * self.speed_factor
