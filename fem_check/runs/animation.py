"""The data of the animation in a report: a recording in whole numbers, small enough to be inlined."""

import base64
from typing import Any

import numpy as np
from matplotlib.colors import to_hex
from numpy.typing import NDArray

from fem_check.answer.units import Units
from fem_check.output.film.stage import nice
from fem_check.output.geometry import edges
from fem_check.output.panels import GROWTH_MAP
from fem_check.output.tint import tint
from fem_check.runs.recording import Recording

Array = NDArray[np.float64]

LAPS = 4
"""Periods of the animation of a motion that repeats."""

FRAMES = 145
"""Most frames; longer records are thinned out."""

MOST = 65535
"""Whole numbers to a coordinate: a sheet on a screen has a few thousand pixels."""

COLOURS = 64

TURNS = 0.02
"""Radians in all, from which a sheet needs as much room across as along."""

DRAPED = 80
"""Points of a line of uneven ground."""

RULES = 14
"""Lines of the ground along the longer side, about."""


def data_of(recording: Recording, units: Units) -> dict[str, Any]:
    """What `page/sheet.js` reads. Lengths in units of the recording, time in that of `units`."""
    every = -(-(len(recording.times) - 1) // (FRAMES - 1))
    place = recording.place[::every]
    times = recording.times[::every]
    laps = LAPS if recording.repeats else 1
    low, high = place.min((0, 2)), place.max((0, 2))
    unit = np.maximum(high - low, 1e-12) / MOST
    whole = np.rint((place - low[:, None]) / unit[:, None]).astype("<u2")
    shown = tint(recording.growth, recording.wave)
    values = shown.of(recording.growth, recording.wave)[::every]
    colour = np.rint((values / (shown.most or 1.0) + 1) * 127.5).astype("u1")
    step = recording.centre[-1] - recording.centre[0]
    middle, size, grid = _ground(recording, laps)
    dt = (times[1] - times[0]) * units.time_factor
    return {
        "points": place.shape[2],
        "frames": len(times),
        "axes": place.shape[1],
        "place": _text(whole),
        "colour": _text(colour),
        "triangles": _text(recording.triangles.astype("<u2")),
        "edges": _text(edges(recording.triangles).astype("<u2")),
        "low": low.tolist(),
        "unit": unit.tolist(),
        "first": recording.centre[0].tolist(),
        "step": step.tolist(),
        "turn": float(recording.heading[-1] - recording.heading[0]),
        "laps": laps,
        "periods": recording.periods,
        "size": size,
        "middle": middle,
        "grid": grid,
        "start": float(times[0]) * units.time_factor if recording.repeats else 0.0,
        "dt": dt,
        "time": units.time,
        "digits": max(0, 2 - int(np.floor(np.log10(recording.period * units.time_factor)))),
        "colours": [to_hex(GROWTH_MAP(k / (COLOURS - 1))) for k in range(COLOURS)],
    }


def _text(values: NDArray[Any]) -> str:
    return base64.b64encode(np.ascontiguousarray(values).tobytes()).decode("ascii")


def _ground(recording: Recording, laps: int) -> tuple[list[float], float, list[Any]]:
    """The middle of all places and their extent, and lines of the ground as lists of points."""
    spread = np.abs(recording.place[:, :2] - recording.centre[:, :, None]).max((0, 2))
    _, way = recording.way(laps * recording.periods, 24)
    if np.ptp(recording.heading) > TURNS:  # a sheet that turns takes as much room each way
        spread = np.full(2, spread.max())
    low, high = way.min(1) - spread, way.max(1) + spread
    middle, half = (low + high) / 2, (high - low) / 2 + 0.1 * recording.length
    rule = nice(2 * float(half.max()) / RULES)
    digits = 5 - int(np.floor(np.log10(recording.length)))
    first, last = (np.rint((middle + sign * half) / rule).astype(int) for sign in (-1, 1))
    lines = []
    for axis in (0, 1):
        other = 1 - axis
        count = 2 if recording.level else DRAPED
        along = rule * np.linspace(first[other], last[other], count)
        for k in range(first[axis], last[axis] + 1):
            places = np.empty((3, count))
            places[axis], places[other] = k * rule, along
            places[2] = recording.ground(places[0], places[1])
            lines.append(places.T.round(digits).tolist())
    return middle.tolist(), 2.1 * float(half.max()), lines
