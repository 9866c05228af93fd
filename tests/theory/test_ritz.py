"""Legendre-Ritz solution: exact solutions, invariants, honest errors, limits."""

import numpy as np
import pytest
import sympy as sp

from linear_theory import Sheet, SineWave, TravellingWave
from linear_theory.common.errors import NotConvergedError
from linear_theory.deformation.ritz import field as ritz
from linear_theory.deformation.ritz import ritz_field
from linear_theory.motion.motion import CellGrid
from linear_theory.sheet import hooke
from linear_theory.wave.given import FieldWave
from linear_theory.wave.phases import phases

SHEETS = [
    Sheet(),
    Sheet(1, 0.1, 0.3),
    Sheet(2, 3, 0.0),
    Sheet(1, 1, -0.5),
]
PULSE = TravellingWave.from_samples(np.exp(-(((np.arange(16) - 8) / 2) ** 2)), count=-1)


def grid(sheet, nx=9, ny=14):
    """Points x (nx, 1), y (ny,) and weights of a Gauss rule on the sheet."""
    x, wx = np.polynomial.legendre.leggauss(nx)
    y, wy = np.polynomial.legendre.leggauss(ny)
    weights = np.multiply.outer(wx, wy) * sheet.area / 4
    return x[:, None] * sheet.width / 2, y * sheet.length / 2, weights


def distance(field, reference, count=16):
    """Relative L2 distance of two fields at the worst of the phases, by quadrature."""
    x, y, weights = grid(field.sheet, 30, 60)
    t = phases(field.wave.period, count)[:, None, None]
    u, v = field.displacement(x, y, t), reference.displacement(x, y, t)
    square = ((u - v) ** 2 * weights).sum(axis=(0, 2, 3)) / (v**2 * weights).sum(axis=(0, 2, 3))
    return np.sqrt(square.max())


def bubble_wave(sheet):
    """Growth c = -laplacian(chi) cos(2 pi t), whose stress is the Airy stress of chi and

    u = -(1 + nu) grad(chi) cos(2 pi t): chi and its slope vanish on all edges. Returns the wave and
    functions for u and the stress at t = 0.
    """
    x, y = sp.symbols("x y")
    a, b = sheet.width / 2, sheet.length / 2
    chi = (1 - (x / a) ** 2) ** 2 * (1 - (y / b) ** 2) ** 2 * (1 + x / a + 2 * y / b)
    c = -(sp.diff(chi, x, 2) + sp.diff(chi, y, 2))
    u = [-(1 + sheet.poisson) * sp.diff(chi, v) for v in (x, y)]
    s = [sp.diff(chi, y, 2), sp.diff(chi, x, 2), -sp.diff(chi, x, y)]
    c, u, s = (sp.lambdify((x, y), e) for e in (c, u, s))
    return FieldWave(lambda x, y, t: c(x, y) * np.cos(2 * np.pi * t), 1.0), u, s


@pytest.mark.parametrize("sheet", SHEETS)
def test_polynomial_solution_is_found_exactly(sheet):
    wave, u, s = bubble_wave(sheet)
    field = ritz_field(sheet, wave, degree=9)  # chi has degree 5 + 4
    x, y, _ = grid(sheet)
    # roundoff times the condition of a 100-unknown system, relative to the largest value
    np.testing.assert_allclose(
        field.displacement(x, y, 0), u(x, y), atol=1e-12 * abs(np.array(u(x, y))).max()
    )
    np.testing.assert_allclose(
        field.stress(x, y, 0), s(x, y), atol=1e-11 * abs(np.array(s(x, y))).max()
    )
    # the rate is a difference quotient of eighth order, good to 1e-12 for a sine
    np.testing.assert_allclose(
        field.velocity(x, y, 0.25),
        -2 * np.pi * np.array(u(x, y)),
        atol=1e-10 * abs(np.array(u(x, y))).max(),
    )
    assert field.error < 1e-12


@pytest.mark.parametrize("sheet", SHEETS)
def test_growth_linear_in_space_makes_no_stress(sheet):
    wave = FieldWave(lambda x, y, t: 0.3 + 0.7 * x * np.sin(2 * np.pi * t) - 1.1 * y, period=1.0)
    field = ritz_field(sheet, wave, degree=5)
    x, y, _ = grid(sheet)
    c = wave.value(x, y, 0.2)
    np.testing.assert_allclose(field.stress(x, y, 0.2), 0, atol=1e-12)  # roundoff
    np.testing.assert_allclose(field.strain(x, y, 0.2), [c, c, 0 * c], atol=1e-12)


def test_mean_growth_is_a_uniform_dilation():
    sheet = Sheet()
    base = TravellingWave([0.0], [1.0])
    lifted = TravellingWave([0.0], [1.0], mean=0.25)
    x, y, _ = grid(sheet)
    more = ritz_field(sheet, lifted, degree=11).displacement(x, y, 0.1)
    less = ritz_field(sheet, base, degree=11).displacement(x, y, 0.1)
    uniform = np.stack(np.broadcast_arrays(0.25 * x, 0.25 * y))
    np.testing.assert_allclose(more - less, uniform, atol=1e-14)


@pytest.mark.parametrize("sheet", SHEETS)
def test_general_and_travelling_waves_agree(sheet):
    wave, length = SineWave(2, period=3.0), sheet.length
    general = FieldWave(lambda x, y, t: np.sin(4 * np.pi * y / length - 2 * np.pi * t / 3), period=3.0)
    # 31: Gauss rule and plane wave expansion are both exact to roundoff for two waves
    one, two = ritz_field(sheet, wave, degree=31), ritz_field(sheet, general, degree=31)
    x, y, _ = grid(sheet)
    t = np.linspace(-1, 2, 5)[:, None, None]
    for name in ("displacement", "velocity", "strain"):
        a, b = getattr(one, name)(x, y, t), getattr(two, name)(x, y, t)
        np.testing.assert_allclose(a, b, atol=1e-11 * abs(a).max())
    a, b = (f.motion(t.ravel(), CellGrid.uniform(f.sheet, 3, 4, half=False), 2) for f in (one, two))
    for name in ("position", "area", "velocity", "dilation", "growth"):
        np.testing.assert_allclose(getattr(a, name), getattr(b, name), atol=1e-11)


def table():
    """Sheets, waves: widths 1:100 to 100:1, soft and auxetic, one to 50 waves, a pulse."""
    yield from ((sheet, wave) for sheet in SHEETS for wave in (SineWave(1), SineWave(-3), PULSE))
    yield Sheet(1, 0.01, 0.5), SineWave(1)
    yield Sheet(1, 0.01, 0.3), SineWave(50)
    yield Sheet(1, 0.5, 0.5), SineWave(50)
    yield Sheet(1, 0.3, -0.9), SineWave(7)
    yield Sheet(1, 2, -0.9), SineWave(1)
    yield Sheet(1, 100, 0.3), SineWave(1)


@pytest.mark.parametrize(("sheet", "wave"), list(table()))
def test_error_estimate_is_honest_and_meets_rtol(sheet, wave):
    rtols = [1e-2, 1e-4, 1e-6]
    reference = ritz_field(sheet, wave, rtol=1e-8)
    for rtol in rtols:
        field = ritz_field(sheet, wave, rtol=rtol)
        true = coefficient_distance(field, reference)
        assert true <= field.error + reference.error
        assert field.error <= rtol
        # not wasteful either: within a decade or two where degrees are not at their minimum
        assert field.error < 500 * true or min(field.degree) < 9


def coefficient_distance(field, reference):
    """As `distance`, exactly: by the coefficients of the orthonormal polynomials."""
    pair = [f._polynomials for f in (field, reference)]
    shape = [max(sizes) for sizes in zip(*(p.shape for p in pair), strict=True)]
    u, v = (np.pad(p, [(0, n - m) for n, m in zip(shape, p.shape, strict=True)]) for p in pair)
    factors = reference._cases.samples()
    norm = [np.sqrt((np.tensordot(factors.T, c, 1) ** 2).sum(axis=(1, 2, 3))) for c in (u - v, v)]
    return float((norm[0] / norm[1]).max())


@pytest.mark.parametrize("degree", [(3, 5), (5, 9), (7, 31), (21, 11)])
def test_estimate_is_honest_where_the_wave_is_not_resolved(degree):
    for sheet, wave in ((Sheet(), SineWave(7)), (Sheet(1, 3, 0.0), PULSE), (Sheet(), SineWave(1))):
        field, reference = ritz_field(sheet, wave, degree=degree), ritz_field(sheet, wave, rtol=1e-6)
        assert coefficient_distance(field, reference) <= field.error


def test_distance_of_public_values_is_that_of_the_coefficients():
    field, reference = (
        ritz_field(Sheet(), SineWave(), degree=7),
        ritz_field(Sheet(), SineWave(), degree=31),
    )
    assert distance(field, reference) == pytest.approx(coefficient_distance(field, reference), rel=1e-9)


def test_error_estimate_for_a_wave_that_depends_on_x():
    wave = FieldWave(lambda x, y, t: np.exp(x) * np.sin(2 * np.pi * (y - t) + 3 * x * y), period=1.0)
    reference = ritz_field(Sheet(), wave, rtol=1e-8)
    for rtol in (1e-3, 1e-5):
        field = ritz_field(Sheet(), wave, rtol=rtol)
        assert distance(field, reference) <= field.error + reference.error
        assert field.error <= rtol


def test_convergence_is_algebraic_as_the_corners_demand():
    reference = ritz_field(Sheet(), SineWave(), degree=(81, 113))
    errors = [
        coefficient_distance(ritz_field(Sheet(), SineWave(), d), reference)
        for d in ((21, 29), (41, 57))
    ]
    rate = np.log(errors[0] / errors[1]) / np.log(41 / 21)
    # u ~ distance**2.74 at the corners: between energy (2 * 2.74) and best approximation (2 * 3.74)
    assert 5.5 < rate < 7.5
    assert errors[1] < 1e-9  # measured 7e-10


@pytest.mark.parametrize("sheet", SHEETS)
def test_energy_falls_with_the_degree(sheet):
    """1/2 int (eps - c I) : sigma, by quadrature of the public strain and stress."""
    x, y, weights = grid(sheet, 40, 60)
    energies = []
    for degree in (3, 5, 7, 11, 15):
        field = ritz_field(sheet, SineWave(), degree=degree)
        strain, stress = field.strain(x, y, 0.1), field.stress(x, y, 0.1)
        elastic = (
            strain - field.wave.value(x, y, 0.1, sheet.length) * np.array([1, 1, 0])[:, None, None]
        )
        density = (elastic * stress).sum(axis=0) + elastic[2] * stress[2]
        energies.append((density * weights).sum() / 2)
    assert np.all(np.diff(energies) < 1e-14)  # equal to roundoff where one more degree changes nothing
    assert energies[-1] > 0


@pytest.mark.parametrize("wave", [SineWave(2), PULSE])
def test_cross_sections_carry_no_force_and_no_moment(wave):
    sheet = Sheet(1, 0.5, 0.3)
    field = ritz_field(sheet, wave, rtol=1e-8)
    x, weights = np.polynomial.legendre.leggauss(60)
    y = np.array([-0.41, -0.1, 0.0, 0.33])[:, None]
    stress = field.stress(x * sheet.width / 2, y, 0.3)
    force = (stress[1:] * weights).sum(axis=-1)
    moment = (stress[1] * x * weights).sum(axis=-1)
    # stresses of order 0.3 converge two powers of the degree behind the displacements' 1e-8
    np.testing.assert_allclose(force, 0, atol=1e-5)
    np.testing.assert_allclose(moment, 0, atol=1e-5)


def test_edges_are_free():
    sheet = Sheet()
    field = ritz_field(sheet, SineWave(), degree=(41, 57))
    y, x = np.linspace(-0.45, 0.45, 19), np.linspace(-0.2, 0.2, 19)
    # away from corners, where traction converges slowly; measured 2e-6
    assert abs(field.stress(sheet.width / 2, y, 0.1)[[0, 2]]).max() < 1e-5
    assert abs(field.stress(x, sheet.length / 2, 0.1)[[1, 2]]).max() < 1e-5


def test_stress_does_not_depend_on_poisson():
    x, y, _ = grid(Sheet())
    stresses = [
        ritz_field(Sheet(poisson=nu), SineWave(), degree=(41, 57)).stress(x, y, 0.1)
        for nu in (0.5, 0.0, -0.5)
    ]
    # truncated solutions are not independent of nu: the error of the stress at Gauss points
    np.testing.assert_allclose(stresses[1], stresses[0], atol=2e-6)
    np.testing.assert_allclose(stresses[2], stresses[0], atol=2e-6)


@pytest.mark.parametrize("sheet", SHEETS)
def test_no_rigid_motion(sheet):
    tilted = FieldWave(lambda x, y, t: x**2 * y + y**3 - x**3 + np.cos(x - y) * t, period=1.0)
    for wave in (SineWave(3), tilted):
        field = ritz_field(sheet, wave, degree=15)
        x, y, weights = grid(sheet, 20, 20)
        u = field.displacement(x, y, 0.3)
        scale = abs(u).max()
        np.testing.assert_allclose((u * weights).sum(axis=(1, 2)), 0, atol=1e-13 * sheet.area * scale)
        # the mean rotation (du_y/dx - du_x/dy)/2 is an integral of u along the edges
        right, left = (field.displacement(s * sheet.width / 2, y, 0.3)[1] for s in (1, -1))
        front, rear = (field.displacement(x[:, 0], s * sheet.length / 2, 0.3)[0] for s in (1, -1))
        _, wx = np.polynomial.legendre.leggauss(20)
        turned = (right - left) @ wx * sheet.length - (front - rear) @ wx * sheet.width
        assert abs(turned) < 1e-12 * scale * (sheet.length + sheet.width)


def test_mirrored_wave_gives_the_mirrored_field():
    sheet = Sheet(1, 0.4, 0.2)
    there, back = (ritz_field(sheet, SineWave(n), degree=15) for n in (2, -2))
    x, y, _ = grid(sheet)
    u, v = there.displacement(x, y, 0.15), back.displacement(x, -y, 0.15)
    np.testing.assert_allclose(v, u * np.array([1, -1])[:, None, None], atol=1e-13)


@pytest.mark.parametrize("width", [0.04, 0.02, 0.01])
def test_narrow_strip_strains_freely(width):
    sheet = Sheet(1, width, 0.4)
    field = ritz_field(sheet, SineWave(), rtol=1e-8)
    x, y, _ = grid(sheet)
    c = field.wave.value(x, y, 0.1)
    # the strain differs from c I at second order in width times wave number; 0.6 measured
    assert abs(field.strain(x, y, 0.1) - [c, c, 0 * c]).max() < (2 * np.pi * width) ** 2


def test_velocity_is_the_rate_of_displacement():
    field = ritz_field(Sheet(), PULSE, degree=21)
    x, y, _ = grid(Sheet())
    h = 1e-5
    quotient = (field.displacement(x, y, 0.3 + h) - field.displacement(x, y, 0.3 - h)) / (2 * h)
    # (2 pi 8 h)**2/6 for the pulse's highest harmonic, and roundoff / h
    np.testing.assert_allclose(field.velocity(x, y, 0.3), quotient, atol=1e-7)


def test_strain_is_the_gradient_of_displacement():
    field = ritz_field(Sheet(), SineWave(), degree=15)
    x, y, _ = grid(Sheet(), 5, 6)
    h = 1e-6
    dx = (field.displacement(x + h, y, 0.3) - field.displacement(x - h, y, 0.3)) / (2 * h)
    dy = (field.displacement(x, y + h, 0.3) - field.displacement(x, y - h, 0.3)) / (2 * h)
    np.testing.assert_allclose(field.strain(x, y, 0.3), [dx[0], dy[1], (dx[1] + dy[0]) / 2], atol=1e-8)


def test_points_in_any_order_give_the_values_of_the_grid():
    field = ritz_field(Sheet(), SineWave(), degree=15)
    rng = np.random.default_rng(1)
    x, y, t = rng.uniform(-0.25, 0.25, 40), rng.uniform(-0.5, 0.5, 40), rng.uniform(0, 1, 40)
    scattered = field.strain(x, y, t)
    single = np.stack([field.strain(*p) for p in zip(x, y, t, strict=True)], axis=1)
    np.testing.assert_allclose(scattered, single, atol=1e-13)


def test_motion_holds_the_values_at_its_points():
    for wave in (
        SineWave(),
        FieldWave(lambda x, y, t: np.sin(6 * (y - t)) * (1 + x), period=np.pi / 3),
    ):
        field = ritz_field(Sheet(), wave, degree=13)
        times = np.array([0.0, 0.3, 0.4])
        motion = field.motion(times, CellGrid.uniform(field.sheet, 2, 3, half=False), 3)
        x, y = motion.position
        for i, t in enumerate(times):
            np.testing.assert_allclose(motion.velocity[:, i], field.velocity(x, y, t), atol=1e-12)
            np.testing.assert_allclose(
                motion.dilation[i], field.strain(x, y, t)[:2].sum(axis=0), atol=1e-12
            )
    assert ritz_field(Sheet(), SineWave(), degree=5).mirrored
    assert not field.mirrored


def test_stress_is_hooke_of_the_elastic_strain():
    field = ritz_field(Sheet(), SineWave(), degree=9)
    strain, growth = field.strain(0.1, 0.2, 0.3), field.wave.value(0.1, 0.2, 0.3)
    np.testing.assert_allclose(
        field.stress(0.1, 0.2, 0.3), hooke.stress(strain, growth, 0.5), rtol=1e-14
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"degree": 2}, "degree = 2: must be >= 3"),
        ({"degree": 7.5}, "degree = 7.5: must be one integer"),
        ({"degree": (5, 5, 5)}, r"degree = \(5, 5, 5\): must be one integer or \(across, along\)"),
        ({"degree": 3000}, "degree = 3000: must be smaller, its matrix has more than"),
        ({"degree": 5, "rtol": 1e-3}, "degree = 5, rtol = 0.001: must not both be given"),
        ({"rtol": 0.0}, "rtol = 0: must be in"),
        ({"rtol": np.nan}, "rtol contains nan: must be finite"),
        ({"rtol": 1e-15}, "rtol = 1e-15: must be in"),
    ],
)
def test_bad_input(arguments, message):
    with pytest.raises(ValueError, match=message):
        ritz_field(Sheet(), SineWave(), **arguments)


def test_bad_wave():
    with pytest.raises(ValueError, match="wave = 3: must be a SineWave, a TravellingWave or a"):
        ritz_field(Sheet(), 3)


def test_bad_points_and_times():
    field = ritz_field(Sheet(), FieldWave(lambda x, y, t: y * t, period=1.0), degree=3)
    with pytest.raises(ValueError, match=r"x = 0.3: must be in \[-0.25, 0.25\]"):
        field.displacement(0.3, 0, 0)
    with pytest.raises(ValueError, match="t has 600 different times: must be <= 512"):
        field.displacement(0, 0, np.linspace(0, 1, 600))


def test_a_tolerance_that_needs_too_much_memory_is_refused_with_the_best_field(monkeypatch):
    monkeypatch.setattr(ritz, "MOST_NUMBERS", 15_000)
    with pytest.raises(NotConvergedError, match="rtol = 1e-10: requires degrees"):
        ritz_field(Sheet(), SineWave(), rtol=1e-10)
    rough = FieldWave(lambda x, y, t: np.sign(y - 0.1 + 0 * t), period=1.0)
    with pytest.raises(NotConvergedError) as caught:
        ritz_field(Sheet(), rough, rtol=1e-5)
    assert caught.value.best.error > 1e-5
