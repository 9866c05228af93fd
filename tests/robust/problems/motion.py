"""The nonlinear sheet in motion: cycles of shapes and stepping in time."""

from dataclasses import replace
from functools import cache

import mpmath as mp
import numpy as np
import skfem

from fem_check.shell.cycle.speed import cycle_speed
from fem_check.shell.effects.friction import Friction
from fem_check.shell.effects.gravity import Gravity
from fem_check.shell.effects.ground import Ground
from fem_check.shell.effects.inertia import Inertia
from fem_check.shell.effects.koiter import Bending, Membrane
from fem_check.shell.material import Material
from fem_check.shell.statics.equilibrium import ConvergenceError, UnstableError
from fem_check.shell.stepping.simulation import simulate
from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory import FieldWave, Sheet, SineWave, second_order
from linear_theory.scene.scene import Scene
from tests.robust.problems.line import slow_clock
from tests.robust.problems.problem import Outcome, Problem, case, family, of_speed
from tests.shell.shell_scenes import MATERIAL, PAPER, WEAK, lying
from tests.shell.shell_scenes import planar as stepped

SINE = SineWave()


def stretching(
    alpha: float, sheet: Sheet = PAPER, cells: tuple[int, int] = (4, 8), wave: object = SINE
) -> Scene:
    """A planar sheet without friction in its shape, on cubic elements."""
    effects = (Membrane(Material(sheet.thickness, sheet.poisson)),)
    return Scene(sheet, wave, alpha, effects=effects, cells=cells, element=skfem.ElementQuadBFS())


def small(alpha: float, sheet: Sheet = PAPER, wave: object = SINE, cells: tuple = (4, 8)) -> Outcome:
    """V/alpha^2 of the nonlinear sheet against V_2 of the second-order theory, by Ritz."""
    found = cycle_speed(stretching(alpha, sheet, cells, wave), rtol=1e-2)
    exact = second_order(sheet, wave, rtol=3e-3)
    # the next term is of relative order alpha^2, with factors up to 3 met in the table of V_2
    allowance = exact.second_error + 3 * alpha**2 * abs(exact.second)
    return Outcome(
        found.mean / alpha**2, exact.second, found.error / alpha**2, allowance, found.converged
    )


def strip(alpha: float) -> Outcome:
    """A narrow strip: stretch exp(alpha c), weight its square; half of the weight above the level."""
    found = cycle_speed(stretching(alpha, Sheet(width=0.01), (1, 16)), rtol=1e-3)
    with mp.workdps(20):
        total = mp.pi * mp.besseli(0, 2 * alpha)

        def excess(phi: mp.mpf) -> mp.mpf:
            return mp.quad(lambda p: mp.exp(2 * alpha * mp.sin(p)), [phi, mp.pi / 2]) - total / 2

        level = mp.sin(mp.findroot(excess, alpha / 2))
        exact = float(mp.exp(alpha * level) - mp.besseli(0, alpha))
    return of_speed(found, exact, (2 * np.pi * 0.01) ** 2 * exact)


def cycle(alpha: float, cells: tuple[int, int], sheet: Sheet = PAPER, rtol: float = 1e-2) -> Outcome:
    """Against 1.5 times the elements each way and a third of the tolerance."""
    found = cycle_speed(stretching(alpha, sheet, cells), rtol=rtol)
    fine = stretching(alpha, sheet, (3 * cells[0] // 2, 3 * cells[1] // 2))
    exact = cycle_speed(fine, rtol=rtol / 3)
    return of_speed(found, exact.mean, exact.error, unit=alpha**2)


def bilayer(alpha: float) -> Scene:
    """The paper's bilayer, beta = 100 alpha, on few elements."""
    return lying(alpha, 100 * alpha, cells=(2, 4))


def snapping_cycle() -> Outcome:
    scene = bilayer(0.1)
    static = [e for e in scene.effects if not isinstance(e, Friction)]
    return of_speed(cycle_speed(scene.but(effects=static)), 0.0)


def snapping_run() -> Outcome:
    """Stepped by error control; whatever the steps, it must never count as converged."""
    run = simulate(bilayer(0.1), periods=1, rtol=0.1)
    finer = simulate(bilayer(0.1), periods=1, rtol=0.05)
    spread = abs(run.speed.mean - finer.speed.mean)
    assert run.buckled.any()
    return of_speed(run.speed, finer.speed.mean, finer.speed.error + spread)


def growing_flat(alpha: float) -> Outcome:
    """Growth alone, no bending by the wave: flat is an equilibrium at all times, then no minimum."""
    run = simulate(lying(alpha, 0.0, cells=(2, 4)), periods=1, steps=16)
    out_of_plane = float(np.ptp(run.positions(1.0)[2]))
    assert run.buckled.any()
    # the found amplitude is between one and ten thicknesses; flat would be 0
    return Outcome(out_of_plane, 5 * PAPER.thickness, 4 * PAPER.thickness, stated=True)


def by_period(period: float) -> Outcome:
    """Steps of a sixteenth of any period: quasi-static motion knows no time but its wave's."""
    distance = []
    for t, slip in ((period, 1e-2 / period), (1.0, 1e-2)):
        friction = (Gravity(WEAK), Friction(1.0, slip))
        scene = Scene(
            PAPER, SineWave(1, t), 0.25, effects=(Membrane(MATERIAL), *friction), cells=(2, 4)
        )
        distance.append(simulate(scene, periods=1, steps=16).period_speeds[-1] * t)
    return Outcome(float(distance[0]), float(distance[1]), 1e-6 * abs(distance[1]), stated=True)


def slipping(slip: float) -> Outcome:
    """Stepped with friction 1e-4 of the stiffness, against the cycle of shapes with the same law."""
    scene = stepped(0.25, slip=slip, cells=(2, 4))
    run = simulate(scene, periods=1, steps=48)
    exact = cycle_speed(scene, rtol=1e-3)
    # friction over stiffness, times the strain that it makes: measured below 3e-3
    return of_speed(replace(run.speed, converged=True), exact.mean, exact.error + 3e-3 * exact.mean)


@cache
def long_run(periods: int = 100, steps: int = 8) -> Trajectory:
    """Eight steps a period, on two elements of degree 5."""
    scene = stepped(0.25, slip=1e-2, cells=(1, 2))
    return simulate(scene, periods=periods, steps=steps, keep_every=steps)


def drift_of_speed() -> Outcome:
    """The speed of the 100th period against that of the third."""
    speeds = long_run().period_speeds
    # positions are right to 1e-8 of the size of the sheet, which is what minimisations are asked for
    return Outcome(float(speeds[-1]), float(speeds[2]), 1e-7, stated=True)


def drift_of_energy() -> Outcome:
    """What the balance of power lacks grows by the same in each period: no energy piles up."""
    run = long_run()
    power, rows = run.power, [run.period_end(k) for k in (2, 3, 99, 100)]
    lacking = np.diff(power.residual[rows])[[0, 2]]
    work = power.growth[rows[1]] - power.growth[rows[0]]
    elastic = power.elastic[rows]
    assert np.ptp(elastic) < 1e-6 * abs(power.growth[-1])
    return Outcome(float(lacking[1] / work), float(lacking[0] / work), 1e-5, stated=True)


def vibration(periods: int = 100) -> Outcome:
    """A planar sheet that is let go in a stretched rest state: Newmark keeps its energy."""
    c = FieldWave(lambda x, y, t: 1.0 + 0 * x + 0 * y + 0 * t, 1.0)
    scene = Scene(PAPER, c, 1e-3, effects=(Membrane(MATERIAL), Inertia(1.0, MATERIAL)), cells=(1, 2))
    run = simulate(scene, periods=periods, steps=8, ramp=0.0, keep_every=8)
    energy = run.power.elastic + run.power.kinetic
    size = float(run.power.kinetic.max())
    # the trapezoidal rule keeps quadratic energies; the rest is of the order of the strain, 1e-3, and
    # swings: two periods, in which every part of the sheet has turned round, at the end and the start
    first, last = energy[:17].mean(), energy[-17:].mean()
    return Outcome(float(last - first) / size, 0.0, 5e-3, stated=True)


def thrown(speed: float = 0.5) -> Outcome:
    """A sheet thrown upwards from the ground: the height of its flight is that of its energy."""
    density, wave = 1.0, SineWave()
    effects = (
        Membrane(MATERIAL), Bending(MATERIAL), Gravity(0.05, "material"), Ground(50.0, 0.0, "material"),
        Inertia(density, MATERIAL),
    )  # fmt: skip
    scene = Scene(PAPER, wave, 0.0, effects=effects, cells=(1, 2))
    run = simulate(scene, periods=1, steps=128, velocity=(0.0, 0.0, speed), ramp=0.0)
    depth = np.sqrt(0.05 / 50.0)
    mass = density * PAPER.thickness
    # from -depth with the ground's energy k depth^3/3 to the top: weight times height
    top = (mass * speed**2 / 2 + 50.0 * depth**3 / 3) / 0.05 - depth
    # parabola between steps: (dt/2)^2 g/2, g = 5/3; the ground's push takes a few steps
    return Outcome(float(run.centre[2].max()), float(top), 0.01 * float(top), stated=True)


def dropped() -> Outcome:
    """The same with damped ground: it lands and comes to rest at its static depth."""
    effects = (
        Membrane(MATERIAL), Bending(MATERIAL), Gravity(0.05, "material"), Ground(50.0, 0.2, "material"),
        Inertia(1.0, MATERIAL),
    )  # fmt: skip
    scene = Scene(PAPER, SineWave(), 0.0, effects=effects, cells=(1, 2))
    run = simulate(scene, periods=4, steps=48, velocity=(0.0, 0.0, 0.5), ramp=0.0, keep_every=48)
    assert run.centre[2].max() > 0.02
    depth = float(np.sqrt(0.05 / 50.0))
    return Outcome(float(run.centre[2, -1]), -depth, 0.02 * depth, stated=True)


def stopping(slip: float) -> Outcome:
    """A wave that stands still for half of each period carries the sheet as far as a steady one."""
    still = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (y - slow_clock(t))) + 0 * x, 1.0)
    scene = stepped(0.2, still, slip=slip, cells=(2, 4))
    run = simulate(scene, periods=1, rtol=1e-2)
    steady = cycle_speed(stretching(0.2), "current", "tanh", slip / 2, rtol=1e-3)
    # dry friction at this slip speed: the steady wave is half as fast, and its slip speed with it
    return of_speed(run.speed, steady.mean, steady.error + 0.01 * steady.mean)


def nothing_moves() -> Outcome:
    """No growth: a sheet at rest stays at rest."""
    run = simulate(stepped(0.0, cells=(2, 4)), periods=1, steps=8)
    return Outcome(run.speed.mean, 0.0, 1e-12, converged=True, stated=True)


def hardly_moves(alpha: float) -> Outcome:
    """Nearly all of the sheet slower than the slip speed: viscous, V/alpha^2 has its limit."""
    run = simulate(stepped(alpha, slip=1e-3, cells=(2, 4)), periods=1, steps=48)
    assert run.linear_share == 1
    exact = cycle_speed(stretching(1e-2), "current", "viscous", rtol=1e-3)
    limit = exact.mean / 1e-4 * alpha**2
    # friction over stiffness, and the next term of the cycle's V/alpha^2, 1e-4 of it
    return of_speed(replace(run.speed, converged=True), limit, 1e-2 * abs(limit), alpha**2)


PROBLEMS: tuple[Problem, ...] = family(
    "The nonlinear sheet in motion",
    *(
        case(
            f"cycle: alpha = {alpha:g}",
            "small parameter",
            "static shapes to 1e-10 of the size, V of order alpha^2",
            "V_2 of the second-order theory",
            lambda a=alpha: small(a),
        )
        for alpha in (1e-6, 1e-3)
    ),
    case(
        "cycle: alpha = 1e-08",
        "small parameter",
        "alpha^2 = 1e-16 is the roundoff of the shapes",
        "V_2 of the second-order theory, which is the way to such a speed",
        lambda: small(1e-8),
        expected="flagged",
    ),
    *(
        case(
            f"cycle: nu = {nu:g}",
            "material",
            "shear modulus over bulk modulus from 1/3 to 200",
            "V_2 of the second-order theory",
            lambda n=nu: small(1e-2, Sheet(poisson=n)),
        )
        for nu in (-0.99, 0.0)
    ),
    case(
        "cycle: width L/100",
        "aspect",
        "one element across",
        "V_2 of the second-order theory",
        lambda: small(1e-2, Sheet(width=0.01), cells=(1, 16)),
    ),
    case(
        "cycle: width 10 L",
        "aspect",
        "V is what is left of edge layers",
        "1.5 times the elements each way",
        lambda: cycle(0.1, (10, 2), Sheet(width=10.0)),
        expected="flagged",
    ),
    case(
        "cycle: strip, growth of 150 %",
        "large growth, aspect",
        "lengths between 0.4 and 2.5 times their own at once",
        "weighted median of exp(alpha c), mpmath",
        lambda: strip(float(np.log(2.5))),
    ),
    case(
        "cycle: sheet, growth of 54 %",
        "large growth",
        "alpha = 0.43 on the 2 : 1 sheet, 3 % below where its edges wrinkle",
        "1.5 times the elements each way",
        lambda: cycle(0.43, (4, 8)),
    ),
    *(
        case(
            f"cycle: sheet, growth of {percent} %",
            "large growth, spurious",
            f"alpha = {alpha:.3g} has shapes on coarse meshes alone: edges compressed below 0.639 "
            "wrinkle in waves too short for them, which Koiter's energy does not resist",
            "finer meshes, which have none",
            lambda a=alpha: cycle(a, (4, 8)),
            expected="refused",
            limit=r"beyond material stability .* (compressed to 0\.\d+, wrinkling starts at 0\.6388)",
            raises=UnstableError,
        )
        for percent, alpha in ((65, 0.5), (82, 0.6), (150, float(np.log(2.5))))
    ),
    case(
        "cycle: bilayer that snaps",
        "instability",
        "beta = 10 at alpha = 0.1: the bends jump from side to side",
        "shapes that repeat",
        snapping_cycle,
        expected="refused",
        limit="snap-through",
        raises=ConvergenceError,
    ),
    case(
        "step: bilayer that snaps",
        "instability, slow",
        "the same in time: steps of different length take different ways",
        "half the tolerance",
        snapping_run,
        expected="flagged",
    ),
    case(
        "step: flat sheet that buckles",
        "instability",
        "nothing pushes it off its plane",
        "leaves it by one to nine thicknesses",
        lambda: growing_flat(0.25),
    ),
    *(
        case(
            f"step: steps of {period / 16:g}",
            "stiff",
            "six decades in the size of the step",
            "the same distance per period at any period",
            lambda t=period: by_period(t),
        )
        for period in (1e-3, 1e3)
    ),
    *(
        case(
            f"step: slip speed {slip:g} wave speeds",
            "stiff",
            "friction changes sign over the slip speed" if slip < 1 else "friction is viscous",
            "cycle of shapes with the same law",
            lambda v=slip: slipping(v),
        )
        for slip in (1e-6, 1e-3, 1.0, 1e3)
    ),
    case(
        "step: 100 periods, speed",
        "long time",
        "800 minimisations, each from the ones before",
        "the third period",
        drift_of_speed,
    ),
    case(
        "step: 100 periods, energy",
        "long time",
        "works summed over all steps",
        "the third period",
        drift_of_energy,
    ),
    case(
        "step: 100 periods of vibration",
        "long time",
        "inertia alone, nothing damps; energy over the largest kinetic one",
        "0, nothing is lost or gained",
        vibration,
    ),
    case(
        "step: sheet thrown up",
        "stiff",
        "contact ends and begins",
        "height of flight from the energy",
        thrown,
    ),
    case(
        "step: sheet dropped",
        "stiff",
        "lands on damped ground",
        "static depth sqrt(weight/stiffness)",
        dropped,
    ),
    case(
        "step: wave that stops",
        "stuck",
        "all of the sheet at rest for half of each period",
        "rate independence: cycle of shapes of the steady wave",
        lambda: stopping(1e-3),
    ),
    case("step: no growth", "stuck", "nothing moves, ever", "0", nothing_moves),
    case(
        "step: alpha = 1e-6",
        "stuck, small parameter",
        "all points slower than the slip speed",
        "viscous cycle of shapes, V/alpha^2",
        lambda: hardly_moves(1e-6),
    ),
)
