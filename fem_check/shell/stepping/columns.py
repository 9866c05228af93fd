"""The table of a trajectory: quantities at the end of each step, with units, and positions."""

from typing import TYPE_CHECKING

import numpy as np

from linear_theory.common.tables import LENGTH, NUMBER, SPEED, TIME, Column

if TYPE_CHECKING:
    from fem_check.shell.stepping.trajectory import Trajectory

ENERGY = "force*length"

AXES = {"x": "across", "y": "along", "z": "above the ground"}

ENERGIES = {
    "growth": "work of growth on the sheet",
    "elastic": "increase of the elastic energy",
    "weight": "increase of the energy of weight and dead loads",
    "ground": "increase of the energy of the ground",
    "kinetic": "increase of the kinetic energy",
    "friction": "energy lost to friction",
    "damping": "energy lost to damping by the ground",
}
"""Entries of `Works`, all since the start of the run."""


def columns(trajectory: "Trajectory") -> list[Column]:
    """Columns at the ends of the steps, times first."""
    table, works = trajectory.table, trajectory.power
    places = [
        Column(f"centre_{axis}", row, f"centre of mass, {AXES[axis]}", LENGTH)
        for axis, row in zip("xyz", trajectory.centre, strict=False)
    ]
    energies = [
        Column(name, getattr(works, name), f"{words}, since the start", ENERGY)
        for name, words in ENERGIES.items()
    ]
    return [
        Column("time", trajectory.times, "time", TIME),
        *places,
        Column("velocity", trajectory.velocity, "velocity of the centre along y", SPEED),
        *energies,
        Column("residual", works.residual, "residual of the energy balance", ENERGY),
        Column("fastest", table["fastest"], "largest speed along the ground", SPEED),
        Column("linear", table["linear"], "share of the load slower than the slip speed", NUMBER),
        Column("iterations", table["iterations"], "Newton iterations of the step", NUMBER),
        Column(
            "buckled", trajectory.buckled, "whether a negative curvature of the energy was met", NUMBER
        ),
        Column("snapped", trajectory.snapped, "whether the sheet jumped: motion not resolved", NUMBER),
    ]


def positions(trajectory: "Trajectory") -> list[Column]:
    """Positions of the mesh vertices at the stored times, and in the undeformed sheet."""
    model = trajectory.model
    vertices = model.discretisation.mesh.p
    region = model.discretisation.points(vertices)
    places = np.array([region.position(u, (0,))[0] for u in trajectory.states])
    axes = np.array(list("xyz"[: model.components]))
    dims = ("stored_time", "component", "vertex")
    return [
        Column("stored_time", trajectory.stored_times, "times of stored shapes", TIME, dims[:1]),
        Column("component", axes, "direction in space", NUMBER, dims[1:2]),
        Column("position", places, "position of a vertex of the mesh", LENGTH, dims),
        Column("vertex_x", vertices[0], "its place in the undeformed sheet, across", LENGTH, dims[2:]),
        Column("vertex_y", vertices[1], "its place in the undeformed sheet, along", LENGTH, dims[2:]),
    ]
