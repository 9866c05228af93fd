"""Folders show the way of the data: imports run one way, and every option is implemented once."""

import ast
import inspect
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import ModuleType

import pytest

import fem_check
import linear_theory
from fem_check.shell.effects.effect import Effect
from linear_theory.friction.law import FrictionLaw
from linear_theory.growth.laws import GrowthLaw

ROOT = Path(__file__).parents[2]

LAYERS = (
    *(f"linear_theory.{part}" for part in ("common", "identity", "sheet", "wave", "growth")),
    *(f"linear_theory.{part}" for part in ("friction", "motion", "deformation", "energy", "scene")),
    *(f"linear_theory.{part}" for part in ("balance", "speed", "gradient", "line", "optimisation")),
    "linear_theory",
    *(f"fem_check.{part}" for part in ("version", "scene", "mesh", "plane_stress", "outlines")),
    "fem_check.excitable",
    *(f"fem_check.shell.{part}" for part in ("material", "kinematics", "effects", "statics")),
    *(
        f"fem_check.shell.{part}"
        for part in ("model", "depth", "abilities", "coupling", "cycle", "stepping")
    ),
    *(
        f"fem_check.{part}"
        for part in (
            "answer",
            "choice",
            "output",
            "files",
            "runs",
            "sweeps",
            "optimisation",
            "explorer",
            "command",
        )
    ),
    "fem_check",
    "figures",
    "paper",
    "docs",
)
"""Each imports from itself and from those before it; the first that fits a module is its layer."""


TOPS = ("linear_theory", "fem_check", "figures", "paper", "docs")


def modules() -> Iterator[tuple[str, Path]]:
    for top in TOPS:
        for path in sorted((ROOT / top).rglob("*.py")):
            yield ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__"), path


MODULES = dict(modules())


@cache
def parsed(name: str) -> ast.Module:
    """Parsed when a test asks: the files are listed by every process that collects tests."""
    return ast.parse(MODULES[name].read_text())


def layer(name: str) -> int:
    """Of a module, the most special one: "linear_theory" alone is its list of names."""
    fits = [i for i, part in enumerate(LAYERS) if name == part or name.startswith(f"{part}.")]
    return max(fits, key=lambda i: len(LAYERS[i]))


def imported(tree: ast.Module) -> Iterator[str]:
    """Modules of the project that are imported, anywhere but for type checkers."""
    skipped = {
        id(inner)
        for node in ast.walk(tree)
        if isinstance(node, ast.If) and getattr(node.test, "id", "") == "TYPE_CHECKING"
        for inner in ast.walk(node)
    }
    for node in ast.walk(tree):
        if id(node) in skipped:
            continue
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names if alias.name.split(".")[0] in TOPS)
        if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] in TOPS:
            whole = [f"{node.module}.{alias.name}" for alias in node.names]
            yield from (name if name in MODULES else node.module for name in whole)


@pytest.mark.parametrize("name", MODULES)
def test_no_import_points_upward(name: str) -> None:
    above = [other for other in imported(parsed(name)) if layer(other) > layer(name)]
    assert not above


def test_modules_do_not_import_each_other_in_a_circle() -> None:
    graph = {name: set(imported(parsed(name))) - {name} for name in MODULES}
    done: set[str] = set()

    def visit(name: str, path: tuple[str, ...]) -> None:
        assert name not in path, " -> ".join((*path, name))
        if name not in done:
            for other in graph.get(name, ()):
                visit(other, (*path, name))
            done.add(name)

    for name in graph:
        visit(name, ())


def test_no_long_rows_of_loose_files() -> None:
    for folder in {path.parent for top in (*TOPS, "tests") for path in (ROOT / top).rglob("*.py")}:
        files = [path for path in folder.glob("*.py") if path.name != "__init__.py"]
        assert len(files) <= 16, f"{folder.relative_to(ROOT)} has {len(files)} files"


OPTIONS = {
    "growth law": (GrowthLaw, ("linear_theory.growth.laws",)),
    "friction law": (
        FrictionLaw,
        # of the size of slip; with a direction; of law and map; and face; of opposite velocities
        tuple(
            f"linear_theory.friction.{part}"
            for part in ("laws", "directional", "maps", "wrapped", "law")
        ),
    ),
}


@pytest.mark.parametrize("option", OPTIONS)
def test_laws_are_classes_of_few_files(option: str) -> None:
    kind, homes = OPTIONS[option]
    found, left = set(), [kind]
    while left:
        classes = left.pop().__subclasses__()
        laws = [c for c in classes if not inspect.isabstract(c)]
        found |= {c.__module__ for c in laws if c.__module__.split(".")[0] in TOPS}
        left += classes
    assert found == set(homes)


WORDS = {
    # the names of an option, in quotes, may stand where it is defined, in the signature of a façade and
    # in the choices of the command: nowhere is a text compared with them
    "growth law": ("exp", "linear", "metric"),
    "friction": ("coulomb", "tanh"),  # "viscous" is a regime, too
    "load": ("current", "grown", "material"),
    "area": ("grown", "undeformed"),
}


@pytest.mark.parametrize("option", WORDS)
def test_no_option_is_interpreted_as_a_string(option: str) -> None:
    """No comparison with the name of an option, no table by its names, outside of its definition."""
    faults = []
    for name in MODULES:
        if not name.startswith(("linear_theory", "fem_check")):
            continue
        for node in ast.walk(parsed(name)):
            parts: list[ast.expr | None] = []
            if isinstance(node, ast.Compare):
                parts = [node.left, *node.comparators]
            elif isinstance(node, ast.Dict):
                parts = list(node.keys)
            words = {part.value for part in parts if isinstance(part, ast.Constant)}
            if words & set(WORDS[option]):
                faults.append(f"{name}:{node.lineno}")
    assert not faults


def test_nobody_asks_of_which_class_an_effect_is() -> None:
    """Outside of the effects: of three, by `find`, the fields that only they have are read."""
    names = "|".join(kind.__name__ for kind in Effect.__subclasses__())
    for name in MODULES:
        if name.startswith(("linear_theory", "fem_check")) and ".effects" not in name:
            text = Path(ROOT, *name.split(".")).with_suffix(".py")
            if text.exists():
                assert not re.search(rf"isinstance\([^)]*\b({names})\b", text.read_text()), name


@pytest.mark.parametrize("package", [linear_theory, fem_check], ids=lambda package: package.__name__)
def test_no_module_hides_a_public_name(package: ModuleType) -> None:
    """As `fem_check.predict` would be the folder, not the function, once a module of it is imported."""
    modules = {name.split(".")[1] for name in MODULES if name.startswith(f"{package.__name__}.")}
    assert not modules & set(package.__all__)


def test_what_a_package_with_a_marker_brings_has_that_marker() -> None:
    """Else the lock asks for a package where neither it nor the one that needs it can be installed."""
    pinned = re.split(r"\n(?=[a-z])", (ROOT / "requirements.lock").read_text())
    markers, brought = {}, {}
    for entry in pinned:
        first, *rest = entry.splitlines()
        if match := re.match(r"([\w.-]+)(\[.*\])?==[^;]+(?:; (.*))?$", first):
            markers[match[1]] = (match[3] or "").strip()
            said = re.findall(r"#\s+(?:via )?([\w.-]+)", "\n".join(rest))
            brought[match[1]] = {name for name in said if name != "via"}
    assert markers["netgen-mesher"]
    for name, by in brought.items():
        needed = {markers[other] for other in by if other in markers}
        if "sheetcrawl" not in by and needed and "" not in needed:
            assert markers[name] in needed, name
    assert markers["netgen-occt"] == markers["netgen-mesher"]
