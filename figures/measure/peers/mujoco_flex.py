"""The scenes by flexes of MuJoCo: `python -m figures.measure.peers.mujoco_flex CASE`, JSON to JSON."""

import json
import math
import sys
import time
from dataclasses import asdict

import mujoco
import numpy as np

from figures.measure.peers.problems import (
    BLOCK,
    FRICTION,
    GRAVITY,
    INCLINE,
    MASS,
    SPEED,
    THICKNESS,
    WIDTHS,
    Answer,
    Array,
    Case,
    answer,
    followed,
    natural,
    strip,
    young,
)

RADIUS = 0.005
"""Of the vertices, in m."""

DAMPING = 0.02
"""Of the strip's elasticity, in s: it settles within 3 s."""

MODEL = """
<mujoco>
 <option timestep="{step}" gravity="{down}" solver="Newton" cone="elliptic" integrator="discrete"/>
 <size memory="200M"/>
 <worldbody>
  <geom type="plane" size="5 5 .1" friction="{friction} 0 0" condim="3" priority="1"
        solref="0.005 1" solimp="0.99 0.999 0.0001"/>
  <flexcomp name="sheet" type="direct" dim="2" mass="{mass}" radius="{radius}" pos="0 0 {radius}"
            point="{points}" element="{triangles}">
   <contact selfcollide="none"/>
   <elasticity young="{young}" poisson="0" thickness="{thickness}" damping="{damping}"
               elastic2d="both"/>
  </flexcomp>
 </worldbody>
</mujoco>
"""
"""Contacts as stiff as MuJoCo recommends at these steps; implicit elasticity needs "discrete"."""


def solve(case: Case) -> Answer:
    """Run a case."""
    points, triangles = strip(case, natural(case))
    incline = INCLINE if case.problem == BLOCK else 0.0
    model = mujoco.MjModel.from_xml_string(_model(case, points, triangles, incline))
    data = mujoco.MjData(model)
    model.body_mass[model.flex_vertbodyid] = masses(case)
    mujoco.mj_setConst(model, data)
    if case.problem == BLOCK:
        data.qvel[0::3] = -SPEED
    mujoco.mj_forward(model, data)
    begin = time.process_time()
    found = followed(
        case, lambda: data.flexvert_xpos.reshape(-1, 3), lambda: mujoco.mj_step(model, data)
    )
    return answer(case, found, time.process_time() - begin, f"mujoco {mujoco.__version__}")


def masses(case: Case) -> Array:
    """Of the vertices: by the area around them, (points,).

    Flexes give all vertices the same mass, so that the ends of the strip would weigh twice what they
    should, and stand 22 to 43 % too low.
    """
    along, across = np.ones(case.along + 1), np.ones(case.across + 1)
    along[[0, -1]] = across[[0, -1]] = 0.5
    shares = np.outer(along, across).ravel()
    return np.asarray(MASS * WIDTHS[case.problem] * shares / shares.sum())


def _model(case: Case, points: Array, triangles: Array, incline: float) -> str:
    down = f"{-GRAVITY * math.sin(incline)} 0 {-GRAVITY * math.cos(incline)}"
    return MODEL.format(
        step=case.step,
        down=down,
        friction=FRICTION,
        mass=MASS * WIDTHS[case.problem],
        radius=RADIUS,
        points=" ".join(f"{c:.12g}" for c in np.ravel(points)),
        triangles=" ".join(str(k) for k in np.ravel(triangles)),
        young=young(),
        thickness=THICKNESS,
        damping=0.0 if case.problem == BLOCK else DAMPING,
    )


if __name__ == "__main__":
    print(json.dumps(asdict(solve(Case(**json.loads(sys.argv[1]))))))
