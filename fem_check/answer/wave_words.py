"""A wave in words, and which way it runs."""

import numpy as np

from linear_theory.wave.protocol import Drive, Wave
from linear_theory.wave.travelling import TravellingWave

PULSE = 0.4
"""Fraction of a wavelength above half height below which a wave is called a pulse (sine: 1/2)."""

PHASES = 4096


def direction(drive: Drive) -> int:
    """1 for a wave that runs towards +y, -1 towards -y, 0 for a general wave c(x, y, t)."""
    series = drive.series
    return 0 if series is None or not series.moves else int(np.sign(series.count))


def arrows(drive: Drive, speed: float) -> tuple[str, str]:
    """Labels of wave and sheet with arrows along their motion, +y to the right."""
    ways = {1: "{} ──▶", -1: "◀── {}", 0: "{}"}
    return ways[direction(drive)].format("wave"), ways[int(np.sign(speed))].format("sheet")


def wave_words(drive: Drive, given: Wave) -> str:
    """Number and form of the waves on the sheet; what the given wave says of itself goes first."""
    wave = drive.series
    if wave is None:
        own = getattr(drive.wave, "words", "a wave c(x, y, t)")
        return str(getattr(given, "words", own))
    if not wave.moves:
        return "growth constant in time"
    count = abs(wave.count)
    if wave.sine_amplitude is not None:
        return f"{_counted(count, 'sine wave')} on the sheet"
    width = above_half(wave)
    if width < PULSE:
        return f"{_counted(count, 'pulse')} on the sheet ({width:.2g} of a wavelength)"
    return f"{_counted(count, 'wave')} of {_counted(wave.cosine.size, 'harmonic')} on the sheet"


def above_half(wave: TravellingWave) -> float:
    """Fraction of a wavelength where c is above the middle of its range; 1 if not one interval."""
    c = wave.profile(2 * np.pi / PHASES * np.arange(PHASES))
    above = c > (c.max() + c.min()) / 2
    pieces = int(np.sum(above & ~np.roll(above, 1)))
    return float(above.mean()) if pieces == 1 else 1.0


def _counted(count: int, name: str) -> str:
    return f"{count} {name}{'s' if count > 1 else ''}"
