"""Sources that several comparisons share."""

from figures.validation.comparison import Confirmed, Source

SZE = Source(
    "K. Y. Sze, X. H. Liu, S. H. Lo, Finite Elem. Anal. Des. 40:1551 (2004), "
    "doi:10.1016/j.finel.2003.11.001",
    Confirmed.READ,
)

TIMOSHENKO_PLATES = (
    "S. Timoshenko, S. Woinowsky-Krieger, Theory of Plates and Shells, 2nd ed., McGraw-Hill (1959)"
)

ZHENG = (
    "Z. Zheng et al., arXiv:2202.13521, doi:10.1109/ICRA46639.2022.9811927; numbers of the robot in "
    "the public repository zhiwuz/sfers"
)
