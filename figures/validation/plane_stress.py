"""Plane stress: benchmarks of finite elements, and a strip that grows in its middle."""

from figures.validation.comparison import ByRefinement, Comparison, Confirmed, Number, Source
from figures.validation.problems.plane import cook, curved_beam, heated_strip, straight_beam

MIDDLE = "grows_in_middle.toml"
MACNEAL = "R. H. MacNeal, R. L. Harder, Finite Elem. Anal. Des. 1:3 (1985)"

COMPARISONS = (
    Comparison(
        "Cook's membrane",
        "a tapered panel under end shear",
        Source(
            "R. D. Cook, J. Struct. Div. ASCE 100:1851 (1974)",
            Confirmed.MEMORY,
            "23.96 is the limit that is quoted for plane stress, nu = 1/3",
        ),
        (Number("deflection of the middle of the loaded edge", 23.96, 5e-3),),
        ByRefinement(cook, {"n": 32}, {"n": 8}),
    ),
    Comparison(
        "straight beam in its plane",
        "a cantilever 6 x 0.2 x 0.1, end force 1, E = 1e7, nu = 0.3",
        Source(MACNEAL, Confirmed.DERIVED, "beam theory with shear"),
        (Number("extension", 3e-5, 5e-7), Number("deflection", 0.1081, 5e-5)),
        ByRefinement(straight_beam, {"n": 8}, {"n": 4}),
    ),
    Comparison(
        "curved beam in its plane",
        "a quarter of a ring of radii 4.12 and 4.32, radial end force 1, E = 1e7, nu = 0.25",
        Source(
            f"{MACNEAL}; a converged value in FinEALE (P. Krysl), curved_beam.m",
            Confirmed.READ,
        ),
        (
            Number(
                "deflection of MacNeal & Harder",
                0.08734,
                5e-6,
                why="of beam theory; FinEALE, too, found it 1.3 % too small",
            ),
            Number(
                "deflection of FinEALE",
                0.088519352,
                5e-10,
                why="of a solid, held otherwise at its foot",
            ),
        ),
        ByRefinement(curved_beam, {"n": 12}, {"n": 4}),
    ),
    Comparison(
        "strip that grows in its middle",
        "growth c = 1 - (2 x/W)^2 of a long strip: far from its ends it lengthens by the mean of c",
        Source(
            "S. Timoshenko, J. N. Goodier, Theory of Elasticity, 3rd ed., McGraw-Hill (1970), on "
            "thermal stress in a strip",
            Confirmed.DERIVED,
        ),
        (Number("strain along the strip over alpha", 2 / 3, 1e-15),),
        ByRefinement(
            heated_strip, {"length": 8.0, "size": 0.25}, {"length": 5.0, "size": 0.5}, {"name": MIDDLE}
        ),
        scenes=(MIDDLE,),
    ),
)
