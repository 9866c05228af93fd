"""Energy stored by a cycle of shapes, and its rate.

At every phase the sheet is in equilibrium, so that no force does work as it moves on: what is stored,
in the sheet, its weight and the ground, is the work of growth.
"""

import math

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.cycle.shapes import Shapes, harmonics, time_factors, working_effects
from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.statics.potential import Potential
from linear_theory.energy.stored import Storing

Array = NDArray[np.float64]


def storing(shapes: Shapes, other: tuple[Shapes, float] | None, times: Array) -> Storing:
    """Rate of the stored energy over E h and the undeformed area, 1/time, (times,).

    The slope of the trigonometric polynomial through the energies at the phases. other: shapes on
    another mesh and the least ratio of the difference to the error, which else is not known.
    """
    energies = _energies(shapes)
    rate = _rate(energies, shapes, times)
    if other is None:
        return Storing(rate, math.nan)
    compared, gain = other
    by_phases = np.mean(abs(rate - _rate(energies[::2], shapes, times))) * _beyond(energies)
    by_mesh = np.mean(abs(rate - _rate(_energies(compared), shapes, times))) / gain
    return Storing(rate, float(by_phases + by_mesh))


def _energies(shapes: Shapes) -> Array:
    """Over E h and the undeformed area, (phases,)."""
    model, effects = shapes.model, working_effects(shapes.model)
    energies = [
        Potential(model.discretisation, effects, model.rest(t)).energy(u)
        for t, u in zip(shapes.times, shapes.states, strict=True)
    ]
    material = model.find(Membrane).material
    area = float(model.discretisation.interior.measure.sum())
    return np.array(energies) / (material.young * material.thickness * area)


def _beyond(energies: Array) -> float:
    """Unresolved harmonics of the rate, taken as twice the highest, over those that half the phases
    lose; at most 1."""
    count = len(energies) // 2
    found = harmonics(energies[:, None])[1:, 0]
    rates = np.hypot(found[:count], found[count:]) * np.arange(1, count + 1)
    lost, beyond = float(np.linalg.norm(rates[count // 2 - 1 :])), 2 * float(rates[-2:].max())
    return min(1.0, beyond / lost) if lost else 0.0


def _rate(energies: Array, shapes: Shapes, times: Array) -> Array:
    _, slopes = time_factors(times, shapes.scene.period, len(energies) // 2)
    return np.asarray(slopes @ harmonics(energies[:, None])[:, 0])
