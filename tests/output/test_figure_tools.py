"""Style, files, progress and units of the figures."""

import io
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import matplotlib
import numpy as np
import pytest
from matplotlib.image import imread

from fem_check.output import progress
from figures.common import output, records, style
from figures.draw import excitable as excitable_picture
from figures.measure import (
    directional,
    excitable,
    model_error,
    nonlinear,
    reach,
    regimes,
    saddle,
    second_order,
    turning,
)
from figures.measure.energy import errors as energy_errors
from figures.measure.energy import gaits as energy_gaits
from figures.measure.plate import bent_alone, lower_face, saddle_range
from figures.measure.plate import model_error as plate_error
from linear_theory.speed.si import Scale, speed_si
from paper.numbers import shell

ROOT = Path(__file__).resolve().parents[2]

OLD = tuple(map(int, matplotlib.__version__.split(".")[:2])) < (3, 11)
NEWER = ("-W", "ignore::DeprecationWarning") if OLD else ()
"""Packages newer than an old matplotlib deprecate what that uses."""

DRAWING = """
import sys
import numpy as np
from figures.common import style
fig = style.figure(width=style.COLUMN_CM, height=5.0)
left, right = fig.subplots(1, 2)
x = np.linspace(0, 1, 50)
for k in range(1, 9):
    left.plot(x, np.sin(k * x), label=rf"$\\alpha_{k}$")
left.set_xlabel("y / L")
left.legend()
image = right.pcolormesh(x, x, np.outer(x, x), rasterized=True)
fig.colorbar(image)
style.save(fig, "drawing", sys.argv[1], formats=("png", "pdf", "svg"))
"""


def draw(out: Path, hash_seed: str, **environment: str) -> dict[str, bytes]:
    """The files of DRAWING, drawn in a process of its own, where the order of sets differs."""
    settings = os.environ | {"PYTHONHASHSEED": hash_seed} | environment
    command = [sys.executable, "-W", "error", *NEWER, "-c", DRAWING, str(out)]
    subprocess.run(command, cwd=ROOT, env=settings, check=True)
    return {path.suffix: path.read_bytes() for path in out.iterdir()}


@pytest.fixture(scope="module")
def drawings(tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, bytes]]:
    home = tmp_path_factory.mktemp("config")
    (home / "matplotlibrc").write_text("font.size: 20\naxes.grid: True\nbackend: svg\n")
    plain = draw(tmp_path_factory.mktemp("first"), "1")
    own_taste = draw(tmp_path_factory.mktemp("second"), "2", MATPLOTLIBRC=str(home / "matplotlibrc"))
    return [plain, own_taste]


@pytest.mark.parametrize("suffix", [".png", ".pdf", ".svg"])
def test_same_figure_same_bytes_whatever_the_hash_seed_and_the_matplotlibrc(
    drawings: list[dict[str, bytes]], suffix: str
) -> None:
    first, second = drawings
    assert len(first) == 3
    assert first[suffix] == second[suffix]


def test_files_name_neither_date_nor_program(drawings: list[dict[str, bytes]]) -> None:
    for content in drawings[0].values():
        for word in (b"Software", b"CreationDate", b"<dc:date>", b"Producer", b"matplotlib.org"):
            assert word not in content


@pytest.mark.parametrize("width", [style.COLUMN_CM, style.DOUBLE_CM])
def test_a_figure_has_the_width_of_the_column(tmp_path: Path, width: float) -> None:
    fig = style.figure(width=width, height=4.0)
    fig.subplots().plot([0, 1])
    (path,) = style.save(fig, "wide", tmp_path, formats=("png",))
    pixels = imread(path).shape[1]
    assert pixels / style.STYLE["savefig.dpi"] * 2.54 == pytest.approx(width, abs=0.02)


def test_all_text_is_legible() -> None:
    sizes = {key: v for key, v in style.STYLE.items() if key.endswith("size") and "marker" not in key}
    assert len(sizes) >= 6
    assert min(sizes.values()) >= 7


def test_output_goes_to_one_place_or_where_the_user_says(tmp_path: Path) -> None:
    assert style.output_path("fig3.png") == ROOT / "figures" / "out" / "fig3.png"
    assert style.output_path("fig3.png", tmp_path) == tmp_path / "fig3.png"


def test_unknown_format_is_refused_before_anything_is_written(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"formats = .*'gif'"):
        style.save(style.figure(), "x", tmp_path, formats=("png", "gif"))
    assert not list(tmp_path.iterdir())


def test_csv_text(tmp_path: Path) -> None:
    columns = {"½": [0.1, 1 / 3], "V": np.array([-0.0, np.nan]), "n": [1, 2], "law": ["dry, 1D", "wet"]}
    path = records.write_csv(tmp_path / "new" / "data.csv", columns)
    assert path.read_bytes().decode() == '½,V,n,law\n0.1,0,1,"dry, 1D"\n0.333333333,nan,2,wet\n'


def test_csv_comes_back_to_the_digits_asked_for(tmp_path: Path) -> None:
    values = np.random.default_rng(1).normal(size=100) * 10.0 ** np.arange(-50, 50)
    for digits in (4, 9, 17):
        path = records.write_csv(tmp_path / "data.csv", {"v": values}, digits=digits)
        back = np.loadtxt(path, skiprows=1)
        np.testing.assert_allclose(back, values, rtol=0.51 * 10.0 ** (1 - digits) if digits < 17 else 0)


TABLES = [
    *(
        module.TABLE
        for module in (
            bent_alone,
            directional,
            energy_errors,
            energy_gaits,
            lower_face,
            model_error,
            nonlinear,
            plate_error,
            regimes,
            saddle,
            saddle_range,
            second_order,
            turning,
            shell,
        )
    ),
    *(reach.SPEEDS, reach.REACHES),
]


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.path.stem)
def test_tables_are_kept_as_their_command_writes_them(table: records.Table, tmp_path: Path) -> None:
    again = table.write(table.read(), tmp_path / "again.csv")
    assert again.read_bytes() == table.path.read_bytes()


def test_a_table_without_rows_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"rows of none.csv: must be one or more"):
        nonlinear.TABLE.write([], tmp_path / "none.csv")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "columns",
    [{}, {"a": [1.0], "b": [1.0, 2.0]}, {"a": [[1.0]]}, {"a": 1.0}, {"a": [1j]}, {"a": [None]}],
)
def test_csv_refuses_what_is_no_table(tmp_path: Path, columns: dict[str, object]) -> None:
    with pytest.raises(ValueError, match="column"):
        records.write_csv(tmp_path / "data.csv", columns)  # type: ignore[arg-type]
    assert not list(tmp_path.iterdir())


def test_json_text(tmp_path: Path) -> None:
    numbers = {
        "speed": np.float64(1 / 3),
        "error": np.nan,
        "modes": np.int64(20),
        "model": "eq. 11, Poisson ratio ½",
        "alphas": np.array([[0.1, -0.0]]),
        "fem": {"converged": np.True_, "times": (0, 1.5)},
    }
    path = output.write_json(tmp_path / "data.json", numbers)
    assert json.loads(path.read_text("utf-8")) == {
        "alphas": [[0.1, 0.0]],
        "error": None,
        "fem": {"converged": True, "times": [0, 1.5]},
        "model": "eq. 11, Poisson ratio ½",
        "modes": 20,
        "speed": 0.333333333,
    }
    same = output.write_json(tmp_path / "same.json", dict(reversed(numbers.items())))
    assert same.read_bytes() == path.read_bytes()


@pytest.mark.parametrize(
    ("numbers", "place"),
    [
        ({"a": {"b": [0.0, np.inf]}}, r"numbers\.a\.b\[1\] = inf"),
        ({"a": 1j}, r"numbers\.a = 1j"),
        ({"a": {1: 2}}, r"numbers\.a has keys \[1\]"),
        ({"a": object()}, r"numbers\.a = <object"),
    ],
)
def test_json_says_where_it_cannot_write(
    tmp_path: Path, numbers: dict[str, object], place: str
) -> None:
    with pytest.raises(ValueError, match=place):
        output.write_json(tmp_path / "data.json", numbers)


def test_an_interrupted_write_leaves_the_old_file_and_nothing_else(tmp_path: Path) -> None:
    path = output.write_bytes(tmp_path / "data.csv", b"old")

    def interrupted() -> None:
        with output.replacing(path) as part:
            part.write_bytes(b"ne")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


class Clock:
    """A clock that moves when told."""

    now = 100.0

    def __call__(self) -> float:
        return self.now


def test_time_left_from_the_rate_so_far() -> None:
    clock = Clock()
    progress = output.Progress("fig3", total=4, clock=clock)
    clock.now += 3
    assert progress.line() == "fig3:   0%, 3 s, time left unknown"
    clock.now += 27
    progress.advance()
    assert progress.line() == "fig3:  25%, 30 s, about 1 min 30 s left"
    clock.now += 10  # within a step the estimate counts down
    assert progress.line() == "fig3:  25%, 40 s, about 1 min 20 s left"
    progress.advance(3)
    assert progress.line() == "fig3: 100%, 40 s, about 0 s left"


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.4, "0 s"), (59.6, "1 min 00 s"), (3599.6, "1 h 00 min"), (9000, "2 h 30 min")],
)
def test_durations_in_words(seconds: float, words: str) -> None:
    assert progress._duration(seconds) == words


def test_what_is_fast_prints_nothing() -> None:
    stream = io.StringIO()
    with output.Progress("fast", total=1, stream=stream) as progress:
        progress.advance()
    assert stream.getvalue() == ""


def test_one_slow_step_still_shows() -> None:
    stream = io.StringIO()
    with output.Progress("slow", total=1, stream=stream, delay=0.01, interval=0.01):
        deadline = time.monotonic() + 30
        while not stream.getvalue() and time.monotonic() < deadline:
            time.sleep(0.005)
    lines = stream.getvalue().splitlines()
    assert lines[0] == "slow:   0%, 0 s, time left unknown"
    assert lines[-1].startswith("slow: done in ")


@pytest.mark.parametrize("total", [0, -1, np.nan, np.inf])
def test_progress_towards_nothing_is_refused(total: float) -> None:
    with pytest.raises(ValueError, match="total = "):
        output.Progress("x", total=total)


def test_si() -> None:
    assert speed_si(0.05, length_m=0.02, period_s=0.5) == pytest.approx(0.002)
    scale = Scale(length_m=0.02, period_s=0.5)
    np.testing.assert_allclose(scale.speed(np.array([0.0, -1.0])), [0.0, -0.04])
    assert scale.length(0.5) / scale.time(0.25) == pytest.approx(scale.speed(2.0))


@pytest.mark.parametrize("bad", [0.0, -1.0, np.nan, np.inf, "1", None])
def test_si_refuses_what_is_no_size(bad: float) -> None:
    with pytest.raises(ValueError, match="length_m"):
        Scale(bad, 1.0)
    with pytest.raises(ValueError, match="period_s"):
        speed_si(1.0, 1.0, bad)


def test_each_wave_along_the_sheet_is_measured_and_drawn() -> None:
    assert list(excitable_picture.LABELS) == list(excitable.WAVES)
    assert list(dict.fromkeys(row.preset for row in excitable.TABLE.read())) == list(excitable.WAVES)
