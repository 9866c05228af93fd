"""Problems of thin shells with known answers, as functions of the mesh, and helpers of the shell tests.

Sources. Sze, Liu & Lo 2004: Finite Elem. Anal. Des. 40:1551, Abaqus S4R. Its tables were read where
others quote them: end shear and end moment in MBDyn (tests/plates/sze2004), the pinched semi-cylinder
in FEniCSx-Shells (demo_nonlinear_naghdi_clamped_semicylinder.py); of the slit annulus the data were
confirmed (PENGoLINS, slit_annular.py), its two deflections were not. Clamped plate: Taylor &
Govindjee 2004, Commun. Numer. Meth. Eng. 20:757, in libMesh's Clough-Tocher shell example.
Scordelis-Lo: 0.3006 for Kirchhoff-Love shells in PENGoLINS (Scordelis_Lo.py).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import skfem
from numpy.typing import NDArray

from fem_check.shell.effects.effect import Effect
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.effects.loads import DeadLoad, EdgeMoment
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rest_state import grown_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.kinematics.surface import AnnulusSector, Cylinder, Flat, Surface
from fem_check.shell.material import Material
from fem_check.shell.statics.equilibrium import Equilibrium
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Load, Potential
from fem_check.shell.statics.ramp import ramp

Array = NDArray[np.float64]

ELEMENTS = {"bfs": skfem.ElementQuadBFS, "argyris": skfem.ElementTriArgyris}


def rectangle(element: str, x: tuple[float, float, int], y: tuple[float, float, int]) -> object:
    """A uniform mesh of rectangles, or of triangles with alternating diagonals."""
    grid = [np.linspace(start, end, count + 1) for start, end, count in (x, y)]
    kind = skfem.MeshQuad if element == "bfs" else skfem.MeshTri
    return kind.init_tensor(*grid)


def shell(
    element: str,
    x: tuple[float, float, int],
    y: tuple[float, float, int],
    surface: Surface | None = None,
    degree: int | None = None,
) -> Discretisation:
    """A rectangle of parameters mapped to a surface."""
    return Discretisation(
        rectangle(element, x, y), ELEMENTS[element](), surface or Flat(), degree=degree
    )


def trapezoid(xi1: Array, xi2: Array) -> Array:
    """A flat `Surface`, 0.5 wide at xi_2 = -1/2 and 0.8 at 1/2: its parameter lines are oblique."""
    slope = 0.3
    width = 0.65 + slope * xi2
    jet = np.zeros((6, 3, *xi1.shape))
    jet[0, 0], jet[0, 1] = xi1 * width, xi2
    jet[1, 0] = width
    jet[2, 0], jet[2, 1] = xi1 * slope, 1
    jet[5, 0] = slope
    return jet


def at(axis: int, value: float) -> Callable[[Array], NDArray[np.bool_]]:
    """Points of the parameter domain on a line."""
    return lambda xi: np.isclose(xi[axis], value)


def koiter(material: Material) -> tuple[Effect, Effect]:
    return Membrane(material), Bending(material)


def displacement(sheet: Discretisation, state: Array, xi: tuple[float, float]) -> Array:
    """Displacement of one point, (3,)."""
    return sheet.point(xi).displacement(state, (0,))[0, :, 0]


def affine(sheet: Discretisation, gradient: Array, shift: Array) -> Array:
    """Unknowns of the displacement shift + gradient (3, 2) xi."""

    def jets(x: Array, y: Array) -> Array:
        out = np.zeros((6, 3, x.size))
        out[0] = shift[:, None] + gradient @ np.stack([x, y])
        out[1], out[2] = gradient[:, :1], gradient[:, 1:]
        return out

    return sheet.interpolate(jets)


@dataclass(frozen=True)
class Path:
    """Displacements of named points at shares of the full load."""

    values: dict[float, tuple[float, ...]]
    result: Equilibrium
    elements: int


def loaded(
    sheet: Discretisation,
    supports: Supports,
    material: Material,
    loads: Callable[[float], tuple[Load, ...]],
    read: Callable[[Array], tuple[float, ...]],
    shares: tuple[float, ...] = (1.0,),
    first: float = 0.25,
) -> Path:
    """Equilibria at shares of the load, each reached from the one before."""
    rest, minimiser = grown_state(sheet.interior), Minimiser(supports)
    state, start, values, result = sheet.zeros(), 0.0, {}, None
    for share in shares:
        result = ramp(
            minimiser,
            lambda s, a=start, b=share: Potential(
                sheet, koiter(material), rest, loads=loads(a + s * (b - a))
            ),
            state,
            first=min(1.0, first / (share - start)),
        )
        state, start, values[share] = result.state, share, read(result.state)
    return Path(values, result, sheet.mesh.nelements)


def end_shear(element: str, n: int, shares: tuple[float, ...] = (0.25, 0.5, 0.75, 1.0)) -> Path:
    """Cantilever, L 10, b 1, h 0.1, E 1.2e6, nu 0, end shear 4: (-u, w) of the tip."""
    sheet = shell(element, (0, 10, n), (-0.5, 0.5, 1))
    edge = sheet.edge(at(0, 10))

    def read(state: Array) -> tuple[float, ...]:
        u = displacement(sheet, state, (10, 0))
        return -u[0], u[2]

    return loaded(
        sheet,
        Supports(sheet).clamp(at(0, 0)),
        Material(0.1, 0.0, 1.2e6),
        lambda s: (Load(edge, DeadLoad((0.0, 0.0, 4 * s))),),
        read,
        shares,
    )


def end_moment(element: str, n: int, shares: tuple[float, ...] = (0.25, 0.5, 0.75, 1.0)) -> Path:
    """Cantilever, L 12, b 1, h 0.1, E 1.2e6, nu 0, end moment 50 pi/3: (-u, w); a circle at every load.

    Half of the width, up to the plane of mirror symmetry: the whole strip leaves that plane sideways
    beyond about three quarters of the load, because a moment about a fixed axis does not hold it.
    """
    sheet = shell(element, (0, 12, n), (0, 0.5, 1))
    edge = sheet.edge(at(0, 12))

    def read(state: Array) -> tuple[float, ...]:
        u = displacement(sheet, state, (12, 0))
        return -u[0], u[2]

    return loaded(
        sheet,
        Supports(sheet).clamp(at(0, 0)).symmetric(at(1, 0), 1),
        Material(0.1, 0.0, 1.2e6),
        lambda s: (Load(edge, EdgeMoment(s * 50 * np.pi / 3, angle=2 * np.pi * s)),),
        read,
        shares,
        first=0.05,
    )


def slit_annulus(element: str, n: int, m: int) -> Path:
    """Radii 6 and 10, h 0.03, E 21e6, nu 0, one slit edge clamped, dead load 0.8/length on the other.

    n across and m around; the lift of the loaded edge at its outer and inner end.
    """
    sheet = shell(element, (6, 10, n), (0, 2 * np.pi, m), AnnulusSector())
    edge = sheet.edge(at(1, 2 * np.pi))

    def read(state: Array) -> tuple[float, ...]:
        return tuple(displacement(sheet, state, (r, 2 * np.pi))[2] for r in (10, 6))

    return loaded(
        sheet,
        Supports(sheet).clamp(at(1, 0)),
        Material(0.03, 0.0, 21e6),
        lambda s: (Load(edge, DeadLoad((0.0, 0.0, 0.8 * s))),),
        read,
        first=0.01,
    )


def semi_cylinder(element: str, n: int, m: int, shares: tuple[float, ...] = (1.0,)) -> Path:
    """r 101.6, L 304.8, t 3, E 2068.5, nu 0.3: half of it, n around and m along; (deflection,).

    One curved end clamped, straight edges free of vertical displacement and of rotation about the axis,
    full load 2000 at the crown of the free end; half of that on the half modelled here.
    """
    sheet = shell(element, (0, np.pi / 2, n), (0, 304.8, m), Cylinder(101.6))
    tip = sheet.point((0.0, 304.8))
    supports = Supports(sheet).clamp(at(1, 0)).symmetric(at(0, 0), 0)
    supports.pin(at(0, np.pi / 2), (2,)).hold_slope(at(0, np.pi / 2), (0,))

    return loaded(
        sheet,
        supports,
        Material(3.0, 0.3, 2068.5),
        lambda s: (Load(tip, DeadLoad((0.0, 0.0, -1000.0 * s))),),
        lambda state: (-displacement(sheet, state, (0.0, 304.8))[2],),
        shares,
        first=0.02,
    )


def linear_response(
    sheet: Discretisation, supports: Supports, material: Material, load: DeadLoad
) -> Array:
    """State per unit of a load so small that the answer is linear: one Newton step from the rest."""
    potential = Potential(sheet, (*koiter(material), load), grown_state(sheet.interior))
    minimiser = Minimiser(supports)
    factorised = minimiser.factorised(potential, sheet.zeros(), 0.0)
    assert factorised.shift == 0
    state = sheet.zeros()
    order = minimiser.sparsity.order
    state[order] = -factorised.factor.solve(potential.gradient(sheet.zeros())[order])
    return state


def clamped_plate(element: str, n: int) -> float:
    """Centre deflection w D/(q L^4) of a clamped square plate; a quarter of it on n x n cells."""
    sheet = shell(element, (0, 0.5, n), (0, 0.5, n))
    supports = (
        Supports(sheet)
        .clamp(at(0, 0.5))
        .clamp(at(1, 0.5))
        .symmetric(at(0, 0), 0)
        .symmetric(at(1, 0), 1)
    )
    material = Material(0.01, 0.3)
    state = linear_response(sheet, supports, material, DeadLoad((0.0, 0.0, 1.0)))
    return displacement(sheet, state, (0, 0))[2] * material.bending


def scordelis_lo(element: str, n: int) -> float:
    """Deflection at the middle of the free edge, a quarter of the roof on n x n cells.

    R 25, L 50, half-angle 40 degrees, t 0.25, E 4.32e8, nu 0, load 90 per area, diaphragms at the ends.
    """
    angle = np.deg2rad(40)
    sheet = shell(element, (0, angle, n), (0, 25, n), Cylinder(25.0))
    supports = Supports(sheet).symmetric(at(0, 0), 0).symmetric(at(1, 0), 1).pin(at(1, 25), (0, 2))
    state = linear_response(sheet, supports, Material(0.25, 0.0, 4.32e8), DeadLoad((0.0, 0.0, -90.0)))
    return -displacement(sheet, state, (angle, 0))[2]
