"""Gradients of speed, power and cost of transport, by the adjoints of balance and deformation."""

from linear_theory.gradient.parameters.family import WaveFamily
from linear_theory.gradient.parameters.names import parameter, parameters
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.gradient.result import (
    CostGradient,
    Gradient,
    MotionGradient,
    PowerGradient,
    SpeedGradient,
)
from linear_theory.gradient.speed import (
    cost_gradient,
    motion_gradient,
    power_gradient,
    speed_gradient,
)

__all__ = [
    "CostGradient",
    "Gradient",
    "MotionGradient",
    "Parameter",
    "PowerGradient",
    "SpeedGradient",
    "WaveFamily",
    "cost_gradient",
    "motion_gradient",
    "parameter",
    "parameters",
    "power_gradient",
    "speed_gradient",
]
