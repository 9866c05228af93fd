"""A scene in finite elements: mesh and unknowns, rest state at any time, potential.

Effects that the scene does not name are neither built nor evaluated. If no effect requires the third
component the model is planar: two displacement components on continuous elements, first derivatives.
"""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fem_check.mesh.elements import default_cells, default_element, grid
from fem_check.shell.effects.contact.coupling import Coupling
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Region
from fem_check.shell.kinematics.rest_state import RestState, grown_state
from fem_check.shell.kinematics.shape_functions import is_global
from fem_check.shell.material import Material
from fem_check.shell.statics.potential import Potential
from linear_theory.common.shown import Shown
from linear_theory.scene.scene import Scene
from linear_theory.wave.protocol import Drive

Array = NDArray[np.float64]


class ShellModel(Shown):
    """The finite-element model of a scene; its parts are built on first use and kept.

    drive: the wave on the sheet, by default that of the scene; of a run, the one that follows it.

    >>> from fem_check.shell.model import ShellModel
    >>> from linear_theory import Scene, Sheet, SineWave
    >>> model = ShellModel(Scene(Sheet(), SineWave(), alpha=0.25))
    >>> print(model.discretisation.mesh.nelements, model.rest(t=0.0).abar.shape)
    8 (3, 288)
    """

    def __init__(self, scene: Scene, drive: Drive | None = None) -> None:
        self.scene, self.planar, self.components = scene, scene.planar, scene.components
        self.drive = scene.drive if drive is None else drive
        sheet = scene.sheet
        alone = (Membrane(Material(sheet.thickness, sheet.poisson)),)
        self.effects: tuple[Effect, ...] = scene.effects or alone
        scene.growth.law.check(scene.alpha, scene.extremes)

    def _contents(self) -> Mapping[str, Any]:
        return {"scene": self.scene}

    def find(self, kind: type) -> Any:
        """The effect of that class; None if there is none."""
        return next((effect for effect in self.effects if isinstance(effect, kind)), None)

    @property
    def heavy(self) -> bool:
        """Whether the sheet has inertia."""
        return any(effect.areal_mass for effect in self.effects)

    @property
    def static_effects(self) -> tuple[Effect, ...]:
        """Effects that are defined without a velocity."""
        return tuple(effect for effect in self.effects if effect.is_static)

    @cached_property
    def discretisation(self) -> Discretisation:
        """Mesh, element and unknowns."""
        scene, elements = self.scene, self.scene.elements
        mesh = scene.mesh
        if mesh is None:
            cells = scene.cells or default_cells(scene.drive, self.planar)
            mesh = grid(scene.sheet, cells)
        element = None if elements is None else elements.element
        element = default_element(mesh, self.planar) if element is None else element
        degree = _quadrature(mesh, element)
        return Discretisation(mesh, element, components=self.components, degree=degree)

    @cached_property
    def couplings(self) -> tuple[Coupling, ...]:
        """Of the effects between distant parts of the sheet."""
        return tuple(e.coupling(self.discretisation, self.scene) for e in self.effects if e.couples)

    def check_elements(self) -> None:
        """Raise ValueError for elements that do not suit an effect."""
        for effect in self.effects:
            effect.check_elements(self.discretisation, self.scene)

    def growth(self, t: float, x: ArrayLike, y: ArrayLike) -> Array:
        """c at points of the undeformed sheet."""
        return np.asarray(self.drive.value(x, y, t))

    def rest(self, t: float, amplitude: float = 1.0, region: Region | None = None) -> RestState:
        """Rest state at time t for `amplitude` times the wave, by default at interior points."""
        region = self.discretisation.interior if region is None else region
        x, y = region.parameters.reshape(2, -1)
        return grown_state(region, amplitude * self.growth(t, x, y), self.scene.growth)

    def potential(
        self,
        rest: RestState,
        step: Step | None = None,
        effects: Sequence[Effect] | None = None,
    ) -> Potential:
        """The potential of all (or the given) effects with that rest state and step."""
        chosen = self.effects if effects is None else effects
        couplings = self.couplings if any(effect.couples for effect in chosen) else ()
        return Potential(self.discretisation, chosen, rest, step, couplings=couplings)


def _quadrature(mesh: Any, element: Any) -> int | None:
    """Quadrature degree: p + 1 points along each side for Lagrange squares; otherwise the default."""
    if mesh.t.shape[0] != 4 or is_global(element):
        return None
    return 2 * round(float(np.sqrt(element.maxdeg))) + 1
