"""Random questions to fields, to sheets that bend and to the choice of a level."""

import numpy as np

from fem_check import Outline, plane_stress_field
from fem_check.answer.energy import with_model_errors
from fem_check.choice.levels import finer
from fem_check.choice.prediction import predict
from fem_check.shell.cycle.speed import cycle_speed
from figures.measure.plate import model_error
from linear_theory import (
    Contact,
    Scene,
    Sheet,
    SineWave,
    airy_series,
    crawl_speed,
    field_speed,
    ritz_field,
    second_order,
)
from linear_theory.friction.load import WEIGHTS as LOADS
from tests.robust.trials.drawn import a_law, a_sheet, a_wave, an_alpha
from tests.robust.trials.outcome import REFUSALS, Outcome, compared, refusal
from tests.robust.trials.theory import LAWS


def prediction(rng: np.random.Generator) -> Outcome:
    """`predict`, against the nonlinear sheet on three times the default elements each way."""
    sheet = Sheet(width=float(rng.uniform(0.1, 1.0)), poisson=float(rng.uniform(0, 0.5)))
    wave, alpha = SineWave(int(rng.choice([1, -1, 2]))), an_alpha(rng, 0.25)
    load, law = str(rng.choice(LOADS)), str(rng.choice(LAWS))
    rtol = 10.0 ** rng.uniform(-2.5, -0.5)
    scene = Scene(sheet, wave, alpha, growth_law=law, contact=Contact(load))
    words = f"{sheet}, {wave}, {scene.growth}, {load} load, rtol {rtol:.1e}"
    try:
        found = predict(sheet, wave, alpha, law, load=load, rtol=rtol)
        better = cycle_speed(finer(scene, 3), rtol=3e-4, atol=3e-5 * alpha**2)
    except REFUSALS as error:
        return refusal(words, error)
    return compared(with_model_errors(found.speed), better, words)


def field(rng: np.random.Generator) -> Outcome:
    """The Airy series, in mean square over the sheet at the worst phase, against Ritz, far sharper."""
    sheet, wave = a_sheet(rng), a_wave(rng)
    rtol = 10.0 ** rng.uniform(-7, -2)
    words = f"{sheet}, {wave}, rtol {rtol:.1e}"
    # errors gather at the corners, where points at random would miss or overrate them
    places, weights = np.polynomial.legendre.leggauss(40)
    x = np.repeat(places, places.size) * sheet.width / 2
    y = np.tile(places, places.size) * sheet.length / 2
    root = np.sqrt(np.outer(weights, weights).ravel())
    try:
        found = airy_series(sheet, wave, rtol=rtol)
        better = ritz_field(sheet, wave, rtol=max(rtol / 100, 1e-9))
    except REFUSALS as error:
        return refusal(words, error)
    times = np.linspace(0, wave.period, 8, endpoint=False)
    pairs = [(found.displacement(x, y, t), better.displacement(x, y, t)) for t in times]
    size = max(float(np.linalg.norm(root * exact)) for _, exact in pairs)
    true = max(float(np.linalg.norm(root * (near - exact))) for near, exact in pairs) / size
    return Outcome(words, true, found.error + better.error)


def bent(rng: np.random.Generator) -> Outcome:
    """Second order of a sheet that bends on its ground, against itself to a thirtieth of rtol."""
    row = model_error.drawn(int(rng.integers(10**6)))
    share = float(rng.uniform(0.05, 0.9))
    rtol = 10.0 ** rng.uniform(-3, -1.5)
    words = f"{row}, share {share:.3g}, rtol {rtol:.1e}"
    try:
        limit = second_order(model_error.scene(row, 0.0), rtol=rtol).coefficients.lift_off[1]
        asked = model_error.scene(row, share * limit)
        found = crawl_speed(asked, order=2, rtol=rtol)
        better = crawl_speed(asked, order=2, rtol=rtol / 30)
    except REFUSALS as error:
        return refusal(words, error)
    return compared(found, better, words)


def outline(rng: np.random.Generator) -> Outcome:
    """Speed of a sheet of some outline by finite elements, against twice as fine a mesh."""
    corners = int(rng.integers(3, 8))
    angles = 2 * np.pi * (np.arange(corners) + rng.uniform(-0.3, 0.3, size=corners)) / corners
    radii = rng.uniform(0.35, 0.5, size=corners)
    shape = Outline(radii[:, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1))
    poisson, wave, alpha = float(rng.uniform(0, 0.5)), a_wave(rng, 2), an_alpha(rng, 0.2)
    options = a_law(rng, alpha)
    words = f"{shape}, {poisson:.3f}, {wave}, {alpha:.4g}, {options}"
    try:
        coarse, fine = (plane_stress_field(shape, wave, poisson, size=size) for size in (0.1, 0.05))
        found = field_speed(coarse, alpha, rtol=1e-2, **options)
        better = field_speed(fine, alpha, rtol=1e-3, **options)
    except REFUSALS as error:
        return refusal(words, error)
    return compared(found, better, words)
