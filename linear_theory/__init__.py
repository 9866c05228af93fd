"""How fast a sheet driven by a travelling wave of growth crawls: closed form, series, balance."""

from linear_theory.airy import AirySeries, airy_series
from linear_theory.crawl import crawl_speed, field_speed, friction_field
from linear_theory.errors import (
    BeyondReachWarning,
    NotConvergedError,
    SheetcrawlError,
    ViscousRegimeWarning,
)
from linear_theory.field_wave import FieldWave
from linear_theory.line import (
    LAPLACE_LIMIT,
    line_balance,
    line_cycle_series,
    line_cycle_speed,
    line_series,
    line_speed,
    line_speed_series,
    line_speed_tanh,
    line_speed_viscous,
)
from linear_theory.path import rigid_path
from linear_theory.pulse import pulse_wave
from linear_theory.ritz import RitzField, ritz_field
from linear_theory.second_order import SecondOrder, second_order
from linear_theory.sheet import Sheet
from linear_theory.si import Scale, speed_si
from linear_theory.speed import CrawlSpeed
from linear_theory.version import current_version
from linear_theory.waves import SineWave, TravellingWave

__version__ = current_version()

__all__ = [
    "LAPLACE_LIMIT",
    "AirySeries",
    "BeyondReachWarning",
    "CrawlSpeed",
    "FieldWave",
    "NotConvergedError",
    "RitzField",
    "Scale",
    "SecondOrder",
    "Sheet",
    "SheetcrawlError",
    "SineWave",
    "TravellingWave",
    "ViscousRegimeWarning",
    "airy_series",
    "crawl_speed",
    "field_speed",
    "friction_field",
    "line_balance",
    "line_cycle_series",
    "line_cycle_speed",
    "line_series",
    "line_speed",
    "line_speed_series",
    "line_speed_tanh",
    "line_speed_viscous",
    "pulse_wave",
    "rigid_path",
    "ritz_field",
    "second_order",
    "speed_si",
]
