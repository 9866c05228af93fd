"""The thin rectangular sheet."""

from dataclasses import dataclass

from numpy.typing import ArrayLike

from linear_theory.common import validation
from linear_theory.common.shown import Value


@dataclass(frozen=True)
class Sheet(Value):
    """A flat rectangular sheet, |x| <= width/2, |y| <= length/2, of Young modulus 1.

    Lengths are in any one unit (length = 1 makes them multiples of L). The defaults are
    the sheet of the paper: L x L/2, nu = 1/2, h = 0.03 L.

    Raises ValueError for sizes that are not finite and positive and for a Poisson ratio
    outside (-1, 1/2].

    >>> from linear_theory import Sheet
    >>> strip = Sheet(length=1.0, width=0.1, poisson=0.3)
    >>> print(f"area {strip.area:.1f} L^2, thickness {strip.thickness} L")
    area 0.1 L^2, thickness 0.03 L
    """

    length: float = 1.0
    width: float = 0.5
    poisson: float = 0.5
    thickness: float = 0.03

    def __post_init__(self) -> None:
        for name in ("length", "width", "thickness"):
            object.__setattr__(self, name, validation.positive(name, getattr(self, name)))
        object.__setattr__(self, "poisson", validation.poisson(self.poisson))

    @property
    def area(self) -> float:
        """Reference area, length * width."""
        return self.length * self.width

    def check_inside(self, x: ArrayLike, y: ArrayLike) -> None:
        """Raise ValueError if a point lies outside the sheet (by more than roundoff)."""
        for name, values, half in (("x", x, self.width / 2), ("y", y, self.length / 2)):
            array = validation.real_array(name, values)
            if array.size and abs(array).max() > half * (1 + 1e-12):
                worst = array.flat[abs(array).argmax()]
                raise ValueError(f"{name} = {worst:g}: must be in [{-half:g}, {half:g}]")
