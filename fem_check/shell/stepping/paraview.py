"""A trajectory as a time series for ParaView (XDMF), written by meshio, an optional package."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.stepping.trajectory import Trajectory
from linear_theory.common import validation
from linear_theory.common.extras import optional

Array = NDArray[np.float64]

CELLS = {3: "triangle", 4: "quad"}


def write_paraview(trajectory: Trajectory, path: str | Path, refine: int = 2) -> None:
    """Write the undeformed mesh, with displacement and growth c at its vertices at every kept time.

    path: of the .xdmf file, which holds all data. refine: number of refinements of the elements for the
    picture, because the corners of a few elements of high degree do not show their shape. In ParaView
    use the filter Warp By Vector.

    Raises ValueError for anything but a trajectory and for a refine that is not an integer >= 0, and
    ModuleNotFoundError, with what to install, without meshio.

    >>> import os, tempfile
    >>> from fem_check import Friction, Gravity, Material, Membrane, Scene, simulate, write_paraview
    >>> from linear_theory import Sheet, SineWave
    >>> effects = [Membrane(Material(0.03, 0.5)), Gravity(3e-6), Friction(1.0, slip_speed=0.005)]
    >>> scene = Scene(Sheet(), SineWave(), alpha=0.1, effects=effects, cells=(1, 2))
    >>> motion = simulate(scene, periods=1, rtol=0.1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     write_paraview(motion, os.path.join(folder, "crawl.xdmf"))
    ...     print(os.listdir(folder))
    ['crawl.xdmf']
    """
    meshio = optional("meshio", "paraview", "ParaView output")
    hint = "simulate returns one"
    model = validation.instance("trajectory", trajectory, Trajectory, hint).model
    mesh = model.discretisation.mesh.refined(validation.integer("refine", refine, 0))
    region = model.discretisation.points(mesh.p)
    flat = np.vstack([mesh.p, np.zeros(mesh.p.shape[1])])
    cells = [(CELLS[mesh.t.shape[0]], np.asarray(mesh.t.T))]
    target = Path(path)
    with meshio.xdmf.TimeSeriesWriter(target, data_format="XML") as writer:
        writer.write_points_cells(flat.T, cells)
        for t, u in zip(trajectory.stored_times, trajectory.states, strict=True):
            displacement = np.zeros((3, mesh.p.shape[1]))
            displacement[: model.components] = region.displacement(u, (0,))[0]
            growth = trajectory.amplitude(t) * model.growth(t, *mesh.p)
            data = {"displacement": displacement.T, "growth": np.asarray(growth)}
            writer.write_data(float(t), point_data=data)
