"""Gradients of bending sheets: differences of speeds, exact identities, a strip, stated errors."""

from functools import cache

import numpy as np
import pytest

from fem_check import Bending, Friction, Gravity, Ground, Material, Membrane
from fem_check.optimisation.adjoint import Adjoint
from fem_check.optimisation.objectives import Speed
from fem_check.optimisation.unknowns import Unknowns
from linear_theory import (
    FieldWave,
    FractionalWave,
    Scene,
    Sheet,
    SineWave,
    Tanh,
    TravellingWave,
    Viscous,
    crawl_speed,
    second_order,
)
from linear_theory.gradient import WaveFamily, cost_gradient, parameters, speed_gradient
from linear_theory.speed.plate.quadratic_form import QuadraticForm
from linear_theory.speed.result import Estimate
from tests.gradient.reference_bending import Frozen
from tests.plate.reference_strip import Strip

PULSE = TravellingWave([0.5, 0.2], [0.3, -0.1], 1, 1.0, 0.1)
PLATE = [
    *("growth.alpha", "growth.curvature_coupling", "sheet.thickness", "sheet.width"),
    *("sheet.poisson", "gravity.weight", "ground.stiffness"),
]
WAVES = [f"wave.{part}.{k}" for k in range(2) for part in ("cosine", "sine")]


def scene_of(wave=PULSE, law=None, seed=None, **sheet) -> Scene:
    """A sheet on its ground, of random numbers for a seed."""
    couplings, weight, stiffness = (0.05, -0.1), 2.5e-4, 0.5
    if seed is not None:
        random = np.random.default_rng(seed)
        width, poisson, thickness = random.uniform([0.2, -0.2, 0.02], [0.6, 0.45, 0.05])
        sheet = {"width": width, "poisson": poisson, "thickness": thickness}
        couplings = random.uniform(0.03, 0.1), random.uniform(-0.2, 0.2)
        weight, stiffness = random.uniform(2e-4, 6e-4), random.uniform(0.1, 2.0)
    flat = Sheet(**sheet)
    material, friction = Material(flat.thickness, flat.poisson), Friction(1e-3, law=law or Viscous())
    effects = [Membrane(material), Bending(material), Gravity(weight), Ground(stiffness), friction]
    return Scene(flat, wave, *couplings, effects)


def direction_of(scene: Scene, names, seed: int = 5):
    """A random one, of changes relative to the parameters."""
    sizes = [abs(one.value(scene)) or 0.1 for one in parameters(names)]
    return np.random.default_rng(seed).uniform(-1, 1, len(sizes)) * sizes


CASES = {
    "viscous": (PULSE, Viscous(), 1, WAVES),
    "tanh": (PULSE, Tanh(0.2), 2, [*WAVES, "wave.sine.2"]),
    "reversal": (TravellingWave([0.6, 0.2], [0.0, 0.0]), Tanh(0.2), 3, WAVES),  # V(t_0 - t) = V(t)
    "sine": (SineWave(), Tanh(0.2), 4, [*WAVES[:2], "wave.cosine.2", "wave.mean"]),
}


@pytest.mark.parametrize("case", CASES)
def test_derivatives_on_a_frozen_grid_are_those_of_differences(case):
    """Of speed and power, along a random direction of all parameters, to 1e-6 of its parts."""
    wave, law, seed, waves = CASES[case]
    scene, names = scene_of(wave, law, seed), [*PLATE, *waves]
    direction, frozen = direction_of(scene, names), Frozen(scene)
    parts = frozen.gradients(names) * direction
    off = abs(parts.sum(1) - frozen.along(names, direction))
    assert np.all(off < 1e-6 * np.linalg.norm(parts, axis=1)), off / np.linalg.norm(parts, axis=1)


@cache
def gradient_at(rtol: float):
    """Of a random scene with tanh friction."""
    return speed_gradient(scene_of(law=Tanh(0.1), seed=7), [*PLATE, *WAVES], order=2, rtol=rtol)


def test_stated_errors_are_not_smaller_than_true_ones():
    loose, tight = gradient_at(1e-3), gradient_at(1e-4)
    share = abs(loose.values - tight.values) / loose.errors
    assert 1e-4 < share.max() <= 1
    assert np.all(loose.errors < 0.1 * np.linalg.norm(tight.values) + abs(tight.values))


def test_exact_identities():
    """Only alpha c and beta c count, not the phase of the wave, and V is a quadratic form of both.

    A shift in time by tau/2 pi adds k tau to the phase of the k-th harmonic.
    """
    scene = scene_of(law=Viscous())
    names = ["alpha", "growth.curvature_coupling", "wave.period", "wave.mean", *WAVES]
    found = speed_gradient(scene, names, order=2, rtol=1e-5)
    alpha, beta, size = scene.alpha, scene.curvature_coupling, abs(found.speed.mean)
    by_alpha, by_beta, _, *waves = found.values
    amplitudes = [0.1, 0.5, 0.3, 0.2, -0.1]
    assert np.dot(amplitudes, waves) == pytest.approx(
        alpha * by_alpha + beta * by_beta, abs=1e-5 * size
    )
    turned = 0.5 * waves[2] - 0.3 * waves[1] + 2 * (0.2 * waves[4] + 0.1 * waves[3])
    assert abs(turned) < 1e-5 * size
    assert found["wave.period"] == pytest.approx(-found.speed.mean)
    form = second_order(scene, rtol=1e-5).coefficients
    want = form.alpha.value + 2 * alpha * form.alpha_alpha.value + beta * form.alpha_beta.value
    assert by_alpha == pytest.approx(want, rel=1e-5)
    want = alpha * form.alpha_beta.value + 2 * beta * form.beta_beta.value
    assert by_beta == pytest.approx(want, rel=1e-5)


def test_a_narrow_sheet_is_the_exact_strip():
    """alpha beta dV_ab, viscous; V_aa does not depend on thickness, weight and ground, V_bb is 0."""
    scene = scene_of(SineWave(), width=0.02, poisson=0.0)
    names = ["sheet.thickness", "gravity.weight", "ground.stiffness"]
    found = speed_gradient(scene, names, order=2, rtol=1e-4)
    values = [one.value(scene) for one in parameters(names)]

    def mixed(thickness, weight, stiffness):
        spring = 2 * np.sqrt(stiffness * weight)
        return Strip(thickness**3 / 12, spring, weight, thickness).mixed()

    for i, value in enumerate(values):
        ends = [mixed(*np.add(values, s * 1e-4 * value * np.eye(3)[i])) for s in (1, -1)]
        want = scene.alpha * scene.curvature_coupling * (ends[0] - ends[1]) / (2e-4 * value)
        assert found.values[i] == pytest.approx(want, rel=2e-3)


def test_a_wave_that_is_no_series_and_a_family_of_it():
    """The same pulse, as one of not quite a whole number of waves, by its first amplitude."""

    def wave(size):
        profile = TravellingWave([size, 0.2], PULSE.sine, mean=0.1)
        return FractionalWave(profile, 1 + 1e-9)

    family = WaveFamily("size", 0.5, wave)
    found = speed_gradient(scene_of(wave(0.5)), [family, "sheet.thickness"], order=2, rtol=1e-2)
    series = speed_gradient(scene_of(), ["wave.cosine.0", "sheet.thickness"], order=2, rtol=1e-3)
    assert np.all(abs(found.values - series.values) <= found.errors + series.errors)
    assert found.values == pytest.approx(series.values, rel=1e-3)


def test_the_gradient_of_the_cost_is_that_of_differences():
    """Of speeds that are solved anew."""
    scene, step = scene_of(law=Tanh(0.02)), 1e-2
    (one,) = parameters("sheet.thickness")
    found = cost_gradient(scene, [one], order=2, rtol=1e-3)
    ends = [
        crawl_speed(one.changed(scene, 0.03 * (1 + s * step)), order=2, rtol=1e-4).cost_of_transport
        for s in (1, -1)
    ]
    want = (ends[0].value - ends[1].value) / (2 * 0.03 * step)
    assert found.values[0] == pytest.approx(want, rel=2e-3)
    assert abs(found.values[0] - want) < found.errors[0]


def test_the_best_couplings_are_those_of_a_scan():
    form = QuadraticForm(
        Estimate(0.0, 0.0),
        Estimate(1.5, 1e-3),
        Estimate(-0.4, 1e-3),
        Estimate(-0.03, 1e-3),
        (-9.0, 9.0),
    )
    angle = np.linspace(0, 2 * np.pi, 4001)
    for towards in (1, -1):
        found = form.best(0.1, 2.0, towards)
        scan = [form.at(0.1 * np.cos(a), 2.0 * np.sin(a)).value for a in angle]
        assert towards * found.speed.value == pytest.approx(max(towards * v for v in scan), rel=1e-5)
        assert form.at(found.alpha, found.beta).value == pytest.approx(found.speed.value)
        assert (found.alpha / 0.1) ** 2 + (found.beta / 2.0) ** 2 == pytest.approx(1.0)
    with pytest.raises(ValueError, match="lifts off"):
        form.best(0.1, 100.0, towards=-1)
    with pytest.raises(ValueError, match="first degree"):
        QuadraticForm(Estimate(0.1, 0.0), Estimate(1.5, 0.0)).best(0.1, 2.0)


def test_what_has_no_gradient_is_refused_by_name():
    flat = Scene(Sheet(), SineWave(), alpha=0.1)
    with pytest.raises(ValueError, match=r"sheet\.thickness.*a sheet that bends"):
        speed_gradient(flat, "sheet.thickness")
    with pytest.raises(ValueError, match="cannot represent"):
        speed_gradient(scene_of(), "alpha")  # order 1
    oblique = FieldWave(lambda x, y, t: np.sin(2 * np.pi * (x + y - t)), 1.0)
    for gradient in (speed_gradient, cost_gradient):
        with pytest.raises(ValueError, match=r"order = 2: .*must not turn.*of order = 1"):
            gradient(flat.but(wave=oblique), "alpha", order=2)
    below = Friction(1e-3, law="viscous", surface="bottom")
    effects = [*(e for e in scene_of().effects if not isinstance(e, Friction)), below]
    with pytest.raises(ValueError, match="lower face"):
        speed_gradient(scene_of().but(effects=effects), "alpha", order=2)
    with pytest.raises(ValueError, match="lifts off"):
        speed_gradient(scene_of().but(curvature_coupling=5.0), "alpha", order=2)


def test_optimise_has_the_gradient_of_a_sheet_that_bends():
    scene = scene_of(law=Tanh(0.1))
    unknowns = Unknowns(
        scene, {"growth.curvature_coupling": (-0.3, 0.3), "sheet.thickness": (0.02, 0.05)}
    )
    adjoint = Adjoint.of(unknowns, Speed(), 1e-3, "second order")
    found = adjoint(unknowns.present)
    want = speed_gradient(scene, ["growth.curvature_coupling", "sheet.thickness"], order=2, rtol=1e-3)
    assert found.gradient == pytest.approx(want.values * [0.6, 0.03], rel=1e-6)
    assert Adjoint.of(unknowns, Speed(), 1e-3, "first order") is None
