"""A wave in words, and which way it runs."""

import numpy as np

from linear_theory.wave.protocol import Drive
from linear_theory.wave.travelling import TravellingWave

PULSE = 0.4
"""Share of a wavelength above half height, below which a wave is a pulse; that of a sine is 1/2."""

PHASES = 4096


def direction(drive: Drive) -> int:
    """1 for a wave that runs towards +y, -1 towards -y, 0 where that is not said by a number."""
    series = drive.series
    return 0 if series is None or not series.moves else int(np.sign(series.count))


def arrows(drive: Drive, speed: float) -> tuple[str, str]:
    """The wave and the sheet with the way they go, +y to the right."""
    ways = {1: "{} ──▶", -1: "◀── {}", 0: "{}"}
    return ways[direction(drive)].format("wave"), ways[int(np.sign(speed))].format("sheet")


def wave_words(drive: Drive) -> str:
    """How many waves of what form are on the sheet."""
    wave = drive.series
    if wave is None:
        return str(getattr(drive.wave, "words", "a wave c(x, y, t)"))
    if not wave.moves:
        return "growth that stands still"
    count = abs(wave.count)
    if wave.sine_amplitude is not None:
        return f"{_counted(count, 'sine wave')} on the sheet"
    width = above_half(wave)
    if width < PULSE:
        return f"{_counted(count, 'pulse')} on the sheet ({width:.2g} of a wavelength)"
    return f"{_counted(count, 'wave')} of {_counted(wave.cosine.size, 'harmonic')} on the sheet"


def above_half(wave: TravellingWave) -> float:
    """Share of a wavelength in which c is above the middle of its range, in one piece; else 1."""
    c = wave.profile(2 * np.pi / PHASES * np.arange(PHASES))
    above = c > (c.max() + c.min()) / 2
    pieces = int(np.sum(above & ~np.roll(above, 1)))
    return float(above.mean()) if pieces == 1 else 1.0


def _counted(count: int, name: str) -> str:
    return f"{count} {name}{'s' if count > 1 else ''}"
