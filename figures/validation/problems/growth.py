"""Plates, strips and disks that bend because they grow."""

from collections.abc import Callable
from functools import partial

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
from figures.validation.problems.sheets import ELEMENTS, at, koiter, shell
from linear_theory import bilayer
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


def plate_with_curvature(
    ratios: tuple[float, ...], poisson: float, n: int, curvature: float = 3.0, width: float = 0.5
) -> tuple[float, ...]:
    """Mean curvature over kappa_0 of a free 2 : 1 plate with natural curvature kappa_0, averaged.

    ratios: kappa_0 W^2/h. A quarter on n x 2 n cells, finer towards the free edges, where a layer of
    width (h/kappa_0)^(1/2) stays bent both ways.
    """
    grid = [_towards_edge(width / 2, n), _towards_edge(width, 2 * n)]
    sheet = Discretisation(skfem.MeshQuad.init_tensor(*grid), ELEMENTS["bfs"]())
    supports = Supports(sheet).symmetric(at(0, 0), 0).symmetric(at(1, 0), 1)
    supports.held[sheet.dofs_at((0.0, 0.0))["u"], 2] = True
    found = []
    for ratio in ratios:
        thickness = curvature * width**2 / ratio

        def problem(share: float, h: float = thickness) -> Potential:
            bent = share * curvature
            rest = tensor_state(sheet.interior, [1, 1, 0], [bent, bent, 0])
            return Potential(sheet, koiter(Material(h, poisson)), rest)

        result = ramp(
            Minimiser(supports, iterations=100), problem, sheet.zeros(), first=0.1, follow=1e-3
        )
        assert not result.buckled
        mean = np.average(mean_curvatures(sheet, result.state), weights=sheet.interior.measure)
        found.append(float(mean / curvature))
    return tuple(found)


def bilayer_strip(elements: int, mismatch: float = 0.004, thickness: float = 0.02) -> tuple[float]:
    """Curvature h/mismatch of a narrow strip of two equal layers, nu = 0, at its middle."""
    alpha, coupling = bilayer(mismatch, thickness)
    sheet = shell("bfs", (0, 0.02, 1), (0, 0.5, elements))
    supports = Supports(sheet).symmetric(at(0, 0), 0).symmetric(at(1, 0), 1)
    supports.held[sheet.dofs_at((0.0, 0.0))["u"], 2] = True
    material = Material(thickness, 0.0)

    def problem(share: float) -> Potential:
        growth = Growth(share * alpha, curvature_coupling=share * coupling)
        return Potential(sheet, koiter(material), grown_state(sheet.interior, 1.0, growth))

    result = ramp(Minimiser(supports), problem, sheet.zeros(), first=0.5)
    state = PointState(sheet.point((0.0, 0.0)), result.state, (1, 2, 3, 4, 5))
    return (float(-state.curvature[1, 0] / state.metric[1, 0] * thickness / mismatch),)


def _critical(flat: Callable[[float], bool], low: float, high: float, steps: int) -> float:
    """Where `flat` turns false, by bisection."""
    for _ in range(steps):
        middle = (low + high) / 2
        low, high = (middle, high) if flat(middle) else (low, middle)
    return (low + high) / 2


def edge_growth(
    poissons: tuple[float, ...], aspect: float, n: int, thickness: float = 0.002
) -> tuple[float, ...]:
    """alpha W^2/h^2 at which a flat strip whose edges grow, c = (2 x/W)^2, bends into a saddle.

    Of width 1 and length `aspect`, free; a quarter on n cells across and 4 n along, finer to its end.
    """
    x, y = np.linspace(0, 0.5, n + 1), _towards_edge(aspect / 2, 4 * n)
    sheet = Discretisation(skfem.MeshQuad.init_tensor(x, y), ELEMENTS["bfs"]())
    supports = Supports(sheet).symmetric(at(0, 0), 0).symmetric(at(1, 0), 1)
    supports.held[sheet.dofs_at((0.0, 0.0))["u"], 2] = True
    minimiser = Minimiser(supports)
    c = (2 * sheet.interior.parameters.reshape(2, -1)[0]) ** 2

    def flat(ratio: float, poisson: float) -> bool:
        rest = grown_state(sheet.interior, c, Growth(ratio * thickness**2))
        potential = Potential(sheet, koiter(Material(thickness, poisson)), rest)
        return not minimiser.minimise(potential, sheet.zeros()).buckled

    return tuple(_critical(partial(flat, poisson=nu), 2.0, 12.0, 14) for nu in poissons)


def disk(poisson: float, refinements: int, thickness: float = 0.01) -> tuple[float, float]:
    """kappa_0 R^2/h at which the cap of a disk with natural curvature stops to be a minimum, and
    kappa R^2/h, its mean curvature there.

    Argyris triangles of a circle whose boundary points lie on it; radius 1.
    """
    mesh = skfem.MeshTri.init_circle(refinements)
    sheet = Discretisation(mesh, ELEMENTS["argyris"]())
    minimiser = Minimiser(Supports(sheet).anchor((0, 0)), iterations=100)
    material = Material(thickness, poisson)
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
