"""The effects that a scene file names, and what it says of the contact where they do not."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from fem_check.files.mistakes import Mistakes
from fem_check.files.parts.friction import TANH, law_of
from fem_check.files.parts.made import Made
from fem_check.files.parts.terrains import terrain_of
from fem_check.files.system import System
from fem_check.files.tables import (
    DeadLoadTable,
    FrictionTable,
    GravityTable,
    GroundTable,
    InertiaTable,
    SelfContactTable,
)
from fem_check.files.units import registry
from fem_check.shell.effects.contact.self_contact import SelfContact
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.material import Material
from linear_theory.friction.contact import Contact
from linear_theory.friction.load import Load
from linear_theory.scene.scene import Scene
from linear_theory.sheet.rectangle import Sheet

EFFECTS = ("friction", "bending", "gravity", "ground", "inertia", "self_contact", "dead_load")
"""Tables that are effects; [friction] is one where it has a coefficient."""

STANDARD_GRAVITY = "9.80665 m/s^2"


class Effects:
    """Makes effects of their tables."""

    def __init__(
        self, system: System, sheet: Sheet, folder: Path, mistakes: Mistakes, made: Made
    ) -> None:
        self.system, self.sheet, self.folder, self.mistakes = system, sheet, folder, mistakes
        self.made = made

    def material(self, young: Any) -> Material:
        """Of the sheet; with units Young's modulus is the unit of stress."""
        plain = young.number if young is not None and young.unit is None else 1.0
        return Material(self.sheet.thickness, self.sheet.poisson, plain)

    def of(self, name: str, table: Any, material: Material) -> Any:
        """The effect of a table. Raises ValueError, naming the key, for what it cannot be."""
        if name == "bending":
            return Bending(material)
        if name == "inertia":
            return self._inertia(table, material)
        if name == "self_contact":
            return self._self_contact(table, material)
        makers: dict[str, Callable[[Any], Any]] = {
            "friction": self._friction,
            "gravity": self._gravity,
            "ground": self._ground,
            "dead_load": self._dead_load,
        }
        return makers[name](table)

    def _friction(self, table: FrictionTable) -> Friction:
        if table.law not in (None, TANH):
            raise ValueError(
                f"law = {table.law!r}: must be {TANH!r} where a coefficient is given, or that "
                "left out for a sheet that is stiff against its friction"
            )
        for name in ("load", "slope"):
            if name in table.model_fields_set:
                raise ValueError(f"{name}: must be left out, gravity and ground say it")
        if table.slip_speed is None:
            raise ValueError(
                "slip_speed: must be given with a coefficient, such as '0.01 mm/s': friction is dry "
                "where the sheet slides twenty times as fast, viscous where it is slower"
            )
        assert table.coefficient is not None
        return Friction(table.coefficient, law=law_of(table, self.system))

    def _gravity(self, table: GravityTable) -> Gravity:
        if (table.weight is None) == (table.density is None):
            raise ValueError("weight, density: one of them must be given, and no other")
        incline = self.system.number(table.incline)
        return Gravity(self._weight(table), Load(table.load), incline)

    def _weight(self, table: GravityTable) -> float:
        """Force per area, in the units of the file."""
        if table.weight is not None:
            return self.system.number(table.weight)
        if self.system.plain or table.density is None or table.density.unit is None:
            raise ValueError("density: must have a unit, or weight be given, since g has one")
        young, quantity = self.system.young, registry().Quantity
        assert young is not None
        thickness = quantity(self.sheet.thickness, self.system.length)
        density = quantity(table.density.number, table.density.unit)
        weight = density * quantity(STANDARD_GRAVITY) * thickness
        return float((weight / quantity(young.number, young.unit)).to("dimensionless").magnitude)

    def _ground(self, table: GroundTable) -> Ground:
        number = self.system.number
        height = None
        if table.terrain is not None:
            of = (table.terrain, self.system, self.sheet)
            with self.mistakes.under("ground", "terrain"):
                height = self.made.part("terrain", of, lambda: terrain_of(*of, self.folder))
        return Ground(
            number(table.stiffness), number(table.damping), Load(table.load), height, table.form
        )

    def _inertia(self, table: InertiaTable, material: Material) -> Inertia:
        return Inertia(self.system.number(table.density), material)

    def _self_contact(self, table: SelfContactTable, material: Material) -> SelfContact:
        given = (table.gap, table.stiffness)
        return SelfContact(material, *(None if q is None else self.system.number(q) for q in given))

    def _dead_load(self, table: DeadLoadTable) -> DeadLoad:
        return DeadLoad(tuple(map(self.system.number, table.force)))


def effects_of(
    tables: Mapping[str, Any],
    system: System,
    sheet: Sheet,
    folder: Path,
    mistakes: Mistakes,
    made: Made,
) -> list[Any]:
    """Those that tables name; stretching with any of them, and with Young's modulus."""
    named = [name for name in EFFECTS if name in tables]
    if "friction" in named and tables["friction"].coefficient is None:
        named.remove("friction")
    young = tables["sheet"].young
    if not named and (young is None or young.unit is not None):
        return []
    maker = Effects(system, sheet, folder, mistakes, made)
    material = maker.material(young)
    found: list[Any] = [Membrane(material)]
    for name in named:
        with mistakes.under(name):
            found.append(maker.of(name, tables[name], material).under(sheet))
    return found


def with_contact(scene: Scene, table: FrictionTable | None, system: System) -> Scene:
    """The scene with what a file says of load and friction, where no effect says it."""
    if table is None or table.coefficient is not None:
        return scene
    law = law_of(table, system)
    load = scene.contact.load if table.load is None else Load(table.load)
    slope = scene.contact.slope if table.slope is None else table.slope
    return scene.but(contact=Contact(load, law, slope))
