"""Movies 1 to 4 of the paper.

    python -m figures.draw.movies [--out FOLDER] [--which 1234] [--suffix .gif] [--width 480]

1: the flat sheet of figure 3, alpha = 0.25, by a cycle of shapes. 2: the backward and the forward gait
of figure 4. 3: a trapezoid with the wider end ahead, and one with it behind. 4: the forward gait on the
grounds B, C and D of figure 6. Gaits have kappa = beta/h and viscous friction, but 4 has dry friction:
on slopes the paper's viscous one does not hold the sheet. A minute or two.
"""

from collections.abc import Callable, Sequence
from typing import Any

from fem_check import cycle_speed
from figures.common.command import parser
from figures.common.folders import OUT
from figures.common.output import tracked
from figures.common.scenes import planar_scene
from figures.measure.paper import decisive, terrain, trapezoids
from figures.measure.paper.paper_gait import READINGS, SHEET, kept, moved, paper_scene

STEPS, FRAMES, FPS = 64, 24, 15.0

FILMED = 2
"""Cycles of a film."""


def flat() -> Any:
    """Movie 1."""
    return cycle_speed(planar_scene(SHEET, 1, 0.25), rtol=1e-2)


def gait(name: str, **settings: Any) -> Any:
    """The motion of a gait of figure 4, other things than in the map by name."""
    alpha, beta = decisive.GAITS[name]
    scene = paper_scene(alpha, kept(beta * READINGS["thickness"]), **settings)
    return moved(scene, STEPS, periods=FILMED)


def trapezoid(ratio: float) -> Any:
    """The forward gait on a trapezoid of the length of the rectangle."""
    return gait("forward", outline=trapezoids.outline(ratio, 1.0), size=trapezoids.SIZE)


def ground(letter: str) -> Any:
    """The forward gait on a ground of figure 6."""
    return gait("forward", friction="dry", height=terrain.height("cosine", *terrain.SHOWN[letter]))


FILMS: dict[str, Callable[[], Any]] = {
    "movie1": flat,
    "movie2_backward": lambda: gait("backward"),
    "movie2_forward": lambda: gait("forward"),
    "movie3_wide_front": lambda: trapezoid(0.5),
    "movie3_wide_rear": lambda: trapezoid(2.0),
    **{f"movie4_{letter}": lambda letter=letter: ground(letter) for letter in "BCD"},  # type: ignore[misc]
}


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the films."""
    options = parser(
        "python -m figures.draw.movies",
        __doc__,
        OUT,
        which=("1234", "numbers of the movies"),
        suffix=(".gif", ".gif or .mp4"),
        width=(480, "pixels"),
    ).parse_args(arguments)
    options.out.mkdir(parents=True, exist_ok=True)
    for name in tracked("films", [name for name in FILMS if name[5] in options.which]):
        path = options.out / (name + options.suffix)
        look: dict[str, Any] = {"periods": FILMED, "frames": FRAMES, "fps": FPS, "width": options.width}
        print(FILMS[name]().movie(path, **look, view=None if name == "movie1" else "space"))


if __name__ == "__main__":
    main()
