"""The units that are read at once, against pint's own list."""

import subprocess
import sys

import pint
import pytest

from fem_check.files.quantities import read
from fem_check.files.units import WORDS, registry, unit_named
from fem_check.sweeps.points.measures import measured

PINT = pint.UnitRegistry()


@pytest.mark.parametrize("word", sorted(WORDS))
def test_common_units_are_those_of_pint(word: str) -> None:
    found, expected = unit_named(word), PINT.parse_units(word.replace("%", "percent"))
    assert str(found) == str(expected)
    assert f"{found:~P}" == f"{expected:~P}"
    mine, theirs = (
        units.Quantity(1.0, unit).to_root_units()
        for units, unit in ((registry(), found), (PINT, expected))
    )
    assert (mine.magnitude, str(mine.units)) == (theirs.magnitude, str(theirs.units))


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
