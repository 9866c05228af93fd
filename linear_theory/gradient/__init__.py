"""Gradients of the speed and of the cost of transport, by the adjoints of balance and deformation."""

from linear_theory.gradient.parameters.family import WaveFamily
from linear_theory.gradient.parameters.names import parameter, parameters
from linear_theory.gradient.parameters.parameter import Parameter
from linear_theory.gradient.result import CostGradient, Gradient, SpeedGradient
from linear_theory.gradient.speed import cost_gradient, speed_gradient

__all__ = [
    "CostGradient",
    "Gradient",
    "Parameter",
    "SpeedGradient",
    "WaveFamily",
    "cost_gradient",
    "parameter",
    "parameters",
    "speed_gradient",
]
