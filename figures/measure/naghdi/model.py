"""Naghdi's shell of five unknowns by NGSolve: three displacements and two angles of the director.

On orthogonal parameters of a surface with normal n, the energy per area of the undeformed surface is

    h/2 |e|^2 + h^3/24 |k|^2 + (5/12) G h |g|^2,   e = (F.F - A)/2,  k = -(F.grad d)_sym - B,  g = F.d

with F = grad x, |.|^2 the plane-stress form, and a director d = R_0 (sin b cos a, -sin a, cos b cos a)
that is turned from the normal by two angles a, b. High degree needs no means against locking.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from ngsolve import (
    CF,
    H1,
    BilinearForm,
    Grad,
    GridFunction,
    InnerProduct,
    Variation,
    cos,
    dx,
    sin,
    x,
    y,
)

SMALLEST, ITERATIONS = 1e-5, 14
"""Smallest step of the load, and largest number of Newton's iterations of a step."""


class NaghdiShell:
    """A shell and its equilibria along a load.

    place, normal: of points, of ngsolve's x and y, the parameters; lengths: of d place/dx, d place/dy.
    held: edges at which the three displacements and the angles a and b are 0. material: Young's
    modulus, Poisson ratio, thickness; shear: factor of the shear stiffness.
    """

    def __init__(
        self,
        mesh: Any,
        degree: int,
        place: Any,
        normal: Any,
        lengths: tuple[Any, Any],
        held: tuple[str, ...],
        material: tuple[float, float, float],
        shear: float,
    ) -> None:
        self.mesh, self.space = mesh, H1(mesh, order=degree, dirichlet=held[0])
        for edges in held[1:]:
            self.space = self.space * H1(mesh, order=degree, dirichlet=edges)
        self.found = GridFunction(self.space)
        self.free = self.space.FreeDofs()
        self.force = self.found.vec.CreateVector()
        self.force[:] = 0
        self._share, self._step = 0.0, 0.01
        energy = _energy(self.space.TrialFunction(), place, normal, lengths, material, shear)
        self._form = BilinearForm(self.space, symmetric=True)
        self._form += Variation(energy.Compile() * dx(bonus_intorder=2))
        self.deflections: Callable[[], tuple[float, float]]

    def unknown(self, component: int, at: tuple[float, float]) -> int:
        """Number of a displacement of the vertex next to a point."""
        points = np.array([vertex.point for vertex in self.mesh.vertices])
        return int(self.space.Range(component).start + ((points - at) ** 2).sum(1).argmin())

    def load(self, share: float) -> None:
        """Go on to that share of the force, in steps that Newton's method can make."""
        before = self.found.vec.CreateVector()
        while self._share < share - 1e-12:
            target = min(share, self._share + self._step)
            before.data = self.found.vec
            count = self._newton(target)
            if count == ITERATIONS:
                self.found.vec.data = before
                self._step /= 3
                if self._step < SMALLEST:
                    raise RuntimeError(f"no equilibrium beyond {self._share:.4g} of the load")
                continue
            self._step, self._share = (target - self._share) * (1.6 if count < 7 else 1), target

    def _newton(self, share: float) -> int:
        """Iterations until a correction is below 1e-9 of the state; ITERATIONS if that fails."""
        state = self.found.vec
        residual, change = state.CreateVector(), state.CreateVector()
        for count in range(ITERATIONS):
            self._form.Apply(state, residual)
            residual.data -= share * self.force
            self._form.AssembleLinearization(state)
            change.data = self._form.mat.Inverse(self.free, inverse="sparsecholesky") * residual
            state.data -= change
            size = np.abs(change.FV().NumPy()).max()
            if not size < 1e3:
                return ITERATIONS
            if size < 1e-9 * max(1.0, np.abs(state.FV().NumPy()).max()):
                return count
        return ITERATIONS


def _energy(
    trial: Any,
    place: Any,
    normal: Any,
    lengths: tuple[Any, Any],
    material: tuple[float, float, float],
    shear: float,
) -> Any:
    """Per area of the parameters."""
    (modulus, poisson, h), (l1, l2) = material, lengths
    a, b, slopes = trial[3], trial[4], [Grad(u) for u in trial[:3]]
    along = [place.Diff(x), place.Diff(y)]
    moved = [CF(tuple(slope[k] for slope in slopes)) for k in range(2)]
    tangents = [along[k] + moved[k] for k in range(2)]
    director, turning = _director(a, b, (along[0] / l1, along[1] / l2, normal))
    scale, bent = (l1, l2), [normal.Diff(x), normal.Diff(y)]

    def strain(i: int, j: int) -> Any:
        mixed = InnerProduct(along[i], moved[j]) + InnerProduct(moved[i], along[j])
        return (mixed + InnerProduct(moved[i], moved[j])) / 2 / (scale[i] * scale[j])

    def bending(i: int, j: int) -> Any:
        now = InnerProduct(tangents[i], turning[j]) + InnerProduct(tangents[j], turning[i])
        rest = InnerProduct(along[i], bent[j]) + InnerProduct(along[j], bent[i])
        return -(now - rest) / 2 / (scale[i] * scale[j])

    def square(q: Callable[[int, int], Any]) -> Any:
        """Plane stress."""
        determinant = q(0, 0) * q(1, 1) - q(0, 1) ** 2
        return ((q(0, 0) + q(1, 1)) ** 2 - 2 * (1 - poisson) * determinant) / (1 - poisson**2)

    slips = [InnerProduct(tangents[k], director) / scale[k] for k in range(2)]
    sheared = shear * 5 / 12 / (1 + poisson) * (slips[0] ** 2 + slips[1] ** 2)
    return modulus / 2 * (h * square(strain) + h**3 / 12 * square(bending) + h * sheared) * l1 * l2


def _director(a: Any, b: Any, frame: tuple[Any, Any, Any]) -> tuple[Any, list[Any]]:
    """d, and its derivatives with respect to the parameters."""

    def in_frame(values: tuple[Any, Any, Any], vectors: tuple[Any, ...]) -> Any:
        return sum(
            (v * w for v, w in zip(values[1:], vectors[1:], strict=True)), values[0] * vectors[0]
        )

    parts = sin(b) * cos(a), -sin(a), cos(b) * cos(a)
    by_a = -sin(b) * sin(a), -cos(a), -cos(b) * sin(a)
    by_b = cos(b) * cos(a), 0 * a, -sin(b) * cos(a)
    turning = []
    for k, parameter in enumerate((x, y)):
        own = in_frame(parts, tuple(vector.Diff(parameter) for vector in frame))
        turning.append(own + in_frame(by_a, frame) * Grad(a)[k] + in_frame(by_b, frame) * Grad(b)[k])
    return in_frame(parts, frame), turning
