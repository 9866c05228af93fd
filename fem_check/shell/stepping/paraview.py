"""A trajectory as a time series for ParaView (XDMF), written by meshio, an optional package."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory import validation

Array = NDArray[np.float64]

CELLS = {3: "triangle", 4: "quad"}


def write_paraview(trajectory: Trajectory, path: str | Path, refine: int = 2) -> None:
    """The undeformed mesh, and at every kept time the displacement and the growth c at its vertices.

    path: of the .xdmf file; one file holds it all. refine: how often elements are halved for the
    picture, because a few elements of high degree carry more than their corners show. In ParaView:
    Warp By Vector. Raises ModuleNotFoundError, with what to install, without meshio.
    """
    meshio, scene = _meshio(), trajectory.scene
    mesh = scene.discretisation().mesh.refined(validation.integer("refine", refine, 0))
    region = scene.discretisation().points(mesh.p)
    flat = np.vstack([mesh.p, np.zeros(mesh.p.shape[1])])
    cells = [(CELLS[mesh.t.shape[0]], np.asarray(mesh.t.T))]
    target = Path(path)
    with meshio.xdmf.TimeSeriesWriter(target, data_format="XML") as writer:
        writer.write_points_cells(flat.T, cells)
        for t, u in zip(trajectory.stored_times, trajectory.states, strict=True):
            displacement = np.zeros((3, mesh.p.shape[1]))
            displacement[: scene.components] = region.displacement(u, (0,))[0]
            growth = trajectory.amplitude(t) * scene.growth(t, *mesh.p)
            data = {"displacement": displacement.T, "growth": np.asarray(growth)}
            writer.write_data(float(t), point_data=data)


def _meshio() -> Any:
    try:
        import meshio
    except ModuleNotFoundError:
        raise ModuleNotFoundError("ParaView output needs meshio: pip install meshio") from None
    return meshio
