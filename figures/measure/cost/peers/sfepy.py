"""The displacement of the sheet by SfePy, quadratic elements on a uniform grid of quadrilaterals."""

from typing import Any

import numpy as np
from numpy.typing import NDArray
from sfepy.base.base import output
from sfepy.discrete import (
    Equation,
    Equations,
    FieldVariable,
    Integral,
    Material,
    Problem,
)
from sfepy.discrete.conditions import Conditions, EssentialBC
from sfepy.discrete.fem import FEDomain, Field
from sfepy.mesh.mesh_generators import gen_block_mesh
from sfepy.solvers.ls import ScipyDirect
from sfepy.solvers.nls import Newton
from sfepy.terms import Term

from figures.measure.cost.peers.peer import Peer
from linear_theory.sheet.rectangle import Sheet

Array = NDArray[np.float64]

DEGREE = 2
CELLS = (4, 8, 16, 32)

output.set_output(quiet=True)


def solve(sheet: Sheet, parts: tuple[tuple[float, float], ...], n: int) -> list[Any]:
    """Displacement variables for growths p sin + q cos (2 pi y/L), on n elements along the sheet."""
    return [solve_part(sheet, part, n) for part in parts]


def solve_part(sheet: Sheet, part: tuple[float, float], n: int) -> Any:
    """One of them: its own assembly and factor, since the problem is set up with its load."""
    shape = max(n // 2, 1) + 1, n + 1
    mesh = gen_block_mesh((sheet.width, sheet.length), shape, (0.0, 0.0), verbose=False)
    domain = FEDomain("sheet", mesh)
    whole = domain.create_region("whole", "all")
    space = Field.from_args("displacement", np.float64, "vector", whole, approx_order=DEGREE)
    u = FieldVariable("u", "unknown", space)
    v = FieldVariable("v", "test", space, primary_var_name="u")
    material = Material("m", D=plane_stress(sheet.poisson))
    load = Material("f", function=growth_stress(sheet, part))
    integral = Integral("i", order=2 * DEGREE + 2)
    elastic = Term.new("dw_lin_elastic(m.D, v, u)", integral, whole, m=material, v=v, u=u)
    grown = Term.new("dw_lin_prestress(f.stress, v)", integral, whole, f=load, v=v)
    problem = Problem("sheet", equations=Equations([Equation("balance", elastic - grown)]))
    problem.set_bcs(ebcs=pins(domain))
    problem.set_solver(Newton({"i_max": 1}, lin_solver=ScipyDirect({})))
    problem.solve(save_results=False, verbose=False)
    return u


def plane_stress(nu: float) -> Array:
    """Stiffness for (xx, yy, 2 xy); SfePy's own divides by 1 - 2 nu."""
    return np.array([[1, nu, 0], [nu, 1, 0], [0, 0, (1 - nu) / 2]]) / (1 - nu**2)


def growth_stress(sheet: Sheet, part: tuple[float, float]) -> Any:
    """sigma(c I) = c/(1 - nu) I at the quadrature points, as the material of a term."""

    def stress(ts: Any, coors: Array, mode: str | None = None, **_: Any) -> dict[str, Array]:
        if mode != "qp":
            return {}
        phase = 2 * np.pi * coors[:, 1] / sheet.length
        growth = (part[0] * np.sin(phase) + part[1] * np.cos(phase)) / (1 - sheet.poisson)
        return {"stress": np.stack([growth, growth, np.zeros_like(growth)], 1)[:, :, None]}

    return stress


def pins(domain: Any) -> Any:
    """Rigid motions are stopped: the first vertex is held, and the second across their line."""
    first = domain.create_region("first", "vertex 0", "vertex")
    second = domain.create_region("second", "vertex 1", "vertex")
    ends = domain.mesh.coors[:2]
    along = int(abs(np.diff(ends, axis=0)).argmax())  # which way the first two vertices lie apart
    across = "u.0" if along == 1 else "u.1"
    return Conditions(
        [
            EssentialBC("held", first, {"u.all": 0.0}),
            EssentialBC("turned", second, {across: 0.0}),
        ]
    )


def displacements(solution: list[Any], x: Array, y: Array) -> Array:
    """(parts, 2, *x.shape)."""
    points = np.stack([x.ravel(), y.ravel()], 1)
    return np.stack([u.evaluate_at(points).T.reshape(2, *x.shape) for u in solution])


def peers() -> list[Peer]:
    """SfePy at one degree."""
    return [Peer(f"SfePy Q{DEGREE}", CELLS, solve, displacements)]
