"""Words of the write-up that stand for numbers of tables: signs, directions, what holds."""

import numpy as np
import pytest

from figures.draw.gait_statements import statements
from figures.measure import excitable as excitable_table
from figures.measure import saddle as saddle_table
from figures.measure.energy import gaits as energy_table
from figures.measure.optimise import line as best_table
from figures.measure.paper import gait_map
from figures.measure.plate import lower_face as face_table
from tests.docs.test_paper import stored


def test_words_on_growth_and_curvature():
    """The sign of V_ab, and on which lines of two layers the sheet runs along the wave."""
    rows = saddle_table.TABLE.read()
    assert all(r.theory_ab < 0 < r.theory_aa for r in rows)
    assert all(abs(r.theory_bb) < 1e-12 for r in rows if r.law == "viscous")
    along = {
        (r.law, r.way): (r.middle > 0, r.lower > 0)
        for r in face_table.TABLE.read()
        if r.ground == "paper"
    }
    assert all(along[law, -1] == (True, True) for law in ("dry", "tanh", "viscous"))
    assert along["dry", 1] == along["tanh", 1] == (False, False)
    assert along["viscous", 1] == (False, True)


def test_waves_of_short_peaks_crawl_against_the_wave_if_friction_is_dry():
    rows = [r for r in excitable_table.TABLE.read() if r.cycle == 1]
    assert {r.preset for r in rows} == {"printed", "nu = -0.1", "nu = -0.05", "pulse train"}
    assert all(r.displacement > r.error for r in rows if r.friction == "viscous")
    high = [r for r in rows if r.friction == "dry" and r.preset != "printed"]
    assert all(r.displacement < -r.error for r in high)
    # viscous for every alpha up to 0.3: the period is far beyond the bound
    assert min(r.period for r in rows) > 10 * 0.3 * stored("regime.viscous_from")


def test_words_on_the_gaits_of_the_original_paper():
    """Their directions in the three readings of beta, and the saddle near the origin."""
    rows = gait_map.TABLE.read()

    def found(friction, kappas):
        pairs = zip((-0.25, -0.3), kappas, strict=True)
        return [
            next(
                r
                for r in rows
                if (r.friction, r.alpha) == (friction, alpha)
                and r.kappa == pytest.approx(kappa, rel=1e-3)
            )
            for alpha, kappa in pairs
        ]

    as_printed = {}
    for kappas in ((-0.15, 0.1), (-0.15 / 0.03, 0.1 / 0.03), (-15, 10)):
        for friction in ("viscous", "dry"):
            back, forward = found(friction, kappas)
            real = back.crossed == forward.crossed == 0
            as_printed[friction, kappas[0]] = (
                back.third < -back.error and forward.third > forward.error and real
            )
    assert [key for key, value in as_printed.items() if value] == [("viscous", -5.0)]
    near = [r for r in rows if r.friction == "viscous" and abs(r.alpha) == 0.02]
    assert len(near) == 4
    assert all(r.third * r.alpha * r.kappa < 0 for r in near)


def test_verdicts_on_shapes_and_grounds_are_those_of_the_page_on_gaits():
    cells = [row.strip("| ").split(" | ")[:2] for row in statements()]
    said = {statement: verdict for statement, verdict in cells if not statement.startswith("---")}

    def verdicts(start, end=""):
        chosen = [v for s, v in said.items() if s.startswith(start) and s.endswith(end)]
        assert chosen
        return {v.split(":")[0] for v in chosen}

    assert verdicts("trapezoids: the forward gait is fastest") == {"yes"}
    assert verdicts("trapezoids: the backward gait is fastest") == {"no"}
    assert verdicts("trapezoids: a wider leading edge") == {"no"}
    assert verdicts("V is least at") | verdicts("V is largest at") == {
        "cannot be told within the errors"
    }
    assert verdicts("gravity does not matter") == {"no"}
    assert verdicts("the ground is rigid") == {"yes for V, within the errors"}
    dry, viscous = (said[f"V is forward on all grounds, {law}"].split() for law in ("dry", "viscous"))
    assert dry[1] == dry[3]
    assert int(viscous[1]) < int(viscous[3])


def test_words_on_energy():
    """A wave costs 2/(pi alpha) without a direction, and less than a breath on a line."""
    rows = energy_table.TABLE.read()
    line = {(r.wave, r.r, r.alpha): r.cost for r in rows if r.model == "line"}
    assert line["wave", 0.0, 0.01] * np.pi * 0.01 / 2 == pytest.approx(4 / 3, abs=0.01)
    shared = {key[1:] for key in line if key[0] == "breathing"} & {
        k[1:] for k in line if k[0] == "wave"
    }
    assert len(shared) > 10
    assert all(line["wave", *key] < line["breathing", *key] for key in shared)


def test_the_best_waves_lie_below_their_bound():
    for row in best_table.TABLE.read():
        half = row.harmonics // 2
        assert row.bound == pytest.approx(half / (half + 1), rel=1e-4)
        assert row.best < row.reached <= row.bound
