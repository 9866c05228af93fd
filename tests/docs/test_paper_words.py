"""Words of the write-up that stand for numbers of tables: signs, directions, what holds."""

import numpy as np
import pytest

from figures.common.folders import DATA
from figures.draw.gait_statements import statements
from figures.measure import excitable as excitable_table
from figures.measure import saddle as saddle_table
from figures.measure import second_order as second_table
from figures.measure.cost.tables import Point
from figures.measure.cost.tables import read as read_points
from figures.measure.energy import gaits as energy_table
from figures.measure.optimise import line as best_table
from figures.measure.optimise import outlines as outline_table
from figures.measure.paper import gait_map
from figures.measure.paper import terrain as terrain_table
from figures.measure.peers.command import TABLE as PEERS
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


def test_words_on_best_outlines():
    """Only that of viscous friction is certified; the rectangle is the best trapezoid for a sine."""
    rows = outline_table.TABLE.read()
    general = [r for r in rows if r.coefficients == outline_table.GENERAL]
    assert [r.friction for r in general if r.left < 0.1] == ["viscous"]
    assert all(r.best > r.rectangle and r.sheet_best > r.sheet_rectangle for r in general)
    trapezoids = [r for r in rows if r.coefficients == 1]
    assert trapezoids
    assert all(r.best - r.rectangle < r.error for r in trapezoids)


def test_words_on_other_programs():
    """MuJoCo does not converge with its mesh, and Newton still moves at the end."""
    strips = [r for r in PEERS.read() if r.problem == "strip"]
    errors = [r.error for r in strips if r.code == "MuJoCo flex"]
    assert errors[-1] > 5 * min(errors)
    assert min(r.drift for r in strips if r.code == "Newton VBD") > 1e-3
    assert max(r.drift for r in strips if r.code == "sheetcrawl") < 1e-6


def test_words_of_the_summary():
    """A stiff ground changes V_ab; kept weight goes against the wave by two growth laws of three."""
    mixed = {
        r.place: r.theory_ab for r in saddle_table.TABLE.read() if (r.wave, r.law) == ("sine", "tanh")
    }
    assert mixed["stiff ground"] / mixed["paper"] > 1.5
    signs = {
        r.growth_law: np.sign(r.second)
        for r in second_table.TABLE.read()
        if (r.width, r.poisson, r.wave, r.area, r.load) == (0.5, 0.5, "sine", "grown", "material")
    }
    assert signs == {"exp": -1, "linear": -1, "metric": 1}
    ground = [
        r
        for r in terrain_table.TABLE.read()
        if (r.gait, r.form, r.friction) == ("forward", "cosine", "viscous")
    ]
    assert sum(abs(r.third) < r.error for r in ground) > len(ground) / 2


def test_levels_left_out_of_the_table_of_times_are_slower_for_small_errors():
    points = read_points(DATA / "cost.csv", Point)

    def least(level, panel):
        met = [p.seconds for p in points if (p.level, p.panel) == (level, panel) and p.error <= 1e-4]
        return min(met, default=np.inf)

    for panel in ("field", "linear speed"):
        assert least("Airy, plain", panel) > least("Airy, with tail", panel)
        assert least("FEM P2", panel) > least("FEM P4", panel)
