"""Equilibria of the nonlinear shell: exact shapes, classical loads, branches."""

import mpmath as mp
import numpy as np
import skfem
from numpy.typing import NDArray

from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rest_state import grown_state, tensor_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.material import Material
from fem_check.shell.statics.equilibrium import ConvergenceError, Equilibrium
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.orientation import Orientation
from fem_check.shell.statics.potential import Load, Potential
from fem_check.shell.statics.ramp import follow_mode, ramp
from linear_theory import SineWave
from linear_theory.growth.growth import Growth
from tests.robust.problems.problem import Outcome, Problem, case, family, stated
from tests.shell.heavy_elastica import rise, strip
from tests.shell.shell_cases import (
    ELEMENTS,
    affine,
    at,
    displacement,
    koiter,
    linear_response,
    rectangle,
    shell,
)

Array = NDArray[np.float64]

TURN = 1.5 * np.pi
"""By which a strip of length 1 rolls up."""


def rolled(sheet: Discretisation, thickness: float, tip: tuple[float, float] = (1.0, 0.0)) -> Outcome:
    """Rest curvature along x alone: the arc of a circle, without any strain (nu = 0)."""
    minimiser = Minimiser(Supports(sheet).clamp(at(0, 0)), iterations=100)

    def problem(share: float) -> Potential:
        rest = tensor_state(sheet.interior, [1, 1, 0], [share * TURN, 0, 0])
        return Potential(sheet, koiter(Material(thickness, 0.0)), rest)

    state = ramp(minimiser, problem, sheet.zeros(), first=0.1).state
    x, _, z = np.add(displacement(sheet, state, tip), (1.0, 0.0, 0.0))
    exact = np.array([np.sin(TURN), 1 - np.cos(TURN)]) / TURN
    error = float(np.hypot(x - exact[0], z - exact[1]))
    return Outcome(float(z), exact[1], 1e-3, error=error, stated=True)


def roll_of_thickness(thickness: float) -> Outcome:
    """Twelve elements along and one across: curvature and stretch must not compete."""
    return rolled(shell("bfs", (0, 1, 12), (0, 0.1, 1)), thickness)


def roll_of_long_elements() -> Outcome:
    """Elements ten times longer than wide."""
    return rolled(shell("bfs", (0, 1, 8), (0, 0.1, 8)), 0.03)


def leaning(angle: float) -> skfem.MeshTri:
    """Triangles of a strip whose inner lines run zig-zag at that angle."""
    mesh = skfem.MeshTri.init_tensor(np.linspace(0, 1, 9), np.linspace(0, 0.25, 3))
    inside = (mesh.p[0] > 0.01) & (mesh.p[0] < 0.99)
    row = np.round(mesh.p[1] / 0.125)
    shift = 0.5 * 0.125 * np.tan(np.deg2rad(angle)) * (-1.0) ** row
    points = mesh.p.copy()
    points[0] += np.where(inside, shift, 0)
    return skfem.MeshTri(points, mesh.t)


def roll_of_leaning_triangles(angle: float) -> Outcome:
    return rolled(Discretisation(leaning(angle), ELEMENTS["argyris"]()), 0.01)


def oblique_rectangles() -> Outcome:
    mesh = rectangle("bfs", (0, 1, 4), (0, 1, 4))
    points = mesh.p + np.array([[0.0], [1.0]]) * mesh.p[:1]
    return rolled(Discretisation(skfem.MeshQuad(points, mesh.t), skfem.ElementQuadBFS()), 0.01)


PLATE = 0.001265319087
"""Centre deflection w D/(q L^4) of a clamped square plate, Taylor & Govindjee 2004."""


def plate(thickness: float, across: int, along: int) -> Outcome:
    """A quarter of the plate; Kirchhoff's plate knows no thickness."""
    sheet = shell("bfs", (0, 0.5, across), (0, 0.5, along))
    supports = Supports(sheet).clamp(at(0, 0.5)).clamp(at(1, 0.5))
    supports.symmetric(at(0, 0), 0).symmetric(at(1, 0), 1)
    material = Material(thickness, 0.3)
    state = linear_response(sheet, supports, material, DeadLoad((0.0, 0.0, 1.0)))
    return stated(displacement(sheet, state, (0, 0))[2] * material.bending, PLATE, 1e-3)


def walled(h: float, elements: int = 12) -> tuple[Discretisation, Minimiser]:
    """A strip of length 1 between walls that clamp it."""
    sheet = shell("bfs", (0, 1, elements), (-0.05, 0.05, 1))
    return sheet, Minimiser(Supports(sheet).clamp(at(0, 0)).clamp(at(0, 1)), iterations=100)


def lengthened(sheet: Discretisation, h: float, growth: float) -> Potential:
    """Growth along the strip alone, nu = 0: a beam."""
    rest = tensor_state(sheet.interior, [(1 + growth) ** 2, 1, 0], [0, 0, 0])
    return Potential(sheet, koiter(Material(h, 0.0)), rest)


def euler_growth(h: float) -> Outcome:
    """The growth at which the flat strip stops to be a minimum, by bisection."""
    sheet, minimiser = walled(h)
    exact = (np.pi * h) ** 2 / 3
    low, high = 0.5 * exact, 1.5 * exact
    for _ in range(8):
        middle = (low + high) / 2
        flat = minimiser.minimise(lengthened(sheet, h, middle), sheet.zeros())
        low, high = (low, middle) if flat.buckled else (middle, high)
    # the interval, the elements, and that stress and strain differ by the strain itself
    return stated((low + high) / 2, exact, 4e-3 + 2 * exact)


def clamped_elastica(growth: float, h: float) -> float:
    """Height of the middle of an elastica with clamped ends a distance 1 apart.

    Of length l = (1 + growth)(1 - p h^2/12), p = (4 K(m)/l)^2 the thrust over the stiffness, and
    1/l = 2 E(m)/K(m) - 1, height l sqrt(m)/K(m): four quarters of the inflexional elastica.
    """

    def gap(m: mp.mpf) -> mp.mpf:
        k = mp.ellipk(m)
        full = 1 / (2 * mp.ellipe(m) / k - 1)
        thrust = (4 * k / full) ** 2
        return full - (1 + growth) * (1 - thrust * h**2 / 12)

    with mp.workdps(30):
        m = mp.findroot(gap, (mp.mpf(growth), mp.mpf(growth) * 1.1))
        k = mp.ellipk(m)
        return float(mp.sqrt(m) / k / (2 * mp.ellipe(m) / k - 1))


def arch(h: float, growth: float, side: float) -> tuple[Discretisation, Minimiser, Equilibrium]:
    """The buckled strip, left from the flat saddle to one side."""
    sheet, minimiser = walled(h)
    potential = lengthened(sheet, h, growth)
    flat = minimiser.minimise(potential, sheet.zeros())
    assert flat.buckled
    return sheet, minimiser, follow_mode(minimiser, potential, flat, side)


def branch_after_the_saddle(growth: float, h: float = 0.01) -> Outcome:
    """Found as a saddle, left along its mode."""
    sheet, _, bent = arch(h, growth, 1e-3)
    assert not bent.buckled
    height = abs(displacement(sheet, bent.state, (0.5, 0))[2])
    # 12 elements, and the thrust's share along the bent strip: 4e-4 at 10 % of growth
    return stated(height, clamped_elastica(growth, h), 1e-3)


def branch_from_a_perturbed_start(growth: float, h: float = 0.01) -> Outcome:
    """Growth put on by steps while a thousandth of the thickness of load holds it off the plane."""
    sheet, minimiser = walled(h)
    middle = sheet.point((0.5, 0.0))

    def problem(share: float) -> Potential:
        rest = tensor_state(sheet.interior, [(1 + share * growth) ** 2, 1, 0], [0, 0, 0])
        load = Load(middle, DeadLoad((0.0, 0.0, 1e-4 * h**3)))
        return Potential(sheet, koiter(Material(h, 0.0)), rest, loads=(load,))

    start = minimiser.minimise(problem(1e-9), sheet.zeros()).state
    bent = ramp(minimiser, problem, start, first=0.02)
    assert not bent.buckled
    return stated(displacement(sheet, bent.state, (0.5, 0))[2], clamped_elastica(growth, h), 1e-3)


def snapped(h: float = 0.01, growth: float = 0.01) -> Outcome:
    """An arch pushed over by a load at its middle, then released: its mirror image."""
    sheet, minimiser, up = arch(h, growth, 1e-3)
    middle = sheet.point((0.5, 0.0))
    height = displacement(sheet, up.state, (0.5, 0))[2]
    rest = tensor_state(sheet.interior, [(1 + growth) ** 2, 1, 0], [0, 0, 0])
    size = -np.sign(height) * 2e-6

    def pushed(share: float) -> Potential:
        load = Load(middle, DeadLoad((0.0, 0.0, size * share)))
        return Potential(sheet, koiter(Material(h, 0.0)), rest, loads=(load,))

    over = ramp(minimiser, pushed, up.state, first=0.1, follow=1e-3)
    back = ramp(minimiser, lambda s: pushed(1 - s), over.state, first=0.1, follow=1e-3)
    assert not back.buckled
    error = np.abs(back.state.reshape(-1, 3) * [1, 1, -1] - up.state.reshape(-1, 3)).max()
    found = displacement(sheet, back.state, (0.5, 0))[2]
    return Outcome(float(found), float(-height), 1e-5, error=float(error), stated=True)


def planar(alpha: float, area: str) -> tuple[Discretisation, Minimiser, object]:
    mesh = skfem.MeshQuad.init_tensor(np.linspace(-0.25, 0.25, 5), np.linspace(-0.5, 0.5, 9))
    sheet = Discretisation(mesh, skfem.ElementQuad2(), components=2)
    c = SineWave().value(*sheet.interior.parameters.reshape(2, -1), 0.25)
    return (
        sheet,
        Minimiser(Supports(sheet).anchor()),
        lambda s: Potential(
            sheet,
            (Membrane(Material(0.03, 0.5)),),
            grown_state(sheet.interior, c, Growth(alpha * s, energy_area=area)),
        ),
    )


def full_growth_at_once(area: str, alpha: float = 0.25) -> Outcome:
    """Newton from the flat state, where inverted elements are a minimum too."""
    sheet, minimiser, problem = planar(alpha, area)
    ramped = ramp(minimiser, problem, sheet.zeros(), first=0.25)
    direct = minimiser.minimise(problem(1.0), sheet.zeros())
    assert Orientation(sheet.interior).directors(direct.state).min() > 0
    return stated(direct.energy, ramped.energy, 1e-6)


def inverted_start() -> Outcome:
    sheet, minimiser, problem = planar(0.25, "undeformed")
    mirrored = sheet.zeros().reshape(-1, 2)
    mirrored[:, 0] = -2 * sheet.locations[0]
    return stated(minimiser.minimise(problem(1.0), mirrored.ravel()).energy, 0.0, 1.0)


def uniform_growth(factor: float, components: int) -> Outcome:
    """A free sheet that grows alike everywhere: the same sheet, larger, without stress."""
    mesh = rectangle("bfs", (-0.25, 0.25, 2), (-0.5, 0.5, 4))
    sheet = Discretisation(mesh, skfem.ElementQuadBFS(), components=components)
    material, alpha = Material(0.03, 0.5), float(np.log(factor))
    effects = (Membrane(material),) if components == 2 else koiter(material)
    minimiser = Minimiser(Supports(sheet).anchor())
    grown = ramp(
        minimiser,
        lambda s: Potential(sheet, effects, grown_state(sheet.interior, 1.0, Growth(s * alpha))),
        sheet.zeros(),
        first=0.25,
    )
    exact = (factor - 1) * np.eye(components)[:, :2]
    shift = affine(sheet, exact, np.zeros(3)) if components == 3 else None
    tip = displacement(sheet, grown.state, (0.25, 0.5))
    assert shift is None or np.abs(grown.state - shift).max() < 1e-7
    return Outcome(float(tip[1]), (factor - 1) / 2, 1e-8, stated=True)


def depth(stiffness: float) -> Outcome:
    """A sheet that lies on the ground, from a start at 1.3 of its depth."""
    weight, d = 2.5e-4, shell("bfs", (-0.25, 0.25, 2), (-0.5, 0.5, 4))
    exact = -np.sqrt(weight / stiffness)
    start = affine(d, np.zeros((3, 2)), np.array([0, 0, 1.3 * exact]))
    effects = (*koiter(Material(0.03, 0.5)), Gravity(weight), Ground(stiffness))
    minimiser = Minimiser(Supports(d).anchor(motions="xy"))
    found = minimiser.minimise(Potential(d, effects, grown_state(d.interior)), start)
    assert not found.buckled
    return stated(displacement(d, found.state, (0, 0))[2], exact, 1e-8)


def heavy_strip(curvature: float, stiffness: float) -> Outcome:
    """A strip with natural curvature that lies on the ground by its weight, its ends up."""
    return stated(strip(curvature, stiffness).rise, rise(curvature, stiffness), 1e-3)


CIRCLE = "the arc of a circle, no strain"

PROBLEMS: tuple[Problem, ...] = family(
    "Equilibria of the shell",
    *(
        case(
            f"shell: roll-up, h/L = {h:g}",
            "stiff",
            "stretching is 12 (L/h)^2 times stiffer than bending: elements lock",
            CIRCLE,
            lambda h=h: roll_of_thickness(h),
        )
        for h in (0.3, 0.03, 1e-3)
    ),
    *(
        case(
            f"shell: clamped plate, h/L = {h:g}",
            "stiff",
            "the Hessian's entries span (L/h)^2",
            "Taylor & Govindjee's deflection, the same for every h",
            lambda h=h: plate(h, 8, 8),
        )
        for h in (0.3, 1e-3)
    ),
    case(
        "shell: plate of elements 10 : 1",
        "mesh, aspect",
        "2 x 20 elements on a square quarter",
        "Taylor & Govindjee's deflection",
        lambda: plate(0.01, 2, 20),
    ),
    case(
        "shell: roll-up of elements 10 : 1",
        "mesh, aspect",
        "8 x 8 elements on a strip of 10 : 1",
        CIRCLE,
        roll_of_long_elements,
    ),
    *(
        case(
            f"shell: roll-up of triangles leaning by {angle} degrees",
            "mesh",
            "Argyris elements between zig-zag lines",
            CIRCLE,
            lambda a=angle: roll_of_leaning_triangles(a),
        )
        for angle in (20, 45)
    ),
    case(
        "shell: rectangles leaning by 45 degrees",
        "mesh",
        "BFS elements are smooth across edges along the axes only",
        "rectangles along the axes; triangles take any shape",
        oblique_rectangles,
        expected="refused",
        limit="not axis-parallel rectangles",
    ),
    *(
        case(
            f"shell: strip between walls, h/L = {h:g}",
            "instability",
            "the flat strip remains an equilibrium beyond its critical growth",
            "Euler, (pi h)^2/3",
            lambda h=h: euler_growth(h),
        )
        for h in (0.03, 1e-3)
    ),
    *(
        case(
            f"shell: buckled strip, growth {growth:g}",
            "instability",
            "flat is a saddle: found, and left to one side",
            "elastica with clamped ends, elliptic integrals",
            lambda g=growth: branch_after_the_saddle(g),
        )
        for growth in (0.003, 0.1)
    ),
    case(
        "shell: perturbed strip",
        "instability",
        "a small load picks the side, growth is put on in steps",
        "elastica with clamped ends, elliptic integrals",
        lambda: branch_from_a_perturbed_start(0.05),
    ),
    case(
        "shell: arch that snaps through",
        "instability",
        "the load has no equilibrium nearby beyond its limit",
        "after release: the mirror image",
        snapped,
    ),
    *(
        case(
            f"shell: full growth at once, {area} area",
            "spurious, large growth",
            "Newton from the flat state towards minima with inverted elements",
            "energy after growth in steps",
            lambda a=area: full_growth_at_once(a),
        )
        for area in ("grown", "undeformed")
    ),
    case(
        "shell: inverted start",
        "spurious",
        "a sheet that is its own mirror image has the same energy",
        "no point may turn inside out",
        inverted_start,
        expected="refused",
        limit="initial state is inverted",
        raises=ConvergenceError,
    ),
    *(
        case(
            f"shell: uniform growth of 150 %, {where}",
            "large growth",
            "lengths grow by 2.5 from the flat state",
            "the same sheet, larger",
            lambda n=components: uniform_growth(2.5, n),
        )
        for components, where in ((2, "plane"), (3, "space"))
    ),
    *(
        case(
            f"shell: ground of stiffness {stiffness:g}",
            "stiff",
            "six decades, depth h/40 to 25 h",
            "sqrt(weight/stiffness)",
            lambda k=stiffness: depth(k),
        )
        for stiffness in (5e-4, 0.5, 5e2)
    ),
    *(
        case(
            f"shell: heavy strip, kappa L = {curvature:g}",
            "stiff",
            "all but rigid ground lets go of it in a layer of L/56",
            "heavy elastica, an integral at any slope",
            lambda c=curvature: heavy_strip(c, 5e5),
        )
        for curvature in (1.0, 4.0)
    ),
)
