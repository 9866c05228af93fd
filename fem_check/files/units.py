"""Units by name: those that most people write at once, all that pint knows when another is asked for.

Reading pint's list takes half a second, ten times as long as a speed of the closed form. Both are one
registry: units that were named before the list was read stay comparable with those named after it.
"""

import re
import threading
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pint

COMMON = """
micro- = 1e-6 = µ- = μ- = u- = mu- = mc-
milli- = 1e-3 = m-
centi- = 1e-2 = c-
kilo- = 1e3 = k-
mega- = 1e6 = M-
giga- = 1e9 = G-
pi = 3.1415926535897932384626433832795028841971693993751 = π
meter = [length] = m = metre
second = [time] = s = sec
gram = [mass] = g
radian = [] = rad
percent = 0.01 = %
minute = 60 * second = min
hour = 60 * minute = h = hr
degree = π / 180 * radian = deg
newton = kilogram * meter / second ** 2 = N
pascal = newton / meter ** 2 = Pa
"""
"""Some definitions of pint's own list, in its order, in which prefixes are tried."""

NAMES = """
m mm cm um µm μm km meter meters metre metres millimeter millimeters micrometer
s ms min h sec second seconds minute minutes hour hours millisecond milliseconds
g kg mg N mN Pa kPa MPa GPa pascal percent rad mrad radian milliradian deg degree degrees
dimensionless
"""
WORDS = frozenset(NAMES.split())
"""How they are written. Other words might be read as another unit by a list that is not whole: "cd"."""

WORD = re.compile(r"[^\W\d]\w*")

LOCK = threading.RLock()
"""There is one registry, whichever thread asks first."""


def registry(text: str = "") -> "pint.UnitRegistry[Any]":
    """Of the units in a text, and of all that were named before."""
    with LOCK:
        if not WORDS.issuperset(WORD.findall(_spelt(text))):
            _read_all()
        return _made()


def unit_named(text: str) -> "pint.Unit":
    """The unit of that name. Raises one of many exceptions of pint's where there is none.

    >>> from fem_check.files.units import unit_named
    >>> print(unit_named("kPa/mm^2"), unit_named("inch"))
    kilopascal / millimeter ** 2 inch
    """
    return registry(text).parse_units(_spelt(text))


def _spelt(text: str) -> str:
    return text.replace("%", "percent")


@cache
def _made() -> "pint.UnitRegistry[Any]":
    import pint  # a quarter of a second, for those who write units

    return pint.UnitRegistry(COMMON.splitlines(), on_redefinition="ignore", cache_folder=None)


@cache
def _read_all() -> None:
    _made().load_definitions(whole_list())


def whole_list() -> Path:
    """Pint's own definitions."""
    import pint

    return Path(pint.__file__).with_name("default_en.txt")
