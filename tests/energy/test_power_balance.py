"""The power balance of the stepper in space: bending, ground, damping and inertia together.

What the sums over steps lack is the dissipation of the scheme of integration: forces at the end of a
step, and accelerations of backward differences, do other work along it than potential and kinetic
energy change by. It is found here from the effects themselves and from the states, step by step.
"""

import itertools

import numpy as np
import pytest

from fem_check import Inertia, Newmark, simulate
from fem_check.shell.effects.friction import Friction
from fem_check.shell.kinematics.point_state import PointState
from fem_check.shell.kinematics.rates import Step
from fem_check.shell.statics.potential import Potential
from fem_check.shell.stepping.power import Ledger
from tests.shell.shell_scenes import MATERIAL, lying

STEPS = 32


def shaken():
    """The bilayer on damped ground, so heavy that it bounces: 23 of 32 steps to a vibration."""
    scene = lying(damping=1e-5, slip=0.02, cells=(2, 4))
    return scene.but(effects=(*scene.effects, Inertia(1e-2, MATERIAL)))


def followed(scheme=None):
    """A period, and state, rest state, step and velocity at the end of each of its steps."""
    seen, moment = [], Ledger.moment

    def watched(self, u, rest, step, velocity):
        seen.append((u.copy(), rest, step, velocity))
        return moment(self, u, rest, step, velocity)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Ledger, "moment", watched)
        return simulate(shaken(), 1, steps=STEPS, mesh_error=False, scheme=scheme), seen


@pytest.fixture(scope="module")
def run():
    """By backward differences."""
    return followed()


def scheme_dissipation(model, seen):
    """Of each step: by the potential of the sheet, by inertia, and by friction with damping."""
    lasting = [e for e in model.effects if e.stored_as is not None]
    region, mass = model.discretisation.interior, model.find(Inertia).areal_mass
    friction, damped = model.find(Friction), [e for e in lasting if e.damps]

    def forces(u, rest, step):
        state = PointState(region, u, (0,), rest, step)
        still = PointState(region, u, (0,), rest, Step())
        drag = sum((e.gradient(state) - e.gradient(still))[0] for e in damped)
        return friction.gradient(state)[0] + drag

    found = []
    for (u0, r0, s0, v0), (u1, r1, s1, v1) in itertools.pairwise(seen):
        old, new = (Potential(model.discretisation, lasting, r) for r in (r0, r1))
        moved = (old.energy(u1) - old.energy(u0) + new.energy(u1) - new.energy(u0)) / 2
        way = region.displacement(u1 - u0, (0,))[0]
        push = mass * region.measure * s1.accelerated(region.position(u1, (0,))[0])
        speeds = (region.displacement(v, (0,))[0] for v in (v0, v1))
        kinetic = np.diff([mass / 2 * region.measure @ (v**2).sum(0) for v in speeds])[0]
        change = (forces(u1, r1, s1) - forces(u0, r0, s0)) / 2
        by_potential = new.gradient(u1) @ (u1 - u0) - moved
        found.append((by_potential, (push * way).sum() - kinetic, (change * way).sum()))
    return np.array(found).T


def test_growth_is_stored_kinetic_dissipated_and_dissipation_of_the_scheme(run):
    motion, seen = run
    works = motion.power
    parts = scheme_dissipation(motion.model, seen)
    lacking = np.diff(works.residual)
    assert len(lacking) == parts.shape[1]
    size = abs(np.diff(works.growth)).max()
    np.testing.assert_allclose(lacking, parts.sum(0), rtol=0, atol=1e-5 * size)  # of the minimisations
    # nothing of it is small by chance
    assert abs(lacking).max() > 1e-3 * size
    for name in ("elastic", "weight", "ground", "kinetic", "friction", "damping"):
        assert np.ptp(getattr(works, name)) > 1e-3 * works.growth[-1], name


def test_backward_differences_take_energy_from_vibrations_and_newmark_does_not(run):
    motion, _ = run
    newmark, _ = followed(Newmark())
    taken, kept = (m.power.residual[-1] / m.power.growth[-1] for m in (motion, newmark))
    assert taken > 0.05
    assert abs(kept) < 0.2 * taken
