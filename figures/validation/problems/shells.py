"""Large deflections of thin shells.

Sources. Sze, Liu & Lo 2004: Finite Elem. Anal. Des. 40:1551, Abaqus S4R. Its tables were read where
others quote them: end shear and end moment in MBDyn (tests/plates/sze2004), the pinched semi-cylinder
in FEniCSx-Shells (demo_nonlinear_naghdi_clamped_semicylinder.py), the slit annulus in PENGoLINS
(slit_annular_plate.md) and Chrono (demo_FEA_shellsReissner.py), the hemisphere in Elmer
(runhemisphere.m). Scordelis-Lo: 0.3006 for Kirchhoff-Love shells in PENGoLINS (Scordelis_Lo.py).
"""

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.loads import DeadLoad, EdgeMoment
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.kinematics.surface import AnnulusSector, Cylinder, SpherePart
from fem_check.shell.material import Material
from fem_check.shell.statics.potential import Load
from figures.validation.problems.sheets import Path, at, displacement, linear_response, loaded, shell

Array = NDArray[np.float64]


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


def scordelis_lo(element: str, n: int) -> float:
    """Deflection at the middle of the free edge, a quarter of the roof on n x n cells.

    R 25, L 50, half-angle 40 degrees, t 0.25, E 4.32e8, nu 0, load 90 per area, diaphragms at the ends.
    """
    angle = np.deg2rad(40)
    sheet = shell(element, (0, angle, n), (0, 25, n), Cylinder(25.0))
    supports = Supports(sheet).symmetric(at(0, 0), 0).symmetric(at(1, 0), 1).pin(at(1, 25), (0, 2))
    state = linear_response(sheet, supports, Material(0.25, 0.0, 4.32e8), DeadLoad((0.0, 0.0, -90.0)))
    return -displacement(sheet, state, (angle, 0))[2]


def hemisphere(element: str, n: int, shares: tuple[float, ...]) -> tuple[float, ...]:
    """Inward and outward deflection at shares of the full load, one after the other.

    Radius 10, h 0.04, E 6.825e7, nu 0.3, with an 18 degree hole at the pole, free edges; radial loads
    of 400, two outward and two inward, at the ends of the equator's axes: a quarter on n x n cells,
    which are of one longitude and latitude each.
    """
    top = np.deg2rad(72)
    sheet = shell(element, (0, np.pi / 2, n), (0, top, n), SpherePart(10.0))
    places = {"out": (0.0, 0.0), "in": (np.pi / 2, 0.0)}
    # the pole is the axis y, xi_1 = 0 in the plane x = 0, xi_1 = pi/2 in the plane z = 0
    supports = Supports(sheet).symmetric(at(0, 0), 0).symmetric(at(0, np.pi / 2), 2)
    supports.held[sheet.dofs_at((0.0, 0.0))["u"], 1] = True  # against a shift along the axis
    pulled, pushed = (sheet.point(places[name]) for name in ("out", "in"))

    def loads(share: float) -> tuple[Load, ...]:
        half = 200.0 * share  # of each load, the quarter bears a half
        return (
            Load(pulled, DeadLoad((0.0, 0.0, half))),
            Load(pushed, DeadLoad((-half, 0.0, 0.0))),
        )

    def read(state: Array) -> tuple[float, ...]:
        out = displacement(sheet, state, places["out"])[2]
        inward = -displacement(sheet, state, places["in"])[0]
        return float(out), float(inward)

    path = loaded(sheet, supports, Material(0.04, 0.3, 6.825e7), loads, read, shares, first=0.01)
    return tuple(value for share in shares for value in path.values[share])


def cantilever(element: str, n: int, ratios: tuple[float, ...]) -> tuple[float, ...]:
    """w/L and u/L of the tip of a strip under a dead end load P, for each ratio P L^2/B, nu = 0.

    So thin (L/h = 1000) that it does not stretch.
    """
    sheet = shell(element, (0, 1, n), (0, 0.1, 1))
    edge, material = sheet.edge(at(0, 1)), Material(1e-3, 0.0)

    def read(state: Array) -> tuple[float, ...]:
        u = displacement(sheet, state, (1, 0))
        return float(u[2]), float(-u[0])

    path = loaded(
        sheet,
        Supports(sheet).clamp(at(0, 0)),
        material,
        lambda s: (Load(edge, DeadLoad((0.0, 0.0, s * material.bending))),),
        read,
        ratios,
        first=0.5,
    )
    return tuple(value for ratio in ratios for value in path.values[ratio])
