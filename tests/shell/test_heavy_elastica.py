"""A strip with a natural curvature under its weight, ends up: see `tests/shell/heavy_elastica.py`."""

import numpy as np
import pytest

from figures.draw.saddle import limits
from linear_theory import FieldWave, Sheet
from linear_theory.deformation.plate import Foundation, plate_field
from tests.shell.heavy_elastica import (
    BENDING,
    HALF,
    THICKNESS,
    WEIGHT,
    WIDTH,
    Shape,
    depth,
    elastica,
    length_off_rigid_ground,
    rise,
    strip,
)


@pytest.fixture(scope="module")
def stiff() -> dict[float, Shape]:
    """On a ground into which the strip sinks 2e-5, by rest curvature."""
    return {curvature: strip(curvature, 5e5) for curvature in (1.0, 4.0)}


@pytest.mark.parametrize(("curvature", "height"), [(1.0, 0.0045), (4.0, 0.072)])
def test_ends_stand_as_high_as_on_rigid_ground(
    stiff: dict[float, Shape], curvature: float, height: float
) -> None:
    """B kappa^2/(2 q) at slopes of up to 1/11 and 2/3."""
    assert BENDING * curvature**2 / (2 * WEIGHT) == pytest.approx(height, rel=1e-12)
    assert stiff[curvature].height[-1] == pytest.approx(height, rel=5e-3)  # 2 d/3 lower
    assert stiff[curvature].rise == pytest.approx(rise(curvature, 5e5), rel=limits.HEIGHT_ERROR)


@pytest.mark.parametrize("curvature", [1.0, 4.0])
def test_length_off_stiff_ground(stiff: dict[float, Shape], curvature: float) -> None:
    """That of the elastica on the same ground, which tends to that off rigid ground with its layer."""
    found = {k: elastica(curvature, k).free for k in (5e5, 8e6, 1.28e8)}  # layers as 4 : sqrt(8) : 2
    assert stiff[curvature].free == pytest.approx(found[5e5], rel=5e-3)
    layers = np.array(list(found)) ** -0.125
    limit = np.polynomial.Polynomial.fit(layers, list(found.values()), 2)(0.0)
    exact = length_off_rigid_ground(curvature)
    assert limit == pytest.approx(exact, rel=1e-2)
    slender = np.sqrt(2 * BENDING * curvature / WEIGHT)
    assert exact == pytest.approx(slender, rel=2e-4 if curvature == 1 else 1.3e-2)


def test_shape_on_softer_ground() -> None:
    """Where the middle is not flat: the whole shape against collocation."""
    found, exact = strip(4.0, 50.0), elastica(4.0, 50.0)
    expected = np.interp(found.along, exact.along, exact.height)
    assert abs(found.height - expected).max() < 1e-3 * exact.rise


STIFFNESS = 5e3
LINEAR = WEIGHT / np.sqrt(BENDING * 2 * WEIGHT / depth(STIFFNESS))
"""q/sqrt(B s): curvature at which a linear ground lets go of the end of a half-infinite strip."""


@pytest.mark.parametrize("share", [0.3, 0.98])
def test_plate_below_lift_off_is_the_first_order_of_the_elastica(share: float) -> None:
    """The plate rises by kappa sqrt(B/s), the elastica by 1 + D/(6 d) + ... times that."""
    curvature, d = share * LINEAR, depth(STIFFNESS)
    uniform = FieldWave(lambda x, y, t: np.cos(2 * np.pi * t) + 0 * x + 0 * y, period=1.0)
    sheet = Sheet(length=2 * HALF, width=WIDTH / 10, poisson=0.0, thickness=THICKNESS)
    field = plate_field(sheet, uniform, Foundation(BENDING, WEIGHT, STIFFNESS), rtol=1e-4)
    assert field.lift_off() == pytest.approx(LINEAR, rel=2e-3)
    ends = field.deflection(0.0, np.array([0.0, HALF]), 0.5)
    linear, whole = curvature * float(ends[1] - ends[0]), strip(curvature, STIFFNESS).rise
    assert linear == pytest.approx(share * d / 2, rel=2e-3)
    assert whole == pytest.approx(rise(curvature, STIFFNESS), rel=2e-3)
    assert whole / linear - 1 == pytest.approx(whole / (6 * d), rel=0.3)


def test_the_end_leaves_the_ground_at_1_63_times_the_linear_curvature() -> None:
    """4 q d/3 = B kappa^2, against q d/2: sqrt(8/3)."""
    leaving = np.sqrt(4 * WEIGHT * depth(STIFFNESS) / (3 * BENDING))
    assert leaving == pytest.approx(np.sqrt(8 / 3) * LINEAR, rel=1e-12)
    heights = [strip(share * leaving, STIFFNESS).height[-1] for share in (0.99, 1.01)]
    assert heights[0] < 0 < heights[1]
