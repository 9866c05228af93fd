"""The barrier that keeps parts of a sheet apart (incremental potential contact).

Li et al., Incremental potential contact, ACM Trans. Graph. 39(4):49, 2020, with their eq. 6 for the
barrier and, as Li, Kaufman and Jiang (Convergent incremental potential contact, arXiv 2307.15908,
2023) have it, a pressure per area. Two points at the distance d, thickness h and gap g repel each other
if d < h + g, with the energy per area

    stiffness g B(s)/S^2,   B(s) = -(s - S)^2 ln(s/S),   s = d^2 - h^2,   S = (h + g)^2 - h^2,

which is infinite at d = h. Distances are those of a triangulation; ipctk finds and differentiates them.
"""

from typing import Any

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from fem_check.shell.kinematics.triangulation import Triangulation
from linear_theory.common.extras import optional

Array = NDArray[np.float64]

USE = "contact of the sheet with itself"

SAFE = 0.9
"""Fraction of the way to a collision that is allowed: at its end the barrier would be infinite."""

SKIN = 0.25
"""Distance in thickness plus gap by which vertices may move before pairs that are near are looked for
anew. Looking takes longer than all the rest, and longer the more of them are found."""

FURTHEST = 4.0
"""Largest motion of a vertex in one step of a minimisation, in thickness plus gap, which bounds the
number of pairs that could collide on the way."""


class Barrier:
    """A `Coupling` between the triangles of a sheet that are further apart along it than `apart`.

    surface: of the sheet, in space. thickness, gap: h and g above, lengths. stiffness: force per area.
    apart: distance along the undeformed sheet up to which two vertices are neighbours, which do not
    repel each other. Raises ModuleNotFoundError, with what to install, without ipctk.
    """

    def __init__(
        self, surface: Triangulation, thickness: float, gap: float, stiffness: float, apart: float
    ) -> None:
        self._ipctk = optional("ipctk", "contact", USE)
        self._ipctk.set_num_threads(1)
        self.surface, self.thickness, self.gap = surface, thickness, gap
        self._potential = self._ipctk.BarrierPotential(gap, stiffness, True)
        self._mesh = self._collision_mesh(apart)
        self._collision = self._ipctk.AdditiveCCD()
        self._skin, self._furthest = SKIN * (thickness + gap), FURTHEST * (thickness + gap)
        self._list: tuple[Array, Any] | None = None
        self._last: tuple[Array, Any, Array] | None = None

    def _collision_mesh(self, apart: float) -> Any:
        from scipy.spatial import cKDTree

        rest = self.surface.vertices(self.surface.discretisation.zeros())
        faces = self.surface.triangles.astype(np.int32)
        mesh = self._ipctk.CollisionMesh(np.asfortranarray(rest.T), self._ipctk.edges(faces), faces)
        near = cKDTree(rest.T).query_pairs(apart)
        mesh.can_collide = self._ipctk.make_sparse_filter(dict.fromkeys(near, False), True)
        return mesh

    def vertices(self, u: Array) -> Array:
        """Places of the vertices for unknowns u (size,), (n, 3), as ipctk wants them."""
        return np.asfortranarray(self.surface.vertices(u).T)

    def begin(self, u: Array) -> None:
        """See Coupling: the order in which pairs are added up depends on where they were found."""
        self._list = self._last = None
        self._listed(self.vertices(u))

    def _listed(self, vertices: Array) -> Any:
        """Pairs that may repel each other at these vertices, looked for anew if some moved far."""
        if self._list is None or _furthest(self._list[0], vertices) > self._skin:
            candidates = self._ipctk.Candidates()
            radius = (self.thickness + self.gap) / 2 + self._skin
            candidates.build(self._mesh, vertices, radius)
            self._list = vertices, candidates
        return self._list[1]

    def _near(self, u: Array) -> tuple[Any, Array]:
        """Pairs that repel each other at u, and the vertices; kept: a Hessian follows the gradient."""
        if self._last is not None and np.array_equal(self._last[0], u):
            return self._last[1:]
        found, vertices = self._ipctk.NormalCollisions(), self.vertices(u)
        found.use_area_weighting = True
        found.collision_set_type = found.CollisionSetType.IMPROVED_MAX_APPROX
        found.build(self._listed(vertices), self._mesh, vertices, self.gap, self.thickness)
        self._last = u.copy(), found, vertices
        return found, vertices

    def touches(self, u: Array) -> bool:
        """Whether parts of the sheet repel each other."""
        return not self._near(u)[0].empty()

    def distance(self, u: Array) -> float:
        """Smallest distance of parts that repel each other; infinite if there are none."""
        near, vertices = self._near(u)
        if near.empty():
            return np.inf
        return float(np.sqrt(near.compute_minimum_distance(self._mesh, vertices)))

    def energy_and_gradient(self, u: Array) -> tuple[float, Array]:
        """See Coupling."""
        near, vertices = self._near(u)
        if near.empty():
            return 0.0, np.zeros(u.size)
        if self.distance(u) <= self.thickness:
            return np.inf, np.full(u.size, np.nan)
        forces = self._potential.gradient(near, self._mesh, vertices)
        return float(self._potential(near, self._mesh, vertices)), self.surface.map.T @ forces

    def hessian(self, u: Array, convex: bool = False) -> Any:
        """See Coupling."""
        near, vertices = self._near(u)
        if near.empty():
            return None
        projections = self._ipctk.PSDProjectionMethod
        projection = projections.CLAMP if convex else projections.NONE
        found = self._potential.hessian(near, self._mesh, vertices, projection)
        return sp.csr_array(self.surface.map.T @ sp.csr_array(found) @ self.surface.map)

    def reach(self, u: Array, change: Array) -> float:
        """See Coupling."""
        start, end = self.vertices(u), self.vertices(u + change)
        far = _furthest(start, end)
        if 2 * far < SAFE * (min(self.distance(u), self.thickness + self.gap) - self.thickness):
            return 1.0
        most = 1.0 if far <= self._furthest else self._furthest / far
        end = np.asfortranarray(start + most * (end - start))
        share = self._on_the_way(start, end).compute_collision_free_stepsize(
            self._mesh, start, end, self.thickness, self._collision
        )
        return most * (1.0 if share >= 1 else SAFE * float(share))

    def _on_the_way(self, start: Array, end: Array) -> Any:
        """Pairs that may collide between two places of the vertices."""
        listed = self._listed(start)
        assert self._list is not None
        if _furthest(self._list[0], end) <= self._skin:
            return listed
        candidates = self._ipctk.Candidates()
        candidates.build(self._mesh, start, end, self.thickness / 2)
        return candidates


def _furthest(before: Array, after: Array) -> float:
    """Largest distance of points (n, 3) that belong together."""
    return float(np.sqrt(((after - before) ** 2).sum(1).max()))
