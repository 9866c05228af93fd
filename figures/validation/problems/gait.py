"""The inchworm gait of the piezo robot: voltages switched in quarters of a period, quasi-static.

    python -m figures.validation.problems.gait

writes the samples of its scene file, figures/validation/scenes/inchworm_voltages.csv.
"""

import numpy as np
from numpy.typing import NDArray

from fem_check import simulate
from figures.common.records import write_csv
from figures.validation.comparison import SCENES
from figures.validation.problems.piezo import COUNT, LENGTH, VOLTAGES
from linear_theory import Scene

Array = NDArray[np.float64]

QUARTERS = np.array([(0, 0, 0, 0, 0), (0, 1, 1, 1, 0), (1, 1, 1, 1, 0), (1, 0, 0, 0, 0)])
"""Which actuators have their voltage in each quarter, those at the rear first."""

ON = np.array(VOLTAGES)

SAMPLES = (51, 48)
"""Along the robot, ends included, and in a period."""

FILE = SCENES / "inchworm_voltages.csv"


def samples() -> dict[str, Array]:
    """y cm, t s, c (voltages over 1500 V) on a grid; the switches take a sixteenth of the period.

    From one actuator to the next the voltage changes over the distance of two samples, 4 cm.
    """
    y = np.linspace(-0.5, 0.5, SAMPLES[0])
    t = np.arange(SAMPLES[1]) / SAMPLES[1]
    joints, switches = np.arange(1, COUNT) / COUNT - 0.5, np.arange(4) / 4
    levels = QUARTERS * ON / np.abs(ON).max()
    along = np.stack([_step(y, joint, 0.04) for joint in joints])
    share = np.diff(np.concatenate([np.ones((1, y.size)), along, np.zeros((1, y.size))]), axis=0)
    in_time = np.zeros((4, t.size))
    for k, start in enumerate(switches):
        later = sum(
            _step(t, start + n, 1 / 16) - _step(t, start + 0.25 + n, 1 / 16) for n in (-1, 0, 1)
        )
        in_time[k] = later
    c = np.einsum("qa,ay,qt->ty", levels, -share, in_time)
    times, places = np.meshgrid(t, 100 * LENGTH * y, indexing="ij")
    return {"y": places.ravel(), "t": times.ravel(), "c": c.ravel()}


def _step(x: Array, place: float, width: float) -> Array:
    """From 0 to 1 over a width, once differentiable."""
    s = np.clip((x - place) / width + 0.5, 0, 1)
    return np.asarray(s**2 * (3 - 2 * s))


def centimetres_per_period(steps: int, cells: int) -> tuple[float]:
    """Forward, of the second period."""
    scene = Scene.from_toml(SCENES / "piezo_inchworm.toml").but(cells=(1, cells))
    return (simulate(scene, periods=2, steps=steps).speed.mean,)


if __name__ == "__main__":
    write_csv(FILE, samples(), 6)
