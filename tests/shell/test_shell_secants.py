"""A factor that is kept and corrected, against the dense formula; and what effects share in a state."""

import numpy as np
import pytest
from skfem import ElementQuadBFS, MeshQuad, MeshTri
from skfem.element import ElementTriArgyris

from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane, Scene, simulate
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.statics.secants import DEPTH, NO_SECANTS, Secants
from linear_theory import Sheet, SineWave


class Dense:
    """The factor of a matrix, by its inverse."""

    def __init__(self, matrix: np.ndarray) -> None:
        self.inverse = np.linalg.inv(matrix)

    def solve(self, right: np.ndarray) -> np.ndarray:
        return self.inverse @ right


def definite(rng: np.random.Generator, n: int) -> np.ndarray:
    square = rng.normal(size=(n, n))
    return square @ square.T + n * np.eye(n)


def updated(inverse: np.ndarray, step: np.ndarray, change: np.ndarray) -> np.ndarray:
    """(I - r s y') H (I - r y s') + r s s', r = 1/(s . y): eq. 6.17 of Nocedal and Wright (2006)."""
    r, one = 1 / (step @ change), np.eye(step.size)
    left = one - r * np.outer(step, change)
    return left @ inverse @ left.T + r * np.outer(step, step)


@pytest.mark.parametrize("count", [0, 1, 4, DEPTH, DEPTH + 3])
def test_corrected_factor_is_that_of_the_dense_formula(count: int) -> None:
    rng, n = np.random.default_rng(count), 9
    first, true = Dense(definite(rng, n)), definite(rng, n)
    secants, steps = NO_SECANTS, rng.normal(size=(count, n))
    for step in steps:
        secants = secants.with_step(step, true @ step)
    inverse = first.inverse
    for step in steps[-DEPTH:] if count else ():
        inverse = updated(inverse, step, true @ step)
    gradient = rng.normal(size=n)
    np.testing.assert_allclose(secants.solve(first, gradient), inverse @ gradient, rtol=1e-10)
    if count:
        np.testing.assert_allclose(secants.solve(first, true @ steps[-1]), steps[-1], rtol=1e-9)


def test_steps_along_which_the_energy_is_not_convex_teach_nothing() -> None:
    step = np.array([1.0, 2.0])
    assert NO_SECANTS.with_step(step, -step) is NO_SECANTS
    assert NO_SECANTS.with_step(step, np.array([-2.0, 1.0])) is NO_SECANTS
    assert NO_SECANTS.with_step(step, np.full(2, np.nan)) is NO_SECANTS
    assert isinstance(NO_SECANTS.with_step(step, step), Secants)


@pytest.mark.parametrize(
    ("mesh", "element"),
    [
        (MeshQuad.init_tensor(np.linspace(0, 1, 3), np.linspace(0, 1, 4)), ElementQuadBFS()),
        (MeshQuad.init_tensor(np.array([0, 0.3, 1]), np.linspace(0, 1, 4)), ElementQuadBFS()),
        (MeshTri().refined(1), ElementTriArgyris()),
    ],
    ids=["translates", "unequal", "triangles"],
)
@pytest.mark.parametrize("entries", [(0,), (1, 2), (1, 2, 3, 4, 5)])
def test_integral_is_the_transpose_of_displacement(
    mesh: object, element: object, entries: tuple[int, ...]
) -> None:
    sheet, rng = Discretisation(mesh, element), np.random.default_rng(1)
    region, part = sheet.interior, slice(1, 4)
    u = rng.normal(size=sheet.size)
    jets = region.displacement(u, entries, part)
    shapes = region.shapes(entries)
    shapes = np.broadcast_to(shapes, (len(region.elements), *shapes.shape[1:]))[part]
    local = u.reshape(-1, 3)[region.dofs[part]]
    literal = np.einsum("epkf,efc->kcep", shapes, local).reshape(jets.shape)
    np.testing.assert_allclose(jets, literal, atol=1e-12 * abs(literal).max())
    density = rng.normal(size=jets.shape)
    forces = region.integral(density, entries, part)
    work = (forces * local.transpose(2, 0, 1)).sum()
    assert work == pytest.approx((density * jets).sum(), rel=1e-10)


def test_a_kept_factor_changes_no_motion(monkeypatch: pytest.MonkeyPatch) -> None:
    """With a new factor for every correction the sheet goes the same way, to a tolerance."""
    material = Material(0.03, 0.5)
    bending = (Membrane(material), Bending(material), Gravity(2.5e-4), Ground(0.5), Friction(1.0, 0.05))
    scene = Scene(Sheet(), SineWave(), -0.2, -3.0, bending, cells=(2, 4))
    kept = simulate(scene, 1, steps=12, ramp=0.25)
    monkeypatch.setattr("fem_check.shell.statics.newton.CONTRACTION", 0.0)
    anew = simulate(scene, 1, steps=12, ramp=0.25)
    np.testing.assert_allclose(kept.centre, anew.centre, atol=1e-6)
    assert kept.states[-1] == pytest.approx(anew.states[-1], abs=1e-4 * abs(anew.states[-1]).max())
    assert abs(kept.centre[1, -1]) > 1e-3
