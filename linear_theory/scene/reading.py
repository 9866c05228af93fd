"""Scenes from plain data, as written by `Scene.to_dict`."""

from collections.abc import Iterable, Mapping
from importlib import import_module
from typing import Any

from linear_theory.common import validation
from linear_theory.friction.contact import Contact
from linear_theory.friction.laws import FRICTION_LAWS
from linear_theory.growth.growth import Growth
from linear_theory.growth.laws import GROWTH_LAWS
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.measured import SampledWave
from linear_theory.wave.travelling import SineWave, TravellingWave

KINDS: dict[str, type] = {
    kind.__name__: kind
    for kind in (
        *(Sheet, SineWave, TravellingWave, SampledWave, Growth, Contact),
        *(type(law) for law in GROWTH_LAWS.values()),
        *FRICTION_LAWS.values(),
    )
}
"""Classes of the parts of a scene, by their names in the data."""

EFFECTS, MESHES = "fem_check.shell.effects", "fem_check.mesh.elements"
"""Modules of effects and meshes, imported by name if a scene has any."""

RESOLUTION = ("cells", "mesh", "element")

Data = Mapping[str, Any]


def arguments_of(data: Data, given: Iterable[str]) -> tuple[dict[str, Any], Contact | None]:
    """The arguments of `Scene` that are not in `given`, and its contact.

    Raises ValueError for data that are not those of a scene, and for parts that cannot be stored as
    text.
    """
    if not isinstance(data, Mapping) or data.get("type") != "Scene":
        raise ValueError(f"data = {validation.shown(data)}: must be what Scene.to_dict() returns")
    names = [n for n in ("sheet", "wave", "growth", "effects", *RESOLUTION) if n not in given]
    missing = [name for name in names if name not in data and name not in RESOLUTION]
    if missing:
        raise ValueError(f"data: a scene must have {', '.join(missing)}")
    found = {name: _part(data.get(name), name) for name in names if name not in RESOLUTION}
    if any(data.get(name) is not None for name in RESOLUTION):
        found |= import_module(MESHES).from_data({n: data.get(n) for n in names if n in RESOLUTION})
    contact = _part(data.get("contact"), "contact") if "contact" not in given else None
    return found, contact


def _part(value: Any, where: str) -> Any:
    """A part of a scene from its data; where: its name, for messages."""
    if isinstance(value, list | tuple):
        return [_part(item, f"{where}[{i}]") for i, item in enumerate(value)]
    if not isinstance(value, Mapping):
        return value
    name = value.get("type")
    kind = KINDS.get(str(name)) or getattr(import_module(EFFECTS), str(name), None)
    if not isinstance(kind, type):
        raise ValueError(
            f"{where} = {validation.shown(dict(value))}: a {name} cannot be restored from its data; "
            f"pass it: Scene.from_dict(data, {where.partition('[')[0]}=...)"
        )
    arguments = {key: _part(v, f"{where}.{key}") for key, v in value.items() if key != "type"}
    made = getattr(kind, "from_data", kind)
    try:
        return made(**arguments)
    except TypeError as error:
        raise ValueError(f"{where}: data of a {name} must be its arguments ({error})") from None
