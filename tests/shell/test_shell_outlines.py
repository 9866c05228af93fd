"""Sheets of any outline in the plane: supports that carry no force, and the limit of small growth."""

import numpy as np
import pytest
import skfem

from fem_check import Material, Membrane, Outline, Scene, cycle_speed, plane_stress_field
from fem_check.shell.cycle.balance import CycleBalance
from fem_check.shell.cycle.contact import Contact
from fem_check.shell.cycle.frame import gyration, moments
from fem_check.shell.cycle.shapes import cycle_of_shapes
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.ramp import ramp
from linear_theory import Sheet, TravellingWave
from linear_theory.balance.crawl import Crawl, first_resolution
from linear_theory.motion.rigid import RigidNorm

ANGLES = 2 * np.pi * np.arange(12) / 12
CIRCLE = np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1)
WAVE = TravellingWave([1.0, 0.5], [0.0, 0.0])  # a pulse: V of first order


def turned(corners, angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.asarray(corners) @ np.array([[c, s], [-s, c]])


SQUARE = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]])
SHAPES = {
    "ellipse": [CIRCLE * [0.25, 0.5]],
    "turned ellipse": [turned(CIRCLE * [0.25, 0.5], 0.5)],
    "arrow": [np.array([[-0.25, -0.5], [0.25, -0.5], [0.25, 0], [0, 0.5], [-0.25, 0]])],
    "triangle": [np.array([[-0.25, -0.5], [0.25, -0.3], [0, 0.5]])],
    "L": [np.array([[0, 0], [1, 0], [1, 0.5], [0.5, 0.5], [0.5, 1], [0, 1]]) - 0.5],
    "turned square": [turned(SQUARE, 0.4)],
    "disk with a hole": [0.5 * CIRCLE, 0.15 * CIRCLE[::3] + [0.1, 0]],
    "trapezoid": [np.array([[-0.3, -0.5], [0.3, -0.5], [0.1, 0.5], [-0.1, 0.5]])],
}


def outline(name):
    loop, *holes = SHAPES[name]
    middle = (loop.min(axis=0) + loop.max(axis=0)) / 2
    return Outline(loop - middle, [hole - middle for hole in holes])


def scene(name, alpha, mesh):
    shape = outline(name)
    sheet = Sheet(shape.length, shape.width)
    effects = [Membrane(Material(sheet.thickness, sheet.poisson))]
    return Scene(sheet, WAVE, alpha, effects=effects, mesh=mesh, element=skfem.ElementTriP2())


@pytest.mark.parametrize("name", SHAPES)
def test_any_pair_of_vertices_holds_the_sheet_without_force(name):
    sheet = ShellModel(scene(name, 0.2, outline(name).mesh(0.3)))
    discretisation, potential = sheet.discretisation, sheet.potential(sheet.rest(0.1))
    energies, squares = [], []
    for xi in ((0, 0), *discretisation.mesh.p.T[:3]):
        supports = Supports(discretisation).anchor(xi)
        assert supports.held.sum() == 3
        start = discretisation.zeros()
        state = ramp(
            Minimiser(supports, 1e-10), lambda s: sheet.potential(sheet.rest(0.1, s)), start
        ).state
        # forces are of the size of thickness times strain, 6e-3
        assert abs(potential.gradient(state)[~supports.free]).max() < 1e-12
        energies.append(potential.energy(state))
        _, first, second = discretisation.interior.position(state, (0, 1, 2))
        squares.append([(first**2).sum(0), (second**2).sum(0), (first * second).sum(0)])
    np.testing.assert_allclose(energies, energies[0], rtol=1e-10)
    np.testing.assert_allclose(squares, np.broadcast_to(squares[0], np.shape(squares)), atol=1e-8)


@pytest.mark.parametrize("name", SHAPES)
def test_small_growth_moves_it_as_linear_theory_says(name):
    """The same triangles and degree in both: what is left is of order alpha and of the balances."""
    alpha, times = 1e-3, np.array([0.05, 0.3])
    field = plane_stress_field(outline(name).mesh(0.8), WAVE, degree=2)
    crawl = Crawl(field, alpha, Contact(), first_resolution(1e-3))
    both = crawl.balance(np.concatenate([times, times + 0.5]))
    linear = alpha * (both.leading + alpha * both.remainder)
    shapes = cycle_of_shapes(scene(name, alpha, field.mesh), 8)
    found = CycleBalance(shapes, Contact(), 7, 14, 1e-7, False).balance(times)
    norm = RigidNorm(field.gyration, False)
    wrong = norm.speeds(found.leading.reshape(-1, 3).T - linear.T)
    # of order alpha and of the balances; met: 6e-4 to 2.8e-3
    assert abs(wrong).max() < 5e-3 * abs(norm.speeds(linear.T)).max()
    assert gyration(shapes.discretisation) == pytest.approx(field.gyration, rel=1e-12)
    centre = moments(shapes.discretisation, shapes.states[:1] * 0)[0, :2]
    np.testing.assert_allclose(centre, field.centre, atol=1e-13)


def test_the_numbers_of_the_vertices_do_not_matter():
    mesh = outline("triangle").mesh(1.0)
    order = np.random.default_rng(7).permutation(mesh.p.shape[1])
    again = skfem.MeshTri(mesh.p[:, order], np.argsort(order)[mesh.t])
    found = [cycle_speed(scene("triangle", 0.1, m), rtol=0.3) for m in (mesh, again)]
    assert found[1].mean == pytest.approx(found[0].mean, rel=1e-6)
    assert found[1].error == pytest.approx(found[0].error, rel=1e-3)
    assert found[0].mean != 0
