"""The weak forms of plane stress, written out for scikit-fem, which loops over shape functions."""

from skfem import Basis, BilinearForm, ElementVector, LinearForm, MeshTri
from skfem.helpers import ddot, div, eye, sym_grad, trace

from fem_check.plane_stress.elements import ELEMENTS


def basis(mesh: MeshTri, degree: int) -> Basis:
    return Basis(mesh, ElementVector(ELEMENTS[degree]()), intorder=2 * degree)


@BilinearForm
def elastic_work(u, v, w):
    """Work of the stress of u in the strain of v; w.poisson."""
    e, nu = sym_grad(u), w.poisson
    return ddot(e / (1 + nu) + nu / (1 - nu**2) * eye(trace(e), 2), sym_grad(v))


@LinearForm
def dilation_work(v, w):
    """Of a pressure w.growth."""
    return w.growth * div(v)


@LinearForm
def shift(v, w):
    """Displacement along the direction w.along."""
    return v[w.along]


@LinearForm
def rotation(v, w):
    """Local rotation, anticlockwise."""
    return (v.grad[1, 0] - v.grad[0, 1]) / 2
