"""The units that are read at once, against pint's own list."""

import subprocess
import sys
from collections.abc import Sequence

import numpy as np
import pint
import pytest

from fem_check.files import units
from fem_check.files.quantities import read
from fem_check.files.units import WORDS
from fem_check.sweeps.points.measures import measured

PINT = pint.UnitRegistry()


def fresh(whole: bool) -> pint.UnitRegistry:
    """A registry as a new process has it, before or after the whole list is read."""
    found = units._made.__wrapped__()
    if whole:
        found.load_definitions(units.whole_list())
    return found


def told(registry: pint.UnitRegistry, text: str) -> tuple[str, ...] | None:
    """Name, symbol, and size in root units; None for what is no unit, or has no size."""
    try:
        unit = registry.parse_units(text.replace("%", "percent"))
        root = registry.Quantity(1.0, unit).to_root_units()
    except Exception:  # of many kinds
        return None
    return str(unit), f"{unit:~P}", repr(root.magnitude), str(root.units)


def texts(words: Sequence[str], count: int, seed: int) -> set[str]:
    random = np.random.default_rng(seed)
    joints = ("*", "/", " ", "**2/", "^-1*", "**0.5 ", " * 3/")
    return {
        "".join(f"{random.choice(words)}{random.choice(joints)}" for _ in range(random.integers(1, 4)))
        + str(random.choice(words))
        for _ in range(count)
    }


@pytest.mark.parametrize("whole", [False, True])
def test_common_units_are_those_of_pint(whole: bool) -> None:
    """Alone and in random texts, before and after the whole list was read."""
    words, registry = [*sorted(WORDS), "%"], fresh(whole)
    for text in (*words, *texts(words, 300, seed=0)):
        assert told(registry, text) == told(PINT, text), text


def test_other_units_are_those_of_pint() -> None:
    """Among them those that prefixes make ambiguous, and names with digits."""
    registry = fresh(whole=True)
    random = np.random.default_rng(1)
    names = [name for name in PINT if name.isidentifier()]
    words = [
        *random.choice(names, 150),
        "mcd",
        "mct",
        "mcc",
        "mcmil",
        "cd",
        "as",
        "Ms",
        "g0",
        "kg0",
        "Pa0",
    ]
    for text in (*words, *texts([*words, *WORDS], 150, seed=2)):
        assert told(registry, text) == told(PINT, text), text


@pytest.mark.parametrize("text", ["g0", "kg*g0/mm^2", "h%", "mcd", "cd", "Pa0", "inch", "µm·g0", "ft"])
def test_a_word_that_is_not_among_them_leads_to_the_whole_list(text: str) -> None:
    assert not WORDS.issuperset(units.WORD.findall(text.replace("%", "percent")))


def test_a_list_that_cannot_be_read_is_no_unknown_unit(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken() -> None:
        raise OSError("no list")

    monkeypatch.setattr(units, "_read_all", broken)
    with pytest.raises(OSError, match="no list"):
        read("2 inch", "length")


def test_every_example_is_of_common_units() -> None:
    """So that users who write what they are shown do not wait for the whole list."""
    check = (
        "from fem_check.files.quantities import KINDS, read\n"
        "from fem_check.files import units\n"
        "for kind in KINDS: read(KINDS[kind].example, kind)\n"
        "print(units._read_all.cache_info().misses, 'inch' in units.registry())\n"
    )
    done = subprocess.run([sys.executable, "-c", check], capture_output=True, text=True, check=True)
    assert done.stdout.split() == ["0", "False"]


@pytest.mark.parametrize(
    ("text", "kind", "unit", "expected"),
    [
        ("2 inch", "length", "mm", 50.8),
        ("1 psi", "pressure", "Pa", 4.4482216152605 / 0.0254**2),  # pound-force over inch^2, exact
        ("1 day", "time", "h", 24.0),
        ("3 inch/day", "speed", "mm/h", 3 * 25.4 / 24),
        ("90 arcmin", "angle", "deg", 1.5),
    ],
)
def test_other_units_are_in_the_whole_list(text: str, kind: str, unit: str, expected: float) -> None:
    before = read("1 mm", "length")  # named before the list is read
    found = read(text, kind)
    assert found.into(unit) == pytest.approx(expected, rel=1e-12)
    assert before.into("inch") == pytest.approx(1 / 25.4)
    assert kind != "length" or found.unit.is_compatible_with(before.unit)


@pytest.mark.parametrize("text", ["1 cd", "1 mmm", "1 m/0", "1 %%"])
def test_what_is_no_time(text: str) -> None:
    """A list that is not whole would take "cd", candela, for a hundredth of a day."""
    with pytest.raises(ValueError, match="must be a time"):
        read(text, "time")


@pytest.mark.parametrize(("text", "seconds"), [("1 Ms", 1e6), ("1 as", 1e-18), ("1 ns", 1e-9)])
def test_other_prefixes(text: str, seconds: float) -> None:
    assert read(text, "time").into("s") == pytest.approx(seconds, rel=1e-12)


@pytest.mark.parametrize("text", ["1 m**9**9**9", "2 m^9^9^9", "3 m**99999999"])
def test_a_unit_that_would_take_for_ever_is_none(text: str) -> None:
    """In scene files and on the command line, and in the lists and ranges of a sweep."""
    with pytest.raises(ValueError, match="is not a known unit"):
        read(text, "length")
    assert measured(text) is None
