"""Growth: laws, rest states, bilayers, and the shapes that they make."""

import numpy as np
import pytest
import skfem
from numpy.typing import NDArray

from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rest_state import RestState, grown_state, tensor_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.kinematics.surface import AnnulusSector, Cylinder
from fem_check.shell.material import Material
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.ramp import ramp
from linear_theory import SineWave
from linear_theory.growth.bilayer import bilayer
from linear_theory.growth.growth import Growth
from linear_theory.growth.laws import GROWTH_LAWS
from tests.shell.shell_cases import koiter, shell

Array = NDArray[np.float64]


def free_sheet(element: str, n: int, width: float = 0.5) -> Discretisation:
    return shell(element, (-width / 2, width / 2, n), (-0.5, 0.5, 2 * n))


def curvatures(d: Discretisation, u: Array) -> tuple[Array, Array]:
    """Mean and Gauss curvature at the quadrature points."""
    state = PointState(d.interior, u, (1, 2, 3, 4, 5))
    (a11, a22, a12), (b11, b22, b12) = state.metric, state.curvature
    det = a11 * a22 - a12**2
    return (b11 * a22 - 2 * b12 * a12 + b22 * a11) / (2 * det), (b11 * b22 - b12**2) / det


def grown(d: Discretisation, material: Material, rest: object, **options: float) -> object:
    """The free sheet with rest(s) ramped up to s = 1."""
    minimiser = Minimiser(Supports(d).anchor((0, 0)))
    effects = koiter(material) if d.components == 3 else (Membrane(material),)
    return ramp(minimiser, lambda s: Potential(d, effects, rest(s)), d.zeros(), **options)


@pytest.mark.parametrize("law", GROWTH_LAWS)
def test_growth_laws(law: str) -> None:
    c = np.linspace(-1, 1, 7)
    expected = {"exp": np.exp(0.4 * c), "linear": (1 + 0.2 * c) ** 2, "metric": 1 + 0.4 * c}[law]
    np.testing.assert_allclose(Growth(0.2, law).metric(c), expected, rtol=1e-15)
    small = Growth(1e-6, law).metric(c)
    np.testing.assert_allclose(small, 1 + 2e-6 * c, atol=1e-11)


def test_equal_layers_bend_by_three_halves_of_the_mismatch() -> None:
    """Curvature 3 eps/(2h), strain eps/2 in the middle: beta = 100 alpha at h = 0.03 (F7)."""
    alpha, curvature = bilayer(0.2, 0.03)
    assert curvature == pytest.approx(1.5 * 0.2 / 0.03, rel=1e-14)
    assert alpha == pytest.approx(0.1, rel=1e-14)
    assert curvature == pytest.approx(100 * alpha, rel=1e-14)


@pytest.mark.parametrize(("m", "n"), [(0.5, 1.0), (1.0, 3.0), (0.2, 10.0), (4.0, 0.3)])
def test_bilayer_against_the_minimum_of_its_energy(m: float, n: float) -> None:
    """Strain e + k z through two layers, the upper one with misfit eps: minimum over e and k.

    z from the middle of the stack; k > 0 lengthens the upper side.
    """
    eps, h = 0.01, 0.05
    split = -h / 2 + h / (1 + m)
    moments = [
        [
            (split ** (p + 1) - (-h / 2) ** (p + 1)) / (p + 1),
            ((h / 2) ** (p + 1) - split ** (p + 1)) / (p + 1),
        ]
        for p in range(3)
    ]
    total = [low + n * up for low, up in moments]
    load = [n * eps * moments[0][1], n * eps * moments[1][1]]
    strain, slope = np.linalg.solve([[total[0], total[1]], [total[1], total[2]]], load)
    alpha, curvature = bilayer(eps, h, m, n)
    assert curvature == pytest.approx(slope, rel=1e-12)
    assert alpha == pytest.approx(strain, rel=1e-12)


@pytest.mark.parametrize("area", ["grown", "undeformed"])
def test_rest_states(area: str) -> None:
    d = Discretisation(
        skfem.MeshQuad.init_tensor(np.linspace(0.6, 1, 3), np.linspace(0, 1, 3)),
        skfem.ElementQuadBFS(),
        Cylinder(0.8),
    )
    region = d.interior
    c = np.linspace(-1, 1, region.size)
    rest = grown_state(region, c, Growth(0.2, curvature_coupling=3.0, energy_area=area))
    np.testing.assert_allclose(rest.abar, np.exp(0.4 * c) * region.metric)
    np.testing.assert_allclose(rest.bbar, region.curvature - 3 * c * rest.abar)
    measure = np.exp(0.4 * c) * region.measure
    np.testing.assert_allclose(rest.grown_area, measure)
    np.testing.assert_allclose(rest.measure, measure if area == "grown" else region.measure)
    other = grown_state(region, c, Growth(0.2, curvature_coupling=3.0, curvature="undeformed"))
    np.testing.assert_allclose(other.bbar, region.curvature - 3 * c * region.metric)


@pytest.mark.parametrize("element", ["bfs", "argyris"])
@pytest.mark.parametrize("stretch", [0.7, 1.5])
def test_uniform_growth_is_pure_dilation_without_energy(element: str, stretch: float) -> None:
    d = free_sheet(element, 2)

    def rest(s: float) -> RestState:
        return tensor_state(d.interior, [(1 + s * (stretch - 1)) ** 2] * 2 + [0], [0, 0, 0])

    result = grown(d, Material(0.03, 0.5), rest)
    first, second = d.interior.position(result.state, (1, 2))
    assert result.energy < 1e-25
    np.testing.assert_allclose(first, np.array([[stretch], [0], [0]]) + 0 * first, atol=1e-10)
    np.testing.assert_allclose(second, np.array([[0], [stretch], [0]]) + 0 * second, atol=1e-10)
    assert not result.buckled


def test_uniform_growth_of_a_planar_ring() -> None:
    """A ring in the plane grows to a similar one, up to what its polynomials can say."""
    ring = Discretisation(
        skfem.MeshTri.init_tensor(np.linspace(0.6, 1, 3), np.linspace(0, 1, 4)),
        skfem.ElementTriP4(),
        AnnulusSector(),
        2,
    )
    supports = Supports(ring)
    supports.held[ring.dofs_at((0.6, 0))["u"]] = True
    supports.held[ring.dofs_at((1.0, 0))["u"], 1] = True
    rest = grown_state(ring.interior, 1.0, Growth(0.1))
    result = Minimiser(supports).minimise(
        Potential(ring, (Membrane(Material(0.1, 0.3)),), rest), ring.zeros()
    )
    stretched = ring.interior.position(result.state, (1, 2))
    expected = np.exp(0.1) * ring.interior.reference[1:3]
    assert np.abs(stretched - expected).max() < 1e-4  # the ring is not a polynomial of the parameters
    assert result.energy < 1e-11


@pytest.mark.parametrize(("element", "orders"), [("bfs", 1.8), ("argyris", 3.5)])
def test_one_curvature_rolls_up_an_exact_cylinder(element: str, orders: float) -> None:
    """bbar = diag(0, kappa): curvature kappa along the sheet; its error falls at the rate p - 1."""
    kappa, errors = 3.0, []
    for n in (2, 4, 8) if element == "bfs" else (1, 2, 4):
        d = free_sheet(element, n)
        result = grown(
            d,
            Material(0.03, 0.5),
            lambda s, d=d: tensor_state(d.interior, [1, 1, 0], [0, kappa * s, 0]),
        )
        mean, gauss = curvatures(d, result.state)
        errors.append(np.sqrt(np.average((mean - kappa / 2) ** 2 + gauss**2)))
        assert not result.buckled
    assert errors[-1] < 5e-3 * kappa
    assert np.log2(errors[-2] / errors[-1]) > orders


def test_a_bent_sheet_is_a_cap_when_small_and_a_cylinder_when_large() -> None:
    """bbar = kappa abar. Small: a cap, K = kappa^2; large: a cylinder of curvature (1 + nu) kappa.

    The mean curvature falls from kappa to (1 + nu)/2 kappa = 3/4 kappa (Pezzulla et al. 2016,
    arXiv:1509.05259), the Gauss curvature to zero but for a layer of width sqrt(h/kappa) at the edges.
    """
    d, material = free_sheet("bfs", 4), Material(0.01, 0.5)
    means, gausses = [], []
    for kappa in (0.03, 0.3, 1.0, 3.0):
        result = grown(
            d,
            material,
            lambda s, k=kappa: tensor_state(d.interior, [1, 1, 0], [k * s, k * s, 0]),
            first=0.2,
            follow=1e-3,
        )
        assert not result.buckled
        mean, gauss = curvatures(d, result.state)
        means.append(np.average(mean) / kappa)
        gausses.append(np.average(gauss) / kappa**2)
    assert means[0] == pytest.approx(1, abs=0.01)
    assert gausses[0] == pytest.approx(1, abs=0.02)
    assert np.all(np.diff(means) < 0)
    assert np.all(np.diff(gausses) < 0)
    assert means[-1] == pytest.approx(0.75, abs=0.03)
    middle = PointState(d.point((0.0, 0.0)), result.state, (1, 2, 3, 4, 5)).curvature[:2, 0]
    assert sorted(middle) == pytest.approx([0, 1.5 * 3.0], abs=0.15)


def test_equal_bilayer_bends_to_its_curvature() -> None:
    """A narrow strip, nu = 0: its curvature along its length is that of the formula."""
    eps, h = 0.004, 0.02
    alpha, curvature = bilayer(eps, h)
    d = shell("bfs", (-0.02, 0.02, 1), (-0.5, 0.5, 8))
    result = grown(
        d,
        Material(h, 0.0),
        lambda s: grown_state(d.interior, 1.0, Growth(alpha * s, curvature_coupling=curvature * s)),
        first=0.5,
    )
    state = PointState(d.interior, result.state, (1, 2, 3, 4, 5))
    along = state.curvature[1] / state.metric[1]
    np.testing.assert_allclose(along, -1.5 * eps / h, rtol=3e-3)


@pytest.mark.parametrize("law", GROWTH_LAWS)
def test_planar_waves_on_four_kinds_of_element_agree(law: str) -> None:
    """Energy of the sheet at alpha = 0.25, free in its plane."""
    energies = []
    for element, n in (
        (skfem.ElementQuad2(), 8),
        (skfem.ElementTriP4(), 4),
        (skfem.ElementQuadBFS(), 6),
        (skfem.ElementTriArgyris(), 3),
    ):
        kind = skfem.MeshQuad if "Quad" in type(element).__name__ else skfem.MeshTri
        mesh = kind.init_tensor(np.linspace(-0.25, 0.25, n + 1), np.linspace(-0.5, 0.5, 2 * n + 1))
        d = Discretisation(mesh, element, components=2)
        c = SineWave().value(*d.interior.parameters.reshape(2, -1), 0.1)
        result = grown(
            d,
            Material(0.03, 0.5),
            lambda s, d=d, c=c: grown_state(d.interior, c, Growth(0.25 * s, law=law)),
        )
        energies.append(result.energy)
        assert not result.buckled
    np.testing.assert_allclose(energies, energies[-1], rtol=5e-3)
