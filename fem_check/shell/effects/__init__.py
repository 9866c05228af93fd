"""The effects on a sheet, one file each; a scene names those that act."""

import lazy_loader

from fem_check.shell.material import Material

# Each class is imported on first use: a closed form loads none, scenes as data look for them here.
__getattr__, _, _classes = lazy_loader.attach(
    __name__,
    submod_attrs={
        "contact.self_contact": ["SelfContact"],
        "effect": ["Effect"],
        "friction": ["Friction"],
        "gravity": ["Gravity"],
        "ground": ["Ground"],
        "inertia": ["Inertia"],
        "koiter": ["Bending", "Membrane"],
        "loads": ["DeadLoad", "EdgeMoment"],
        "terrain": ["Terrain"],
    },
)
__all__ = [*_classes, Material.__name__]


def __dir__() -> list[str]:
    return sorted(__all__)
