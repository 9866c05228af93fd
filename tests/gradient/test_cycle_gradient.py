"""The gradient of a cycle of shapes: exact on frozen grids, honest, for small growth that of theory."""

from dataclasses import replace
from importlib.resources import files

import numpy as np
import pytest

from fem_check import (
    Bending,
    Friction,
    Gravity,
    Ground,
    Harmonics,
    Material,
    Membrane,
    cycle_gradient,
    cycle_speed,
    optimise,
)
from fem_check.optimisation.adjoint import Adjoint
from fem_check.optimisation.objectives import objective_of
from fem_check.optimisation.optimise_file import read
from fem_check.shell.cycle.balance import CycleBalance
from fem_check.shell.cycle.gradient.changes import Changes
from fem_check.shell.cycle.gradient.statics import StaticAdjoint
from fem_check.shell.cycle.gradient.sums import FrictionAdjoint
from fem_check.shell.cycle.shapes import Shapes, cycle_of_shapes, minimiser_of, phases, working_effects
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.potential import Potential
from linear_theory import (
    Contact,
    Coulomb,
    Directional,
    FieldWave,
    Mapped,
    Patches,
    Scene,
    Sheet,
    Tanh,
    TravellingWave,
    Viscous,
    speed_gradient,
)
from linear_theory.gradient import WaveFamily, parameters

PULSE = TravellingWave([0.5, 0.2], [0.3, -0.1], 1, 1.0, 0.1)
WAVE = ["wave.cosine.0", "wave.sine.1", "wave.cosine.2", "wave.mean"]


def oblique(s):
    return FieldWave(lambda x, y, t: np.sin(2 * np.pi * (s * x + y - t)) * (1 + 0.3 * x), 1.0)


def on_ground():
    material = Material(0.03, 0.3)
    ground = (Gravity(2.5e-4), Ground(0.5), Friction(1.0, slip_speed=0.1, surface="bottom"))
    effects = (Membrane(material), Bending(material), *ground)
    sheet = Sheet(poisson=0.3)
    return Scene(sheet, PULSE, alpha=0.1, curvature_coupling=0.8, effects=effects, cells=(2, 4))


FLAT = Scene(Sheet(), PULSE, alpha=0.2, cells=(2, 4), contact=Contact("current", Tanh(0.1)))
MAPPED = Mapped(Tanh(0.1), Patches([(-1, 1, -1, -0.25, 3.0)], edge=0.1))
BENT = ["growth.curvature_coupling", "sheet.thickness", "gravity.weight", "ground.stiffness"]
SHEET = ["growth.alpha", "sheet.width", "sheet.poisson"]

FROZEN = {
    "flat": (FLAT, [*SHEET, *WAVE, "wave.count", "friction.slip_speed"]),
    "map": (
        FLAT.but(contact=Contact("grown", MAPPED), area="undeformed", sheet=Sheet(poisson=0.3)),
        ["growth.alpha", "sheet.poisson", *WAVE, "friction.map.mu.0"],
    ),
    "turning": (
        FLAT.but(wave=oblique(0.2), contact=Contact("current", Viscous())),
        ["growth.alpha", WaveFamily("tilt", 0.2, oblique)],
    ),
    "lower face": (on_ground(), [*SHEET, *BENT, *WAVE]),
}
COUNT = 6


class Frozen:
    """A sum of V_y at fixed times, with fixed phases and cells."""

    def __init__(self, scene):
        self.scene, self.model = scene, ShellModel(scene)
        self.shapes = cycle_of_shapes(self.model, COUNT)
        self.times = np.array([0.03, 0.41, 0.77])
        self.rule = np.array([[1.0, 0.7, 1.2]])

    def _balance(self, shapes):
        found = CycleBalance.of(shapes, shapes.scene.contact, 1e-2)
        return replace(found, order=5, halvings=0, tolerance=1e-13)

    def value(self, scene):
        """Of another scene, its shapes found from the own ones."""
        model = ShellModel(scene)
        minimiser, effects = minimiser_of(model), working_effects(model)
        states = []
        for t, state in zip(phases(1.0, COUNT), self.shapes.states, strict=True):
            potential = Potential(model.discretisation, effects, model.rest(t))
            near = minimiser.minimise(potential, state).state
            states.append(minimiser.minimise(potential, near).state)
        balance = self._balance(Shapes(model, np.array(states), 0, 0, 0.0))
        return (self.rule @ balance._balance(self.times).solve().leading)[0, 1]

    def slopes(self, over):
        """By the adjoint."""
        balance = self._balance(self.shapes)
        directions = [one.direction(self.scene) for one in over]
        changes = Changes.of(over, directions, balance, self.scene)
        q = balance._balance(self.times).solve().leading
        sums = FrictionAdjoint(balance, changes).sums(self.times, q, self.rule)
        return (sums.explicit + StaticAdjoint(self.shapes).along(sums.states, changes))[0]


@pytest.mark.parametrize("name", FROZEN)
def test_the_adjoint_is_the_derivative_on_a_frozen_grid(name):
    """Along a random direction of all parameters, by a difference of fourth order of the same sums.

    Towards smaller values where Poisson's ratio is at its bound.
    """
    scene, over = FROZEN[name][0], parameters(FROZEN[name][1])
    frozen, random = Frozen(scene), np.random.default_rng(5)
    sizes = np.array([abs(one.value(scene)) or 1.0 for one in over])
    direction = random.uniform(0.3, 1.0, len(over)) * sizes

    def at(step):
        changed = scene
        for one, part in zip(over, direction, strict=True):
            if isinstance(one, WaveFamily):
                changed = changed.but(wave=one.make(one.number + step * part))
            else:
                changed = one.changed(changed, one.value(scene) + step * part)
        return frozen.value(changed)

    h = 1e-3
    rule = {0: 25, -1: -48, -2: 36, -3: -16, -4: 3}
    slope = sum(factor * at(k * h) for k, factor in rule.items()) / (12 * h)
    parts = frozen.slopes(over) * direction
    assert abs(parts.sum() - slope) < 1e-6 * np.linalg.norm(parts)
    assert abs(parts).min() > 1e-4 * abs(parts).max()  # each parameter counts


@pytest.fixture(scope="module")
def found():
    """The gradient on a coarse mesh, with harmonics that the wave does not have."""
    over = [*SHEET, *WAVE, "wave.sine.2", "wave.period", "friction.slip_speed"]
    return cycle_gradient(FLAT, over, rtol=1e-2)


def test_stated_errors_are_not_smaller_than_true_ones(found):
    finer = cycle_gradient(FLAT.but(cells=(3, 6)), found.parameters, rtol=5e-3)
    assert np.all(abs(found.values - finer.values) <= found.errors)
    assert np.all(finer.errors < found.errors)
    assert not found.kinks


def test_whole_evaluations_differ_as_the_gradient_says(found):
    step, one = 2e-2, parameters("wave.sine.1")[0]
    ends = [
        cycle_speed(one.changed(FLAT, one.value(FLAT) + sign * step), rtol=1e-2) for sign in (1, -1)
    ]
    slope = (ends[0].mean - ends[1].mean) / (2 * step)
    error = dict(zip(found.names, found.errors, strict=True))[one.name]
    assert abs(found[one.name] - slope) <= error + 1e-3 * abs(slope)


def test_small_growth_has_the_gradient_of_theory():
    scene = FLAT.but(alpha=1e-3, contact=Contact("current", Viscous()))
    over = ["growth.alpha", "wave.cosine.1", "wave.sine.0", "sheet.width", "sheet.poisson"]
    ours, theory = cycle_gradient(scene, over), speed_gradient(scene, over, order=2, rtol=1e-3)
    third = 2 * scene.alpha * abs(theory.values)  # of the next order
    assert np.all(abs(ours.values - theory.values) <= ours.errors + theory.errors + third)
    assert np.all(ours.errors[:3] < 0.02 * abs(ours.values[:3]))


def test_a_sine_knows_its_symmetries():
    """Quarter of a period and half a sheet stand for all: phases do not count, even harmonics do."""
    sine = FLAT.but(wave=TravellingWave([0.0], [1.0]), contact=Contact("grown", Viscous()))
    found = cycle_gradient(sine, ["wave.phase.0", "wave.cosine.1", "wave.sine.1"])
    ends = [
        cycle_speed(sine.but(wave=TravellingWave([0.0, a], [1.0, b])), rtol=1e-2).mean
        for a, b in ((0.02, 0.0), (-0.02, 0.0), (0.0, 0.02), (0.0, -0.02))
    ]
    slopes = np.array([ends[0] - ends[1], ends[2] - ends[3]]) / 0.04
    assert np.all(abs(found.values[1:] - slopes) <= found.errors[1:] + 5e-3 * abs(slopes).max())
    assert abs(found.values[0]) <= found.errors[0] < 1e-4


def test_friction_with_a_direction_has_creases_that_move():
    law = Directional(0.6, 1.4, 1.1, form=Viscous())
    scene = FLAT.but(contact=Contact("current", law))
    found = cycle_gradient(scene, "friction.forward")
    ends = [
        cycle_speed(scene.but(contact=Contact("current", replace(law, forward=f))), rtol=1e-2).mean
        for f in (0.62, 0.58)
    ]
    assert found["friction.forward"] == pytest.approx((ends[0] - ends[1]) / 0.04, rel=2e-3)


def test_a_sheet_that_sticks_has_a_subgradient(monkeypatch):
    """An elastic sheet hardly ever has points at rest: here any share of them counts."""
    monkeypatch.setattr("fem_check.shell.cycle.balance.STICKING", -1.0)
    found = cycle_gradient(FLAT, "alpha", rtol=0.1)
    assert "one of its subgradients" in found.kinks[0]
    assert found._title().startswith("SpeedGradient: subgradient")


@pytest.mark.parametrize(
    ("change", "over", "words"),
    [
        ({"alpha": 0.0}, "alpha", "alpha = 0: must not be 0"),
        ({}, "wave.cosine.70", r"wave\.cosine\.70.*is harmonic 71, must be at most 60"),
        ({}, "ground.stiffness", "must have a sheet that bends"),
        ({}, "sheet.thicknes", "no parameter"),
        ({"contact": Contact("current", Coulomb())}, "friction.slip_speed", "slip speed"),
    ],
)
def test_what_has_no_gradient_is_refused_by_name(change, over, words):
    with pytest.raises(ValueError, match=words):
        cycle_gradient(FLAT.but(**change), over)


def test_the_best_wave_by_cycles_climbs():
    start = FLAT.but(wave=TravellingWave([0.5], [0.0]), contact=Contact("current", Viscous()))
    over = {"wave": Harmonics(1, largest=1.0)}
    found = optimise(start, over, level="cycle", starts=1, rtol=1e-2, check=False)
    assert found.converged
    assert found.value.value > 3 * cycle_speed(start).mean > 0


@pytest.mark.parametrize(
    ("field", "low", "high", "known"),
    [
        ("sheet.thickness", "1.2 mm", "1.6 mm", False),
        ("ground.stiffness", "150 Pa/mm^2", "200 Pa/mm^2", True),
    ],
)
def test_a_field_that_changes_more_than_itself_has_no_adjoint(tmp_path, field, low, high, known):
    """Of two layers and a density, growth and weight follow the thickness."""
    scene = files("fem_check.files").joinpath("scenes", "inchworm.toml").read_text()
    tmp_path.joinpath("inchworm.toml").write_text(scene)
    path = tmp_path / "optimise.toml"
    path.write_text(
        f'scene = "inchworm.toml"\n[over]\n{field} = {{ low = "{low}", high = "{high}" }}\n'
    )
    found = Adjoint.of(read(path).unknowns, objective_of("speed"), 1e-2, "cycle")
    assert (found is not None) == known
