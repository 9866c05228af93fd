"""What the site has: its pages in the order of the navigation, and the files that they come from."""

from dataclasses import dataclass
from pathlib import Path

from linear_theory.common.shown import Value

ROOT = Path(__file__).resolve().parents[2]

EXAMPLES = ROOT / "figures" / "examples"

API = (
    *("linear_theory", "linear_theory.friction.law", "linear_theory.friction.isotropic"),
    *("fem_check", "fem_check.output", "fem_check.shell.effects", "fem_check.shell.effects.effect"),
    *("fem_check.shell.material", "fem_check.files", "fem_check.runs", "fem_check.sweeps"),
    *("fem_check.optimisation", "fem_check.outlines.best", "fem_check.outlines.gradient"),
    *("fem_check.outlines.shapes", "linear_theory.line.best.dry", "linear_theory.line.best.viscous"),
)
"""Modules of the API reference, and those that the index of equations names."""


@dataclass(frozen=True)
class Page(Value):
    """A page: its section, its title in the navigation, its file, and its path in the site."""

    section: str
    title: str
    source: Path
    target: str

    @property
    def up(self) -> str:
        """The way from the page to the root of the site."""
        return "../" * self.target.count("/")


HOWTO = {
    "The sheet and its wave": {
        "own_sheet": "A sheet in millimetres",
        "measurement": "From a measurement to a movie",
        "own_wave": "A wave of your own",
        "outline": "Another outline",
    },
    "The ground": {
        "own_friction_law": "A friction law of your own",
        "friction_direction": "Friction with a direction",
        "slope": "A slope",
        "bending": "A sheet that bends",
        "energy": "What crawling costs",
    },
    "Running it": {
        "scene_file": "A scene in a file",
        "run": "A run with all its pictures",
        "movie": "A movie",
        "explorer": "A page with sliders",
        "compare_levels": "Several levels in one plot",
        "many_scenes": "Many scenes",
    },
    "The best": {
        "optimise": "The best wave, the best scene",
        "best_outlines": "The best outline",
    },
}
"""Files of docs/howto and their titles, one for each wish, by section."""

REFERENCE = {
    "Reference": {
        "conventions": "Conventions",
        "equations": "Equations of the paper",
        "saddle": "V in growth and curvature",
        "gaits": "The paper's gaits",
    },
    "How sure is it?": {
        "validation": "Checked against others",
        "hard_cases": "Hard cases",
        "reliability": "Reliability in figures",
        "peers": "Other codes, side by side",
        "sweeps": "Sweeps: kills and overhead",
        "optimisation": "What optimisation buys",
    },
}
"""Files of docs and their titles, by section."""


def scripts() -> dict[str, Path]:
    """The examples by name, the first speed first."""
    found = sorted(path for path in EXAMPLES.glob("*.py") if path.stem != "__init__")
    return {path.stem: path for path in sorted(found, key=lambda path: path.stem != "first_speed")}


def pages() -> list[Page]:
    """All pages but those of the API."""
    docs = ROOT / "docs"
    start = [
        Page("Start", "sheetcrawl", ROOT / "README.md", "index.html"),
        Page("Start", "Tutorial", docs / "tutorial.md", "tutorial.html"),
        Page("Start", "Which call, which level", docs / "levels.md", "levels.html"),
    ]
    howto = [
        Page(section, title, docs / "howto" / f"{name}.md", f"howto/{name}.html")
        for section, titles in HOWTO.items()
        for name, title in titles.items()
    ]
    examples = [
        Page("Examples", "All examples", EXAMPLES / "__init__.py", "examples/index.html"),
    ]
    examples += [
        Page("Examples", name.replace("_", " ").capitalize(), path, f"examples/{name}.html")
        for name, path in scripts().items()
    ]
    reference = [
        Page(section, title, docs / f"{name}.md", f"{name}.html")
        for section, titles in REFERENCE.items()
        for name, title in titles.items()
    ]
    return [*start, *howto, *examples, *reference]
