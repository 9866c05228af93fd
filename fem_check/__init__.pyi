"""Finite elements that check the linear theory: plane stress, and a nonlinear shell for any alpha.

Read by `lazy_loader` as it runs, and by type checkers.
"""

from .choice.prediction import predict
from .choice.result import Prediction
from .choice.settings import RunSettings
from .choice.solving import solve
from .excitable.equation import FitzHughNagumo
from .excitable.excitation import Excitation
from .excitable.feedback import StrainFeedback
from .excitable.presets import excitable_preset
from .excitable.speeds import speeds
from .mesh.outline import Outline
from .optimisation.optimising import optimise
from .optimisation.options.constraints import Bound
from .optimisation.options.robust import Robust
from .optimisation.over import Harmonics
from .outlines.best import best_outline
from .outlines.gradient import outline_gradient
from .outlines.shapes import LegendreShape, Trapezoid
from .output.paraview import write_paraview
from .plane_stress.field import PlaneStressField, plane_stress_field
from .scene import Scene, bilayer
from .shell.cycle.gradient.gradient import cycle_gradient
from .shell.cycle.speed import cycle_speed
from .shell.effects.contact.self_contact import SelfContact
from .shell.effects.friction import Friction
from .shell.effects.gravity import Gravity
from .shell.effects.ground import Ground
from .shell.effects.height_map import HeightMap
from .shell.effects.inertia import Inertia
from .shell.effects.koiter import Bending, Membrane
from .shell.effects.loads import DeadLoad
from .shell.effects.terrain import Terrain
from .shell.material import Material
from .shell.stepping.further.rigid_ground import RigidGround, rigid_ground
from .shell.stepping.schemes import BackwardDifferences, Newmark
from .shell.stepping.simulation import simulate
from .shell.stepping.trajectory import Trajectory
from .sweeps.running import sweep
from .version import __version__

__all__ = [
    "BackwardDifferences",
    "Bending",
    "Bound",
    "DeadLoad",
    "Excitation",
    "FitzHughNagumo",
    "Friction",
    "Gravity",
    "Ground",
    "Harmonics",
    "HeightMap",
    "Inertia",
    "LegendreShape",
    "Material",
    "Membrane",
    "Newmark",
    "Outline",
    "PlaneStressField",
    "Prediction",
    "RigidGround",
    "Robust",
    "RunSettings",
    "Scene",
    "SelfContact",
    "StrainFeedback",
    "Terrain",
    "Trajectory",
    "Trapezoid",
    "__version__",
    "best_outline",
    "bilayer",
    "cycle_gradient",
    "cycle_speed",
    "excitable_preset",
    "optimise",
    "outline_gradient",
    "plane_stress_field",
    "predict",
    "rigid_ground",
    "simulate",
    "solve",
    "speeds",
    "sweep",
    "write_paraview",
]
