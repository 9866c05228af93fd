"""Whether a sheet passes through itself.

Nothing in the energy keeps two parts of a sheet apart: one that rolls up may cross itself, and what it
does from then on is the motion of no real sheet. Crossings are looked for on a triangulation of the
middle surface whose vertices are points of the sheet, a linear map of the unknowns. Its triangles
are flat, so that parts closer than their sagitta may be missed, or be taken to touch.
"""

from collections.abc import Iterable
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.triangulation import Triangulation
from linear_theory.common.errors import SheetcrawlError
from linear_theory.common.extras import optional

Array = NDArray[np.float64]
Integers = NDArray[np.int64]
Flags = NDArray[np.bool_]

PIECES = 3
"""Parts into which the side of an element is divided."""

USE = "looking for places where the sheet passes through itself"


class CrossingsUnknown(SheetcrawlError, RuntimeError):
    """It cannot be said whether a sheet crosses itself, for lack of a package."""


class Crossings:
    """Looks for places where the surface of a discretisation in space intersects itself.

    >>> import numpy as np
    >>> from fem_check.shell.kinematics.crossing import Crossings
    >>> from fem_check.shell.model import ShellModel
    >>> from linear_theory import Sheet, SineWave
    >>> from fem_check import Bending, Material, Membrane, Scene
    >>> stiff = [Membrane(Material(0.03, 0.5)), Bending(Material(0.03, 0.5))]
    >>> sheet = ShellModel(Scene(Sheet(), SineWave(), 0.1, effects=stiff, cells=(2, 4))).discretisation
    >>> print(Crossings(sheet).found(sheet.zeros()))
    False
    """

    def __init__(self, discretisation: Discretisation) -> None:
        self.discretisation = discretisation

    @cached_property
    def surface(self) -> Triangulation:
        """The triangulation that is looked at."""
        return Triangulation(self.discretisation, PIECES)

    @property
    def _places(self) -> tuple[Array, Integers]:
        """Vertices (2, n) of the triangulation in the parameter domain, and its triangles (m, 3)."""
        return self.surface.places, self.surface.triangles

    @cached_property
    def _convex(self) -> bool:
        """Whether the parameter domain is convex, without holes."""
        from scipy.spatial import ConvexHull

        places, triangles = self._places
        area = np.abs(_area(places[:, triangles])).sum()
        return bool(area > (1 - 1e-6) * ConvexHull(places.T).volume)

    def vertices(self, u: Array) -> Array:
        """Places (3, n) of the vertices of the triangulation for unknowns u (size,)."""
        return self.surface.vertices(u)

    def found(self, u: Array) -> bool:
        """Whether the sheet with unknowns u (size,) crosses itself.

        Raises CrossingsUnknown, with what to install, if that takes ipctk and it is missing.
        """
        vertices = self.vertices(u)
        if self._convex and self._lies_open(vertices):
            return False
        try:
            ipctk = optional("ipctk", "contact", USE)
        except ModuleNotFoundError as missing:
            raise CrossingsUnknown(str(missing)) from None
        ipctk.set_num_threads(1)
        return bool(ipctk.has_intersections(self._collision_mesh(ipctk), np.asfortranarray(vertices.T)))

    def _lies_open(self, vertices: Array) -> bool:
        """Whether some projection of the triangulated sheet is one to one, so that it cannot cross.

        A map of a convex domain is, if the symmetric part of its gradient is positive definite
        everywhere; the projection is that along the mean normal, turned to the mean gradient.
        """
        places, triangles = self._places
        sides, moved = _edges(places[:, triangles]), _edges(vertices[:, triangles])
        gradient = np.einsum("cat,abt->cbt", moved, _inverse(sides))
        left, _, right = np.linalg.svd((gradient * np.abs(_area(places[:, triangles]))).sum(-1))
        frame = left[:, :2] @ right
        flat = np.einsum("cb,cat->bat", frame, gradient)
        shear = (flat[0, 1] + flat[1, 0]) / 2
        return bool(np.all((flat[0, 0] > 0) & (flat[0, 0] * flat[1, 1] > shear**2)))

    def _collision_mesh(self, ipctk: Any) -> Any:
        if not hasattr(self, "_mesh"):
            places, triangles = self._places
            rest = np.asfortranarray(np.vstack([places, np.zeros(places.shape[1])]).T)
            faces = triangles.astype(np.int32)
            self._mesh = ipctk.CollisionMesh(rest, ipctk.edges(faces), faces)
        return self._mesh


def crossed(discretisation: Discretisation, states: Iterable[Array]) -> Flags | None:
    """Whether the sheet passes through itself in each of some states (n, size), (n,).

    In the plane it does not. None if that could not be found out, for lack of ipctk.
    """
    if discretisation.components == 2:
        return np.array([False for _ in states])
    looks = Crossings(discretisation)
    try:
        return np.array([looks.found(u) for u in states])
    except CrossingsUnknown:
        return None


def crossing_words(crossed: Flags | None, times: Array) -> str:
    """What the flags of states at some times (n,) say of a speed; nothing if the sheet stays apart."""
    if crossed is None:
        return "not looked at for crossing itself (pip install 'sheetcrawl[contact]')"
    return f"passes through itself from t = {times[crossed][0]:.4g}" if crossed.any() else ""


def touching_words(touching: Flags, times: Array) -> str:
    """What such flags say of a sheet that presses on itself; nothing if it does not."""
    if not touching.any():
        return ""
    return f"touches itself from t = {times[touching][0]:.4g}, without friction between its layers"


def _edges(corners: Array) -> Array:
    """Two sides of triangles (components, m, 3), as columns, (components, 2, m)."""
    first, second, third = np.moveaxis(corners, -1, 0)
    return np.stack([second - first, third - first], axis=1)


def _area(corners: Array) -> Array:
    """Signed areas of plane triangles (2, m, 3), (m,)."""
    (a, b), (c, d) = _edges(corners)
    return np.asarray(a * d - b * c) / 2


def _inverse(matrices: Array) -> Array:
    """Inverses of (2, 2, m) matrices."""
    (a, b), (c, d) = matrices
    return np.asarray(np.stack([np.stack([d, -b]), np.stack([-c, a])]) / (a * d - b * c))
