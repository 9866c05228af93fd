"""A further run that fails: the speed stays, its error is infinite, and everything says so."""

import json
import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from fem_check.answer.block import block
from fem_check.answer.record import record
from fem_check.answer.units import Units
from fem_check.choice.solving import Solved, solved
from fem_check.command import MISSED, main
from fem_check.files import read
from fem_check.output.curves import draw_speed
from fem_check.output.moving import Course
from fem_check.output.panels import _ways
from fem_check.output.pictures import moving_of
from fem_check.runs.record import errors_of
from fem_check.shell.statics.equilibrium import ConvergenceError
from fem_check.shell.stepping.further import second_runs
from fem_check.shell.stepping.further.errors import FURTHER
from fem_check.shell.stepping.run import Run
from fem_check.shell.stepping.trajectory import SpeedErrors, Trajectory
from fem_check.sweeps.records.record import answer_of
from linear_theory import Coulomb, GivenMap, Mapped
from linear_theory.common.estimate import Estimate
from linear_theory.common.tolerance import Tolerance
from linear_theory.energy.energy import Energy
from linear_theory.friction.mean_map import PLAIN
from tests.runs.run_cases import STEPPED

SAID = "the run with other steps failed, without which the error of the speed is not known"


COURSE = Course(np.array([0.0, 1.0]), np.array([0.1, 0.2]), (0.0, 1.0), (0.0, 1.0))


class Failing(Run):
    """A run that finds no further step."""

    def finish(self, *_: object) -> None:
        """Raise the error."""
        raise ConvergenceError("no further step", self.history.state, 0.0)


@pytest.fixture(scope="module")
def patched() -> Iterator[pytest.MonkeyPatch]:
    with pytest.MonkeyPatch.context() as patch:
        yield patch


@pytest.fixture(scope="module")
def scene_file(tmp_path_factory: pytest.TempPathFactory, patched: pytest.MonkeyPatch) -> Path:
    """Of a sheet that could take another way, whose run with other steps fails."""
    patched.setattr(Trajectory, "branches", True)
    patched.setattr(second_runs, "Run", Failing)
    path = tmp_path_factory.mktemp("failed") / "stepped.toml"
    path.write_text(STEPPED.replace("steps = 40", "steps = 8"))
    return path


@pytest.fixture(scope="module")
def found(scene_file: Path) -> Solved:
    """Steps are asked for: there is no tolerance."""
    file = read(scene_file)
    return solved(file.scene, file.run)


def test_the_answer_is_not_converged_and_names_the_run(found: Solved) -> None:
    answer = found.answer
    assert answer.tolerance is None
    assert (answer.error, answer.converged, answer.speed.converged) == (math.inf, False, False)
    assert answer.caution == SAID
    assert found.motion is not None
    assert "the run with other steps failed" in found.motion.speed.model
    assert "NOT converged" in repr(answer)


def test_block_and_records_say_it(found: Solved) -> None:
    said = " ".join(block(found.answer).split())
    assert f"CAUTION {SAID}" in said
    assert "accuracy the error is unknown; not estimated: error of the mesh" in said
    assert "L/T with unknown error, direction unknown" in said
    assert "cost of transport and efficiency unknown: the error of the speed is not known" in said
    assert "inf" not in said.replace("infinite", "")
    kept = json.loads(json.dumps(record(found.answer, None), allow_nan=False))
    assert (kept["error"], kept["converged"], kept["caution"]) == (None, False, SAID)
    assert SAID in answer_of(found.answer)["reason"]
    parts = {row["part"]: row["error"] for row in errors_of(found)}
    assert parts["path through snap-throughs"] == "unknown: the run that tells it failed"
    assert not {"gap between layers that touch", "feedback of the strain on the wave"} & parts.keys()


def test_a_tolerance_is_missed_by_an_unknown_error(found: Solved) -> None:
    asked = replace(found.answer, tolerance=Tolerance(0.2).of_speed(0.1, 1.0))
    said = " ".join(block(asked).split())
    assert "the tolerance, 20 %, is not met: the error is unknown" in said


def test_the_command_exits_with_the_status_of_a_missed_tolerance(
    scene_file: Path, found: Solved, capsys: Any
) -> None:
    with pytest.raises(SystemExit) as end:
        main(["speed", str(scene_file)])
    printed = capsys.readouterr()
    assert end.value.code == MISSED
    assert SAID in " ".join(printed.out.split())
    assert "RuntimeWarning" not in printed.err


def test_energies_have_infinite_errors_or_none(found: Solved) -> None:
    speed = found.answer.speed
    assert speed.power.value > 0
    assert speed.power.error == math.inf
    assert speed.cost_of_transport.error == math.inf
    assert not math.isfinite(speed.cost_of_transport.value)
    assert math.isnan(speed.efficiency.value)
    assert "cost of transport unknown: the error of the speed is not known" in " ".join(
        repr(speed).split()
    )


@pytest.mark.parametrize("heading", [0.0, 0.3])
@pytest.mark.parametrize(("doubt", "wrong"), [(math.inf, 0.0), (0.01, math.inf), (math.inf, math.inf)])
def test_an_efficiency_keeps_its_value(heading: float, doubt: float, wrong: float) -> None:
    """Of dry friction: |V| over the power, whatever the error."""
    of = Energy(Estimate(0.5, 0.01), np.ones(1), Coulomb(), Estimate(1.0, wrong), heading=heading)
    value, error = of.efficiency(np.array([0.03, -0.04]), doubt)
    assert value == pytest.approx(0.05 / 0.5)
    assert error == math.inf


def test_an_efficiency_that_is_not_known_stays_so() -> None:
    law = Mapped(Coulomb(), GivenMap(lambda x, y: 1 + y**2))
    nan = Estimate(math.nan, math.nan)
    of = Energy(Estimate(0.5, 0.01), np.ones(1), law, nan)
    assert math.isnan(of.efficiency(np.array([0.0, 0.1]), math.inf).value)
    idle = Energy(Estimate(0.5, math.inf), np.ones(1), Coulomb(), PLAIN)
    assert math.isnan(idle.efficiency(np.array([0.0, 0.1]), math.inf).value)


@pytest.mark.parametrize("name", FURTHER)
def test_every_run_that_may_fail_has_a_name(name: str) -> None:
    errors = SpeedErrors(0.1, math.nan, 0.0, math.nan, math.nan)._replace(**{name: math.inf})
    assert errors.failed == f"the run {FURTHER[name]} failed"
    assert not errors._replace(**{name: 0.1}).failed
    assert set(FURTHER) == set(SpeedErrors._fields) - {"step", "spread", "slip_speed"}


def test_three_failures_are_listed() -> None:
    errors = SpeedErrors(0.1, 0.1, math.inf, math.nan, math.inf, math.nan, math.inf)
    said = "the runs on a coarser mesh, with other steps and with a narrower gap between layers failed"
    assert errors.failed == said


def test_a_picture_has_no_band_of_infinite_width(found: Solved) -> None:
    axes, motion = Figure().subplots(), found.motion
    assert motion is not None
    moving = SimpleNamespace(speed=motion.speed, course=lambda: COURSE)
    draw_speed(axes, moving, Units.of_sheet(1.0, 1.0))  # type: ignore[arg-type]
    assert not axes.collections
    assert axes.get_title(loc="left").endswith("L/T, error unknown")
    assert "inf" not in axes.get_title(loc="left")
    assert _ways(moving_of(motion)).endswith(", sheet ?")
