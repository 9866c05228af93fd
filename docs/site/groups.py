"""The public names of the packages by what a user wants of them: the order of the API reference."""

import inspect
from types import ModuleType

GROUPS: dict[str, dict[str, tuple[str, ...]]] = {
    "linear_theory": {
        "The scene: sheet, growth, tolerance": (
            *("Sheet", "Scene", "Growth", "GrowthLaw", "Exp", "Linear", "Metric", "bilayer"),
            *("Tolerance", "Scale", "speed_si"),
        ),
        "Waves": (
            *("SineWave", "pulse_wave", "TravellingWave", "FractionalWave", "FieldWave"),
            "SampledWave",
        ),
        "Friction and load": (
            *("Contact", "Load", "Coulomb", "Tanh", "Viscous", "Directional", "Mapped", "Patches"),
            *("GivenMap", "OnLowerFace", "FrictionLaw", "Isotropic"),
        ),
        "Speed of a sheet": (
            *("crawl_speed", "field_speed", "second_order", "rigid_path", "friction_field"),
            *("speed_gradient", "power_gradient", "cost_gradient"),
        ),
        "Speed of a body on a line": (
            *("line_speed", "line_balance", "line_cycle_speed", "line_power", "line_speed_tanh"),
            *("line_speed_viscous", "line_series", "line_speed_series", "line_cycle_series"),
            "LAPLACE_LIMIT",
        ),
        "Deformation of a sheet": ("airy_series", "ritz_field"),
        "What calls return": (
            *(
                "CrawlSpeed",
                "Estimate",
                "SecondOrder",
                "SpeedGradient",
                "PowerGradient",
                "CostGradient",
            ),
            *("AirySeries", "RitzField"),
        ),
        "Errors and warnings": (
            *("SheetcrawlError", "NotConvergedError", "BeyondReachWarning", "ViscousRegimeWarning"),
        ),
    },
    "fem_check": {
        "Speed of a scene": (
            *("predict", "solve", "cycle_speed", "simulate", "rigid_ground", "speeds"),
            "plane_stress_field",
        ),
        "A scene and its effects": (
            *("Scene", "Material", "Membrane", "Bending", "Gravity", "Ground", "Friction", "Inertia"),
            *("SelfContact", "DeadLoad", "Terrain", "HeightMap", "Outline", "bilayer"),
        ),
        "The best outline": ("best_outline", "outline_gradient", "Trapezoid", "LegendreShape"),
        "Excitable waves": (*("FitzHughNagumo", "excitable_preset", "Excitation", "StrainFeedback"),),
        "Many scenes, the best scene": (
            *("sweep", "optimise", "Harmonics", "Bound", "Robust", "cycle_gradient"),
        ),
        "Schemes and settings": ("BackwardDifferences", "Newmark", "RunSettings", "__version__"),
        "What calls return": ("Prediction", "Trajectory", "RigidGround", "PlaneStressField"),
        "Files": ("write_paraview",),
    },
}
"""For each package the groups of its names, in the order in which they are shown."""


def summary(module: ModuleType, name: str) -> str:
    """What a public name is: the first sentence of its docstring; of a number, its value."""
    value = getattr(module, name)
    if not callable(value):
        return f"= {value}"
    first = " ".join((inspect.getdoc(value) or "").split("\n\n")[0].split())
    return first.replace("`", "")
