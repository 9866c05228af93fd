"""Meshes that are not one sheet are refused at every entrance, in any unit of length."""

import numpy as np
import pytest
import skfem

from fem_check import Material, Membrane, Outline, Scene, plane_stress_field
from fem_check.mesh.checks import check_mesh
from fem_check.shell.kinematics.discretisation import Discretisation
from linear_theory import Sheet, SineWave

X, Y = np.linspace(-0.25, 0.25, 5), np.linspace(-0.5, 0.5, 9)
TRIANGLES = skfem.MeshTri.init_tensor(X, Y)
QUADS = skfem.MeshQuad.init_tensor(X, Y)


def beside(one, other):
    """Both meshes as one, nothing merged."""
    return type(one)(
        np.hstack([one.p, other.p]), np.hstack([one.t, other.t + one.p.shape[1]]), sort_t=False
    )


def halves(across=5, shift=0.0):
    lower = skfem.MeshQuad.init_tensor(X, Y[:5])
    return beside(lower, skfem.MeshQuad.init_tensor(np.linspace(-0.25, 0.25, across), Y[4:] + shift))


def doubled(mesh, where):
    return type(mesh)(mesh.p, np.hstack([mesh.t, mesh.t[:, where(mesh.p[:, mesh.t].mean(1))]]))


def moved(mesh, vertex, to):
    p = mesh.p.copy()
    p[:, vertex] = to
    return type(mesh)(p, mesh.t)


def middle(mesh):
    return int(np.abs(mesh.p).sum(0).argmin())


def hinged():
    """A triangle more at the upper right corner."""
    corner, count = int(TRIANGLES.p.sum(0).argmax()), TRIANGLES.p.shape[1]
    p = np.hstack([TRIANGLES.p, [[0.4, 0.25], [0.5, 0.7]]])
    return skfem.MeshTri(p, np.hstack([TRIANGLES.t, [[corner], [count], [count + 1]]]))


def pinched():
    """A chain of four triangles that touch at vertices alone, but for two of them."""
    p = np.array([[0, 1, 2, 2, 1, 0, 0.5], [0, 0.5, 0, 1, 1.5, 1, 0.5]])
    t = np.array([[0, 1, 6], [1, 2, 3], [1, 3, 4], [4, 5, 6]]).T
    return skfem.MeshTri(p, t)


def ramp():
    """A spiral of one and a half turns whose end lies on its start."""
    angle = np.linspace(0.03, 3 * np.pi, 43)
    radius = np.array([[0.5], [1.0]]) + 0.01 * angle
    p = np.stack([(radius * np.cos(angle)).ravel(), (radius * np.sin(angle)).ravel()])
    i = np.arange(42)
    return skfem.MeshTri(p, np.hstack([[i, i + 1, i + 43], [i + 1, i + 44, i + 43]]))


def crossed_sheets():
    """Two discs on each other, joined crosswise along a slit: no edge is wrong, the area is."""
    small, large = (skfem.MeshTri.init_tensor(*[np.linspace(-n, n, 2 * n + 1)] * 2) for n in (3, 5))
    at = {tuple(p): i for i, p in enumerate(small.p.T)}
    below = large.p[1, large.t].mean(0) < 0
    count, t = small.p.shape[1], large.t + small.p.shape[1]
    lower_small = small.p[1, small.t].mean(0) < 0
    t_small = small.t.copy()
    for i, point in enumerate(large.p.T):
        if point[1] == 0 and abs(point[0]) == 1:  # the ends of the slit are one in both
            t[large.t == i] = at[tuple(point)]
    inner = int(np.flatnonzero((large.p == 0).all(0))[0])
    t[(large.t == inner) & below] = at[0.0, 0.0]  # the lower part of the one hangs on the upper of the
    t_small[(small.t == at[0.0, 0.0]) & lower_small] = inner + count  # other, and the other way round
    # edges from the ends to the middle differ between the sheets, since the middle has two numbers
    mesh = skfem.MeshTri(np.hstack([small.p, large.p]), np.hstack([t_small, t]))
    return mesh.remove_unused_nodes()


FAULTS = {
    "seam": (
        halves(),
        r"10 vertices lie on edges .* first 4 and 25 at x = -0.25, y = 0: merge these",
    ),
    "seam in single precision": (halves(shift=3e-8), "merge these"),
    "hanging nodes": (halves(across=4), r"9 vertices lie on edges .* not connected"),
    "a hanging node": (
        skfem.MeshTri(
            np.array([[0, 2, 1, 1, 0, 2], [0, 0, 0, 1, 1, 1]], float),
            np.array([[0, 1, 3], [0, 3, 4], [1, 5, 3]]).T,
        ),
        "belong to no element: 2",
    ),
    "a hanging node of two elements": (
        skfem.MeshTri(
            np.array([[0, 2, 1, 1, 0, 2], [0, 0, 0, 1, -1, -1]], float),
            np.array([[0, 1, 3], [0, 2, 4], [2, 1, 5], [2, 4, 5]]).T,
        ),
        r"1 vertices lie on edges .* first 2 at x = 1, y = 0 on the edge from 0 to 1: split that edge",
    ),
    "elements twice": (
        doubled(TRIANGLES, lambda centre: centre[1] > 0.25),
        r"16 of 80 elements are duplicates; remove one of each pair: ",
    ),
    "three at an edge": (
        skfem.MeshTri(
            np.array([[0, 1, 0, 1, 0.5], [0, 0, 1, 1, -0.5]]),
            np.array([[0, 0, 0], [1, 1, 1], [2, 3, 4]]),
        ),
        "3 of 3 elements are at an edge shared by more than two: 0, 1, 2",
    ),
    "inverted": (moved(TRIANGLES, middle(TRIANGLES), (0.3, 0.0)), "are inverted"),
    "flat": (moved(TRIANGLES, middle(TRIANGLES), (0.125, 0.0)), "inverted or have no area"),
    "folded quadrilateral": (moved(QUADS, middle(QUADS), (0.2, 0.2)), "inverted or have no area"),
    "overlapping itself": (ramp(), "elements overlap: the boundary crosses itself"),
    "two sheets joined crosswise": (
        crossed_sheets(),
        r"elements overlap: their total area is 2\.125 times",
    ),
    "pieces": (
        beside(TRIANGLES, skfem.MeshTri(TRIANGLES.p + 3, TRIANGLES.t)),
        "has 2 separate pieces, must be one; elements 0 and 64 are in two",
    ),
    "hinge": (hinged(), r"parts are connected only by single vertices \(hinges\): 44"),
    "pinched ring": (pinched(), r"\(hinges\): 1, 4, 6"),
    "unused vertex": (
        skfem.MeshTri(np.hstack([TRIANGLES.p, [[0.1], [0.1]]]), TRIANGLES.t),
        "1 vertices belong to no element: 45; remove them",
    ),
    "curved sides": (skfem.MeshTri2.init_circle(1), "mesh = MeshTri2: must be triangles"),
    "in space": (skfem.MeshTet(), "mesh = MeshTet1: must be triangles or quadrilaterals in the plane"),
}


@pytest.mark.parametrize("unit", [1.0, 1e-9, 1e9])
@pytest.mark.parametrize("name", FAULTS)
def test_faults_are_named_in_any_unit(name, unit):
    mesh, words = FAULTS[name]
    if unit != 1:
        mesh, words = type(mesh)(mesh.p * unit, mesh.t), words.split(" at x")[0]
    with pytest.raises(ValueError, match=words):
        check_mesh(mesh)


@pytest.mark.parametrize("name", ["seam in single precision", "elements twice", "hinge", "pieces"])
def test_every_entrance_checks(name):
    mesh, words = FAULTS[name]
    words = words.split(" at x")[0]
    triangles = mesh.t.shape[0] == 3
    element = skfem.ElementTriP2() if triangles else skfem.ElementQuad2()
    with pytest.raises(ValueError, match=words):
        Discretisation(mesh, element, components=2)
    with pytest.raises(ValueError, match=words):
        Scene(Sheet(), SineWave(), 0.1, effects=[Membrane(Material(0.03, 0.5))], mesh=mesh)
    if triangles:
        with pytest.raises(ValueError, match=words):
            plane_stress_field(mesh, SineWave())


@pytest.mark.parametrize("unit", [1.0, 1e-9, 1e9])
@pytest.mark.parametrize(
    "mesh",
    [
        TRIANGLES,
        QUADS,
        skfem.MeshTri.init_circle(3),
        skfem.MeshTri.init_lshaped().refined(1),
        skfem.MeshTri.init_tensor(np.linspace(0, 1e-3, 3), np.linspace(0, 1, 5)),
        skfem.MeshTri(TRIANGLES.p + 1e6, TRIANGLES.t),
        Outline([[0, 0], [1, 0], [1, 1], [0.5, 1], [0.499, 1.001], [0, 1]]).mesh(0.3),
        Outline(
            np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]), [[[0, 0.9], [0.3, 0.5], [0, 0.1]]]
        ).mesh(1),
    ],
)
def test_good_meshes_pass(mesh, unit):
    check_mesh(type(mesh)(mesh.p * unit, mesh.t))


@pytest.mark.parametrize(
    ("mesh", "sheet", "good"),
    [
        (TRIANGLES, Sheet(), True),
        (TRIANGLES, Sheet(width=0.6), True),  # narrower, as a trapezoid is somewhere
        (TRIANGLES, Sheet(length=1.05), True),  # a polygon inscribed in a curved outline
        (TRIANGLES, Sheet(length=1.2), False),
        (TRIANGLES, Sheet(width=0.4), False),
        (skfem.MeshTri(1e3 * TRIANGLES.p, TRIANGLES.t), Sheet(), False),  # mm for m
        (skfem.MeshTri(1e-3 * TRIANGLES.p, TRIANGLES.t), Sheet(), False),
        (skfem.MeshTri(1e3 * TRIANGLES.p, TRIANGLES.t), Sheet(1e3, 500.0, thickness=30.0), True),
        (skfem.MeshTri(TRIANGLES.p + 0.5, TRIANGLES.t), Sheet(), False),
        (skfem.MeshTri(TRIANGLES.p[::-1].copy(), TRIANGLES.t), Sheet(), False),
    ],
)
def test_a_mesh_must_be_in_the_coordinates_of_its_sheet(mesh, sheet, good):
    effects = [Membrane(Material(sheet.thickness, 0.5))]
    if good:
        Scene(sheet, SineWave(), 0.1, effects=effects, mesh=mesh)
        return
    with pytest.raises(ValueError, match=r"mesh: is .* by .* must lie within the sheet, .* unit"):
        Scene(sheet, SineWave(), 0.1, effects=effects, mesh=mesh)
