"""How fast a sheet driven by a travelling wave of growth crawls: closed form, series, balance."""

from linear_theory.sheet import Sheet
from linear_theory.waves import SineWave, TravellingWave

__all__ = ["Sheet", "SineWave", "TravellingWave"]
