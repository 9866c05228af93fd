"""Koiter's shell: the energies of stretching (eq. 1a) and of bending (eq. 1b) in covariant form.

    W = 1/2 K alpha : H : alpha + 1/2 D beta : H : beta,   alpha = (a - abar)/2,   beta = bbar - b

per rest area (appendix A.2), K and D as in `Material`, H the isotropic tensor of the grown metric. With
a_a = x_a, n the unit normal, a^c the dual base and Gamma^c_ab = a^c . x_ab the variations are

    d(a_ab)/2      = (da_a . a_b + a_a . da_b)/2
    db_ab          = n . d_ab,   d_ab = dx_ab - Gamma^c_ab da_c
    d1 d2 (a_ab)/2 = (d1 a_a . d2 a_b + d2 a_a . d1 a_b)/2
    d1 d2 b_ab     = - (n . d1 a_c)(a^c . d_ab(d2)) - (n . d2 a_c)(a^c . d_ab(d1))
                     - b_ab a^cd (n . d1 a_c)(n . d2 a_d)
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.kinematics.point_state import PointState, dot, once_per_state
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.kinematics.region import Entries
from fem_check.shell.material import Material, check_materials
from linear_theory.common import validation
from linear_theory.common.pairs import identity, outer
from linear_theory.common.shown import Value
from linear_theory.friction.load import Load
from linear_theory.scene.scene import Scene

Array = NDArray[np.float64]

_ENGINEERING = np.array([1.0, 1.0, 2.0])[:, None]
"""Weights of the components (11, 22, 12) in a full contraction of symmetric tensors."""


def _apply(tensor: Array, strain: Array) -> Array:
    """H : e of (3, 3, points) and covariant (3, points)."""
    out = tensor[:, 0] * strain[0]
    out += tensor[:, 1] * strain[1]
    out += tensor[:, 2] * (2 * strain[2])
    return np.asarray(out)


def _contracted(stress: Array, strain: Array) -> Array:
    """stress : strain of symmetric tensors (3, points)."""
    return np.asarray(stress[0] * strain[0] + stress[1] * strain[1] + 2 * stress[2] * strain[2])


@dataclass(frozen=True)
class Membrane(Value, Effect):
    """Energy of stretching, eq. 1a; any number of components, first derivatives only."""

    material: Material
    entries: ClassVar[Entries] = (1, 2)
    reads_rest: ClassVar[bool] = True
    stretches: ClassVar[bool] = True
    stored_as: ClassVar[str] = "elastic"

    def __post_init__(self) -> None:
        validation.instance("material", self.material, Material)

    @once_per_state
    def strain(self, state: PointState) -> Array:
        """alpha = (a - abar)/2, (3, points), covariant."""
        return np.asarray((state.metric - state.rest.abar) / 2)

    @once_per_state
    def stress(self, state: PointState) -> Array:
        """n^ab = K H alpha of appendix A.2, (3, points), contravariant, times the measure."""
        tensor = state.rest.elastic_tensor(self.material.poisson)
        return self.material.stretching * state.rest.measure * _apply(tensor, self.strain(state))

    def energy(self, state: PointState) -> Array:
        """See Effect."""
        return _contracted(self.stress(state), self.strain(state)) / 2

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        n11, n22, n12 = self.stress(state)
        first, second = state.tangents
        out = n12 * state.tangents[::-1]
        out[0] += n11 * first
        out[1] += n22 * second
        return np.asarray(out)

    def hessian(self, state: PointState) -> Array:
        """See Effect."""
        n11, n22, n12 = self.stress(state)
        scale = self.material.stretching * state.rest.measure
        h = state.rest.elastic_tensor(self.material.poisson) * scale
        first, second = state.tangents
        p11, p22, p12, p21 = (
            outer(first, first), outer(second, second), outer(first, second), outer(second, first)
        )  # fmt: skip
        same = identity(state.components)
        mixed = p12 + p21
        out = np.empty((2, 2, *p11.shape))
        out[0, 0] = h[0, 0] * p11 + h[0, 2] * mixed + h[2, 2] * p22 + n11 * same
        out[1, 1] = h[1, 1] * p22 + h[1, 2] * mixed + h[2, 2] * p11 + n22 * same
        shared = h[0, 2] * p11 + h[1, 2] * p22 + n12 * same
        out[0, 1] = shared + h[0, 1] * p12 + h[2, 2] * p21
        out[1, 0] = shared + h[0, 1] * p21 + h[2, 2] * p12
        return out

    def check_scene(self, scene: Scene) -> None:
        """See Effect."""
        check_materials(scene)

    def beyond_theory(self, scene: Scene) -> str:
        """Nothing."""
        return ""


@dataclass(frozen=True)
class Bending(Value, Effect):
    """Energy of bending, eq. 1b; three components, H2 elements."""

    material: Material
    entries: ClassVar[Entries] = (1, 2, 3, 4, 5)
    reads_rest: ClassVar[bool] = True
    needs_space: ClassVar[bool] = True
    bends: ClassVar[bool] = True
    stored_as: ClassVar[str] = "elastic"

    def __post_init__(self) -> None:
        validation.instance("material", self.material, Material)

    @once_per_state
    def change(self, state: PointState) -> Array:
        """b - bbar, (3, points), covariant."""
        return np.asarray(state.curvature - state.rest.bbar)

    @once_per_state
    def moment(self, state: PointState) -> Array:
        """-m^ab of appendix A.2, D H (b - bbar), (3, points), contravariant, times the measure."""
        tensor = state.rest.elastic_tensor(self.material.poisson)
        return self.material.bending * state.rest.measure * _apply(tensor, self.change(state))

    def energy(self, state: PointState) -> Array:
        """See Effect."""
        return _contracted(self.moment(state), self.change(state)) / 2

    def gradient(self, state: PointState) -> Array:
        """See Effect."""
        return self._weights(state)[:, None] * state.normal

    def hessian(self, state: PointState) -> Array:
        """See Effect."""
        weights, normal, dual = self._weights(state), state.normal, state.dual
        out = self._scalar(state)[:, :, None] * outer(normal, normal)
        # From the rotation of the normal: entries a_c along n, all entries along a^c.
        out[:2] -= outer(normal, dual)[:, None] * weights[:, None]
        out[:, :2] -= outer(dual, normal) * weights[:, None, None]
        return np.asarray(out)

    def _weights(self, state: PointState) -> Array:
        """m^ab d_ab as coefficients of the entries (_1, _2, _11, _22, _12), (5, points)."""
        out = np.empty((5, state.measure.size))
        out[2:] = self.moment(state)
        out[4] *= 2
        first, second, mixed = state.second
        bent = out[2] * first
        bent += out[3] * second
        bent += out[4] * mixed
        out[:2] = -dot(state.dual, bent[None])
        return out

    def _scalar(self, state: PointState) -> Array:
        """Factor of n_c n_d in the Hessian, (5, 5, points)."""
        tensor = state.rest.elastic_tensor(self.material.poisson)
        scale = _ENGINEERING * (self.material.bending * state.rest.measure)
        stiffness = tensor * _ENGINEERING[:, None] * scale
        christoffel = state.christoffel
        lowered = dot(christoffel[:, None], stiffness)
        total = dot(self.moment(state) * _ENGINEERING, state.curvature)
        i11, i22, i12 = state.inverse_metric * total
        out = np.empty((5, 5, *total.shape))
        out[2:, 2:] = stiffness
        out[:2, 2:], out[2:, :2] = -lowered, -lowered.swapaxes(0, 1)
        out[:2, :2] = dot(lowered[:, None], christoffel[None])
        out[0, 0] -= i11
        out[1, 1] -= i22
        out[0, 1] -= i12
        out[1, 0] -= i12
        return out

    def check_scene(self, scene: Scene) -> None:
        """See Effect."""
        check_materials(scene)

    def beyond_plate(self, scene: Scene) -> str:
        """Nothing."""
        return ""

    @property
    def plate_numbers(self) -> Mapping[str, float | Load]:
        """See Effect."""
        return {"rigidity": self.material.bending}

    def check(self, components: int, step: Step | None) -> None:
        """Raise ValueError in the plane, where nothing bends."""
        if components == 2:
            raise ValueError("effects: Bending must not be named in a planar scene (components = 2)")
