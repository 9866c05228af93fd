"""Contact of the sheet with itself: parts of it keep apart by its thickness."""

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.contact.barrier import Barrier
from fem_check.shell.effects.contact.coupling import Coupling
from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.koiter import Bending
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from fem_check.shell.kinematics.triangulation import Triangulation
from fem_check.shell.material import Material, check_materials
from linear_theory.common import validation
from linear_theory.common.shown import Value
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

GAP = 0.5
"""Default gap in thicknesses."""

SAGITTA = 0.2
"""Largest distance between the sheet and its triangles, in thicknesses."""

MOST_PIECES = 8
"""Largest number of parts of the side of an element between which there are triangles."""

ROOM = 2.0
"""Distance along the sheet, in thickness plus gap, within which points are neighbours that do not repel
each other: bent as sharply as a sheet can be, they are nearer than that in space."""


@dataclass(frozen=True, init=False)
class SelfContact(Value, Effect):
    """Repulsion of parts of the sheet that come nearer to each other than thickness plus gap.

    material: of the sheet; its thickness h is the smallest distance of two middle surfaces. gap g: the
    repulsion begins at the distance h + g; None for h/2. stiffness, force per area: the pressure at a
    third of the gap is about that; None for D/h^3 of the bending stiffness D, about a tenth of Young's
    modulus. See `barrier` for the energy. There is no friction between the layers. Points whose
    distance along the sheet is about 2 (h + g) or less do not repel each other.

    Raises ValueError for a gap or stiffness <= 0. A scene must name Bending, and simulate needs ipctk:
    pip install 'sheetcrawl[contact]'.

    >>> from fem_check import Material, SelfContact
    >>> contact = SelfContact(Material(thickness=0.03, poisson=0.5))
    >>> print(f"gap {contact.gap:g}, stiffness {contact.stiffness:.3f}")
    gap 0.015, stiffness 0.111
    """

    material: Material
    gap: float
    stiffness: float
    entries: ClassVar[Entries] = (0,)
    needs_space: ClassVar[bool] = True
    couples: ClassVar[bool] = True
    stored_as: ClassVar[str] = "elastic"

    def __init__(
        self, material: Material, gap: float | None = None, stiffness: float | None = None
    ) -> None:
        validation.instance("material", material, Material)
        chosen = GAP * material.thickness if gap is None else gap
        firm = material.bending / material.thickness**3 if stiffness is None else stiffness
        object.__setattr__(self, "material", material)
        object.__setattr__(self, "gap", validation.positive("gap", chosen))
        object.__setattr__(self, "stiffness", validation.positive("stiffness", firm))

    @property
    def distance(self) -> float:
        """Of two middle surfaces, at which the repulsion begins."""
        return self.material.thickness + self.gap

    def idle(self, components: int) -> bool:
        """Point by point it does nothing: see `coupling`."""
        return True

    def energy(self, state: PointState) -> Array:
        """None at single points."""
        return np.zeros(state.measure.size)

    def gradient(self, state: PointState) -> Array:
        """None at single points."""
        return np.zeros((1, *state.position.shape))

    def hessian(self, state: PointState) -> None:
        """Vanishes at single points."""

    def coupling(self, discretisation: Discretisation, scene: Scene) -> Coupling:
        """The barrier on a triangulation whose sagitta is a small part of the thickness.

        Raises ValueError as `check_elements`.
        """
        surface, apart = self._surface(discretisation, scene)
        return Barrier(surface, self.material.thickness, self.gap, self.stiffness, apart)

    def check_elements(self, discretisation: Discretisation, scene: Scene) -> None:
        """Raise ValueError for elements or a gap that do not fit the curvature of the sheet.

        Elements may be too long for it, and the sheet may touch itself within the length over which
        points count as neighbours.
        """
        self._surface(discretisation, scene)

    def _surface(self, discretisation: Discretisation, scene: Scene) -> tuple[Triangulation, float]:
        """The triangulation, and the distance along it within which points are neighbours."""
        sharpest = abs(scene.growth.curvature_coupling) * float(abs(scene.extremes).max())
        surface = Triangulation(discretisation, self._pieces(discretisation, sharpest))
        neighbours = ROOM / _least_stretch(scene)
        apart = surface.longest + neighbours * self.distance
        if sharpest * (apart + self.distance) > 2 * math.pi:
            most = 2 * math.pi / (apart + self.distance)
            thickness = self.material.thickness
            gap = (2 * math.pi / sharpest - surface.longest) / (neighbours + 1) - thickness
            remedy = f"; or the gap must be <= {gap:.3g}" if gap > 0 else ""
            raise ValueError(
                f"curvature_coupling: bends the sheet by {sharpest:.3g}, must be by <= {most:.3g} for "
                f"SelfContact with thickness {thickness:g} and gap {self.gap:g}{remedy}"
            )
        return surface, apart

    def _pieces(self, discretisation: Discretisation, sharpest: float) -> int:
        """An even number of parts of the side of an element, which keeps mirror symmetries."""
        allowed = SAGITTA * self.material.thickness
        whole = Triangulation(discretisation, 1).longest
        needed = whole * math.sqrt(sharpest / (8 * allowed))
        pieces = max(2, 2 * math.ceil(needed / 2))
        if pieces > MOST_PIECES:
            raise ValueError(
                f"cells: elements are {whole:.3g} long, must be shorter by {needed / MOST_PIECES:.2g} "
                f"times for SelfContact at curvature {sharpest:.3g}"
            )
        return pieces

    def check_scene(self, scene: Scene) -> None:
        """Raise ValueError without Bending, or with another material than that of the sheet."""
        check_materials(scene)
        if scene.find(Bending) is None:
            names = ", ".join(type(e).__name__ for e in scene.effects)
            raise ValueError(f"effects = {names}: SelfContact must come with Bending")

    def beyond_cycle(self, scene: Scene) -> str:
        """All of it."""
        return type(self).__name__

    def check(self, components: int, step: Step | None) -> None:
        """Raise ValueError in the plane, where a sheet cannot touch itself."""
        if components == 2:
            raise ValueError(
                "effects: SelfContact must not be named in a planar scene (components = 2)"
            )


def _least_stretch(scene: Scene) -> float:
    """Smallest ratio of a length of the grown to that of the undeformed sheet, at most 1."""
    return float(np.sqrt(min(1.0, scene.growth.metric(scene.extremes).min())))
