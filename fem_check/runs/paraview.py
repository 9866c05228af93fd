"""A recorded motion as a time series for ParaView (XDMF), written by meshio, an optional package."""

from pathlib import Path

import numpy as np

from fem_check.runs.recording import Recording
from linear_theory.common.extras import optional


def write_motion(recording: Recording, path: Path) -> None:
    """The undeformed sheet, and at every recorded time the displacement, c and growth at its points.

    One file holds it all; in ParaView: Warp By Vector. Raises ModuleNotFoundError, with what to
    install, without meshio.
    """
    meshio = optional("meshio", "paraview", "ParaView output")
    flat = np.vstack([recording.points, np.zeros(recording.points.shape[1])])
    with meshio.xdmf.TimeSeriesWriter(path, data_format="XML") as writer:
        writer.write_points_cells(flat.T, [("triangle", recording.triangles)])
        for t, place, wave, growth in zip(
            recording.times, recording.place, recording.wave, recording.growth, strict=True
        ):
            displacement = -flat
            displacement[: len(place)] += place
            data = {"displacement": displacement.T, "wave": wave, "growth": growth}
            writer.write_data(float(t), point_data=data)
