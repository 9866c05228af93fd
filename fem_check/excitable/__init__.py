"""Excitable waves: the FitzHugh–Nagumo equation on lines, rectangles and outlines (eq. 12)."""

from fem_check.excitable.equation import FitzHughNagumo
from fem_check.excitable.excitation import Excitation
from fem_check.excitable.feedback import StrainFeedback
from fem_check.excitable.methods import Adaptive, Euler
from fem_check.excitable.periodic.train import WaveTrain, wave_train
from fem_check.excitable.periodic.wave import PeriodicExcitation
from fem_check.excitable.presets import PRESETS, excitable_preset
from fem_check.excitable.speeds import CycleSpeeds, speeds
from fem_check.excitable.starts import BumpStart, CrossedStart, Pacing, RationalStart, UniformStart
from fem_check.mesh.outline import Outline

__all__ = [
    "PRESETS",
    "Adaptive",
    "BumpStart",
    "CrossedStart",
    "CycleSpeeds",
    "Euler",
    "Excitation",
    "FitzHughNagumo",
    "Outline",
    "Pacing",
    "PeriodicExcitation",
    "RationalStart",
    "StrainFeedback",
    "UniformStart",
    "WaveTrain",
    "excitable_preset",
    "speeds",
    "wave_train",
]
