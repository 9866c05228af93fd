"""Speed of a sheet driven by a travelling wave of growth: closed forms, series, friction balance."""

from linear_theory.common.errors import (
    BeyondReachWarning,
    NotConvergedError,
    SheetcrawlError,
    ViscousRegimeWarning,
)
from linear_theory.common.tolerance import Tolerance
from linear_theory.common.version import current_version
from linear_theory.deformation.airy import AirySeries, airy_series
from linear_theory.deformation.ritz import RitzField, ritz_field
from linear_theory.friction.contact import Contact
from linear_theory.friction.directional import Directional
from linear_theory.friction.isotropic import Isotropic
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.laws import Coulomb, Tanh, Viscous
from linear_theory.friction.load import Load
from linear_theory.friction.maps import GivenMap, Mapped, Patches
from linear_theory.friction.wrapped import OnLowerFace
from linear_theory.gradient import (
    CostGradient,
    PowerGradient,
    SpeedGradient,
    cost_gradient,
    power_gradient,
    speed_gradient,
)
from linear_theory.growth.bilayer import bilayer
from linear_theory.growth.growth import Growth
from linear_theory.growth.laws import Exp, GrowthLaw, Linear, Metric
from linear_theory.line import (
    LAPLACE_LIMIT,
    line_balance,
    line_cycle_series,
    line_cycle_speed,
    line_power,
    line_series,
    line_speed,
    line_speed_series,
    line_speed_tanh,
    line_speed_viscous,
)
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet
from linear_theory.speed.crawl import crawl_speed, field_speed
from linear_theory.speed.friction_field import friction_field
from linear_theory.speed.path import rigid_path
from linear_theory.speed.result import CrawlSpeed, Estimate
from linear_theory.speed.second_order import SecondOrder, second_order
from linear_theory.speed.si import Scale, speed_si
from linear_theory.wave.fractional import FractionalWave
from linear_theory.wave.given import FieldWave
from linear_theory.wave.measured import SampledWave
from linear_theory.wave.pulse import pulse_wave
from linear_theory.wave.travelling import SineWave, TravellingWave

__version__ = current_version()

__all__ = [
    "LAPLACE_LIMIT",
    "AirySeries",
    "BeyondReachWarning",
    "Contact",
    "CostGradient",
    "Coulomb",
    "CrawlSpeed",
    "Directional",
    "Estimate",
    "Exp",
    "FieldWave",
    "FractionalWave",
    "FrictionLaw",
    "GivenMap",
    "Growth",
    "GrowthLaw",
    "Isotropic",
    "Linear",
    "Load",
    "Mapped",
    "Metric",
    "NotConvergedError",
    "OnLowerFace",
    "Patches",
    "PowerGradient",
    "RitzField",
    "SampledWave",
    "Scale",
    "Scene",
    "SecondOrder",
    "Sheet",
    "SheetcrawlError",
    "SineWave",
    "SpeedGradient",
    "Tanh",
    "Tolerance",
    "TravellingWave",
    "Viscous",
    "ViscousRegimeWarning",
    "airy_series",
    "bilayer",
    "cost_gradient",
    "crawl_speed",
    "field_speed",
    "friction_field",
    "line_balance",
    "line_cycle_series",
    "line_cycle_speed",
    "line_power",
    "line_series",
    "line_speed",
    "line_speed_series",
    "line_speed_tanh",
    "line_speed_viscous",
    "power_gradient",
    "pulse_wave",
    "rigid_path",
    "ritz_field",
    "second_order",
    "speed_gradient",
    "speed_si",
]
