"""Recordings as netCDF files, which any tool for labelled arrays reads, and back again.

The time series of the result, over `time`, stand beside the recorded motion, each variable with its
unit and its long name; the velocity V(t) is `velocity` in every file. The format is netCDF 3, for
which xarray needs no further library.
"""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.output.files import replacing
from fem_check.output.moving import Course, closed
from fem_check.output.works import LOOKS, Energies, since
from fem_check.runs.recording import Recording
from linear_theory.common.extras import optional
from linear_theory.common.tables import LENGTH, NUMBER, RADIANS, TIME, Column
from linear_theory.speed.result import CrawlSpeed, Estimate

Array = NDArray[np.float64]

USE = "a run, which keeps its motion as netCDF,"

PLACES = ("frame", "axis", "point")

COLUMNS = (
    ("frame", "times", "times of the recorded shapes", TIME, ("frame",)),
    ("sheet_place", "place", "position of a point of the sheet in space", LENGTH, PLACES),
    ("sheet_wave", "wave", "the wave c at the points", NUMBER, ("frame", "point")),
    ("sheet_growth", "growth", "growth alpha c at the points", NUMBER, ("frame", "point")),
    ("body_centre", "centre", "centre of mass", LENGTH, ("frame", "plane")),
    ("body_heading", "heading", "heading of the sheet, anticlockwise", RADIANS, ("frame",)),
    ("point_place", "points", "the points in the undeformed sheet", LENGTH, ("plane", "point")),
    ("middle", "middle", "centre of mass of the undeformed sheet", LENGTH, ("plane",)),
    ("triangle", "triangles", "points at the corners of triangles", NUMBER, ("cell", "corner")),
    ("arrow_place", "tails", "points with known friction", LENGTH, ("plane", "arrow")),
    ("sheet_friction", "arrows", "friction over mu weight", NUMBER, ("frame", "plane", "arrow")),
    ("sheet_load", "load", "normal load over weight per area", NUMBER, ("frame", "point")),
    ("floor_x", "floor_x", "places on the ground, across", LENGTH, ("floor_x",)),
    ("floor_y", "floor_y", "places on the ground, along", LENGTH, ("floor_y",)),
    ("floor", "floor", "height of the ground", LENGTH, ("floor_x", "floor_y")),
)
"""Names in the file and in a Recording, long names, units and dimensions."""

OPTIONAL = {"sheet_load"}
"""Left out where a motion, or a version, does not have them."""

FLOATS = {"sheet_load", "sheet_place", "sheet_wave", "sheet_growth", "sheet_friction"}
"""Large arrays, kept in single precision: a millionth of the sheet is enough to draw."""


def require_netcdf() -> None:
    """Raise ModuleNotFoundError, with what to install, without xarray."""
    optional("xarray", "tables", USE)


ENERGIES = tuple(LOOKS)
"""Variables of a motion in time, over `time`, from its start."""


def write(recording: Recording, result: Any, path: Path, units: Units | None = None) -> None:
    """The recording and the time series of its result to a file, which appears when it is whole.

    units: of the numbers, named in the attributes of the variables; None for those of the sheet.
    """
    dataset = result.to_xarray()
    for name, attribute, words, unit, dims in COLUMNS:
        values = getattr(recording, attribute)
        if values is None and name in OPTIONAL:
            continue
        values = values.astype(np.float32) if name in FLOATS else values
        dataset[name] = (dims, values, Column(name, values, words, unit).attributes)
    for variable in dataset.variables.values():
        variable.attrs["units"] = _named(variable.attrs["units"], units)
    dataset.attrs = _attributes(recording)
    with replacing(path) as part:
        dataset.to_netcdf(part, engine="scipy", format="NETCDF3_64BIT")


def _named(unit: str, units: Units | None) -> str:
    """A unit such as length/time by the names of its parts."""
    if units is None:
        return unit
    names = {LENGTH: units.length, "time": units.time}
    return "/".join(names.get(part, part) for part in unit.split("/"))


def _attributes(recording: Recording) -> dict[str, Any]:
    speed, course = recording.speed, recording.course()
    return {
        "mean": speed.mean,
        "error": speed.error,
        "model_error": speed.model_error,
        "converged": int(speed.converged),
        "seconds": speed.seconds,
        "slip_ratio": speed.slip_ratio,
        "regime": speed.regime,
        **speed.energies(),
        "model": speed.model,
        "words": recording.words,
        "period": recording.period,
        "length": recording.length,
        "direction": recording.direction,
        "periods": recording.periods,
        "repeats": int(recording.repeats),
        "counted": np.array(course.counted),
        "shown": np.array(course.shown),
    }


def read(path: Path) -> Recording:
    """The recording in a file. Raises ValueError for a file that holds none."""
    xarray = optional("xarray", "tables", "a run, read from its netCDF file,")
    try:
        # As numbers: times in days, or the like, are not dates.
        with xarray.open_dataset(path, engine="scipy", decode_times=False) as dataset:
            return _recording(dataset.load())
    except Exception as problem:  # whatever a damaged file leads its readers to
        raise ValueError(f"{path}: is not the trajectory of a run, or is damaged ({problem})") from None


def _recording(dataset: Any) -> Recording:
    known = dataset.attrs
    there = [column for column in COLUMNS if column[0] in dataset or column[0] not in OPTIONAL]
    arrays = {attribute: np.array(dataset[name].values) for name, attribute, *_ in there}
    arrays = {n: v.astype(np.int64 if n == "triangles" else np.float64) for n, v in arrays.items()}
    course = _course(dataset)
    speed = CrawlSpeed(
        Estimate(float(known["mean"]), float(known["error"])),
        float(known["model_error"]),
        bool(known["converged"]),
        course.times,
        course.velocity,
        float(known["seconds"]),
        str(known["model"]),
        float(known["slip_ratio"]),
    )
    return Recording(
        speed=speed,
        period=float(known["period"]),
        length=float(known["length"]),
        words=str(known["words"]),
        direction=int(known["direction"]),
        periods=int(known["periods"]),
        repeats=bool(known["repeats"]),
        course_shown=course,
        energies=_energies(dataset, course),
        **arrays,
    )


def _course(dataset: Any) -> Course:
    """V(t) as it is drawn: closed over its period, or from the end of the ramp on."""
    known = dataset.attrs
    names = ("time", "velocity") if "velocity" in dataset else ("course_time", "course_velocity")
    times, velocity = (np.array(dataset[name].values) for name in names)  # the latter of old files
    counted, shown = _interval(known["counted"]), _interval(known["shown"])
    if known["repeats"]:
        return closed(times, velocity, float(known["period"]))
    seen = times >= shown[0]
    return Course(times[seen], velocity[seen], counted, shown)


def _energies(dataset: Any, course: Course) -> Energies | None:
    """Of a motion in time."""
    if ENERGIES[0] not in dataset:
        return None
    works = {name: np.array(dataset[name].values) for name in ENERGIES}
    return since(np.array(dataset["time"].values), works, course.shown[0])


def _interval(values: Any) -> tuple[float, float]:
    first, last = (float(t) for t in values)
    return first, last
