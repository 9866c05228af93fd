"""Parts of a scene from plain data, as written by `to_dict` and no other.

Nothing is filled in or ignored: every part is written again after it is read. Data that come back
different are refused, whatever a class would make of them: a left-out key with a default, True for 1, a
name for an object.
"""

import difflib
import math
import re
from collections.abc import Collection, Mapping
from dataclasses import fields, is_dataclass
from importlib import import_module
from typing import Any

from linear_theory.common import validation
from linear_theory.common.errors import SheetcrawlError
from linear_theory.friction.contact import Contact
from linear_theory.friction.directional import Directional
from linear_theory.friction.laws import FRICTION_LAWS
from linear_theory.friction.maps import Mapped, Patches
from linear_theory.friction.wrapped import OnLowerFace
from linear_theory.growth.growth import Growth
from linear_theory.growth.laws import GROWTH_LAWS
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.fractional import FractionalWave
from linear_theory.wave.measured import SampledWave
from linear_theory.wave.travelling import SineWave, TravellingWave

KINDS: dict[str, type] = {
    kind.__name__: kind
    for kind in (
        *(Sheet, SineWave, TravellingWave, FractionalWave, SampledWave, Growth, Contact),
        *(type(law) for law in GROWTH_LAWS.values()),
        *FRICTION_LAWS.values(),
        *(Directional, Mapped, OnLowerFace, Patches),
    )
}
"""Classes of the parts of a scene, by their names in the data."""

EFFECTS = "fem_check.shell.effects"
"""Module of the effects, imported by name if a scene has any."""

EXCITABLE = "fem_check.excitable"
"""Module of waves that solve an equation, imported by name if no other knows the class."""

COMPUTED: dict[type, float] = {SampledWave: 1e-6}
"""Relative difference allowed to numbers that a class computes anew when it is read. Their last digits
depend on the machine."""

MISSPELT = 0.85
"""Likeness of a name to the known one that may be meant."""

NUMBER = re.compile(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?")

FAULTS = (TypeError, KeyError, IndexError, OverflowError, AttributeError, ZeroDivisionError)
"""Raised by classes that are given something of a kind that they do not expect."""


class NotRestorable(SheetcrawlError, ValueError):
    """A part that plain data cannot hold, such as a function, and that must be passed again."""


def part_of(value: Any, where: str) -> Any:
    """A part of a scene from its data; where: its name, for messages.

    Raises NotRestorable for a class that is not known, and other ValueErrors for damaged data.

    >>> from linear_theory.scene.data import part_of
    >>> print(part_of({"type": "Tanh", "slip_speed": 0.1}, "friction"))
    tanh
    >>> part_of({"type": "Tanh", "slip_sped": 0.1}, "friction")
    Traceback (most recent call last):
    ValueError: friction.slip_sped: a Tanh has no such key, the nearest is 'slip_speed'
    """
    if isinstance(value, list | tuple):
        return [part_of(item, f"{where}[{i}]") for i, item in enumerate(value)]
    if not isinstance(value, Mapping):
        return value
    kind = _kind_of(value, where)
    if is_dataclass(kind) and not hasattr(kind, "from_data"):
        known = [f.name for f in fields(kind) if f.init and f.compare]
        check_keys(value, ("type", *known), where, f"a {kind.__name__}")
    arguments = {key: part_of(v, f"{where}.{key}") for key, v in value.items() if key != "type"}
    made = _made(kind, arguments, where)
    check_same(made.to_dict(), value, where, COMPUTED.get(kind, 0.0))
    return made


def _kind_of(value: Mapping[str, Any], where: str) -> type:
    """The class of a part."""
    name = value.get("type")
    if not isinstance(name, str):
        shown = validation.shown(dict(value))
        raise ValueError(f"{where} = {shown}: must have the key 'type', the name of its class")
    kind = KINDS.get(name) or _elsewhere(name)
    if kind is not None:
        return kind
    known = [*KINDS, *import_module(EFFECTS).__all__, *import_module(EXCITABLE).__all__]
    close = difflib.get_close_matches(name, known, n=1, cutoff=MISSPELT)
    hint = f", unless {close[0]!r} is meant" if close else ""
    raise NotRestorable(f"{where}: a {name} cannot be restored from data{hint}")


def _elsewhere(name: str) -> type | None:
    """A class of that public name among the effects or the excitable waves."""
    for module in map(import_module, (EFFECTS, EXCITABLE)):
        kind = getattr(module, name, None) if name in module.__all__ else None
        if isinstance(kind, type):
            return kind
    return None


def _made(kind: type, arguments: Mapping[str, Any], where: str) -> Any:
    """The object. Raises ValueError, with the place, whatever its class makes of the arguments."""
    try:
        return getattr(kind, "from_data", kind)(**arguments)
    except ValueError as error:
        kept = NotRestorable if isinstance(error, NotRestorable) else ValueError
        named = str(error).partition(" ")[0] in arguments  # "period = 0: must be > 0"
        raise kept(f"{where}{'.' if named else ': '}{error}") from None
    except FAULTS as error:
        raise ValueError(
            f"{where}: data of a {kind.__name__} must be its arguments ({error})"
        ) from None


def check_keys(
    data: Mapping[str, Any],
    known: Collection[str],
    where: str,
    what: str,
    spared: Collection[str] = (),
) -> None:
    """Raise ValueError for keys that are not known, and for known ones that are missing.

    what: the thing whose keys they are, for messages; spared: keys that may be missing.
    """
    for key in data:
        if key not in known:
            place = f"{where}.{key}" if where else str(key)
            close = difflib.get_close_matches(str(key), list(known), n=1)
            hint = f", the nearest is {close[0]!r}" if close else f", its keys are {', '.join(known)}"
            raise ValueError(f"{place}: {what} has no such key{hint}")
    missing = [key for key in known if key not in data and key not in spared]
    if missing:
        raise ValueError(f"{where or 'data'}: {what} must have {', '.join(missing)}")


def check_same(written: Any, given: Any, where: str, rtol: float = 0.0) -> None:
    """Raise ValueError, with the place, unless what is written of a part is what was given.

    rtol: relative difference at which numbers still count as the same.
    """
    if isinstance(written, Mapping) and isinstance(given, Mapping):
        check_keys(given, written, where, "it")
        for key, value in written.items():
            check_same(value, given[key], f"{where}.{key}", rtol)
    elif isinstance(written, list) and isinstance(given, list | tuple) and len(written) == len(given):
        for i, (one, other) in enumerate(zip(written, given, strict=True)):
            check_same(one, other, f"{where}[{i}]", rtol)
    elif not _agree(written, given, rtol):
        raise ValueError(
            f"{where} = {validation.shown(given)}: is read as {validation.shown(written)}; must be as "
            "Scene.to_dict() writes it"
        )


def _agree(one: Any, other: Any, rtol: float) -> bool:
    """Whether two values are the same, for numbers up to rtol, also those within text."""
    if isinstance(one, bool) or isinstance(other, bool):
        return one is other
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=rtol)
    if isinstance(one, int | float) and isinstance(other, int | float):
        return one == other
    if isinstance(one, str) and isinstance(other, str):
        return str(one) == str(other) or (rtol > 0 and _rounded(one) == _rounded(other))
    return one is None and other is None


def _rounded(text: str) -> str:
    """The text with its numbers rounded to two digits."""
    return NUMBER.sub(lambda found: f"{float(found[0]):.2g}", text)
