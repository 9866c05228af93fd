"""Small deflections and vibrations of plates."""

from figures.validation.comparison import ByRefinement, Comparison, Confirmed, Number, Source
from figures.validation.problems.plates import clamped_plate, nafems_plate, rectangular_plate
from figures.validation.sources import TIMOSHENKO_PLATES

SUPPORTED = {1.0: 0.00406, 1.5: 0.00772, 2.0: 0.01013, 5.0: 0.01297}
CLAMPED = {1.0: 0.00126, 1.5: 0.00220, 2.0: 0.00254}
FREE = (1.622, 2.360, 2.922, 4.190, 4.190, 7.356, 7.356, 7.668)
HELD = (0.421, 1.029, 2.582, 3.306, 3.753, 6.555)


def deflections(n: int, aspects: tuple[float, ...], clamped: bool) -> tuple[float, ...]:
    """w D/(q a^4) of plates of several aspect ratios."""
    return tuple(rectangular_plate(n, aspect, clamped)[0] for aspect in aspects)


def square(n: int) -> tuple[float]:
    """w D/(q a^4) of the clamped square."""
    return (float(clamped_plate("argyris", n)),)


def _table(values: dict[float, float], half: float) -> tuple[Number, ...]:
    return tuple(Number(f"w D/(q a^4), b/a = {a:g}", v, half) for a, v in values.items())


COMPARISONS = (
    Comparison(
        "supported plate",
        "a simply supported rectangle under a uniform load, nu = 0.3: deflection of the centre",
        Source(f"{TIMOSHENKO_PLATES}, table 8", Confirmed.DERIVED, "Navier's series"),
        _table(SUPPORTED, 5e-6),
        ByRefinement(deflections, {"n": 16}, {"n": 6}, {"aspects": tuple(SUPPORTED), "clamped": False}),
    ),
    Comparison(
        "clamped plate",
        "the same, clamped",
        Source(f"{TIMOSHENKO_PLATES}, table 35", Confirmed.MEMORY, "rounded to either side"),
        _table(CLAMPED, 1e-5),
        ByRefinement(deflections, {"n": 16}, {"n": 6}, {"aspects": tuple(CLAMPED), "clamped": True}),
    ),
    Comparison(
        "clamped square plate, in twelve digits",
        "the same, square",
        Source(
            "R. L. Taylor, S. Govindjee, Commun. Numer. Meth. Eng. 20:757 (2004)",
            Confirmed.READ,
            "read where the Clough-Tocher shell of libMesh quotes it",
        ),
        (Number("w D/(q a^4)", 0.001265319087, 5e-13),),
        ByRefinement(square, {"n": 16}, {"n": 8}),
    ),
    Comparison(
        "free square plate, FV12",
        "vibrations of a free plate 10 m x 10 m x 0.05 m, E = 200 GPa, nu = 0.3, 8000 kg/m^3",
        Source(
            "NAFEMS, The Standard NAFEMS Benchmarks, TNSB Rev. 3 (1990), FV12; converged values in "
            "FinEtoolsFlexStructures (P. Krysl)",
            Confirmed.READ,
        ),
        tuple(Number(f"mode {k}, Hz", f, 5e-4) for k, f in enumerate(FREE, 7)),
        ByRefinement(nafems_plate, {"n": 20}, {"n": 10}, {"cantilever": False, "count": 8}),
    ),
    Comparison(
        "cantilever plate, FV16",
        "the same plate, one edge clamped",
        Source(
            "NAFEMS, The Standard NAFEMS Benchmarks, TNSB Rev. 3 (1990), FV16",
            Confirmed.READ,
            "read where FinEALE quotes it",
        ),
        tuple(
            Number(
                f"mode {k}, Hz",
                f,
                5e-4,
                why="there mode 1 is 3.494 (D/(rho h))^(1/2)/a^2, an upper bound of Rayleigh and Ritz "
                "(from memory: D. Young, 1950); here 3.471",
            )
            for k, f in enumerate(HELD, 1)
        ),
        ByRefinement(nafems_plate, {"n": 20}, {"n": 10}, {"cantilever": True, "count": 6}),
    ),
)
