"""Sheets that stretch and do not bend, under loads in their plane."""

from dataclasses import replace

import numpy as np
import skfem
from numpy.typing import NDArray

from fem_check import plane_stress_field
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.effects.loads import DeadLoad
from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.rest_state import grown_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.kinematics.surface import AnnulusSector
from fem_check.shell.material import Material
from fem_check.shell.statics.potential import Load, Potential
from figures.validation.problems.sheets import at, displacement, first_step
from figures.validation.scene_files import scene_of

Array = NDArray[np.float64]


def _loaded(
    sheet: Discretisation, supports: Supports, material: Material, edge: float, force: Array
) -> Array:
    """State under a force per length on the edge xi_i = `edge`, the linear answer."""
    axis = 0 if np.isclose(sheet.mesh.p[0].max(), edge) else 1
    load = Load(sheet.edge(at(axis, edge)), DeadLoad((float(force[0]), float(force[1]))))
    effects = (Membrane(material),)
    return first_step(supports, Potential(sheet, effects, grown_state(sheet.interior), loads=(load,)))


def cook(n: int) -> tuple[float]:
    """Cook's membrane: deflection of the middle of the loaded edge; n x n cells of degree 2.

    Corners (0, 0), (48, 44), (48, 60), (0, 44); the edge x = 0 is clamped, a shear force of 1 acts on
    x = 48; E = 1, nu = 1/3, h = 1.
    """
    grid = np.linspace(0, 1, n + 1)
    mesh = skfem.MeshQuad.init_tensor(grid, grid)
    s, t = mesh.p
    bottom, top = 44 * s, 44 + 16 * s
    mesh = skfem.MeshQuad(np.stack([48 * s, bottom + t * (top - bottom)]), mesh.t)
    sheet = Discretisation(mesh, skfem.ElementQuad2(), components=2, degree=6)
    supports = Supports(sheet).pin(at(0, 0.0), (0, 1))
    state = _loaded(sheet, supports, Material(1.0, 1 / 3), 48.0, np.array([0.0, 1 / 16]))
    return (float(displacement(sheet, state, (48.0, 52.0))[1]),)


def straight_beam(n: int) -> tuple[float, float]:
    """Tip of the straight beam of MacNeal & Harder: extension, and in-plane shear.

    6 x 0.2 x 0.1, E = 1e7, nu = 0.3, force 1 at the free end; 6 n x n cells of degree 2.
    """
    mesh = skfem.MeshQuad.init_tensor(np.linspace(0, 6, 6 * n + 1), np.linspace(-0.1, 0.1, n + 1))
    sheet = Discretisation(mesh, skfem.ElementQuad2(), components=2)
    supports = Supports(sheet).pin(at(0, 0.0), (0, 1))
    material, tips = Material(0.1, 0.3, 1e7), []
    for axis in range(2):
        state = _loaded(sheet, supports, material, 6.0, np.eye(2)[axis] / 0.2)
        tips.append(float(displacement(sheet, state, (6.0, 0.0))[axis]))
    return tips[0], tips[1]


def curved_beam(n: int) -> tuple[float, float]:
    """Twice, the tip of the curved beam of MacNeal & Harder under a radial force of 1.

    A quarter of a ring of radii 4.12 and 4.32, h = 0.1, E = 1e7, nu = 0.25; n x 6 n cells of degree 2.
    """
    radii, angles = np.linspace(4.12, 4.32, n + 1), np.linspace(0, np.pi / 2, 6 * n + 1)
    mesh = skfem.MeshQuad.init_tensor(radii, angles)
    sheet = Discretisation(mesh, skfem.ElementQuad2(), AnnulusSector(), components=2)
    supports = Supports(sheet).pin(at(1, 0.0), (0, 1))
    state = _loaded(sheet, supports, Material(0.1, 0.25, 1e7), np.pi / 2, np.array([0.0, 1 / 0.2]))
    tip = float(displacement(sheet, state, (4.22, np.pi / 2))[1])
    return tip, tip


def heated_strip(name: str, length: float, size: float) -> tuple[float]:
    """Strain along the strip of a scene file in its middle, at t = 0, of another length."""
    scene = scene_of(name)
    field = plane_stress_field(replace(scene.sheet, length=length), scene.wave, size=size)
    return (float(field.strain(0.0, 0.0, 0.0)[1]),)
