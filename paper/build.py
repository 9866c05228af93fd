"""Sets the write-up as a PDF, with Typst.

    python -m paper.build [--out FILE] [--pages FOLDER] [--figures FOLDER]

Writes paper/out/sheetcrawl.pdf: the same bytes for the same input. Fonts are those that come with Typst
and nothing is fetched. A file that the text reads and that is missing stops the build, which names the
command that makes it. --pages also writes every page as a PNG.
"""

import re
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import typst

from figures.common import output
from figures.common.command import parser

ROOT = Path(__file__).resolve().parent.parent
MAIN = ROOT / "paper" / "paper.typ"
PATH = ROOT / "paper" / "out" / "sheetcrawl.pdf"
FIGURES = "figures/out"

PAGE_PPI = 200.0
"""Resolution of the pages as PNG: below it, words in figures lose parts of their letters."""

COMMANDS = {
    "docs/hard_cases.json": "python -m tests.robust.hard_cases_page",
    "linear_theory/data/model_error.csv": "python -m figures.measure.model_error",
    "paper/generated/numbers.json": "python -m paper.numbers",
    "paper/generated/derivations.json": "python -m paper.derive",
    "paper/generated/shell.csv": "python -m paper.numbers.shell",
    "figures/data/second_order.csv": "python -m figures.measure.second_order",
    "figures/data/reach.csv": "python -m figures.measure.reach",
    "figures/data/turning.csv": "python -m figures.measure.turning",
    "figures/data/cost.csv": "make cost",
    "figures/data/saddle.csv": "python -m figures.measure.saddle",
    "figures/data/saddle_range.csv": "python -m figures.measure.plate.saddle_range",
    "figures/data/lower_face.csv": "python -m figures.measure.plate.lower_face",
    "figures/data/excitable.csv": "python -m figures.measure.excitable",
    "figures/data/gait_map.csv": "python -m figures.measure.paper.gait_map",
    "figures/data/decisive.csv": "python -m figures.measure.paper.decisive",
    "figures/data/trapezoids.csv": "python -m figures.measure.paper.trapezoids",
    "figures/data/terrain.csv": "make gaits",
    "figures/data/energy_gaits.csv": "python -m figures.measure.energy.gaits",
    "figures/data/energy_error.csv": "python -m figures.measure.energy.errors",
    "figures/data/gradients.csv": "python -m figures.measure.gradient",
    "figures/data/best_waves.csv": "python -m figures.measure.optimise.line",
    "figures/data/optimisation_buys.csv": "python -m figures.measure.optimise.buys",
    "figures/data/best_outlines.csv": "python -m figures.measure.optimise.outlines",
    "figures/data/best_numbers.csv": "python -m figures.measure.optimise.scan",
    "figures/data/random_trials.csv": "python -m tests.robust.trials.table",
    "figures/data/peers.csv": "make peers",
    "figures/data/validation.csv": "python -m figures.measure.validation",
    "docs/validation.md": "python -m figures.validation.page",
}
"""What makes the files that the text reads; `make figures` makes those of FIGURES."""

INCLUDE = re.compile(r'^[ \t]*#(?:include|import) "([^"]+)"', re.MULTILINE)
DATA = re.compile(r'"/((?:paper|figures|docs|linear_theory)/[^"]+\.(?:json|csv|md))"')
IMAGE = re.compile(r'sys\.inputs\.figures \+ "/([^"]+)"')


class MissingInputError(FileNotFoundError):
    """A file that the text reads is not there."""


def sources(start: Path = MAIN) -> list[Path]:
    """The Typst files of the text: `start` and all that it includes."""
    found = [start]
    for path in found:
        for name in INCLUDE.findall(path.read_text()):
            inner = (path.parent / name).resolve()
            if inner not in found:
                found.append(inner)
    return found


def inputs(figures: str = FIGURES, start: Path = MAIN) -> Iterator[tuple[str, str]]:
    """Files that the text reads, relative to the root, each with the command that makes it."""
    for path in sources(start):
        text = path.read_text()
        for name in DATA.findall(text):
            yield name, COMMANDS.get(name, "make figures")
        for name in IMAGE.findall(text):
            yield f"{figures}/{name}", "make figures"


def check_inputs(figures: str = FIGURES, root: Path = ROOT, start: Path = MAIN) -> None:
    """Raise MissingInputError, naming every missing file and its command."""
    missing = [
        f"{name}: `{command}` makes it"
        for name, command in dict(inputs(figures, start)).items()
        if not (root / name).exists()
    ]
    if missing:
        raise MissingInputError(
            "the write-up reads files that are not there:\n  " + "\n  ".join(missing)
        )


def compiler(figures: str = FIGURES) -> typst.Compiler:
    """Typst with its own fonts, reading below the root only."""
    return typst.Compiler(
        str(MAIN), root=str(ROOT), ignore_system_fonts=True, sys_inputs={"figures": f"/{figures}"}
    )


def pdf(figures: str = FIGURES) -> bytes:
    """The write-up. Raises MissingInputError, or ValueError where Typst warns."""
    check_inputs(figures)
    content, warnings = compiler(figures).compile_with_warnings(format="pdf", timestamp=0)
    if warnings:
        raise ValueError("Typst warns: " + "; ".join(warning.message for warning in warnings))
    assert isinstance(content, bytes)
    return content


def pages(figures: str = FIGURES, ppi: float = PAGE_PPI) -> list[bytes]:
    """The pages as PNG."""
    check_inputs(figures)
    made = compiler(figures).compile(format="png", ppi=ppi, timestamp=0)
    return made if isinstance(made, list) else [made] if made else []


def main(arguments: Sequence[str] | None = None) -> int:
    """Set the text; returns 1 where something is missing."""
    settings = {"figures": (FIGURES, "folder of the figures, relative to the root")}
    made = parser("python -m paper.build", __doc__, PATH, **settings)
    made.add_argument("--pages", type=Path, metavar="FOLDER", help="also write every page as PNG")
    options = made.parse_args(arguments)
    try:
        print(output.write_bytes(options.out, pdf(options.figures)))
        for number, page in enumerate(pages(options.figures) if options.pages else [], 1):
            print(output.write_bytes(options.pages / f"{number:02d}.png", page))
    except MissingInputError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
