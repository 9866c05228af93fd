"""What scene files say of outlines, uneven ground and measured waves."""

from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
import sympy
from numpy.typing import NDArray
from PIL import Image

from fem_check import Ground, Outline, Terrain
from fem_check.files import SceneFileError
from fem_check.files.reading import parsed
from fem_check.files.writing import toml_of
from fem_check.shell.effects.formula import parsed as formula
from fem_check.shell.effects.formula import text_of
from fem_check.shell.effects.height_map import HeightMap
from linear_theory import SampledWave, Scene, Sheet, SineWave
from linear_theory.identity import content_key

Array = NDArray[np.float64]

GROWTH = "[growth]\nalpha = 0.01\n"
IN_MM = '[sheet]\nlength = "40 mm"\nwidth = "20 mm"\nyoung = "1 MPa"\n[wave]\nperiod = "8 s"\n' + GROWTH
SPACE = GROWTH + "[bending]\n[gravity]\nweight = 1e-4\n[ground]\nstiffness = 0.5\n[ground.terrain]\n"
IN_MM_SPACE = (
    IN_MM
    + '[bending]\n[gravity]\nweight = "8 Pa"\n[ground]\nstiffness = "50 Pa/mm^2"\n[ground.terrain]\n'
)


def scene_of(text: str, folder: Path = Path()) -> Scene:
    return parsed(text, folder / "scene.toml").scene


def mistake_of(text: str, folder: Path = Path()) -> str:
    with pytest.raises(SceneFileError) as refused:
        scene_of(text, folder)
    (found,) = refused.value.mistakes
    return found


def area(mesh: Any) -> float:
    """Of triangles or quadrilaterals, by the shoelace formula."""
    x, y = mesh.p[:, mesh.t]
    return float(np.abs((x * np.roll(y, -1, 0) - y * np.roll(x, -1, 0)).sum(0)).sum() / 2)


OUTLINES = {
    "rectangle": ('shape = "rectangle"', 20 * 40),
    "trapezoid": ('shape = "trapezoid"\nrear = "1 cm"\nfront = "20 mm"', 15 * 40),
    "ellipse": ('shape = "ellipse"', np.pi * 10 * 20 * np.sinc(2 / 96)),
    "corners": ('unit = "cm"\ncorners = [[-1, -2], [1, -2], [0, 2]]', 10 * 40),
    "circle": ('shape = "rectangle"\nholes = [{diameter = "8 mm"}]', 800 - np.pi * 16),
    "holes": (
        'shape = "rectangle"\n'
        'holes = [{shape = "ellipse", length = "8 mm", width = "4 mm", y = "-1 cm"}, '
        '{shape = "rectangle", length = "8 mm", width = "4 mm", x = "3 mm", y = "1 cm"}]',
        800 - np.pi * 8 - 32,
    ),
    "polygon": (
        'shape = "rectangle"\nunit = "mm"\n'
        'holes = [{shape = "polygon", corners = [[0, 0], [4, 0], [0, 6]], x = "-2 mm"}]',
        800 - 12,
    ),
    "vertices": (
        'unit = "mm"\nvertices = [[-10, -20], [10, -20], [10, 20], [-10, 20]]\n'
        "elements = [[0, 1, 2], [0, 2, 3]]",
        800,
    ),
    "quadrilaterals": (
        'unit = "m"\nvertices = [[-0.01, -0.02], [0.01, -0.02], [0.01, 0.02], [-0.01, 0.02]]\n'
        "elements = [[0, 1, 2, 3]]",
        800,
    ),
}


@pytest.mark.parametrize("name", OUTLINES)
def test_outlines_have_their_area(name: str) -> None:
    text, expected = OUTLINES[name]
    scene = scene_of(f"{IN_MM}[outline]\n{text}")
    assert area(scene.mesh) == pytest.approx(expected, rel=1e-12)
    assert scene_of(toml_of(scene)) == scene


def test_the_size_of_triangles_is_that_of_the_file() -> None:
    outline = Outline.trapezoid(10.0, 20.0, 40.0)
    text = f'{IN_MM}[outline]\nshape = "trapezoid"\nrear = "10 mm"\nfront = "20 mm"\nsize = "5 mm"'
    expected = Scene(Sheet(40, 20, thickness=1.2), SineWave(1, 8.0), 0.01, mesh=outline.mesh(5.0))
    assert scene_of(text.replace('young = "1 MPa"\n', "")) == expected


@pytest.mark.parametrize("suffix", [".vtk", ".msh", ".vtu"])
def test_a_mesh_of_another_program(suffix: str, tmp_path: Path) -> None:
    mesh = Outline.trapezoid(10.0, 20.0, 40.0).mesh(8.0)
    points = np.vstack([mesh.p, 0 * mesh.p[:1]]).T
    points = np.vstack([points, [[99.0, 99.0, 0.0]]])  # a point without a cell, as Gmsh leaves them
    meshio.write_points_cells(tmp_path / f"a{suffix}", points, [("triangle", mesh.t.T)])
    scene = scene_of(f'{IN_MM}[outline]\nmesh = "a{suffix}"\nunit = "mm"', tmp_path)
    assert area(scene.mesh) == pytest.approx(area(mesh), rel=1e-12)
    assert scene.mesh.t.shape == mesh.t.shape


def test_what_is_no_mesh_is_refused(tmp_path: Path) -> None:
    text = f'{IN_MM}[outline]\nunit = "mm"\nmesh = '
    (tmp_path / "a.msh").write_text("no mesh")
    assert "meshio cannot read it" in mistake_of(f'{text}"a.msh"', tmp_path)
    points = np.array([[0.0, 0, 0], [10, 0, 0], [0, 40, 1]])
    meshio.write_points_cells(tmp_path / "b.vtk", points, [("triangle", [[0, 1, 2]])])
    assert "must lie in the plane z = 0" in mistake_of(f'{text}"b.vtk"', tmp_path)
    meshio.write_points_cells(tmp_path / "c.vtk", points, [("line", [[0, 1]])])
    assert "must have triangles or quadrilaterals alone, has line" in mistake_of(
        f'{text}"c.vtk"', tmp_path
    )


def test_equation_13_and_its_formula_are_one_ground() -> None:
    eq_13 = scene_of(f"{SPACE}amplitude = 0.02\nwavelength_x = 0.25\nwavelength_y = 0.5")
    text = "0.02*sin(2*pi*x/0.25)*sin(2*pi*y/0.5)"
    assert eq_13 == scene_of(f'{SPACE}expression = "{text}"')
    x, y = np.random.default_rng(0).uniform(-0.5, 0.5, (2, 50))
    height = eq_13.find(Ground).height.values(x, y)
    expected = 0.02 * np.sin(2 * np.pi * x / 0.25) * np.sin(2 * np.pi * y / 0.5)
    np.testing.assert_allclose(height, expected, atol=1e-16)
    with_units = scene_of(
        f'{IN_MM_SPACE}amplitude = "0.5 mm"\nwavelength_x = "1 cm"\nwavelength_y = "20 mm"'
    )
    expected = 0.5 * np.sin(2 * np.pi * x / 10) * np.sin(2 * np.pi * y / 20)
    np.testing.assert_allclose(with_units.find(Ground).height.values(x, y), expected, atol=1e-15)


FORMULAS = {
    "0.1*(x + 2)**3/7 - y": lambda x, y: 0.1 * (x + 2) ** 3 / 7 - y,
    "exp(-x**2 - y**2)*tanh(3*x)": lambda x, y: np.exp(-(x**2) - y**2) * np.tanh(3 * x),
    "sqrt(x**2 + 1e-3) + -cos(pi*y)": lambda x, y: np.sqrt(x**2 + 1e-3) - np.cos(np.pi * y),
    "+2": lambda x, y: 2 + 0 * x,
}


@pytest.mark.parametrize("text", FORMULAS)
def test_formulas_are_what_python_makes_of_them(text: str) -> None:
    expression, (x, y) = formula(text), np.random.default_rng(0).uniform(-1, 1, (2, 50))
    found = Terrain(expression, length=1.0).values(x, y)
    np.testing.assert_allclose(found, FORMULAS[text](x, y), rtol=1e-14)
    assert sympy.srepr(formula(text_of(expression))) == sympy.srepr(expression)


EVIL = (
    "__import__('os').system('true')", "x.__class__", "(lambda: 1)()", "[x][0]", "x if y else 1", "'x'",
    "9**9**9", "((9**64)**64)**64", "x**y", "x**(1/0)", "1/0", "sqrt(-1)", "sin(x, y)", "sin(x=1)",
    "log(x)",    "z", "True", "1e400", "x;y", "x = 1", "", "(" * 500 + "x", "x" + "+x" * 2000,
    "x < y", "x @ y",    "exp", "x!", "\0", "1j*x", "None", "sin(sin)", "(1/0)*x", "x**1e9",
)  # fmt: skip


@pytest.mark.parametrize("text", EVIL, ids=range(len(EVIL)))
@pytest.mark.filterwarnings("ignore::SyntaxWarning")
def test_what_is_no_height_is_refused_at_once(text: str) -> None:
    with pytest.raises(ValueError, match=r"must|too large|is no|not understood"):
        formula(text)


def bumps(x: Array, y: Array) -> Array:
    return np.asarray(0.02 * np.sin(9 * x) * np.cos(8 * y + 1))


def grid(width: float, length: float, shape: tuple[int, int]) -> Array:
    """Heights with their rows along y from +length/2 down, written without the code under test."""
    rows, columns = shape
    return np.array(
        [
            [
                bumps(width * (j / (columns - 1) - 0.5), length * (0.5 - i / (rows - 1)))
                for j in range(columns)
            ]
            for i in range(rows)
        ]
    )


def test_a_map_is_the_ground_that_was_sampled() -> None:
    found = HeightMap(grid(1.2, 1.8, (91, 61)), 1.2, 1.8)
    x, y = np.random.default_rng(0).uniform(-0.5, 0.5, (2, 200))
    jets = found(x, y)
    a, b, sx, cx = 9 * x, 8 * y + 1, np.sin(9 * x), np.cos(9 * x)
    sy, cy = np.sin(b), np.cos(b)
    exact = 0.02 * np.array(
        [sx * cy, 9 * cx * cy, -8 * sx * sy, -81 * sx * cy, -64 * sx * cy, -72 * cx * sy]
    )
    assert a.size
    for row, expected, error in zip(jets, exact, (1e-9, 1e-7, 1e-7, 1e-5, 1e-5, 1e-5), strict=True):
        np.testing.assert_allclose(row, expected, atol=error)
    np.testing.assert_array_equal(found.values(x, y), jets[0])
    np.testing.assert_array_equal(found.slopes(x, y), jets[1:3])


def test_errors_of_a_map_fall_with_the_sixth_power_of_its_spacing() -> None:
    x, y = np.random.default_rng(0).uniform(-0.4, 0.4, (2, 500))
    sizes = ((31, 21), (61, 41), (121, 81))
    errors = [
        np.abs(HeightMap(grid(1.2, 1.8, s), 1.2, 1.8).values(x, y) - bumps(x, y)).max() for s in sizes
    ]
    rates = np.log2(errors[:-1]) - np.log2(errors[1:])
    assert (rates > 5.5).all(), rates
    assert errors[-1] < 1e-10


def test_a_map_goes_on_level_beyond_its_border() -> None:
    found = HeightMap(grid(1.2, 1.8, (91, 61)), 1.2, 1.8)
    inside, outside = found(*np.array([[0.6], [0.2]])), found(*np.array([[5.0], [0.2]]))
    assert outside[0] == inside[0]
    assert outside[2] == inside[2]
    assert (outside[[1, 3, 5]] == 0).all()


def test_smoothing_takes_the_noise_away() -> None:
    rng, x, y = np.random.default_rng(3), *np.random.default_rng(0).uniform(-0.5, 0.5, (2, 300))
    noisy = grid(1.2, 1.8, (91, 61)) + rng.normal(0, 1e-3, (91, 61))
    rough, smooth = (
        np.std(HeightMap(noisy, 1.2, 1.8, s)(x, y)[3] - (-81) * bumps(x, y)) for s in (0.0, 1e-3)
    )
    assert smooth < rough / 20
    error = HeightMap(noisy, 1.2, 1.8, 1e-3).values(x, y) - bumps(x, y)
    assert np.sqrt(np.mean(error**2)) < 0.5e-3


def test_maps_are_known_by_their_heights() -> None:
    heights = grid(1.2, 1.8, (31, 21))
    one, other = HeightMap(heights, 1.2, 1.8), HeightMap(heights.copy(), 1.2, 1.8)
    one(np.zeros(1), np.zeros(1))
    assert one == other
    assert hash(one) == hash(other)
    assert content_key(one) == content_key(other)
    assert content_key(HeightMap(heights, 1.2, 1.8, 1e-3)) != content_key(one)
    assert one != HeightMap(2 * heights, 1.2, 1.8)


@pytest.mark.parametrize("kind", ["heights", ".npy", ".csv"])
def test_maps_in_files_are_the_same_ground(kind: str, tmp_path: Path) -> None:
    heights = grid(1.2, 1.8, (31, 21))
    said = f"heights = {heights.tolist()}"
    if kind == ".npy":
        np.save(tmp_path / "floor.npy", heights)
        said = 'map = "floor.npy"'
    elif kind == ".csv":
        np.savetxt(tmp_path / "floor.csv", heights, delimiter=",", fmt="%.17g")
        said = 'map = "floor.csv"'
    scene = scene_of(f"{SPACE}{said}\nwidth = 1.2\nlength = 1.8", tmp_path)
    assert scene.find(Ground).height.height == HeightMap(heights, 1.2, 1.8)
    assert scene_of(toml_of(scene)) == scene  # without the file


def test_an_image_is_ground_to_its_grey_values(tmp_path: Path) -> None:
    """Height from black to white 2 mm; what 8 bits round away is smoothed as noise of that size."""
    heights = grid(1.2, 1.8, (91, 61)) / 0.04 + 0.5  # from 0 to 1
    Image.fromarray(np.round(255 * heights).astype(np.uint8)).save(tmp_path / "floor.png")
    Image.fromarray(np.round(65535 * heights).astype(np.uint16)).save(tmp_path / "fine.png")
    x, y = np.random.default_rng(0).uniform(-25, 25, (2, 300))
    expected = 2.0 * (bumps(x / 50, y / 50) / 0.04 + 0.5)
    size = 'width = "6 cm"\nlength = "9 cm"\nheight = "2 mm"'
    for name, step in (("floor", 2 / 255), ("fine", 2 / 65535)):
        scene = scene_of(f'{IN_MM_SPACE}map = "{name}.png"\n{size}', tmp_path)
        found = scene.find(Ground).height
        assert found.height.smoothing == pytest.approx(step / np.sqrt(12))
        assert np.sqrt(np.mean((found.values(x, y) - expected) ** 2)) < step / 4


def test_what_is_no_map_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_text("no image")
    (tmp_path / "a.csv").write_text("1,2\n3,x\n")
    (tmp_path / "a.doc").write_text("")
    np.save(tmp_path / "a.npy", np.array([{}]), allow_pickle=True)
    for name in ("a.png", "a.csv", "a.npy"):
        words = mistake_of(f'{SPACE}map = "{name}"\nwidth = 2\nlength = 2', tmp_path)
        assert f"map = '{name}': cannot be read" in words
    words = mistake_of(f'{SPACE}map = "a.doc"\nwidth = 2\nlength = 2', tmp_path)
    assert "must end in .npy, .csv or .png" in words
    Image.fromarray(np.zeros((9, 9), np.uint8)).save(tmp_path / "b.png")
    words = mistake_of(f'{SPACE}map = "b.png"\nwidth = 2\nlength = 2', tmp_path)
    assert "height: must be given for an image" in words
    np.save(tmp_path / "b.npy", np.zeros((9, 9)))
    size = '\nwidth = "9 cm"\nlength = "9 cm"'
    assert "what the number 1 stands for" in mistake_of(f'{IN_MM_SPACE}map = "b.npy"{size}', tmp_path)


def samples(noise: float) -> tuple[Array, Array, Array]:
    """y (40 mm), t (8 s) and c of a sine with noise."""
    y, t = np.linspace(-20, 20, 21), np.linspace(0, 8, 12, endpoint=False)
    c = np.sin(2 * np.pi * (y[:, None] / 40 - t / 8))
    return y, t, c + noise * np.random.default_rng(0).normal(size=c.shape)


@pytest.mark.parametrize("noise", [0.0, 0.02])
def test_measured_waves_are_those_of_the_library(noise: float, tmp_path: Path) -> None:
    y, t, c = samples(noise)
    rows = np.stack([v.ravel() for v in np.broadcast_arrays(y[:, None], t, c)], axis=1)
    np.savetxt(tmp_path / "wave.csv", rows, delimiter=",", header="y,t,c", comments="")
    text = IN_MM.replace('period = "8 s"', 'period = "8 s"\ncsv = "wave.csv"')
    scene = scene_of(text, tmp_path)
    assert scene.wave == SampledWave.from_csv(tmp_path / "wave.csv", period=8.0)
    assert scene_of(toml_of(scene)) == scene  # without the file
    asked = scene_of(text.replace("csv =", "harmonics = 2\ndegree = 9\ncsv ="), tmp_path)
    assert asked.wave == SampledWave.from_csv(tmp_path / "wave.csv", period=8.0, harmonics=2, degree=9)
    assert scene_of(toml_of(asked)) == asked
    free = Scene(Sheet(40.0, 20.0), SampledWave(y, t, c), 0.01)
    assert scene_of(toml_of(free)) == free
    x = np.linspace(-10, 10, 5)
    wide = Scene(
        Sheet(40.0, 20.0),
        SampledWave(x, y, t, c + 0 * x[:, None, None], period=8.0, degree=(1, 8)),
        0.01,
    )
    assert scene_of(toml_of(wide)) == wide


def test_a_measured_wave_that_cannot_be_read_is_refused(tmp_path: Path) -> None:
    text = IN_MM.replace('period = "8 s"', 'period = "8 s"\ncsv = "wave.csv"')
    assert "csv = 'wave.csv': there is no such file" in mistake_of(text, tmp_path)
    path = tmp_path / "wave.csv"
    path.write_text("y,time,c\n1,2,3\n")
    assert "column" in mistake_of(text, tmp_path)
    path.write_text("y,t,c\n1,2,x\n")
    words = mistake_of(text, tmp_path)
    assert "wave.csv, line 2, column 'c' has 'x'" in words
    assert words.startswith(f"{tmp_path}/scene.toml:") or "[wave]" in words
