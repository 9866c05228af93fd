"""The two shells, with the supports and loads of figures/validation/problems/shells.py."""

from collections.abc import Callable
from math import nan, pi
from typing import Any

from ngsolve import CF, cos, sin, x, y
from ngsolve.meshes import MakeStructured2DMesh

from figures.measure.naghdi.model import NaghdiShell


def graded(s: float, cells: float, ratio: float) -> float:
    """A place in [0, 1] on a grid whose cells grow by a ratio from 0 on."""
    return float((ratio ** (s * cells) - 1) / (ratio**cells - 1))


def to_both_ends(s: float, cells: int, ratio: float) -> float:
    """The same from both ends on."""
    half = graded(min(2 * s, 2 - 2 * s), cells / 2, ratio) / 2
    return half if s <= 0.5 else 1 - half


def grid(across: int, along: int, place: Callable[[float, float], tuple[float, float]]) -> Any:
    """A mesh of rectangles of the parameters."""
    return MakeStructured2DMesh(quads=True, nx=across, ny=along, mapping=place)


def hemisphere(cells: int, degree: int, shear: float) -> NaghdiShell:
    """x the longitude, y the latitude; pulled at x = 0, pushed at x = pi/2."""
    mesh = grid(
        cells,
        cells,
        lambda s, t: (to_both_ends(s, cells, 1.25) * pi / 2, graded(t, cells, 1.25) * 0.4 * pi),
    )
    normal = CF((sin(x) * cos(y), sin(y), cos(x) * cos(y)))
    held = "left", "", "right", "", "left|right"
    shell = NaghdiShell(
        mesh,
        degree,
        10 * normal,
        normal,
        (10 * cos(y), CF(10.0)),
        held,
        (6.825e7, 0.3, 0.04),
        shear,
    )
    out, inward = shell.unknown(2, (0, 0)), shell.unknown(0, (pi / 2, 0))
    shell.force[out], shell.force[inward] = 200, -200
    shell.free.Clear(shell.unknown(1, (0, 0)))  # against a shift along the axis
    shell.deflections = lambda: (shell.found.vec[out], -shell.found.vec[inward])
    return shell


def semi_cylinder(cells: int, degree: int, shear: float) -> NaghdiShell:
    """x around from the crown, y along; pushed at the crown of the free end."""
    radius, length = 101.6, 304.8
    mesh = grid(
        cells,
        cells,
        lambda s, t: (graded(s, cells, 1.3) * pi / 2, length * (1 - graded(1 - t, cells, 1.3))),
    )
    normal = CF((sin(x), 0, cos(x)))
    place = CF((radius * sin(x), y, radius * cos(x)))
    held = "left|bottom", "bottom", "right|bottom", "bottom", "left|right|bottom"
    lengths, material = (CF(radius), CF(1.0)), (2068.5, 0.3, 3.0)
    shell = NaghdiShell(mesh, degree, place, normal, lengths, held, material, shear)
    tip = shell.unknown(2, (0, length))
    shell.force[tip] = -1000
    shell.deflections = lambda: (-shell.found.vec[tip], nan)
    return shell


PROBLEMS = {"hemisphere": hemisphere, "semi-cylinder": semi_cylinder}
