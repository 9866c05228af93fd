"""Wheel and source distribution, built and used in clean environments without the repository.

    python -m tests.release.clean_install     # a minute; `make test-dist`

Builds both, looks for data files and types in them, installs each into a new environment with the
pinned versions of what it needs (no extras), and asks it from an empty folder: version, speed, scene
file, run. With the wheel the examples are checked by `mypy --strict`, as a user's own scripts would be.
"""

import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import venv
import zipfile
from collections.abc import Iterable
from pathlib import Path

ROOT = Path(__file__).parents[2]

SHIPPED = (".toml", ".csv", ".typed", ".pyi", ".html", ".js", ".css")
"""What a package needs beside its Python files."""

PACKAGES = ("linear_theory", "fem_check")

QUESTION = (
    "speed",
    "--length",
    "40 mm",
    "--width",
    "15 mm",
    "--period",
    "8 s",
    "--growth",
    "12 %",
    "--json",
)

SCRIPT = """
from fem_check import predict
from linear_theory import Sheet, SineWave, __version__
found = predict(Sheet(), SineWave(), alpha=0.05, rtol=1e-2)
print(__version__, 0 < found.error < 1e-2 * abs(found.mean) < abs(found.mean) < 0.1)
"""


def main() -> None:
    """Exits with the first thing that fails."""
    with tempfile.TemporaryDirectory(prefix="sheetcrawl-") as temporary:
        folder = Path(temporary)
        run([sys.executable, "-m", "build", "--no-isolation", "--outdir", folder, ROOT], folder)
        (wheel,), (source,) = folder.glob("*.whl"), folder.glob("*.tar.gz")
        with zipfile.ZipFile(wheel) as packed:
            everything_in(wheel, packed.namelist())
        with tarfile.open(source) as packed_source:
            everything_in(source, (name.partition("/")[2] for name in packed_source.getnames()))
        for distribution in (wheel, source):
            python = installed(distribution, folder / distribution.suffix.strip("."))
            answers(python, folder)
            print(f"{distribution.name}: installed and asked in a clean environment")
            if distribution is wheel:
                typed(python, folder)


def everything_in(distribution: Path, names: Iterable[str]) -> None:
    """Files of the packages that it lacks, or files of anything else in it."""
    there = set(names)
    wanted = {
        str(path.relative_to(ROOT))
        for package in PACKAGES
        for path in (ROOT / package).rglob("*")
        if path.suffix == ".py" or path.suffix in SHIPPED
    }
    if missing := sorted(wanted - there):
        sys.exit(f"{distribution.name} lacks {', '.join(missing)}")


def installed(distribution: Path, folder: Path) -> Path:
    """The interpreter of a new environment that has the distribution and what it needs, no more."""
    venv.create(folder, with_pip=True)
    python = folder / "bin" / "python"
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    run([*pip, "--constraint", ROOT / "requirements.lock", distribution], folder)
    return python


def answers(python: Path, folder: Path) -> None:
    """What a user types first, in an empty folder."""
    empty = folder / f"empty-{python.parents[1].name}"
    empty.mkdir()
    command = python.parent / "sheetcrawl"
    version = run([command, "--version"], empty)
    printed = run([python, "-c", SCRIPT], empty).split()
    if printed != [version.split()[-1], "True"]:
        sys.exit(f"answers of {python} are {printed} by version {version}")
    run([command, *QUESTION], empty)
    run([command, "new", "hydrogel"], empty)
    run([command, "run", "hydrogel.toml"], empty)
    if not (empty / "hydrogel" / "report.html").stat().st_size:
        sys.exit("the report is empty")


def typed(python: Path, folder: Path) -> None:
    """The examples, and what they import of `figures`, against the types of the installed package."""
    source = folder / "source"
    shutil.copytree(ROOT / "figures", source / "figures", ignore=shutil.ignore_patterns("data", "out"))
    mypy = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports"]
    print(run([*mypy, "--python-executable", python, "-p", "figures.examples"], source).strip())


def run(command: list[str | Path] | list[Path | str], folder: Path) -> str:
    """Output of a command that knows of no source tree. Exits where it fails."""
    free = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "VIRTUAL_ENV")}
    found = subprocess.run(
        [str(word) for word in command], cwd=folder, env=free, capture_output=True, text=True
    )
    if found.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{found.stdout}{found.stderr}")
    return found.stdout


if __name__ == "__main__":
    main()
