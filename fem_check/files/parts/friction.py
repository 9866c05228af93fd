"""The law of friction of a scene file: its form, its direction and its map, to and fro."""

from collections.abc import Sequence
from typing import Any

from fem_check.files.quantities import Quantity, direction
from fem_check.files.system import System
from fem_check.files.tables import FrictionMapTable, FrictionTable
from linear_theory.common import validation
from linear_theory.friction.directional import Directional
from linear_theory.friction.isotropic import Isotropic
from linear_theory.friction.law import FrictionLaw
from linear_theory.friction.laws import FRICTION_LAWS, Coulomb, Tanh, Viscous
from linear_theory.friction.maps import Mapped, Patches
from linear_theory.friction.wrapped import OnLowerFace

LAWS = {Coulomb.name: "dry", Tanh.name: "tanh", Viscous.name: "viscous"}
"""What a file calls the laws of friction."""

TANH = LAWS[Tanh.name]


def law_of(table: FrictionTable, system: System) -> FrictionLaw:
    """The law. Raises ValueError, naming the key, for keys that do not go together."""
    law = _directed(table, system, _form(table, system))
    if table.map is not None:
        law = Mapped(law, _patches(table.map, system))
    return OnLowerFace(law) if table.surface == "bottom" else law


def _form(table: FrictionTable, system: System) -> Isotropic:
    name = table.law or (LAWS[Coulomb.name] if table.slip_speed is None else TANH)
    if (table.slip_speed is None) == (name == TANH):
        must = "given for" if table.slip_speed is None else "left out but for"
        raise ValueError(f"slip_speed: must be {must} law = {TANH!r}")
    if table.slip_speed is not None:
        return Tanh(system.number(table.slip_speed))
    return Coulomb() if name == LAWS[Coulomb.name] else Viscous()


def _directed(table: FrictionTable, system: System, form: Isotropic) -> FrictionLaw:
    forward, backward = table.forward, table.backward
    if forward is None or backward is None:
        for name in ("forward", "backward", "sideways", "heading", "fixed_to"):
            if name in table.model_fields_set:
                lacking = "forward" if forward is None else "backward"
                raise ValueError(f"{lacking}: must be given beside {name}")
        return form
    heading = 0.0 if table.heading is None else _heading(table.heading)
    return Directional(forward, backward, table.sideways, heading, table.fixed_to, form)  # type: ignore[arg-type]


def _heading(given: Quantity) -> float:
    """In radians. Raises ValueError, in the units of the file."""
    try:
        return direction(given)
    except ValueError as problem:
        raise ValueError(f"heading = {given.text!r}: {problem}") from None


def _patches(table: FrictionMapTable, system: System) -> Patches:
    if not len(table.x) == len(table.y) == len(table.mu):
        counts = f"{len(table.x)}, {len(table.y)} and {len(table.mu)}"
        raise ValueError(f"map: x, y and mu must have one entry for each patch, and have {counts}")
    sides = {"x": table.x, "y": table.y}
    spans = {
        name: [_span(f"{name}[{i}]", name, pair, system) for i, pair in enumerate(pairs)]
        for name, pairs in sides.items()
    }
    rows = zip(spans["x"], spans["y"], table.mu, strict=True)
    patches = [[*x, *y, mu] for x, y, mu in rows]
    return Patches(patches, system.number(table.edge), table.outside, table.fixed_to)


def _span(key: str, axis: str, pair: Sequence[Quantity], system: System) -> tuple[float, float]:
    """The ends of a patch along an axis. Raises ValueError, in the units of the file."""
    low, high = map(system.number, pair)
    if not low < high:
        shown = ", ".join(end.text for end in pair)
        raise ValueError(f"map: {key} = [{shown}]: must have {axis}_min < {axis}_max")
    return low, high


def entries_of(law: FrictionLaw) -> dict[str, Any]:
    """What a file says of a law.

    Raises ValueError for a law of one's own, and for a map that is a function.
    """
    if type(law) is OnLowerFace:
        return {**entries_of(law.law), "surface": "bottom"}
    if type(law) is Mapped:
        return {**entries_of(law.law), "map": _map_entries(law.map)}
    if type(law) is Directional:
        names = ("forward", "backward", "sideways", "heading")
        own = {name: getattr(law, name) for name in names}
        return {**entries_of(law.form), **own, "fixed_to": str(law.fixed_to)}
    if type(law) not in FRICTION_LAWS.values():
        raise ValueError(f"friction = {validation.shown(law)}: has no name in a scene file")
    entries = {"law": LAWS[law.name]}
    return {**entries, "slip_speed": law.width} if law.regularised else entries


def entries_of_effect(coefficient: float, law: FrictionLaw) -> dict[str, Any]:
    """What a file says of friction with a coefficient. Raises ValueError for other laws than tanh."""
    entries = entries_of(law)
    if entries["law"] != TANH:
        raise ValueError(
            f"law = {validation.shown(law)}: cannot be written to a scene file beside a coefficient, "
            "which there goes with Tanh(slip_speed) alone; keep the scene by to_dict(), which is plain "
            "data for a scene.json"
        )
    return {"coefficient": coefficient, **entries}


def _map_entries(found: Any) -> dict[str, Any]:
    if type(found) is not Patches:
        shown = validation.shown(found)
        raise ValueError(f"map = {shown}: a scene file holds no functions, must be Patches")
    x, y = ([list(patch[i : i + 2]) for patch in found.patches] for i in (0, 2))
    sizes = {"edge": found.edge, "outside": found.outside, "fixed_to": str(found.fixed_to)}
    return {"x": x, "y": y, "mu": [patch[4] for patch in found.patches], **sizes}
