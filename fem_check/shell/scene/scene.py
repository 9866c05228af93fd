"""What is simulated: a sheet, its wave, the couplings of growth and the effects that act on it.

What a scene does not name is neither built nor evaluated. Where no effect needs the third component
the scene is planar: two displacement components on continuous elements and first derivatives only.
"""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import skfem
from numpy.typing import ArrayLike, NDArray

from fem_check.mesh.checks import check_fits, check_mesh
from fem_check.mesh.shown import MeshShown
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction, load_bearer
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Region
from fem_check.shell.kinematics.rest_state import CURVATURE_FORMS, MEASURES, RestState, grown_state
from fem_check.shell.kinematics.shape_functions import is_global
from fem_check.shell.scene.growth import GROWTH_LAWS, metric_factor
from fem_check.shell.statics.potential import Potential
from linear_theory.common import validation
from linear_theory.common.shown import Shown, in_words
from linear_theory.deformation.field import Wave
from linear_theory.deformation.load_cases import phases
from linear_theory.scene import arguments
from linear_theory.sheet.rectangle import Sheet
from linear_theory.wave.survey import WaveSurvey, waves_along

Array = NDArray[np.float64]

PLANAR_CELLS, SHELL_CELLS = 2, 6
"""Elements across the width by default, of degree 5 in the plane and of BFS in space; along the
sheet as many as make them about square, and at least twice as many to a wavelength. With 2 x 4 the
distances between points of the 2 : 1 sheet at alpha = 0.25 are right to 7e-5 of the length."""

PLANAR_DEGREE = 5

LONGEST, MOST_CELLS = 256, 100_000
"""Elements to a wavelength by default, at most: in a strip narrower than a hundredth of the wave they
are longer than wide, as growth is. And elements of a sheet, whose factor then fits in memory."""

GROWTH = ("alpha", "curvature_coupling", "growth_law", "curvature", "area")
"""Fields of a scene that say how its wave grows it."""

SAME = 1e-12
"""Difference of two descriptions of one material that is roundoff."""


@dataclass(frozen=True, eq=False)
class Scene(Shown):
    """A sheet driven by a wave of growth, under the effects that are named.

    sheet: rectangle, thickness and Poisson ratio. wave: c(x, y, t) with its period. alpha: growth of
    lengths per c; curvature_coupling: beta of eq. 4, 1/length. effects: Membrane(material) in any
    case, and of Bending, Gravity, Ground, Friction, Inertia, DeadLoad those that are wanted, each once.
    growth_law, curvature, area: as law, curvature and area of `rest_state.grown_state`.
    cells: elements across and along, two integers. mesh: instead of cells, a scikit-fem mesh of another
    outline in the coordinates of the sheet. element: of scikit-fem; by default degree 4 in the plane,
    BFS on rectangles and Argyris on triangles in space.

    Raises ValueError, naming the argument, for values out of range, for effects that contradict each
    other or the sheet, and for effects that miss what they need (friction without load).

    >>> from fem_check import Bending, Material, Membrane, Scene
    >>> from linear_theory import Sheet, SineWave
    >>> material = Material(thickness=0.03, poisson=0.5)
    >>> stretching, bending = Membrane(material), Bending(material)
    >>> for effects in ([stretching], [stretching, bending]):
    ...     print(Scene(Sheet(), SineWave(), alpha=0.25, effects=effects).components)
    2
    3
    """

    sheet: Sheet
    wave: Wave
    alpha: float
    curvature_coupling: float = 0.0
    effects: Sequence[Effect] = ()
    growth_law: str = "exp"
    curvature: str = "grown"
    area: str = "grown"
    cells: tuple[int, int] | None = None
    mesh: Any = None
    element: Any = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "sheet", arguments.sheet(self.sheet))
        object.__setattr__(self, "wave", arguments.wave(self.wave))
        effects = _checked_effects(self.effects)
        placed = (e.under(self.sheet) if isinstance(e, Ground) else e for e in effects)
        object.__setattr__(self, "effects", tuple(placed))
        for name in ("alpha", "curvature_coupling"):
            object.__setattr__(self, name, validation.real(name, getattr(self, name)))
        validation.choice("growth_law", self.growth_law, GROWTH_LAWS)
        validation.choice("curvature", self.curvature, CURVATURE_FORMS)
        validation.choice("area", self.area, MEASURES)
        metric_factor(self.growth_law, self.alpha, self._extremes())
        self._check_mesh()
        check_effects(self.effects, self.components, self.sheet)
        if self.curvature_coupling and self.find(Bending) is None:
            raise ValueError(
                f"curvature_coupling = {self.curvature_coupling:g}: must be 0 without the effect "
                "Bending, the only one that knows of a rest curvature"
            )

    def _title(self) -> str:
        effects = ", ".join(type(effect).__name__ for effect in self.effects)
        return f"Scene: {'in the plane' if self.planar else 'in space'}, {effects}"

    def _rows(self) -> Mapping[str, Any]:
        growth = [f"{name}={in_words(getattr(self, name))}" for name in GROWTH]
        mesh = "as the wave needs" if self.cells is None else self.cells
        rows = {"sheet": self.sheet, "wave": self.wave, "growth": ", ".join(growth)}
        rows["cells"] = mesh if self.mesh is None else MeshShown(self.mesh)
        return {**rows, **{f"effects[{i}]": effect for i, effect in enumerate(self.effects)}}

    def _contents(self) -> Mapping[str, Any]:
        mesh = None if self.mesh is None else MeshShown(self.mesh)
        element = None if self.element is None else type(self.element).__name__
        return {**super()._contents(), "mesh": mesh, "element": element}

    @property
    def planar(self) -> bool:
        """Whether no effect needs the third component."""
        return not any(needs_space(effect) for effect in self.effects)

    @property
    def components(self) -> int:
        """2 in the plane, 3 in space."""
        return 2 if self.planar else 3

    @property
    def period(self) -> float:
        """Of the wave."""
        return float(self.wave.period)

    @cached_property
    def survey(self) -> WaveSurvey:
        """How the wave depends on time, at points of the sheet."""
        if self.mesh is None:
            return WaveSurvey.on_sheet(self.wave, self.sheet)
        return WaveSurvey.at_some(self.wave, self.sheet, *self.mesh.p[:, self.mesh.t].mean(1))

    def speed_per_rate(self, leading: bool) -> float:
        """Largest V that dc/dt of root mean square 1 makes, see `WaveSurvey.speed_per_rate`.

        Curvature c times its coupling tilts the sheet by as much, over a wavelength/(2 pi).
        """
        bent = abs(self.curvature_coupling) * self.sheet.length / (2 * np.pi)
        return self.survey.speed_per_rate(abs(self.alpha) + bent, leading)

    def find(self, kind: type) -> Any:
        """The effect of that class, None where the scene does not name it."""
        return next((effect for effect in self.effects if isinstance(effect, kind)), None)

    def discretisation(self) -> Discretisation:
        """Mesh, element and unknowns; made when first asked for and kept."""
        return self._discretisation

    @cached_property
    def _discretisation(self) -> Discretisation:
        mesh = self._rectangle() if self.mesh is None else self.mesh
        element = self._default_element(mesh) if self.element is None else self.element
        degree = self._quadrature(mesh, element)
        return Discretisation(mesh, element, components=self.components, degree=degree)

    def growth(self, t: float, x: ArrayLike, y: ArrayLike) -> Array:
        """c at points of the undeformed sheet."""
        return np.asarray(self.wave.value(x, y, t, self.sheet.length))

    def rest(self, t: float, amplitude: float = 1.0, region: Region | None = None) -> RestState:
        """Rest state at time t of `amplitude` times the wave, at interior points unless given."""
        region = self.discretisation().interior if region is None else region
        x, y = region.parameters.reshape(2, -1)
        return grown_state(
            region,
            amplitude * self.growth(t, x, y),
            self.alpha,
            self.curvature_coupling,
            law=self.growth_law,
            curvature=self.curvature,
            area=self.area,
        )

    def potential(
        self,
        rest: RestState,
        step: Step | None = None,
        effects: Sequence[Effect] | None = None,
    ) -> Potential:
        """The sum of the effects (or of some of them) with that rest state and step."""
        chosen = self.effects if effects is None else effects
        return Potential(self.discretisation(), chosen, rest, step)

    @property
    def static_effects(self) -> tuple[Effect, ...]:
        """Those that have a meaning without a velocity: all but friction and inertia."""
        return tuple(e for e in self.effects if not isinstance(e, Friction | Inertia))

    def _rectangle(self) -> Any:
        across, along = self.cells or default_cells(self.sheet, self.wave, self.planar)
        x, y = self.sheet.width / 2, self.sheet.length / 2
        grid = np.linspace(-x, x, across + 1), np.linspace(-y, y, along + 1)
        return skfem.MeshQuad.init_tensor(*grid)

    def _default_element(self, mesh: Any) -> Any:
        quadrilaterals = mesh.t.shape[0] == 4
        if self.planar:
            return skfem.ElementQuadP(PLANAR_DEGREE) if quadrilaterals else skfem.ElementTriP4()
        return skfem.ElementQuadBFS() if quadrilaterals else skfem.ElementTriArgyris()

    def _quadrature(self, mesh: Any, element: Any) -> int | None:
        """p + 1 points along each side of a Lagrange square; otherwise the default."""
        if mesh.t.shape[0] != 4 or is_global(element):
            return None
        return 2 * round(float(np.sqrt(element.maxdeg))) + 1

    def _check_mesh(self) -> None:
        """And make them two plain integers."""
        if self.mesh is not None:
            hint = "outline.mesh(size) makes one of an Outline"
            check_mesh(validation.instance("mesh", self.mesh, skfem.Mesh, hint))
            check_fits(self.mesh, self.sheet)
        if self.element is not None:
            validation.instance("element", self.element, skfem.Element)
        if self.cells is None:
            return
        if self.mesh is not None:
            shown = validation.shown(self.cells)
            raise ValueError(f"cells = {shown}: must be None where a mesh is given")
        object.__setattr__(self, "cells", _two_integers(self.cells))

    def _extremes(self) -> Array:
        """c on a grid of places and times, to find growth that no rest state can have."""
        x, y = np.array([-0.5, 0, 0.5]) * self.sheet.width, np.linspace(-0.5, 0.5, 33)
        t = np.append(phases(self.period, 64), 0.0)
        y = y * self.sheet.length
        return np.stack([self.growth(s, x[:, None], y[None]) for s in t])


def _two_integers(cells: Any) -> tuple[int, int]:
    """Elements across and along, from any sequence of two."""
    if (
        not isinstance(cells, Sequence | np.ndarray)
        or np.shape(cells) != (2,)
        or isinstance(cells, str)
    ):
        shown = validation.shown(cells)
        raise ValueError(f"cells = {shown}: must be two integers, across and along")
    across, along = (validation.integer("cells", count, 1) for count in cells)
    if across * along > MOST_CELLS:
        raise ValueError(
            f"cells = {across, along}: {across * along} elements are too many to be solved, must be "
            f"<= {MOST_CELLS}"
        )
    return across, along


def _checked_effects(effects: Any) -> tuple[Effect, ...]:
    """The effects, one of them alone, too. Raises ValueError for what is no instance of an effect."""
    if _is_effect(effects):
        return (effects,)
    if isinstance(effects, type | str) or not isinstance(effects, Iterable):
        shown = validation.shown(effects)
        raise ValueError(f"effects = {shown}: must be a sequence of effects, as [Membrane(material)]")
    found = tuple(effects)
    for i, effect in enumerate(found):
        if not _is_effect(effect):
            hint = "an instance, made with its arguments" if isinstance(effect, type) else "an effect"
            raise ValueError(f"effects[{i}] = {validation.shown(effect)}: must be {hint}")
    return found


def _is_effect(value: object) -> bool:
    """Whether it is an object, and no class, that has an energy."""
    return not isinstance(value, type) and hasattr(value, "energy") and hasattr(value, "entries")


def needs_space(effect: Effect) -> bool:
    """Whether the effect has no meaning with two components."""
    if isinstance(effect, DeadLoad):
        return len(effect.force) == 3
    return isinstance(effect, Bending | Ground)


def default_cells(sheet: Sheet, wave: Wave, planar: bool) -> tuple[int, int]:
    """Elements across and along: about square, and several to a wavelength, up to LONGEST each.

    Raises ValueError where that would be too many elements.
    """
    across = PLANAR_CELLS if planar else SHELL_CELLS
    waves = waves_along(wave)
    square = min(across * sheet.length / sheet.width, LONGEST * waves)
    return _two_integers((across, max(round(square), 2 * across * waves)))


def check_effects(effects: Sequence[Effect], components: int, sheet: Sheet) -> None:
    """Raise ValueError where effects miss what they need, contradict each other or the sheet."""
    kinds = [type(effect) for effect in effects]
    names = ", ".join(kind.__name__ for kind in kinds) or "none"
    for kind in kinds:
        if kinds.count(kind) > 1:
            raise ValueError(f"effects: {kind.__name__} is named twice, must be named once")
    if Membrane not in kinds:
        raise ValueError(f"effects = {names}: must name Membrane, without which nothing has a shape")
    if Friction in kinds:
        load_bearer(components, effects)
    for load in effects:
        if isinstance(load, DeadLoad):
            load.check(components, effects, None)
    if Ground in kinds and Gravity not in kinds:
        raise ValueError(f"effects = {names}: Ground must come with Gravity, else nothing lies on it")
    if components == 3 and Gravity in kinds and Ground not in kinds:
        raise ValueError(f"effects = {names}: Gravity must come with Ground, else the sheet falls")
    _check_materials(effects, sheet)


def _check_materials(effects: Sequence[Effect], sheet: Sheet) -> None:
    materials = [effect.material for effect in effects if hasattr(effect, "material")]
    for material in materials:
        if material != materials[0]:
            raise ValueError(f"effects: materials {materials[0]} and {material} must be the same")
        for name in ("thickness", "poisson"):
            mine, theirs = getattr(material, name), getattr(sheet, name)
            none = 0.0 if name == "thickness" else SAME  # a length has no size but its own
            if not math.isclose(mine, theirs, rel_tol=SAME, abs_tol=none):
                raise ValueError(f"effects: material has {name} = {mine:g}, the sheet has {theirs:g}")
