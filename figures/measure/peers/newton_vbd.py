"""The scenes by Newton's cloth: `python -m figures.measure.peers.newton_vbd CASE`, JSON to JSON.

Vertex block descent on the CPU by Warp, whose kernels are compiled on the first use, minutes that are
not counted. Bending by angles at edges with energy k l (angle - angle at rest)^2/2, l the length of the
edge: k = B over the distance of edges across makes a bent strip as stiff as it should be.
"""

import json
import math
import sys
import time
from dataclasses import asdict
from typing import Any

import newton
import warp as wp

from figures.measure.peers.problems import (
    BLOCK,
    FRICTION,
    GRAVITY,
    INCLINE,
    MASS,
    SPEED,
    THICKNESS,
    Answer,
    Array,
    Case,
    answer,
    bending,
    followed,
    natural,
    strip,
    young,
)

RADIUS, CONTACT = 0.005, 1e4
"""Radius of the vertices in m; stiffness of contact."""

BENDING_DAMPING = 0.005
"""Of the strip, so that it settles; the block has none."""


def solve(case: Case) -> Answer:
    """Run a case."""
    model = _model(case)
    pipeline = newton.CollisionPipeline(model, broad_phase="nxn", soft_contact_gap=0.02)
    solver = newton.solvers.SolverVBD(
        model,
        iterations=case.iterations,
        particle_enable_self_contact=False,
        collision_pipeline=pipeline,
    )
    _stepped(model, solver, case)()  # compiles
    states = [model.state(), model.state()]
    advance = _stepped(model, solver, case, states)

    def positions() -> Array:
        return states[0].particle_q.numpy().astype(float)

    begin = time.process_time()
    found = followed(case, positions, advance)
    version = f"newton {newton.__version__}, warp-lang {wp.__version__}"
    return answer(case, found, time.process_time() - begin, version)


def _stepped(model: Any, solver: Any, case: Case, states: list[Any] | None = None) -> Any:
    states = [model.state(), model.state()] if states is None else states
    control = model.control()

    def advance() -> None:
        states[0].clear_forces()
        solver.step(states[0], states[1], control, None, case.step)
        states.reverse()

    return advance


def _model(case: Case) -> Any:
    points, triangles = strip(case, natural(case))
    block = case.problem == BLOCK
    incline, speed = (INCLINE, SPEED) if block else (0.0, 0.0)
    builder = newton.ModelBuilder(
        gravity=(-GRAVITY * math.sin(incline), 0.0, -GRAVITY * math.cos(incline))
    )
    builder.default_shape_cfg.ke = CONTACT
    builder.default_shape_cfg.kd = 0.0
    builder.default_shape_cfg.mu = FRICTION
    stretching = young() * THICKNESS
    builder.add_cloth_mesh(
        pos=wp.vec3(0.0, 0.0, RADIUS),
        rot=wp.quat_identity(),
        scale=1.0,
        vel=wp.vec3(-speed, 0.0, 0.0),
        vertices=[wp.vec3(*point) for point in points.tolist()],
        indices=triangles.ravel().tolist(),
        density=MASS,
        tri_ke=stretching / 2,
        tri_ka=1e-3 * stretching,
        tri_kd=0.0,
        edge_ke=bending() * case.along,
        edge_kd=0.0 if block else BENDING_DAMPING,
        particle_radius=RADIUS,
    )
    builder.color(include_bending=True)
    builder.add_ground_plane()
    model = builder.finalize(device="cpu")
    model.soft_contact_ke, model.soft_contact_kd = CONTACT, 0.0
    model.soft_contact_mu = FRICTION
    return model


if __name__ == "__main__":
    wp.config.quiet = True
    print(json.dumps(asdict(solve(Case(**json.loads(sys.argv[1]))))))
