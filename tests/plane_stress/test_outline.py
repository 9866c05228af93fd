"""Outlines and their meshes."""

import os
import subprocess
import sys
from fractions import Fraction

import numpy as np
import pytest
from netgen.meshing import NgException

from fem_check.mesh.outline import Outline
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
    a, b, c = outline._count()
    assert len(areas) <= a / size**2 + b / size + c
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
        ([[0, 0], [1, 0], [1, 0], [0, 0]], "corners encloses the area 0"),
        ([[0, 0], [0, 0], [0, 0]], "corners encloses the area 0"),
        (1e200 * SQUARE, r"corners has the extent 1e\+200: must be 1e-70 to 1e\+70, .* another unit"),
        (1.5e308 * SQUARE, "corners has the extent "),
        (1e-200 * SQUARE, "corners has the extent 1e-200: must be 1e-70 to"),
        ([[0, 0], [1, 0], [1, 1], [0.5, -0.1], [0, 1]], r"corners: sides at x = 0.\d+, y = 0 cross"),
        ([[0, 0], [2, 0], [2, 2], [1, 0], [0, 2]], "sides at x = 1, y = 0 cross or touch"),
        (
            [[0, 0], [2, 0], [2, 2], [2, 1], [2, 3], [0, 3]],
            "sides at x = 2, y = 1 cross or touch",
        ),
    ],
)
def test_bad_corners(corners, message):
    with pytest.raises(ValueError, match=message):
        Outline(corners)


@pytest.mark.parametrize(
    ("holes", "message"),
    [
        ([SQUARE + 5], r"holes\[0\]: must lie within corners"),
        ([SQUARE], r"holes\[0\] and corners: sides .* cross"),
        (
            [[[0, 0], [0.5, 0], [0.2, 0.2]]],
            r"holes\[0\] and corners: sides at x = 0.5, y = 0 cross or touch",
        ),
        ([0.5 * SQUARE, 0.2 * SQUARE], r"holes\[1\]: must lie .* outside the other holes"),
        ([0.5 * SQUARE, 0.5 * SQUARE + 0.1], r"sides .* cross"),
        ([[[0, 0], [1, 1]]], r"holes\[0\] has shape \(2, 2\)"),
    ],
)
def test_bad_holes(holes, message):
    with pytest.raises(ValueError, match=message):
        Outline(SQUARE, holes)


def test_a_closed_loop_is_the_open_one():
    """linspace closes an ellipse with a corner that is 1e-17 from the first."""
    angles = np.linspace(0, 2 * np.pi, 41)
    ellipse = Outline(np.stack([0.25 * np.cos(angles), 0.5 * np.sin(angles)], axis=1))
    assert len(ellipse.corners) == 40
    # of the inscribed polygon of n corners at equal angles: n/2 sin(2 pi/n) a b
    assert ellipse.area == pytest.approx(20 * np.sin(2 * np.pi / 40) / 8, rel=1e-14)
    assert triangle_areas(ellipse.mesh(0.1)).sum() == pytest.approx(ellipse.area, rel=1e-12)
    repeated = Outline([[0, 0], [0, 0], [1, 0], [1, 1e-16], [0, 1], [0, 0]])
    np.testing.assert_array_equal(repeated.corners, [[0, 0], [1, 1e-16], [0, 1]])


@pytest.mark.parametrize("shift", [1e6, -1e12])
def test_area_far_from_the_origin_is_exact(shift):
    """By fractions, of the corners as they are rounded there."""
    corners = np.array([[0.1, 0], [0.7, 0.05], [0.6, 0.5], [0.3, 0.2], [0, 0.6]])
    corners += np.array([shift, -3 * shift])
    points = [(Fraction(x), Fraction(y)) for x, y in corners.tolist()]
    following = [*points[1:], points[0]]
    exact = sum(x * v - u * y for (x, y), (u, v) in zip(points, following, strict=True)) / 2
    assert Outline(corners).area == pytest.approx(float(exact), rel=1e-14)


@pytest.mark.parametrize("unit", [2.0**-30, 2.0**30])
def test_meshes_do_not_depend_on_the_unit(unit):
    mesh, scaled = Outline(ELL).mesh(0.2), Outline(ELL * unit).mesh(0.2 * unit)
    np.testing.assert_array_equal(scaled.t, mesh.t)
    np.testing.assert_array_equal(scaled.p, mesh.p * unit)


def test_the_same_mesh_in_every_process():
    code = (
        "from fem_check import Outline; "
        f"mesh = Outline({ELL.tolist()}, [{(0.1 * DISC + 0.25).tolist()}]).mesh(0.07); "
        "print(mesh.p.tobytes().hex(), mesh.t.tolist())"
    )
    environment = os.environ | {"PYTHONHASHSEED": "2", "OMP_NUM_THREADS": "2"}
    other = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    mesh = Outline(ELL, [0.1 * DISC + 0.25]).mesh(0.07)
    assert other.stdout.split(" ", 1) == [mesh.p.tobytes().hex(), f"{mesh.t.tolist()}\n"]
    assert other.stderr == ""


def test_the_mesh_keeps_the_corners():
    mesh = Outline(DISC / 3 + 7, [0.1 * SQUARE + 7]).mesh(0.1)
    given = {tuple(point) for point in np.concatenate([DISC / 3 + 7, 0.1 * SQUARE + 7]).tolist()}
    assert given <= {tuple(point) for point in mesh.p.T.tolist()}


def test_short_sides_are_meshed_or_refused():
    def cut(size):
        return Outline([[0, 0], [1, 0], [1, 1], [0.5, 1], [0.5 - size, 1 + size], [0, 1]])

    mesh = cut(1e-3).mesh(0.1)
    assert triangle_areas(mesh).sum() == pytest.approx(cut(1e-3).area, rel=1e-12)
    assert mesh.t.shape[1] < 1000  # the triangles grow from the short side on
    for size in (1e-5, 1e-9):
        with pytest.raises(ValueError, match=r"apart at x = 0.\d+, y = 1.* must be >= 0\.0002"):
            cut(size).mesh(0.1)
    needle = Outline([[0, 0], [1, 1.4416588377519548], [1, 1.4418891498453696]])
    with pytest.raises(ValueError, match=r"corners, holes: 0\.000131 apart"):  # Netgen does not end
        needle.mesh(0.1)


def test_outlines_that_netgen_gives_up_are_refused(monkeypatch):
    def fail(*_, **__):
        raise NgException("meshing failed")

    monkeypatch.setattr("netgen.geom2d.SplineGeometry.GenerateMesh", fail)
    with pytest.raises(ValueError, match=r"size = 0\.1: Netgen cannot mesh .* skfem\.MeshTri"):
        Outline(ELL).mesh(0.1)


def test_without_netgen_the_way_out_is_said(monkeypatch):
    monkeypatch.setitem(sys.modules, "netgen.geom2d", None)
    with pytest.raises(RuntimeError, match="pip install netgen-mesher"):
        Outline(ELL).mesh(0.1)
    assert Outline(SQUARE).mesh(0.5).t.shape[1] == 16  # which needs none


def test_the_number_of_triangles_is_bounded_beforehand():
    narrow = Outline([[0, 0], [1e3, 0], [1e3, 1e-3], [0, 1e-3]])
    with pytest.raises(ValueError, match=r"size = 0\.001: must be >= 0\.004"):
        narrow.mesh(1e-3)  # 4e6 triangles on an area of 1
    sheared = Outline([[0, 0], [1, 0], [2, 1e-3], [1, 1e-3]])
    with pytest.raises(ValueError, match=r"size = 0\.001: must be >= 0\.002"):
        sheared.mesh(1e-3)  # 4e6 again on an area of 1e-3
    comb = Outline([[0, 0], [1e3, 0], [1e3, 1], [5e2, 2], [0, 1]])
    with pytest.raises(ValueError, match=r"size = 0\.05: must be >= 0\.1"):
        comb.mesh(0.05)
    angles = 2 * np.pi * np.arange(100_000) / 100_000
    with pytest.raises(ValueError, match="must have fewer than 25000 corners"):
        Outline(np.stack([np.cos(angles), np.sin(angles)], axis=1)).mesh(0.5)


def test_bad_sizes():
    with pytest.raises(ValueError, match="rear = 0: must be > 0"):
        Outline.trapezoid(0, 1, 1)
    with pytest.raises(ValueError, match="size = -1: must be > 0"):
        Outline(SQUARE).mesh(-1)
    with pytest.raises(ValueError, match=r"size = 1e-06: must be >= 0\.002"):
        Outline(SQUARE).mesh(1e-6)
