"""The order in which a mesh names its vertices changes no answer."""

from itertools import pairwise

import numpy as np
import pytest
import skfem

from fem_check import Bending, Material, Membrane, Scene, plane_stress_field
from fem_check.mesh.orientation import oriented
from fem_check.shell.cycle.shapes import cycle_of_shapes
from linear_theory import Sheet, SineWave

X, Y = np.linspace(-0.25, 0.25, 4), np.linspace(-0.5, 0.5, 7)
QUADS, TRIANGLES = skfem.MeshQuad.init_tensor(X, Y), skfem.MeshTri.init_tensor(X, Y)
STRETCHING, BENDING = Membrane(Material(0.1, 0.5)), Bending(Material(0.1, 0.5))
SIDES = {3: ((0, 1), (1, 2), (0, 2)), 4: ((0, 1), (1, 2), (3, 2), (0, 3))}
"""Directions of the functions of edges in scikit-fem's triangles and quadrilaterals."""


def split(triangles):
    """Three quadrilaterals in each triangle: vertices where three, four and six of them meet."""
    vertices, edges = triangles.p.shape[1], triangles.facets.shape[1]
    middles = triangles.p[:, triangles.facets].mean(1), triangles.p[:, triangles.t].mean(1)
    ab, bc, ac = vertices + triangles.t2f
    (a, b, c), centre = triangles.t, vertices + edges + np.arange(triangles.t.shape[1])
    corners = [(a, ab, centre, ac), (b, bc, centre, ab), (c, ac, centre, bc)]
    return skfem.MeshQuad(np.hstack([triangles.p, *middles]), np.hstack([np.stack(q) for q in corners]))


def renamed(mesh, seed):
    """Vertices numbered anew, those of each element from another start and half of them backwards."""
    rng = np.random.default_rng(seed)
    numbers = rng.permutation(mesh.p.shape[1])
    places = np.empty_like(mesh.p)
    places[:, numbers] = mesh.p
    corners = numbers[mesh.t]
    for column in corners.T:
        column[:] = np.roll(column, rng.integers(len(column)))[:: rng.choice([1, -1])]
    return type(mesh)(places, corners, sort_t=False)


def torn(mesh):
    """Edges that their elements take in opposite directions."""
    ends = [mesh.t[list(side)].T for side in SIDES[len(mesh.t)]]
    every = np.unique(np.vstack(ends), axis=0)
    return len(every) - len(np.unique(np.sort(every, axis=1), axis=0))


@pytest.mark.parametrize("seed", range(20))
@pytest.mark.parametrize(
    "mesh", [QUADS, TRIANGLES, split(TRIANGLES), split(skfem.MeshTri.init_lshaped().refined())]
)
def test_neighbours_agree(mesh, seed):
    given = renamed(mesh, seed)
    found = oriented(given)
    assert torn(given) > 0 == torn(found)
    np.testing.assert_array_equal(np.sort(found.t, axis=0), np.sort(given.t, axis=0))
    assert oriented(found) is found
    if len(mesh.t) == 4:  # neighbours around an element remain neighbours
        around = {frozenset(pair) for quad in given.t.T for pair in pairwise([*quad, quad[0]])}
        assert around == {frozenset(pair) for quad in found.t.T for pair in pairwise([*quad, quad[0]])}


def places(mesh, effects):
    """Where the vertices of TRIANGLES are in a static shape of the grown sheet."""
    shapes = cycle_of_shapes(
        Scene(Sheet(thickness=0.1), SineWave(), 0.02, effects=effects, mesh=mesh), 4
    )
    points = shapes.discretisation.points(TRIANGLES.p)
    return points.position(shapes.states[1], (0,))


@pytest.mark.parametrize(
    ("mesh", "effects"),
    [(QUADS, [STRETCHING]), (TRIANGLES, [STRETCHING]), (TRIANGLES, [STRETCHING, BENDING])],
    ids=["QuadP", "P4", "Argyris"],
)
def test_static_shapes(mesh, effects):
    """Speeds were wrong by 0.3, 14 and 6 % where neighbours disagreed."""
    expected = places(mesh, effects)
    np.testing.assert_allclose(places(renamed(mesh, 0), effects), expected, atol=1e-9)  # Newton's


@pytest.mark.parametrize("mesh", [QUADS, QUADS.refined(), TRIANGLES, TRIANGLES.refined()])
def test_a_mesh_on_which_neighbours_agree_is_left_as_it_is(mesh):
    assert oriented(mesh) is mesh


def test_small_strain():
    """A third wrong here where neighbours disagreed."""
    one, other = (
        plane_stress_field(mesh, SineWave(), degree=4) for mesh in (TRIANGLES, renamed(TRIANGLES, 0))
    )
    at = (np.array([0.1, -0.2]), np.array([0.2, 0.4]), 0.3)
    np.testing.assert_allclose(other.displacement(*at), one.displacement(*at), rtol=1e-10)
    assert other.error == pytest.approx(one.error, rel=1e-6)
