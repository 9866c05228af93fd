"""Scenes that are run to folders in a moment."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from fem_check.runs import pictures

FRAMES = 6
"""Of a period of a film, where its files matter and not how smooth it is: drawing takes the longest."""


@pytest.fixture(scope="module", autouse=True)
def short_films() -> Iterator[None]:
    """Films of a few frames, for the tests of a module that imports this."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(pictures, "PER_PERIOD", FRAMES)
        yield


def draw_nothing(patch: pytest.MonkeyPatch) -> None:
    """Where pictures and films are not looked at: they are most of the work."""
    patch.setattr("fem_check.runs.running.write_films", lambda *arguments: [])
    patch.setattr("fem_check.runs.running.write_pictures", blank_pictures)


def blank_pictures(recording: object, folder: Path, units: object) -> None:
    """Files without a picture."""
    for name in ("motion.png", "kymographs.png"):
        (folder / name).touch()


PLANE = """
[sheet]
length = "40 mm"
width = "15 mm"

[wave]
period = "8 s"

[growth]
swelling = "5 %"

[run]
rtol = "20 %"
"""
"""A strip, answered by theory."""

STEPPED = """
[sheet]
young = 1.0

[wave]

[growth]
alpha = 0.1

[gravity]
weight = 3e-6

[friction]
coefficient = 1.0
slip_speed = 0.005

[run]
level = "stepped"
steps = 40
periods = 1
cells = [1, 2]
"""
"""A sheet on which friction acts back, stepped through time."""
