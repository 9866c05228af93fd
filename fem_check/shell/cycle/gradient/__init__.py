"""The gradient of the speed of a cycle of shapes, by adjoints of friction balance and equilibrium."""

from fem_check.shell.cycle.gradient.gradient import cycle_gradient

__all__ = ["cycle_gradient"]
