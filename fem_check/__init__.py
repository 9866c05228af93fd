"""Finite elements that check the linear theory across alpha: plane stress and a nonlinear shell."""

from fem_check.outline import Outline
from fem_check.plane_stress import PlaneStressField, plane_stress_field
from fem_check.prediction import Prediction, predict
from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.scene import Scene
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.trajectory import Trajectory

__all__ = [
    "Outline",
    "PlaneStressField",
    "Prediction",
    "Scene",
    "Trajectory",
    "cycle_speed",
    "plane_stress_field",
    "predict",
    "simulate",
]
