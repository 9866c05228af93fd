"""One of each public type, and which types a user can get in hand."""

import inspect
import typing
from functools import cache, partial
from types import SimpleNamespace

import numpy as np

import fem_check
import linear_theory
from fem_check.outlines.best import BestOutline
from fem_check.shell.cycle.frame import BodyFrame
from fem_check.shell.cycle.speed import Cycle
from fem_check.shell.effects.loads import EdgeMoment
from fem_check.shell.kinematics.rates import Affine
from fem_check.shell.kinematics.surface import AnnulusSector, Cylinder, Flat, SpherePart
from fem_check.shell.model import ShellModel
from fem_check.shell.statics.equilibrium import Equilibrium
from fem_check.shell.stepping.further.progress import Progress
from linear_theory.friction.law import Response
from tests.answers.shown_parts import (
    MATERIAL,
    MEMBRANE,
    PARTS_OF_OPTIMUM,
    SHEET,
    SINE,
    excited,
    excited_orbit,
    excited_scene,
    fed_back,
    field,
    full_scene,
    lopsided,
    many_harmonics,
    measured,
    optimum,
    part_of_optimum,
    patches,
    planar,
    potential,
    scene_of_gradient,
    shapes,
    speed,
    sunk,
    swept,
    trajectory,
    turning,
)

PACKAGES = (linear_theory, fem_check)

MADE = {
    "AiryAmplitudes": lambda: field("AirySeries").amplitudes([0.1, 0.3]),
    "AirySeries": lambda: field("AirySeries"),
    "AnnulusSector": AnnulusSector,
    "Bending": lambda: fem_check.Bending(MATERIAL),
    "Bound": lambda: fem_check.Bound(at_most=1.0),
    "BestOutline": lambda: BestOutline(
        made("LegendreShape"),
        linear_theory.Estimate(0.02, 1e-5),
        linear_theory.Estimate(0.01, 1e-5),
        part_of_optimum("Certificate"),
        *(3, "converged", 0.5),
    ),
    "LegendreShape": lambda: fem_check.LegendreShape(0.5, 1.0, [0.1]),
    "OutlineGradient": lambda: fem_check.outline_gradient(
        made("Trapezoid"), SINE, 0.1, rtol=0.3, cells=(1, 4)
    ),
    "PowerGradient": lambda: linear_theory.power_gradient(scene_of_gradient(), "alpha", rtol=1e-2),
    "Trapezoid": lambda: fem_check.Trapezoid(0.6, 0.4, 1.0),
    "Blocks": lambda: potential().hessian_blocks(
        ShellModel(planar(cells=(1, 2))).discretisation.zeros()
    )[0],
    "BodyFrame": lambda: BodyFrame.of(shapes()),
    "Contact": linear_theory.Contact,
    "CostGradient": lambda: linear_theory.cost_gradient(scene_of_gradient(), "alpha", rtol=1e-2),
    "Coulomb": linear_theory.Coulomb,
    "Couplings": lambda: fem_check.bilayer(0.2, 0.03),
    "CrawlSpeed": lambda: linear_theory.crawl_speed(SHEET, SINE, alpha=0.25, rtol=1e-2),
    "CrawlSpeed at rest": lambda: linear_theory.crawl_speed(SHEET, SINE, alpha=0.0),
    "CrawlSpeed turning": turning,
    "CycleSpeeds": lambda: fem_check.speeds(excited_scene(), body="line"),
    "CycleWave": lambda: excited().cycle(0),
    "Cycles": lambda: excited().cycles,
    "BackwardDifferences": lambda: fem_check.BackwardDifferences(0.01),
    "Affine": lambda: Affine(30.0, np.zeros((2, 5))),
    "Cycle": lambda: Cycle(planar()),
    "Cylinder": lambda: Cylinder(0.5),
    "DeadLoad": lambda: fem_check.DeadLoad((0.0, 1.0)),
    "Discretisation": lambda: ShellModel(full_scene()).discretisation,
    "EdgeMoment": lambda: EdgeMoment(0.1),
    "Equilibrium": lambda: Equilibrium(np.zeros(8), 1.0, 3, 1e-9, 0.1),
    "Equilibrium buckled": lambda: Equilibrium(np.zeros(8), 1.0, 3, 1e-9, 0.1, -0.1, 1e-9, np.ones(8)),
    "BestCouplings": lambda: made("QuadraticForm").best(0.1, 0.1),
    "Estimate": lambda: linear_theory.Estimate(0.1, 0.01),
    "Excitation": excited,
    "Excitation not solved": lambda: fem_check.Excitation(
        fem_check.excitable_preset("printed"), SHEET, 60.0
    ),
    "ExcitationDrive": lambda: excited().on(SHEET),
    "Exp": linear_theory.Exp,
    "FieldWave": lambda: linear_theory.FieldWave(lambda x, y, t: np.sin(y - t), 1.0, name="a & <b>"),
    "FieldDrive": lambda: linear_theory.FieldWave(lopsided, period=1.0).on(SHEET),
    "FeedbackDrive": lambda: fed_back().on(SHEET),
    "FollowedDrive": lambda: fed_back().on(SHEET).followed(),
    "SpeedGradient": lambda: linear_theory.speed_gradient(scene_of_gradient(), "alpha", rtol=1e-2),
    "SpeedGradient of many": lambda: linear_theory.speed_gradient(
        scene_of_gradient(), [f"wave.sine.{k}" for k in range(9)], rtol=1e-2
    ),
    "StrainFeedback": lambda: fem_check.StrainFeedback(0.1),
    "FitzHughNagumo": lambda: fem_check.excitable_preset("pulse train"),
    "FractionalDrive": lambda: linear_theory.FractionalWave(SINE, 1.5).on(SHEET),
    "FractionalWave": lambda: linear_theory.FractionalWave(SINE, 1.5),
    "FitUncertainty": lambda: measured().uncertainty,
    "Flat": Flat,
    "Friction": lambda: fem_check.Friction(0.7, 0.01),
    "FrictionField": lambda: linear_theory.friction_field(field("AirySeries"), 0.1, [0.1, 0.2], 0, 0.1),
    "Gravity": lambda: fem_check.Gravity(2.5e-4),
    "Ground": lambda: fem_check.Ground(0.5),
    "HeightMap": lambda: fem_check.HeightMap(np.zeros((9, 9)), 1.0, 2.0),
    "Growth": lambda: linear_theory.Growth(0.25),
    "Inertia": lambda: fem_check.Inertia(1.0, MATERIAL),
    "SelfContact": lambda: fem_check.SelfContact(MATERIAL),
    "Directional": lambda: linear_theory.Directional(0.5, 1.5, 0.7, 0.2),
    "DirectionalResponse": lambda: linear_theory.Directional(0.5, 1.5).at(np.ones((2, 3))),
    "GivenMap": lambda: linear_theory.GivenMap(lambda x, y: 1.0),
    "Mapped": lambda: linear_theory.Mapped(linear_theory.Coulomb(), patches()),
    "OnLowerFace": lambda: linear_theory.OnLowerFace(linear_theory.Coulomb()),
    "Patches": lambda: patches(),
    "IsotropicResponse": lambda: linear_theory.Tanh(0.1).at(np.ones((2, 3))),
    "Limit": lambda: sunk().limit,
    "Linear": linear_theory.Linear,
    "Material": lambda: MATERIAL,
    "Membrane": lambda: MEMBRANE,
    "Metric": linear_theory.Metric,
    "Newmark": lambda: fem_check.Newmark(step=5e-3),
    "Motion": lambda: field("PlaneStressField").motion([0.0, 0.1], None, 2),
    "Outline": lambda: fem_check.Outline.trapezoid(0.6, 0.4, 1.0),
    "Outline with a hole": lambda: fem_check.Outline(
        [[0, 0], [1, 0], [0, 1]], [[[0.1, 0.1], [0.2, 0.1], [0.1, 0.2]]]
    ),
    "Path": lambda: linear_theory.rigid_path(turning(), periods=20),
    "PeriodicExcitation": excited_orbit,
    "OrbitUncertainty": lambda: excited_orbit().uncertainty,
    "PlaneStressField": lambda: field("PlaneStressField"),
    "PolynomialDrive": lambda: measured().on(SHEET),
    "PolynomialWave": lambda: measured().smooth,
    "Poses": lambda: trajectory().path.seen_from(0),
    "SteppedPath": lambda: trajectory().path,
    "Potential": potential,
    "Prediction": lambda: fem_check.predict(SHEET, SINE, alpha=0.05, rtol=0.1),
    "RunSettings": lambda: fem_check.RunSettings(steps=64),
    "Progress": lambda: Progress(0.1, 2.0, 7, 0, 1.0, 20.0),
    "Region": lambda: ShellModel(full_scene()).discretisation.interior,
    "Record": lambda: next(swept().rows())[1],
    "Response": lambda: Response(linear_theory.Coulomb(), np.ones((2, 3))),
    "Robust": lambda: fem_check.Robust({"friction.law": ["dry", "viscous"]}),
    "RigidGround": sunk,
    "RestState": lambda: ShellModel(planar()).rest(0.2),
    "RigidSpeed": lambda: turning().turning,
    "RitzField": lambda: field("RitzField"),
    "SampledWave": measured,
    "Scale": lambda: linear_theory.Scale(0.04, 8.0),
    "Scene": full_scene,
    "Scene on a mesh": lambda: planar(mesh=fem_check.Outline.trapezoid(0.5, 0.5, 1.0).mesh(0.3)),
    "QuadraticForm": lambda: linear_theory.second_order(SHEET, SINE, rtol=0.1).coefficients,
    "SecondOrder": lambda: linear_theory.second_order(SHEET, SINE, rtol=0.1),
    "SecondOrderField": lambda: field("SecondOrderField"),
    "Shapes": shapes,
    "Sheet": lambda: SHEET,
    "SineWave": lambda: SINE,
    "Spectrum": lambda: field("PlaneStressField").drive.rates,
    "SpeedErrors": lambda: trajectory().errors,
    "SpherePart": lambda: SpherePart(1.0),
    "Terrain": lambda: fem_check.Terrain(lambda x, y: 0 * x),
    "Sweep": swept,
    "Tanh": lambda: linear_theory.Tanh(0.1),
    "TimeFactors": lambda: many_harmonics().factors([0.0, 0.1]),
    "Tolerance": lambda: linear_theory.Tolerance(1e-3),
    "Trajectory": trajectory,
    "TravellingDrive": lambda: field("PlaneStressField").drive,
    "TravellingWave": lambda: linear_theory.TravellingWave([1.0, 0.5], [0.0, 0.0]),
    "TravellingWave of many": many_harmonics,
    "Viscous": linear_theory.Viscous,
    "Works": lambda: trajectory().power,
    "EnergySI": lambda: linear_theory.Scale(0.04, 8.0).energy(speed(), 2e-3, 0.4),
    "GrowthPower": lambda: speed().growth_power(1e-2),
    "Harmonics": lambda: fem_check.Harmonics(3, largest=1.0),
    "Optimum": optimum,
    **{name: partial(part_of_optimum, name) for name in PARTS_OF_OPTIMUM},
}
"""One of each public type and of what their calls return; what follows a space tells variants apart."""


@cache
def made(name):
    return MADE[name]()


def is_ours(kind):
    return isinstance(kind, type) and kind.__module__.split(".")[0] in ("linear_theory", "fem_check")


def named_in(annotation):
    """Our classes in a type annotation."""
    found = {annotation} if is_ours(annotation) else set()
    return found.union(*(named_in(part) for part in typing.get_args(annotation)), set())


def returned_by(function):
    function = inspect.unwrap(function)
    if "Rational" in str(function.__annotations__.get("return")):
        return set()  # a type of sympy, imported for the checker alone
    # Of the result alone: arguments may have types that are imported for the checker.
    result = SimpleNamespace(__annotations__={"return": function.__annotations__.get("return")})
    return named_in(typing.get_type_hints(result, function.__globals__)["return"])


def functions_of(kind):
    """Public methods and properties."""
    for name in dir(kind):
        member = inspect.getattr_static(kind, name)
        function = getattr(member, "fget", None) or getattr(member, "func", None)
        function = function or getattr(member, "__func__", member)
        if not name.startswith("_") and inspect.isfunction(function):
            yield function


def public_types():
    """Classes that a user can get in hand: public ones, and all that calls of public names return."""
    public = [getattr(package, name) for package in PACKAGES for name in package.__all__]
    waiting = [v for v in public if isinstance(v, type)]
    for function in filter(inspect.isroutine, public):
        waiting += returned_by(function)
    found = set()
    while waiting:
        kind = waiting.pop()
        if kind not in found:
            found.add(kind)
            waiting += [kind for f in functions_of(kind) for kind in returned_by(f)]
    bare = {k for k in found if inspect.isabstract(k) or getattr(k, "_is_protocol", False)}
    return {kind for kind in found - bare if not issubclass(kind, Exception | str)}
