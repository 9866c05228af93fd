"""The page on other codes side by side, docs/peers.md, from the tables of `figures.measure.peers`.

python -m figures.draw.peers.page [--out FILE]
"""

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

from figures.common.command import write_page
from figures.measure.peers import field
from figures.measure.peers.command import TABLE, Row
from figures.measure.peers.problems import BLOCK, STRIP, TITLES

NEAR = 1e-4
"""Error of the displacement whose time is told."""

ROOT = Path(__file__).parents[3]
PAGE = ROOT / "docs" / "peers.md"
COMMAND = "python -m figures.draw.peers.page"

HEAD = """# Codes for soft bodies, side by side

How do other codes do on what this package is made for? Two scenes on the ground, whose answers are
known exactly, by codes for soft bodies; a sheet that grows, by libraries of finite elements:

* **Block**: a flat sheet slides down an incline of 0.2 rad at 1 m/s, friction 0.5. It stops after
  V²/(2a), a = g (0.5 cos 0.2 − sin 0.2), and rests.
* **Strip**: a strip of 1 m × 0.04 m with a natural curvature of 3/m along it settles on level ground
  with friction 0.5, ends up. B = 0.009 q L³, Poisson's ratio 0. Its ends stand B kappa²/(2 q) high, by
  the first integral of the heavy elastica; friction does not change that, since nothing pulls along the
  part off the ground.
* **Displacement**: the paper's sheet (2 : 1, Poisson's ratio 1/2) grows in its plane by a sine wave;
  plane stress. Errors are against a solution by another method.

"Drift" is the speed at which the block slides on when it should rest, or the ends of the strip still
move at the end. Time is that of one core; of the other codes without setting up and compiling.
For the strip this package looks for the state of rest without the motion towards it, which the other
codes, made for motion, step through: 3 s (MuJoCo) and 1.5 s (Newton).

In short: MuJoCo flex is the fastest on the block while errors of a thousandth will do; on the strip
only this package comes to an answer that no longer changes. FIELD

Made by `python -m figures.draw.peers.page` from figures/data/peers.csv and peers_field.csv, which
`make peers` measures, with an environment of its own for the other codes, build/peers-venv, from
requirements-peers.lock.

![Error against time](../figures/gallery/peers.png)
"""

TAIL = """## What each of them is, and what it cannot do

* **This package.** The block is stepped by `simulate` with `Inertia`, backward differences and the
  tanh law, its slip speed v0 1e-4 of the speed at the start: its drift is v0 artanh(tan 0.2/0.5),
  as that law has it. The strip is stepped without inertia on a ground into which it sinks 2e-5 L;
  its error scatters with the place in an element at which the strip leaves the ground. There are no
  other bodies and no real time, and friction that holds without creeping is only a limit, v0 → 0.
* **MuJoCo flex** (`mujoco`): triangles that stretch, with bending across their edges. Elasticity is
  implicit in time with `integrator="discrete"` alone; "implicitfast" refuses it, and with "Euler"
  the flat sheet was unstable at 0.5 ms. The block is right to first order in the step, and creeps.
  A flex gives all its vertices the same mass, so that the ends of a strip weigh twice too much and
  stood 22 to 43 % too low at the settings of the table; there, masses go by area. With diagonals of
  one direction a strip that is flattened twists; here they alternate. Forces of uniform bending are
  then right to 1/n, those of uniform twist twice too large, and the settled height does not
  converge with the mesh: why, we did not find out. It gives no estimate of its error.
* **Newton** (`newton`, on `warp-lang`): cloth by vertex block descent. With 10 iterations a step
  the block stops far too early at steps of 5 ms and more; at shorter ones it is right, and creeps
  at 2 mm/s.
  STRIP
  It had not come to rest after 1.5 s; longer steps with 20 iterations or more damping were tried on
  a few settings and did no better. Edges are hinges whose stiffness the user has to work out from
  B; numbers are of single precision; no estimate of the error. Its kernels take four minutes to
  compile at the first run. It is made for graphics processors and many bodies at once, which is not
  measured here.
* **ipctk** installs, and is no simulator: potentials of contact and friction, without a sheet and
  without steps in time. This package uses it for `SelfContact`.
* **NGSolve** and **SfePy** are finite element libraries, in which a sheet on a ground with friction
  would have to be written. Above they solve what the finite elements of this package solve, quartic
  (P4) or quadratic (Q2), on a uniform grid; they give no estimate of the error. SfePy has no wheel: it
  is measured where somebody has built it in build/peers-venv.

Waves of growth were not tried with MuJoCo and Newton. Settings were chosen with the
documentation of each code at hand and some trials; who knows a code better may do better.
"""


def page(rows: Sequence[Row], solved: Sequence[field.Row]) -> str:
    """The page of the two tables."""
    lines = [HEAD.replace("FIELD", _shortly(solved))]
    for problem in (BLOCK, STRIP):
        chosen = [r for r in rows if r.problem == problem]
        lines += [f"## {TITLES[problem].capitalize()}: {chosen[0].exact:.4f} m", ""]
        lines += [*_table(chosen), ""]
    lines += ["## Displacement of a sheet that grows in its plane", "", *_field_table(solved), ""]
    return "\n".join([*lines, TAIL.replace("STRIP", _newton(rows))])


def _shortly(solved: Sequence[field.Row]) -> str:
    """What a displacement to 1e-4 takes."""
    near = [row for row in solved if row.error <= NEAR]
    least = {row.code: row.seconds for row in sorted(near, key=lambda row: -row.seconds)}
    told = ", ".join(f"{_time(seconds)} ({code})" for code, seconds in least.items())
    return f"A displacement\nto {NEAR:.0e} takes {told}."


def _time(seconds: float) -> str:
    return f"{seconds:.2g} s" if seconds >= 0.1 else f"{1e3 * seconds:.2g} ms"


def _field_table(solved: Sequence[field.Row]) -> Iterator[str]:
    yield "| code | setting | error | time |"
    yield "| --- " * 4 + "|"
    for said, row in zip(["", *(row.code for row in solved)], solved, strict=False):
        name = row.code if row.code != said else ""
        yield f"| {name} | {row.knob} {row.value} | {row.error:.1e} | {_time(row.seconds)} |"


def _table(rows: Sequence[Row]) -> Iterator[str]:
    yield "| code | setting | found (m) | error | drift (m/s) | time |"
    yield "| --- " * 6 + "|"
    said = ""
    for row in rows:
        name = row.code if row.code != said else ""
        said = row.code
        if math.isnan(row.error):
            yield f"| {name} | {row.knob} | {row.remark} | | | |"
            continue
        yield (
            f"| {name} | {row.knob} | {row.value:.4f} | {100 * row.error:.2g} % | {row.drift:.1g} | "
            f"{row.seconds:.2g} s |"
        )


def _newton(rows: Sequence[Row]) -> str:
    """What became of its strip."""
    found = [r for r in rows if r.code.startswith("Newton") and r.problem == STRIP]
    best = min(found, key=lambda r: math.inf if math.isnan(r.error) else r.error)
    worst = max(found, key=lambda r: -math.inf if math.isnan(r.error) else r.error)
    return (
        f"The strip is {100 * best.error:.2g} % off at best ({best.knob}, where its ends\n"
        f"  still move at {best.drift:.1g} m/s), {100 * worst.error:.2g} % at worst ({worst.knob})."
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the page."""
    write_page(COMMAND, __doc__, PAGE, lambda: page(TABLE.read(), field.TABLE.read()), arguments)


if __name__ == "__main__":
    main()
