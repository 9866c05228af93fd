"""Outlines and their meshes."""

import numpy as np
import pytest

from fem_check.outline import Outline
from linear_theory import Sheet

SQUARE = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / 2
ELL = np.array([[0, 0], [1, 0], [1, 0.5], [0.5, 0.5], [0.5, 1], [0, 1]])
ANGLES = 2 * np.pi * np.arange(24) / 24
DISC = np.stack([np.cos(ANGLES), np.sin(ANGLES)], axis=1)

OUTLINES = [
    (Outline(SQUARE), 1.0, 0.2),
    (Outline(SQUARE[::-1]), 1.0, 0.2),
    (Outline.rectangle(Sheet(2, 0.3)), 0.6, 0.1),
    (Outline.trapezoid(0.5, 0.3, 1), 0.4, 0.1),
    (Outline(ELL), 0.75, 0.15),
    (Outline([[0, 0], [1, 0], [0.9, 0.05], [0.2, 0.04], [0.1, 1]]), 0.136, 0.1),
    (Outline(DISC), 12 * np.sin(2 * np.pi / 24), 0.2),
    (Outline(SQUARE, [0.2 * DISC]), 1 - 0.04 * 12 * np.sin(2 * np.pi / 24), 0.15),
    (Outline(SQUARE, [0.1 * DISC + [0.25, 0], 0.2 * SQUARE - [0.2, 0.1]]), None, 0.1),
]


def triangle_areas(mesh):
    a, b, c = mesh.p[:, mesh.t].transpose(1, 0, 2)
    return abs((b - a)[0] * (c - a)[1] - (b - a)[1] * (c - a)[0]) / 2


@pytest.mark.parametrize(("outline", "area", "size"), OUTLINES)
def test_mesh_fills_the_outline_with_sound_triangles(outline, area, size):
    if area is not None:
        assert outline.area == pytest.approx(area, rel=1e-12)  # roundoff
    mesh = outline.mesh(size)
    areas = triangle_areas(mesh)
    assert areas.sum() == pytest.approx(outline.area, rel=1e-12)
    start, end = mesh.p[:, mesh.facets].transpose(1, 0, 2)
    sides = np.linalg.norm(end - start, axis=0)
    assert sides.max() < 2.2 * size  # smoothed points may drift apart, measured 1.9
    squares = (sides[mesh.t2f] ** 2).sum(axis=0)
    assert (4 * np.sqrt(3) * areas / squares).min() > 0.25  # 1 is equilateral; measured 0.34
    # as many boundary edges as vertices on them: no cracks, no overlaps
    boundary = mesh.boundary_facets()
    assert len(boundary) == len(mesh.boundary_nodes())


def test_trapezoid_mesh_is_mirror_symmetric():
    points = Outline.trapezoid(0.6, 0.2, 1).mesh(0.1).p.T
    mirrored = points * [-1, 1]
    distances = np.linalg.norm(points[:, None] - mirrored, axis=2).min(axis=1)
    assert distances.max() < 1e-15


def test_extents_and_angles():
    outline = Outline.trapezoid(0.6, 0.2, 1)
    assert (outline.width, outline.length) == (0.6, 1.0)
    assert outline.largest_angle == pytest.approx(np.pi / 2 + np.arctan(0.2))
    assert Outline(ELL).largest_angle == pytest.approx(1.5 * np.pi)
    assert Outline(SQUARE, [0.2 * SQUARE]).largest_angle == pytest.approx(1.5 * np.pi)
    assert Outline(SQUARE).largest_angle == pytest.approx(np.pi / 2)


@pytest.mark.parametrize(
    ("corners", "message"),
    [
        ([[0, 0], [1, 0]], r"corners has shape \(2, 2\): must be \(n, 2\) with n >= 3"),
        ([0, 1, 2], "corners has shape"),
        ([[0, 0], [1, 0], [2, 0]], "corners encloses the area 0: must be > 0"),
        ([[0, 0], [1, 0], [np.nan, 1]], "corners contains nan: must be finite"),
        ([[0, 0], [1j, 0], [0, 1]], "corners = .*: must be real numbers"),
        ([[0, 0], [1, 0], [1, 0], [0, 1]], "corners repeats a corner"),
        ([[0, 0], [1, 0], [1, 1], [0.5, -0.1], [0, 1]], r"sides \(0, 2\) cross"),
        ([[0, 0], [2, 0], [2, 2], [1, 0], [0, 2]], r"sides \(0, 2\) cross"),  # touches
    ],
)
def test_bad_corners(corners, message):
    with pytest.raises(ValueError, match=message):
        Outline(corners)


@pytest.mark.parametrize(
    ("holes", "message"),
    [
        ([SQUARE + 5], r"holes\[0\]: must lie within corners"),
        ([SQUARE], r"sides .* cross"),
        ([0.5 * SQUARE, 0.2 * SQUARE], r"holes\[1\]: must lie .* outside the other holes"),
        ([0.5 * SQUARE, 0.5 * SQUARE + 0.1], r"sides .* cross"),
        ([[[0, 0], [1, 1]]], r"holes\[0\] has shape \(2, 2\)"),
    ],
)
def test_bad_holes(holes, message):
    with pytest.raises(ValueError, match=message):
        Outline(SQUARE, holes)


def test_bad_sizes():
    with pytest.raises(ValueError, match="rear = 0: must be > 0"):
        Outline.trapezoid(0, 1, 1)
    with pytest.raises(ValueError, match="size = -1: must be > 0"):
        Outline(SQUARE).mesh(-1)
    with pytest.raises(ValueError, match=r"size = 1e-06: must be >= 0\.002"):
        Outline(SQUARE).mesh(1e-6)
