"""Large deflections of shells and strips: tables of other shell codes."""

from dataclasses import replace

from figures.measure.naghdi import STIFF, known
from figures.validation.comparison import ByRefinement, Comparison, Confirmed, Number, Source
from figures.validation.problems.shells import (
    cantilever,
    end_moment,
    end_shear,
    hemisphere,
    scordelis_lo,
    semi_cylinder,
    slit_annulus,
)
from figures.validation.sources import SZE

QUARTERS = (0.25, 0.5, 0.75, 1.0)
SHEAR = (0.563, 3.015, 1.604, 4.933, 2.541, 6.031, 3.286, 6.698)
MOMENT = (4.361, 7.639, 12.0, 7.639, 14.546, 2.546, 12.0, 0.0)
RATIOS = (1.0, 2.0, 5.0, 10.0)
MATTIASSON = (0.30172, 0.05643, 0.49346, 0.16064, 0.71379, 0.38763, 0.81061, 0.55500)
PINCHED = {0.1: 16.1, 0.25: 48.537, 0.5: 132.653, 0.75: 156.584, 1.0: 171.505}
SHARES = (0.05, 0.25, 0.5, 1.0)
HEMISPHERE = (0.855, 0.955, 2.596, 3.833, 3.406, 5.902, 4.067, 8.178)
ELMER = 0.1849362922672, 0.1890220598746

S4R = "elements of four nodes (Abaqus S4R), on one mesh"


def _sheared(problem: str, share: float, end: str = "first") -> str:
    """Words for a number of Sze: what a shell that shears has there."""
    value = getattr(known(problem, share), end)
    return f"a shell that shears has {value:.5g} (Naghdi's, by NGSolve, figures/data/naghdi.csv)"


def _crown(share: float) -> str:
    """Words for the semi-cylinder, where a point load makes shear count most."""
    stiff = known("semi-cylinder", share, STIFF).first
    return (
        f"{_sheared('semi-cylinder', share)}, and {stiff:.5g} with {STIFF:g} times its stiffness in "
        f"shear, next to the one here, which does not shear; the rest is the mesh there: {S4R}"
    )


def _inward(share: float) -> str:
    """Words for the hemisphere."""
    return (
        f"{_sheared('hemisphere', share, 'second')}, next to the one here; the rest is the mesh there: "
        f"{S4R}"
    )


LIFT = (
    "a published shell that does not shear (PENGoLINS, the next two numbers) has what is found here; "
    f"there {S4R}, that shear: at its edges shear makes a strip of width W softer in torsion, by "
    "0.63 h/W = 0.5 %"
)


def shear(n: int) -> tuple[float, ...]:
    """Deflections -u, w of the tip at quarters of the load."""
    return _flat(end_shear("bfs", n).values)


def moment(n: int) -> tuple[float, ...]:
    """The same under an end moment."""
    return _flat(end_moment("bfs", n).values)


def annulus(n: int) -> tuple[float, ...]:
    """Lift of the outer and the inner end of the loaded edge, twice: for two sources."""
    return 2 * _flat(slit_annulus("bfs", n, 8 * n).values)


def pinched(n: int) -> tuple[float, ...]:
    """Deflections under the load at shares of it."""
    return _flat(semi_cylinder("argyris", n, n, tuple(PINCHED)).values)


def roof(n: int) -> tuple[float]:
    """Deflection of the middle of the free edge."""
    return (float(scordelis_lo("argyris", n)),)


def _flat(values: dict[float, tuple[float, ...]]) -> tuple[float, ...]:
    return tuple(float(v) for share in sorted(values) for v in values[share])


def _pairs(
    names: tuple[str, str], at: tuple[float, ...], values: tuple[float, ...], half: float, why: str = ""
) -> tuple[Number, ...]:
    """Two numbers at each load."""
    wanted = [(name, load) for load in at for name in names]
    return tuple(
        Number(f"{name} at {load:g}", value, half, why=why)
        for (name, load), value in zip(wanted, values, strict=True)
    )


COMPARISONS = (
    Comparison(
        "cantilever under end shear",
        "a strip 10 x 1 x 0.1 at shares of an end shear of 4",
        replace(SZE, remark="read where MBDyn quotes it"),
        _pairs(
            ("-u", "w"),
            QUARTERS,
            SHEAR,
            5e-4,
            "there elements of four nodes that shear, on one mesh; the elastica at the full load has "
            "3.2894 and 6.6996 by elliptic integrals",
        ),
        ByRefinement(shear, {"n": 24}, {"n": 12}),
    ),
    Comparison(
        "cantilever under end moment",
        "a strip 12 x 1 x 0.1 that rolls up to a full circle",
        replace(SZE, remark="read where MBDyn quotes it; the elastica, a circle at every load"),
        _pairs(
            ("-u", "w"),
            QUARTERS,
            MOMENT,
            5e-4,
            "the elastica does not stretch; the energy of eq. 1 stretches a little with curvature",
        ),
        ByRefinement(moment, {"n": 24}, {"n": 12}),
    ),
    Comparison(
        "slit annular plate",
        "radii 6 and 10, h = 0.03, one edge of the slit clamped, 0.8 per length on the other",
        replace(
            SZE,
            remark="read where PENGoLINS and Project Chrono quote it; Kirchhoff-Love: spline patches "
            "coupled by penalty, docs/docs/benchmarks/slit_annular_plate.md in hanzhao2020/PENGoLINS, "
            "H. Zhao et al., Comput. Math. Appl. 111:109 (2022)",
        ),
        (
            Number("lift, outer end", 17.528, 5e-4, why=LIFT),
            Number("lift, inner end", 13.891, 5e-4, why=LIFT),
            Number("lift, outer end, Kirchhoff-Love", 17.472605, 5e-7),
            Number("lift, inner end, Kirchhoff-Love", 13.834648, 5e-7),
        ),
        ByRefinement(annulus, {"n": 6}, {"n": 4}),
        slow=True,
    ),
    Comparison(
        "pinched semi-cylinder",
        "one end clamped, a point load on the free one",
        replace(SZE, remark="read where FEniCSx-Shells quotes it"),
        tuple(
            Number(f"deflection at {share:g} of 2000", value, half, why=why)
            for (share, value), half, why in zip(
                PINCHED.items(),
                (0.05, *4 * (5e-4,)),
                (_crown(0.1), _crown(0.25), "", "", ""),
                strict=True,
            )
        ),
        ByRefinement(pinched, {"n": 10}, {"n": 6}),
        slow=True,
    ),
    Comparison(
        "pinched hemisphere",
        "with an 18 degree hole, at shares of radial loads of 400",
        replace(SZE, remark="read where Elmer and FinEALE quote it"),
        tuple(
            replace(number, why=_inward(float(number.name.split()[-1])))
            if number.name in ("inward at 0.05", "inward at 0.25", "inward at 0.5")
            else number
            for number in _pairs(("outward", "inward"), SHARES, HEMISPHERE, 5e-4)
        ),
        ByRefinement(hemisphere, {"n": 20}, {"n": 12}, {"element": "bfs", "shares": SHARES}),
        slow=True,
    ),
    Comparison(
        "pinched hemisphere, small load",
        "the same at a hundredth of the load",
        Source(
            "ElmerFEM, test Shell_OpenHemisphere_High_Order_Blending (Reissner-Naghdi, degree 4)",
            Confirmed.READ,
            "accuracy there: distance to degree 3 with bubbles; it shears, which adds 0.13 % to both",
        ),
        _pairs(("outward", "inward"), (0.01,), ELMER, 1.1e-5),
        ByRefinement(hemisphere, {"n": 20}, {"n": 12}, {"element": "bfs", "shares": (0.01,)}),
    ),
    Comparison(
        "elastica, end load",
        "a strip that does not stretch under a dead end load P, P L^2/B",
        Source(
            "K. Mattiasson, Int. J. Numer. Meth. Eng. 17:145 (1981), doi:10.1002/nme.1620170113",
            Confirmed.READ,
            "by elliptic integrals; read where others quote it",
        ),
        _pairs(("w/L", "u/L"), RATIOS, MATTIASSON, 5e-6),
        ByRefinement(cantilever, {"n": 40}, {"n": 16}, {"element": "bfs", "ratios": RATIOS}),
    ),
    Comparison(
        "Scordelis-Lo roof",
        "a cylindrical roof under its weight, small deflections",
        Source(
            "A. C. Scordelis, K. S. Lo, J. Am. Concr. Inst. 61:539 (1964); the Kirchhoff-Love limit in "
            "PENGoLINS, Scordelis_Lo.py",
            Confirmed.READ,
        ),
        (Number("deflection of the free edge", 0.3006, 5e-5),),
        ByRefinement(roof, {"n": 8}, {"n": 4}),
    ),
)
