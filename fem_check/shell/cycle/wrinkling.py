"""Whether a motion in the plane is one of a sheet that would wrinkle at once."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from fem_check.shell.effects.koiter import Membrane
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.ellipticity import Ellipticity

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]

WRINKLES = (
    "compressed beyond material stability, where its edge wrinkles and finer meshes have no shape"
)


def wrinkled(
    model: ShellModel, times: Array, states: Array, amplitude: Callable[[float], float]
) -> Flags:
    """Whether states (n, size) at times (n,) are compressed beyond material stability, (n,).

    amplitude: fraction of the growth at a time. Of sheets in the plane, as for cycles of shapes: a
    sheet that bends buckles before. A coarse mesh does not see it, see `statics.ellipticity`.
    """
    membrane = model.find(Membrane)
    if not model.planar or membrane is None:
        return np.zeros(times.size, bool)
    looks = Ellipticity(model.discretisation, membrane.material.poisson)

    def beyond(t: float, u: Array) -> bool:
        return looks.reserve(u, lambda region: model.rest(t, amplitude(t), region)).value <= 0

    return np.array([beyond(t, u) for t, u in zip(times.tolist(), states, strict=True)], bool)


def wrinkling_words(found: Flags, times: Array) -> str:
    """What the flags of states at some times (n,) say of a speed; nothing if none is set."""
    return f"{WRINKLES}, from t = {times[found][0]:.4g}" if found.any() else ""
