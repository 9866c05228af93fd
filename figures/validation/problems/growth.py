"""Plates, strips and disks that bend because they grow."""

from collections.abc import Callable

import numpy as np
import skfem
from numpy.typing import NDArray

from fem_check.shell.kinematics.discretisation import Discretisation
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rest_state import RestState, grown_state, tensor_state
from fem_check.shell.kinematics.supports import Supports
from fem_check.shell.material import Material
from fem_check.shell.statics.equilibrium import Equilibrium
from fem_check.shell.statics.newton import Minimiser
from fem_check.shell.statics.potential import Potential
from fem_check.shell.statics.ramp import ramp
from figures.validation.problems.settled import natural_curvature, settled
from figures.validation.problems.sheets import ELEMENTS, at, koiter
from figures.validation.scene_files import scene_of
from linear_theory import Scene
from linear_theory.growth.growth import Growth

Array = NDArray[np.float64]


def mean_curvatures(sheet: Discretisation, state: Array) -> Array:
    """At the quadrature points."""
    found = PointState(sheet.interior, state, (1, 2, 3, 4, 5))
    (a11, a22, a12), (b11, b22, b12) = found.metric, found.curvature
    return np.asarray((b11 * a22 - 2 * b12 * a12 + b22 * a11) / (2 * (a11 * a22 - a12**2)))


def _towards_edge(end: float, count: int, power: float = 2.0) -> Array:
    """From 0 to `end`, ever finer towards it."""
    return np.asarray(end * (1 - (1 - np.linspace(0, 1, count + 1)) ** power))


def plate_with_curvature(names: tuple[str, ...], n: int) -> tuple[float, ...]:
    """Mean curvature over kappa_0 of the free plates of scene files, averaged.

    kappa_0: their natural curvature. A quarter on n x 2 n cells, finer towards the free edges, where a
    layer of width (h/kappa_0)^(1/2) stays bent both ways.
    """
    return tuple(_curved_plate(scene_of(name), n) for name in names)


def _curved_plate(scene: Scene, n: int) -> float:
    body, curvature = scene.sheet, natural_curvature(scene)
    grid = [_towards_edge(body.width / 2, n), _towards_edge(body.length / 2, 2 * n)]
    sheet = Discretisation(skfem.MeshQuad.init_tensor(*grid), ELEMENTS["bfs"]())
    supports = Supports(sheet).symmetric(at(0, 0), 0).symmetric(at(1, 0), 1)
    supports.held[sheet.dofs_at((0.0, 0.0))["u"], 2] = True
    material = Material(body.thickness, body.poisson)

    def problem(share: float) -> Potential:
        bent = share * curvature
        rest = tensor_state(sheet.interior, [1, 1, 0], [bent, bent, 0])
        return Potential(sheet, koiter(material), rest)

    result = ramp(Minimiser(supports, iterations=100), problem, sheet.zeros(), first=0.1, follow=1e-3)
    assert not result.buckled
    mean = np.average(mean_curvatures(sheet, result.state), weights=sheet.interior.measure)
    return float(mean / curvature)


def bilayer_strip(name: str, elements: int, mismatch: float = 1e-3) -> tuple[float]:
    """Curvature h/mismatch of the strip of a scene file at its middle, with so many elements along.

    mismatch: strain by which one layer of the file is longer than the other one.
    """
    scene = scene_of(name)
    shape = settled(scene.but(cells=(1, elements)))
    there = shape.sheet.point((0.0, 0.0))
    state = PointState(there, shape.state, (1, 2, 3, 4, 5))
    curvature = abs(state.curvature[1, 0] / state.metric[1, 0])
    return (float(curvature * scene.sheet.thickness / mismatch),)


def _critical(flat: Callable[[float], bool], low: float, high: float, steps: int) -> float:
    """Where `flat` turns false, by bisection."""
    for _ in range(steps):
        middle = (low + high) / 2
        low, high = (middle, high) if flat(middle) else (low, middle)
    return (low + high) / 2


def edge_growth(names: tuple[str, ...], n: int, shortened: float = 1.0) -> tuple[float, ...]:
    """alpha W^2/h^2 at which the flat strips of scene files, whose edges grow, bend into a saddle.

    shortened: share of their length. A quarter on n cells across and 4 n along, finer to its end.
    """
    return tuple(_edge_growth(scene_of(name), n, shortened) for name in names)


def _edge_growth(scene: Scene, n: int, shortened: float) -> float:
    body = scene.sheet
    x = np.linspace(0, body.width / 2, n + 1)
    y = _towards_edge(shortened * body.length / 2, 4 * n)
    sheet = Discretisation(skfem.MeshQuad.init_tensor(x, y), ELEMENTS["bfs"]())
    supports = Supports(sheet).symmetric(at(0, 0), 0).symmetric(at(1, 0), 1)
    supports.held[sheet.dofs_at((0.0, 0.0))["u"], 2] = True
    minimiser, material = Minimiser(supports), Material(body.thickness, body.poisson)
    across = sheet.interior.parameters[0]
    c = scene.drive.value(across, np.zeros_like(across), 0.0).reshape(-1)
    unit = (body.thickness / body.width) ** 2

    def flat(ratio: float) -> bool:
        rest = grown_state(sheet.interior, c, Growth(ratio * unit))
        potential = Potential(sheet, koiter(material), rest)
        return not minimiser.minimise(potential, sheet.zeros()).buckled

    return _critical(flat, 2.0, 12.0, 14)


def disk(name: str, refinements: int) -> tuple[float, float]:
    """kappa_0 R^2/h at which the cap of the disk of a scene file, R = 1, stops to be a minimum as its
    natural curvature rises from 0, and kappa R^2/h, its mean curvature there.

    Argyris triangles of a circle whose boundary points lie on it.
    """
    body = scene_of(name).sheet
    thickness = body.thickness
    mesh = skfem.MeshTri.init_circle(refinements)
    sheet = Discretisation(mesh, ELEMENTS["argyris"]())
    minimiser = Minimiser(Supports(sheet).anchor((0, 0)), iterations=100)
    material = Material(thickness, body.poisson)
    area = sheet.interior.measure

    def problem(ratio: float) -> Potential:
        bent = ratio * thickness
        rest: RestState = tensor_state(sheet.interior, [1, 1, 0], [bent, bent, 0])
        return Potential(sheet, koiter(material), rest)

    low, high, step = 0.0, 16.0, 0.5
    state, mean = sheet.zeros(), 0.0
    while step > 2e-3 and low < high:
        found: Equilibrium = minimiser.minimise(problem(low + step), state)
        if found.buckled:
            step /= 4
            continue
        low, state = low + step, found.state
        mean = float(np.average(mean_curvatures(sheet, state), weights=area)) / thickness
    return low, mean
