"""Energy -> gradient -> Hessian of every effect by finite differences, random states and parameters."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import skfem
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.effects.loads import DeadLoad, EdgeMoment
from fem_check.shell.effects.restraint import Restraint
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rates import Affine, Face, Step
from fem_check.shell.kinematics.rest_state import grown_state, tensor_state
from fem_check.shell.kinematics.surface import (
    AnnulusSector,
    Cylinder,
    Flat,
    SpherePart,
    Surface,
)
from fem_check.shell.material import Material
from fem_check.shell.statics.potential import Load, Potential
from fem_check.shell.statics.sparsity import Sparsity
from linear_theory.growth.growth import Growth
from tests.shell.shell_cases import trapezoid

Array = NDArray[np.float64]

STEPS = 10.0 ** -np.arange(2, 7)
"""Relative sizes of the finite differences; the best of them must agree to AGREEMENT."""
AGREEMENT = 2e-8


def sheet(element: object, surface: Surface | None = None, components: int = 3) -> Discretisation:
    x, y = np.linspace(0.6, 1.1, 3), np.array([-0.5, 0.1, 0.5])
    kind = skfem.MeshQuad if "Quad" in type(element).__name__ else skfem.MeshTri
    return Discretisation(kind.init_tensor(x, y), element, surface or Flat(), components)


def check(potential: Potential, u: Array, scale: float, seed: int) -> None:
    """Central differences along a random direction, for steps relative to the size of the state."""
    d = potential.discretisation
    direction = np.random.default_rng(seed).normal(size=d.size) * scale
    gradient = potential.gradient(u)
    sparsity = Sparsity(d, np.ones(d.size, bool))
    hessian = sparsity.matrix(sparsity.assemble(potential.hessian_blocks(u)))
    product = np.empty(d.size)
    product[sparsity.order] = hessian @ direction[sparsity.order]
    slope_errors, curve_errors = [], []
    for step in STEPS:
        ahead, behind = u + step * direction, u - step * direction
        slope = (potential.energy(ahead) - potential.energy(behind)) / (2 * step)
        curve = (potential.gradient(ahead) - potential.gradient(behind)) / (2 * step)
        slope_errors.append(abs(slope - gradient @ direction))
        curve_errors.append(np.abs(curve - product).max())
    assert min(slope_errors) <= AGREEMENT * np.abs(gradient * direction).sum()
    assert min(curve_errors) <= AGREEMENT * max(np.abs(product).max(), 1e-300)


SURFACES = {
    "flat": Flat(),
    "trapezoid": trapezoid,
    "ring": AnnulusSector(),
    "cylinder": Cylinder(0.7),
    "sphere": SpherePart(0.7),
}
SHELL_ELEMENTS = {"bfs": skfem.ElementQuadBFS, "argyris": skfem.ElementTriArgyris}
MATERIALS = {"soft": Material(0.3, 0.5, 0.01), "stiff": Material(0.003, -0.3, 1e6)}


@pytest.mark.parametrize("effect", [Membrane, Bending])
@pytest.mark.parametrize("material", MATERIALS)
@pytest.mark.parametrize("element", SHELL_ELEMENTS)
@pytest.mark.parametrize("surface", SURFACES)
def test_koiter_in_space(element: str, surface: str, material: str, effect: type[Effect]) -> None:
    d = sheet(SHELL_ELEMENTS[element](), SURFACES[surface])
    rng = np.random.default_rng(len(element) + len(surface))
    rest = grown_state(
        d.interior, rng.normal(size=d.interior.size), Growth(0.2, curvature_coupling=0.7)
    )
    check(Potential(d, (effect(MATERIALS[material]),), rest), 0.02 * rng.normal(size=d.size), 0.02, 1)


@pytest.mark.parametrize("area", ["grown", "undeformed"])
def test_koiter_with_an_anisotropic_rest_state(area: str) -> None:
    d = sheet(skfem.ElementQuadBFS(), Cylinder(0.7))
    rng = np.random.default_rng(3)
    abar = np.array([1.2, 0.9, 0.3])[:, None] + 0.1 * rng.normal(size=(3, d.interior.size))
    rest = tensor_state(d.interior, abar, rng.normal(size=(3, d.interior.size)), area)
    material = MATERIALS["soft"]
    check(
        Potential(d, (Membrane(material), Bending(material)), rest),
        0.02 * rng.normal(size=d.size),
        0.02,
        1,
    )


PLANAR = [skfem.ElementQuad2, skfem.ElementTriP2, skfem.ElementTriP4, skfem.ElementQuadBFS]


@pytest.mark.parametrize("element", PLANAR)
@pytest.mark.parametrize("material", MATERIALS)
def test_membrane_in_the_plane(element: Callable[[], object], material: str) -> None:
    d = sheet(element(), trapezoid, 2)
    rng = np.random.default_rng(2)
    rest = grown_state(d.interior, rng.normal(size=d.interior.size), Growth(0.2))
    check(Potential(d, (Membrane(MATERIALS[material]),), rest), 0.01 * rng.normal(size=d.size), 0.01, 2)


def hill(x: Array, y: Array) -> Array:
    """z = 0.3 sin(2x) cos(y) with its derivatives."""
    s, c, sy, cy = np.sin(2 * x), np.cos(2 * x), np.sin(y), np.cos(y)
    return 0.3 * np.stack([s * cy, 2 * c * cy, -s * sy, -4 * s * cy, -s * cy, -2 * c * sy])


def moving(d: Discretisation, seed: int) -> Step:
    """A time step with everything in it, load and normals at random."""
    rng = np.random.default_rng(seed)
    shape = (d.components, d.interior.size)
    normal = rng.normal(size=(3, d.interior.size)) + np.array([[0], [0], [3]])
    return Step(
        Affine(30.0, d.interior.reference[0] + 0.01 * rng.normal(size=shape)),
        Affine(900.0, d.interior.reference[0] + 0.01 * rng.normal(size=shape)),
        rng.uniform(0.1, 1, d.interior.size),
        rng.uniform(0.1, 1, d.interior.size),
        normal / np.linalg.norm(normal, axis=0),
        d.interior.reference[0] + 0.01 * rng.normal(size=shape),
    )


CONTACT = {
    "ground": (Ground(0.5),),
    "stiff ground": (Ground(5e4, load="current"),),
    "damped ground": (Ground(2.0, damping=0.03, load="material"),),
    "damped ground, as printed": (Ground(2.0, damping=0.03, form="printed"),),
    "hill": (Ground(3.0, height=hill),),
    "damped hill": (Ground(3.0, damping=0.03, height=hill, form="printed"),),
    "gravity": (Gravity(2.5e-4),),
    "gravity on the current area": (Gravity(2.5, "current"),),
    "dead load": (DeadLoad((0.3, -0.2, 0.7)),),
    "inertia": (Inertia(3.0, MATERIALS["soft"]),),
    "restraint": (Restraint(0.7),),
    "inertia of a thin sheet": (Inertia(3e-6, MATERIALS["stiff"]),),
}


@pytest.mark.parametrize("name", CONTACT)
def test_effects_of_the_position(name: str) -> None:
    d = sheet(skfem.ElementQuadBFS())
    rng = np.random.default_rng(5)
    u = 0.01 * rng.normal(size=d.size)
    u.reshape(-1, 3)[:, 2] -= 0.3  # well below the ground: its pressure has a kink at the surface
    potential = Potential(d, CONTACT[name], grown_state(d.interior), moving(d, 4))
    check(potential, u, 0.01, 6)


@pytest.mark.parametrize(("components", "tilted"), [(2, False), (3, False), (3, True)])
@pytest.mark.parametrize("slip", [1e-1, 1.0, 1e3])
def test_friction(components: int, slip: float, tilted: bool) -> None:
    d = sheet(skfem.ElementQuadBFS() if components == 3 else skfem.ElementQuad2(), None, components)
    step = moving(d, 7)
    step = Step(step.velocity, load=step.load, area=step.area, normal=step.normal if tilted else None)
    bearer: Effect = Ground(1.0, load="material") if components == 3 else Gravity(1.0, "material")
    potential = Potential(d, (Friction(0.7, slip), bearer), None, step)
    u = 0.02 * np.random.default_rng(8).normal(size=d.size)
    u.reshape(-1, components)[:, -1] -= 0.3 if components == 3 else 0.0
    check(potential, u, 1e-2 * min(1.0, slip), 9)


@pytest.mark.parametrize("tilted", [False, True])
def test_friction_on_the_lower_face(tilted: bool) -> None:
    """Of a bent sheet, since the second derivative of the normal vanishes in the plane along it."""
    d = sheet(skfem.ElementQuadBFS(), Cylinder(0.7))
    step = moving(d, 7)
    slower = Affine(30.0, step.moving.base + 0.05)
    step = replace(step, face=Face(0.1, slower), normal=step.normal if tilted else None)
    effects = Friction(0.7, 1.0, surface="bottom"), Ground(1.0, load="material")
    u = 0.02 * np.random.default_rng(8).normal(size=d.size)
    check(Potential(d, effects, None, step), u, 1e-2, 9)


@pytest.mark.parametrize("angle", [0.0, 2.0, 9.0])
def test_edge_moment_and_loads_on_parts(angle: float) -> None:
    d = sheet(skfem.ElementTriArgyris())
    loads = (
        Load(d.edge(lambda xi: np.isclose(xi[0], 1.1)), EdgeMoment(1.3, angle, 1)),
        Load(d.edge(lambda xi: np.isclose(xi[1], 0.5)), EdgeMoment(-0.4, angle, 2)),
        Load(d.edge(lambda xi: np.isclose(xi[1], 0.5)), DeadLoad((0.1, 0.2, 0.3))),
        Load(d.point((0.8, 0.2)), DeadLoad((0.1, -0.2, 0.3))),
    )
    rng = np.random.default_rng(1)
    u = 0.02 * rng.normal(size=d.size)
    check(Potential(d, (), loads=loads), u, 0.02, 2)


def test_sums_of_effects_are_sums() -> None:
    """One evaluation of all effects equals the sum of the single ones, value by value."""
    d = sheet(skfem.ElementQuadBFS(), Cylinder(0.7))
    rng = np.random.default_rng(0)
    u, step, rest = (
        0.02 * rng.normal(size=d.size),
        moving(d, 1),
        grown_state(d.interior, 0.3, Growth(0.1, curvature_coupling=1.0)),
    )
    material = MATERIALS["soft"]
    effects = (Membrane(material), Bending(material), Ground(1.0), Gravity(1.0), Inertia(1.0, material))
    together = Potential(d, effects, rest, step)
    alone = [Potential(d, (effect,), rest, step) for effect in effects]
    sparsity = Sparsity(d, np.ones(d.size, bool))
    assert together.energy(u) == pytest.approx(sum(p.energy(u) for p in alone), rel=1e-13)
    np.testing.assert_allclose(together.gradient(u), sum(p.gradient(u) for p in alone), atol=1e-12)
    total = sparsity.assemble(together.hessian_blocks(u))
    parts = sum(sparsity.assemble(p.hessian_blocks(u)) for p in alone)
    np.testing.assert_allclose(total, parts, atol=1e-12 * np.abs(total).max())
    energy, gradient = together.energy_and_gradient(u)
    assert energy == pytest.approx(together.energy(u), rel=1e-14)
    np.testing.assert_array_equal(gradient, together.gradient(u))
