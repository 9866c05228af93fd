"""Finite elements that check the linear theory across alpha: plane stress and a nonlinear shell."""

from fem_check.outline import Outline
from fem_check.plane_stress import PlaneStressField, plane_stress_field
from fem_check.prediction import Prediction, predict
from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.effects.terrain import Terrain
from fem_check.shell.material import Material
from fem_check.shell.scene import Scene
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.trajectory import Trajectory

__all__ = [
    "Bending",
    "DeadLoad",
    "Friction",
    "Gravity",
    "Ground",
    "Inertia",
    "Material",
    "Membrane",
    "Outline",
    "PlaneStressField",
    "Prediction",
    "Scene",
    "Terrain",
    "Trajectory",
    "cycle_speed",
    "plane_stress_field",
    "predict",
    "simulate",
]
