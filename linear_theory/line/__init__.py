"""The one-dimensional crawler at finite strain: closed forms, series, and the balance for any wave."""

from linear_theory.line.balance import line_balance
from linear_theory.line.closed_form import line_power, line_speed, line_speed_tanh, line_speed_viscous
from linear_theory.line.finite import line_cycle_speed
from linear_theory.line.finite_series import line_cycle_series
from linear_theory.line.series import LAPLACE_LIMIT, line_series, line_speed_series

__all__ = [
    "LAPLACE_LIMIT",
    "line_balance",
    "line_cycle_series",
    "line_cycle_speed",
    "line_power",
    "line_series",
    "line_speed",
    "line_speed_series",
    "line_speed_tanh",
    "line_speed_viscous",
]
