"""The effects on a sheet, one file each; a scene names those that act."""

from fem_check.shell.effects.contact.self_contact import SelfContact
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.effects.loads import DeadLoad, EdgeMoment
from fem_check.shell.effects.terrain import Terrain
from fem_check.shell.material import Material

__all__ = [
    "Bending",
    "DeadLoad",
    "EdgeMoment",
    "Effect",
    "Friction",
    "Gravity",
    "Ground",
    "Inertia",
    "Material",
    "Membrane",
    "SelfContact",
    "Terrain",
]
