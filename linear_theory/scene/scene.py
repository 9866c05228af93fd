"""The scene, which states the problem: sheet, wave, growth, contact with the ground, other effects.

A scene is plain data. It is neither discretised nor solved here: every level reads it and refuses
scenes that it cannot represent. Effects that a scene does not name are neglected by all levels.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from linear_theory.common import validation
from linear_theory.common.errors import Unidentifiable
from linear_theory.common.shown import Shown, in_words
from linear_theory.friction.contact import Contact
from linear_theory.friction.laws import friction_law
from linear_theory.friction.load import Load
from linear_theory.growth.growth import Growth
from linear_theory.identity import content_key
from linear_theory.scene.agreement import (
    GROWTH,
    check_agrees,
    check_growth,
    check_not_given,
    growth_of,
)
from linear_theory.scene.checks import check_parts
from linear_theory.scene.effects import checked_effects, contact_of, in_order
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave import arguments
from linear_theory.wave.phases import phases
from linear_theory.wave.places import among
from linear_theory.wave.protocol import Drive, Wave
from linear_theory.wave.sampled import drive

Array = NDArray[np.float64]

ELEMENTS = "fem_check.mesh.elements"
"""The module for meshes, imported by name if a scene specifies cells, a mesh or an element."""

FILES = "fem_check.files"
"""The package that knows scene files, likewise."""

PARTS = ("sheet", "wave", "growth", "contact", "effects", "elements")
"""Parts of a scene, from which its key is computed."""


@dataclass(frozen=True, eq=False, init=False)
class Scene(Shown):
    """A sheet driven by a wave of growth, with the effects that are named.

    sheet: rectangle, thickness and Poisson ratio. wave: c(x, y, t) with its period. alpha: growth
    strain per c; curvature_coupling: beta of eq. 4, 1/length; growth_law, curvature, area: those of
    `Growth`, which may be given instead as `growth`. effects: any of Bending, Gravity, Ground,
    Friction, Inertia and DeadLoad, at most one of each, always together with `Membrane`; none for a
    sheet that only stretches in its plane. contact: normal load and friction law, unless the effects
    define them; by default "current" load and dry friction. cells: elements across and along, two
    integers. mesh: instead of cells, a scikit-fem mesh of another outline in the coordinates of the
    sheet. element: of scikit-fem. These three apply to finite elements and are by default chosen to
    resolve the wave.

    Scenes with the same content are equal and have the same `key`. Raises ValueError, naming the
    argument, for values out of range, for effects that contradict each other, the contact or the sheet,
    and for effects that lack what they require (friction without load).

    >>> from fem_check import Bending, Material, Membrane
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> material = Material(thickness=0.03, poisson=0.5)
    >>> stretching, bending = Membrane(material), Bending(material)
    >>> for effects in ([stretching], [stretching, bending]):
    ...     print(Scene(Sheet(), SineWave(), alpha=0.25, effects=effects).components)
    2
    3
    >>> one, other = (Scene(Sheet(), SineWave(), alpha=0.25) for _ in range(2))
    >>> print(one == other, one.but(alpha=0.1) == other)
    True False
    """

    sheet: Sheet
    wave: Wave
    growth: Growth
    contact: Contact
    effects: tuple[Any, ...]
    elements: Any
    _said: Contact | None = field(repr=False)

    def __init__(
        self,
        sheet: Sheet,
        wave: Wave,
        alpha: float | None = None,
        curvature_coupling: float | None = None,
        effects: Sequence[Any] = (),
        growth_law: Any = None,
        curvature: Any = None,
        area: Any = None,
        cells: tuple[int, int] | None = None,
        mesh: Any = None,
        element: Any = None,
        *,
        growth: Growth | None = None,
        contact: Contact | None = None,
    ) -> None:
        sheet, wave = arguments.sheet(sheet), arguments.wave(wave)
        said = (alpha, curvature_coupling, growth_law, curvature, area)
        self._set(
            sheet=sheet,
            wave=wave,
            growth=growth_of(growth, dict(zip(GROWTH.values(), said, strict=True))),
            effects=tuple(effect.under(sheet) for effect in in_order(checked_effects(effects))),
            _said=None if contact is None else validation.instance("contact", contact, Contact),
        )
        self._set(contact=contact_of(self.effects, self.components, self._said))
        self._set(elements=self._elements(cells, mesh, element))
        check_parts(self)

    def _set(self, **parts: Any) -> None:
        for name, value in parts.items():
            object.__setattr__(self, name, value)

    def but(self, **changes: Any) -> "Scene":
        """A copy of the scene with the given arguments replaced.

        >>> from linear_theory import Scene, Sheet, SineWave
        >>> scene = Scene(Sheet(), SineWave(), alpha=0.25, growth_law="linear")
        >>> print(scene.but(alpha=0.1).growth.law)
        linear
        """
        known = {"sheet": self.sheet, "wave": self.wave, "contact": self._said}
        if "growth" not in changes:
            said = {name: getattr(self.growth, part) for name, part in GROWTH.items()}
            known |= {name: changes.get(name, value) for name, value in said.items()}
        return Scene(**{**known, "effects": self.effects, **self._resolution(), **changes})

    def resting(
        self, load: Any = None, friction: Any = None, slip_speed: float | None = None
    ) -> "Scene":
        """The scene with the given load and friction, names or objects; None keeps its own.

        Raises ValueError for unknown names, and if an effect or the contact of the scene contradicts
        them.
        """
        if load is None and friction is None and slip_speed is None:
            return self
        own = self.contact
        asked = Load.named(load, tuple(Load)) if load is not None else own.load
        law = own.friction
        if friction is not None or slip_speed is not None:
            law = friction_law("tanh" if friction is None else friction, slip_speed)
        if self._said is not None:
            check_agrees("load", asked, own.load)
            check_agrees("friction", law, own.friction)
            return self
        return self.but(contact=Contact(asked, law))

    @property
    def alpha(self) -> float:
        """Growth strain per c."""
        return self.growth.alpha

    @property
    def curvature_coupling(self) -> float:
        """beta of eq. 4, 1/length."""
        return self.growth.curvature_coupling

    @property
    def period(self) -> float:
        """Of the wave."""
        return float(self.wave.period)

    @property
    def unit(self) -> float:
        """Unit of speeds, length of the sheet per period."""
        return self.sheet.length / self.period

    @property
    def states_contact(self) -> bool:
        """Whether its contact was given, not taken from effects or defaults."""
        return self._said is not None

    @property
    def planar(self) -> bool:
        """Whether no effect requires the third component."""
        return not any(effect.needs_space for effect in self.effects)

    @property
    def components(self) -> int:
        """2 in the plane, 3 in space."""
        return 2 if self.planar else 3

    @property
    def cells(self) -> tuple[int, int] | None:
        """Elements across and along, if given."""
        return None if self.elements is None else self.elements.cells

    @property
    def mesh(self) -> Any:
        """The mesh of another outline, if given."""
        return None if self.elements is None else self.elements.mesh

    def find(self, kind: type) -> Any:
        """The effect of that class; None if the scene does not name it."""
        return next((effect for effect in self.effects if isinstance(effect, kind)), None)

    @cached_property
    def drive(self) -> Drive:
        """The wave on the sheet, or on the body covered by the mesh."""
        centres = None if self.mesh is None else among(*self.mesh.p[:, self.mesh.t].mean(1))
        return drive(self.wave, self.sheet, centres)

    def speed_per_rate(self, leading: bool) -> float:
        """Largest V for dc/dt of root mean square 1, see `Drive.speed_per_rate`.

        A rest curvature of c times its coupling tilts the sheet by that times a wavelength/(2 pi).
        """
        bent = abs(self.curvature_coupling) * self.sheet.length / (2 * np.pi)
        return self.drive.speed_per_rate(abs(self.alpha) + bent, leading)

    def key(self) -> str:
        """64 hexadecimal digits, the same for every scene with this content, in every process.

        Scenes with the same key give the same numbers. Raises Unidentifiable, a ValueError that says
        what to name, for a function that cannot be identified by its content.
        """
        parts = {name: content_key(getattr(self, name), name) for name in PARTS}
        return content_key(parts, "scene")

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scene):
            return NotImplemented
        try:
            return self is other or self.key() == other.key()
        except Unidentifiable:
            return False

    def __hash__(self) -> int:
        return hash((self.sheet, self.growth, self.contact))

    @classmethod
    def stated(
        cls,
        sheet: "Sheet | Scene",
        wave: Wave | None,
        alpha: float | None,
        load: Any = None,
        friction: Any = None,
        slip_speed: float | None = None,
        **growth: Any,
    ) -> "Scene":
        """The scene of a call: made from sheet, wave and alpha, or a complete scene.

        growth: growth_law and area; load, friction: names or objects, None for the defaults or those of
        the scene; a scene that states neither contact nor such effects takes those given. Raises
        ValueError as Scene does, for a wave or alpha in addition to a scene, and for arguments that
        contradict it.
        """
        if not isinstance(sheet, Scene):
            contact = Contact.named(load, friction, slip_speed)
            if alpha is None:
                raise ValueError("alpha = None: must be given; the arguments are sheet, wave, alpha")
            return cls(sheet, wave, alpha, contact=contact, **growth)  # type: ignore[arg-type]
        check_not_given("a scene", wave=wave, alpha=alpha)
        check_growth(sheet.growth, growth)
        return sheet.resting(load, friction, slip_speed)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any], **given: Any) -> "Scene":
        """The scene written by `to_dict`, also from JSON; given: arguments that replace its own.

        Raises ValueError for data that differ in anything from what `to_dict` writes, and for functions
        (waves, ground) and classes of one's own, which data cannot hold: pass the part that has them,
        as wave=wave. Effects that are passed say what the load and the friction are.

        >>> import json
        >>> from linear_theory import Scene, Sheet, SineWave
        >>> scene = Scene(Sheet(width=0.3), SineWave(), alpha=0.25)
        >>> print(Scene.from_dict(json.loads(json.dumps(scene.to_dict()))) == scene)
        True
        """
        from linear_theory.scene.reading import scene_of  # here: it makes scenes

        return scene_of(cls, data, given)

    @classmethod
    def from_toml(cls, path: str | Path) -> "Scene":
        """The scene of a scene file: see `sheetcrawl new`, which writes examples with comments.

        Raises ValueError that lists all that is wrong in the file, each with its line, table and key.
        """
        scene: Scene = import_module(FILES).read(path).scene
        return scene

    def to_toml(self, path: str | Path) -> Path:
        """Write a scene file that holds the same scene, in units of the sheet, and return its path.

        Raises ValueError for a scene with functions in it, which no text holds, and OSError where the
        file cannot be written.

        >>> import tempfile
        >>> from linear_theory import Scene, Sheet, SineWave
        >>> scene = Scene(Sheet(width=0.3), SineWave(), alpha=0.25)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = scene.to_toml(f"{folder}/strip.toml")
        ...     print(Scene.from_toml(path) == scene)
        True
        """
        written: Path = import_module(FILES).write(self, path)
        return written

    def _title(self) -> str:
        effects = ", ".join(type(effect).__name__ for effect in self.effects)
        return f"Scene: {'in the plane' if self.planar else 'in space'}, {effects or 'stretching'}"

    def _rows(self) -> Mapping[str, Any]:
        growth = [f"{said}={in_words(getattr(self.growth, name))}" for said, name in GROWTH.items()]
        rows = {"sheet": self.sheet, "wave": self.wave, "growth": ", ".join(growth)}
        rows["contact"] = self.contact
        rows["elements"] = "as the wave needs" if self.elements is None else self.elements
        return {**rows, **{f"effects[{i}]": effect for i, effect in enumerate(self.effects)}}

    def _contents(self) -> Mapping[str, Any]:
        parts = {name: getattr(self, name) for name in PARTS if name != "elements"}
        return {**parts, **(self._resolution() if self.elements is None else self.elements.contents())}

    def _resolution(self) -> dict[str, Any]:
        own = self.elements
        return {n: None if own is None else getattr(own, n) for n in ("cells", "mesh", "element")}

    def _elements(self, cells: Any, mesh: Any, element: Any) -> Any:
        if cells is None and mesh is None and element is None:
            return None
        return import_module(ELEMENTS).Elements(cells, mesh, element).on(self.sheet)

    @cached_property
    def extremes(self) -> Array:
        """c on a grid of times and points, to detect growth for which no rest state exists.

        Of a wave that the strain acts back on, as it is without that.
        """
        x, y = np.array([-0.5, 0, 0.5]) * self.sheet.width, np.linspace(-0.5, 0.5, 33)
        x, y, times = x[:, None], self.sheet.length * y, np.append(phases(self.period, 64), 0.0)
        return self.drive.alone.value(x, y, times[:, None, None])
