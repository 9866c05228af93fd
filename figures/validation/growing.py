"""Growing sheets: layers, natural curvature, edges that grow."""

from figures.validation.comparison import ByRefinement, Comparison, Confirmed, Number, Source
from figures.validation.problems.growth import bilayer_strip, disk, edge_growth, plate_with_curvature

PEZZULLA = Source(
    "M. Pezzulla, G. P. Smith, P. Nardinocchi, D. P. Holmes, Soft Matter 12:4435 (2016), "
    "arXiv:1509.05259",
    Confirmed.READ,
)

TRIAL = Source(
    "An independent trial of another shell code, on the way to the limit of M. Pezzulla et al., "
    "arXiv:1509.05259",
    Confirmed.DERIVED,
)

RATIOS = (25.0, 75.0, 250.0)


def _plates(nu: str) -> tuple[str, ...]:
    """Scene files of the plates of RATIOS."""
    return tuple(f"plate_{nu}_{ratio:g}.toml" for ratio in RATIOS)


LARGE = ("plate_half_2500.toml",)
EDGES = ("edge_growth_half.toml", "edge_growth_zero.toml")
BILAYER, DISK = "bilayer_strip.toml", "disk_cap.toml"

COMPARISONS = (
    Comparison(
        "bilayer strip",
        "the shell as a narrow strip of two equal layers, one longer by d",
        Source(
            "S. Timoshenko, J. Opt. Soc. Am. 11:233 (1925), doi:10.1364/JOSA.11.000233",
            Confirmed.DERIVED,
        ),
        (Number("curvature h/d", 1.5, 1e-15),),
        ByRefinement(bilayer_strip, {"elements": 32}, {"elements": 16}, {"name": BILAYER}),
        scenes=(BILAYER,),
    ),
    Comparison(
        "plate with natural curvature, nu = 1/2",
        "mean curvature over kappa_0 of a free 2 : 1 plate, averaged",
        TRIAL,
        tuple(
            Number(f"kappa_0 W^2/h = {ratio:g}", value, 5e-4)
            for ratio, value in zip(RATIOS, (0.798, 0.776, 0.757), strict=True)
        ),
        ByRefinement(plate_with_curvature, {"n": 10}, {"n": 5}, {"names": _plates("half")}),
        scenes=_plates("half"),
    ),
    Comparison(
        "plate with natural curvature, nu = 0",
        "the same without lateral contraction",
        TRIAL,
        tuple(
            Number(f"kappa_0 W^2/h = {ratio:g}", value, 5e-4)
            for ratio, value in zip(RATIOS, (0.635, 0.575, 0.539), strict=True)
        ),
        ByRefinement(plate_with_curvature, {"n": 10}, {"n": 5}, {"names": _plates("zero")}),
        scenes=_plates("zero"),
    ),
    Comparison(
        "very large plate with natural curvature",
        "the plate of nu = 1/2 at kappa_0 W^2/h = 2500, towards the limit (1 + nu)/2",
        PEZZULLA,
        (
            Number(
                "mean curvature over kappa_0",
                0.75,
                5e-3,
                why="a layer of width (h/kappa_0)^(1/2) along the edges stays bent both ways",
            ),
        ),
        ByRefinement(plate_with_curvature, {"n": 12}, {"n": 8}, {"names": LARGE}),
        scenes=LARGE,
        slow=True,
    ),
    Comparison(
        "strip whose edges grow",
        "first buckling of a flat strip with growth c = (2 x/W)^2 into a saddle, length 32 W",
        Source(
            "Energy of quadratic shapes of a long strip",
            Confirmed.DERIVED,
            "an independent trial of a finite strip gave 4.560 and 6.312",
        ),
        tuple(
            Number(f"alpha W^2/h^2, nu = {nu:g}", value, 5e-4)
            for nu, value in ((0.5, 4.547), (0.0, 6.275))
        ),
        ByRefinement(
            edge_growth,
            {"shortened": 1.0},
            {"shortened": 0.5},
            {"names": EDGES, "n": 4},
        ),
        scenes=EDGES,
        slow=True,
    ),
    Comparison(
        "disk: cap to cylinder",
        "natural curvature at which the cap of a free disk, nu = 0.3, stops to be a minimum",
        Source("K. A. Seffen, R. A. McMahon, Int. J. Mech. Sci. 49:230 (2007)", Confirmed.MEMORY),
        (
            Number(
                "kappa_0 R^2/h = 8/(1 + nu)^(3/2)",
                8 / 1.3**1.5,
                5e-4,
                why="there the curvature is uniform, which misses that no moment acts on the free edge",
            ),
            Number(
                "kappa R^2/h = 4/(1 + nu)^(1/2) there",
                4 / 1.3**0.5,
                5e-4,
                why="there the curvature is uniform; here it is that averaged over the disk",
            ),
        ),
        ByRefinement(disk, {"refinements": 4}, {"refinements": 3}, {"name": DISK}),
        scenes=(DISK,),
        slow=True,
    ),
)
