"""Bad input: a ValueError that names the argument, its value and what is allowed."""

from collections.abc import Callable

import numpy as np
import pytest
import skfem

from fem_check.mesh.elements import default_cells
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.effects.loads import DeadLoad, EdgeMoment
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rates import Affine, Step, backward_euler
from fem_check.shell.kinematics.rest_state import grown_state, tensor_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.kinematics.surface import Cylinder, SpherePart
from fem_check.shell.material import Material
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Load, Potential
from fem_check.shell.statics.ramp import ramp
from linear_theory import Sheet, SineWave
from linear_theory.growth.bilayer import bilayer
from linear_theory.growth.growth import Growth
from linear_theory.scene.scene import Scene
from tests.shell.shell_cases import at, koiter, shell

PAPER = Material(0.03, 0.5)
GRID = np.linspace(0, 1, 3)
TRIANGLES = skfem.MeshTri.init_tensor(GRID, GRID)
QUADS = skfem.MeshQuad.init_tensor(GRID, GRID)
BFS, ARGYRIS = skfem.ElementQuadBFS(), skfem.ElementTriArgyris()


def moved(mesh: object, vertex: int, to: tuple[float, float]) -> object:
    p = mesh.p.copy()
    p[:, vertex] = to
    return type(mesh)(p, mesh.t)


def centre(mesh: object) -> int:
    return int(np.abs(mesh.p - 0.5).sum(0).argmin())


PLATE = shell("bfs", (0, 1, 1), (0, 1, 1))
PLANAR = Discretisation(QUADS, skfem.ElementQuad2(), components=2)
REST = grown_state(PLATE.interior)
FLAT_REST = grown_state(PLANAR.interior)
STILL = Step(Affine(1.0, PLATE.interior.reference[0]))

CASES: dict[str, tuple[str, Callable[[], object]]] = {
    "inverted triangle": (
        r"mesh: \d+ of 8 elements are inverted",
        lambda: Discretisation(moved(TRIANGLES, centre(TRIANGLES), (1.6, 0.5)), ARGYRIS),
    ),
    "flat triangle": (
        "inverted or have no area",
        lambda: Discretisation(moved(TRIANGLES, centre(TRIANGLES), (1.0, 0.5)), ARGYRIS),
    ),
    "folded quadrilateral": (
        "inverted or have no area",
        lambda: Discretisation(
            moved(QUADS, centre(QUADS), (1.3, 1.3)), skfem.ElementQuad2(), components=2
        ),
    ),
    "oblique BFS": (
        "not axis-parallel rectangles",
        lambda: Discretisation(moved(QUADS, centre(QUADS), (0.6, 0.5)), BFS),
    ),
    "mesh not finite": (
        "mesh.p must be finite",
        lambda: Discretisation(moved(QUADS, 0, (np.nan, 0)), BFS),
    ),
    "element of another shape": (
        "element = ElementTriArgyris: must be",
        lambda: Discretisation(QUADS, ARGYRIS),
    ),
    "element not conforming": (
        "element = ElementTriMorley: must be conforming",
        lambda: Discretisation(TRIANGLES, skfem.ElementTriMorley()),
    ),
    "element not continuous": (
        "must be a scalar, continuous element",
        lambda: Discretisation(TRIANGLES, skfem.ElementTriRT1()),
    ),
    "element not H2": (
        "element = ElementQuad2: must be H2",
        lambda: Potential(
            Discretisation(QUADS, skfem.ElementQuad2()),
            koiter(PAPER),
            grown_state(Discretisation(QUADS, skfem.ElementQuad2()).interior),
        ),
    ),
    "components": ("components = 4", lambda: Discretisation(QUADS, BFS, components=4)),
    "degree": ("degree = 0", lambda: Discretisation(QUADS, BFS, degree=0)),
    "curved plane": (
        "surface = Cylinder",
        lambda: Discretisation(QUADS, BFS, Cylinder(1.0), components=2),
    ),
    "radius": ("radius = 0", lambda: Cylinder(0.0)),
    "sphere radius": ("radius = -1", lambda: SpherePart(-1.0)),
    "thickness": ("thickness = 0: must be > 0", lambda: Material(0.0, 0.5)),
    "young": ("young = -1: must be > 0", lambda: Material(0.1, 0.5, -1.0)),
    "poisson": ("poisson = 0.6", lambda: Material(0.1, 0.6)),
    "law": ("law = 'cubic'", lambda: Growth(0.1, "cubic")),
    "growth not finite": (
        "growth contains nan",
        lambda: grown_state(PLATE.interior, np.nan, Growth(0.1)),
    ),
    "growth that shrinks to nothing": (
        r"alpha = 1.2: alpha c = -1.2 is not within -1, .*must be < 1",
        lambda: Growth(1.2, "linear").metric(-1.0),
    ),
    "metric law that shrinks to nothing": (
        "not within -0.5, .*must be < 0.5",
        lambda: Growth(0.5, "metric").metric(-1.0),
    ),
    "metric not definite": (
        "abar has determinant",
        lambda: tensor_state(PLATE.interior, [1, 1, 2], [0, 0, 0]),
    ),
    "bbar not finite": (
        "bbar contains inf",
        lambda: tensor_state(PLATE.interior, [1, 1, 0], [np.inf, 0, 0]),
    ),
    "measure": (
        "area = 'current'",
        lambda: grown_state(PLATE.interior, 0.0, Growth(0.0, energy_area="current")),
    ),
    "curvature form": (
        "curvature = 'printed'",
        lambda: grown_state(PLATE.interior, 0.0, Growth(0.0, curvature="printed")),
    ),
    "bilayer": ("thickness_ratio = 0", lambda: bilayer(0.1, 0.03, 0.0)),
    "weight": ("weight = 0: must be > 0", lambda: Gravity(0.0)),
    "load area": ("load = 'printed'", lambda: Gravity(1.0, "printed")),
    "stiffness": ("stiffness = 0: must be > 0", lambda: Ground(0.0)),
    "damping": ("damping = -1: must be >= 0", lambda: Ground(1.0, -1.0)),
    "ground form": ("form = 'sticky'", lambda: Ground(1.0, form="sticky")),
    "friction coefficient": ("coefficient = -0.1", lambda: Friction(-0.1, 1.0)),
    "no friction": ("coefficient = 0: must be > 0", lambda: Friction(0.0, 1.0)),
    "slip speed": ("slip_speed = 0: must be > 0", lambda: Friction(0.7, 0.0)),
    "density": ("density = 0: must be > 0", lambda: Inertia(0.0, PAPER)),
    "dt": ("dt = 0: must be > 0", lambda: backward_euler(np.zeros((3, 1)), 0.0)),
    "force": (r"force contains nan", lambda: DeadLoad((np.nan, 0.0, 0.0))),
    "force in space": (
        "force has 2 components: must have 3",
        lambda: Potential(PLATE, (), loads=(Load(PLATE.interior, DeadLoad((1.0, 0.0))),)),
    ),
    "entry": ("entry = 3", lambda: EdgeMoment(1.0, entry=3)),
    "no effects": ("effects is empty", lambda: Potential(PLATE, ())),
    "no rest state": ("rest = None", lambda: Potential(PLATE, (Membrane(PAPER),))),
    "friction without ground": (
        "Friction must come with Ground",
        lambda: Scene(Sheet(), SineWave(), 0.1, effects=(*koiter(PAPER), Friction(0.7, 1.0))),
    ),
    "planar friction without weight": (
        "Friction must come with Gravity",
        lambda: Scene(Sheet(), SineWave(), 0.1, effects=(Membrane(PAPER), Friction(0.7, 1.0))),
    ),
    "static friction": (
        "step: Friction needs",
        lambda: Potential(PLATE, (Friction(0.7, 1.0), Ground(1.0)), REST),
    ),
    "static inertia": (
        "step: must have an acceleration for Inertia",
        lambda: Potential(PLATE, (Inertia(1.0, PAPER),), REST, STILL),
    ),
    "current area in statics": (
        "load = 'current': must come with a step",
        lambda: Potential(PLATE, (Gravity(1.0, "current"),), REST),
    ),
    "planar bending": ("Bending must not", lambda: Potential(PLANAR, (Bending(PAPER),), FLAT_REST)),
    "planar ground": ("Ground must not", lambda: Potential(PLANAR, (Ground(1.0),), FLAT_REST)),
    "tolerance": ("rtol = 0", lambda: Minimiser(Supports(PLATE), tolerance=0.0)),
    "iterations": ("iterations = 0", lambda: Minimiser(Supports(PLATE), iterations=0)),
    "first increment": (
        r"first = 2: must be in \(0, 1\]",
        lambda: ramp(Minimiser(Supports(PLATE)), lambda s: None, PLATE.zeros(), first=2.0),
    ),
    "no such edge": ("at least one boundary edge", lambda: PLATE.edge(at(0, 7))),
    "point outside": (r"xi = \[7. 0.\]: must be in", lambda: PLATE.point((7.0, 0.0))),
    "point of wrong shape": ("xi has shape", lambda: PLATE.point((1.0,))),
    "held components": ("components", lambda: Supports(PLANAR).pin(at(0, 0), (2,))),
    "slope of Lagrange": (
        "must be BFS or Argyris",
        lambda: Supports(PLANAR).hold_slope(at(0, 0), (0,)),
    ),
    "oblique edge": (
        "along the axes",
        lambda: Supports(
            Discretisation(moved(TRIANGLES, int(TRIANGLES.p.sum(0).argmax()), (0.9, 0.9)), ARGYRIS)
        ).clamp(lambda xi: xi[0] > 0.8),
    ),
    "motions": ("motions = 'z'", lambda: Supports(PLATE).anchor(motions="z")),
    "anchor on a slope": (
        "parameter lines of the surface must run along x",
        lambda: Supports(Discretisation(QUADS, BFS, Cylinder(1.0))).anchor((1.0, 0.0)),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_bad_input_is_named(name: str) -> None:
    message, call = CASES[name]
    with pytest.raises(ValueError, match=message):
        call()


def test_good_meshes_are_accepted() -> None:
    """Unstructured triangles and distorted convex quadrilaterals are no inverted ones."""
    Discretisation(skfem.MeshTri.init_circle(2), ARGYRIS)
    Discretisation(moved(QUADS, centre(QUADS), (0.6, 0.55)), skfem.ElementQuad2(), components=2)
    Discretisation(skfem.MeshTri.init_lshaped().refined(1), skfem.ElementTriP2(), components=2)


def test_the_default_mesh_is_bounded() -> None:
    """A strip a millionth as wide as long has elements as long as growth asks for."""
    assert default_cells(SineWave().on(Sheet(width=1e-6)), True) == (2, 24)
    assert default_cells(SineWave().on(Sheet(width=1e-6)), False) == (6, 256)
    assert default_cells(SineWave().on(Sheet()), True) == (2, 4)
    assert default_cells(SineWave().on(Sheet(width=5.0)), True) == (10, 4)
    assert default_cells(SineWave().on(Sheet(width=1e6)), True) == (64, 4)
    with pytest.raises(ValueError, match=r"cells = \(2, 400000\): makes 800000 elements"):
        default_cells(SineWave(100_000).on(Sheet()), True)
    for cells, words in (
        ((2, 10**9), "2000000000 elements"),
        (np.array(5), "two integers"),
        ("24", "two"),
    ):
        with pytest.raises(ValueError, match=words):
            Scene(Sheet(), SineWave(), 0.1, effects=Membrane(Material(0.03, 0.5)), cells=cells)


@pytest.mark.parametrize("force", [5, (1.0,), (1.0, 2.0, 3.0, 4.0)])
def test_a_dead_load_has_two_or_three_components(force: object) -> None:
    with pytest.raises(ValueError, match=r"force has shape .*: must be \(2,\), or \(3,\) in space"):
        DeadLoad(force)
