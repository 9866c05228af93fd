"""Speed of a stiff sheet: static shapes over one period, then the friction balance."""

from fem_check.shell.cycle.shapes import Shapes, cycle_of_shapes
from fem_check.shell.cycle.speed import cycle_speed

__all__ = ["Shapes", "cycle_of_shapes", "cycle_speed"]
