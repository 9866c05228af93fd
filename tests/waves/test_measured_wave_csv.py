"""Text files as they come from spreadsheets and cameras: delimiters, names, units, decimal commas."""

import numpy as np
import pytest

from linear_theory import SampledWave

Y, T = (a.ravel() for a in np.meshgrid(np.linspace(-0.5, 0.5, 12), np.arange(10) / 10, indexing="ij"))
C = np.sin(2 * np.pi * (Y - T))
EXACT = SampledWave(Y, T, C, period=1.0)


def table(head, delimiter=",", mark=".", more=()):
    rows = [
        delimiter.join(repr(float(v)).replace(".", mark) for v in row)
        for row in zip(Y, T, C, strict=True)
    ]
    return "\n".join([head, *rows, *more]) + "\n"


@pytest.fixture
def read(tmp_path):
    def from_text(text, encoding="utf-8", **options):
        path = tmp_path / "wave.csv"
        path.write_bytes(text.encode(encoding))
        return SampledWave.from_csv(path, period=1.0, **options)

    return from_text


GOOD = {
    "commas": table("y,t,c"),
    "semicolons": table("y;t;c", ";"),
    "tabs": table("y\tt\tc", "\t"),
    "capitals": table("Y, T, C"),
    "units": table("y [mm],t (s),c [-]"),
    "decimal commas": table("y;t;c", ";", ","),
    "decimal commas and tabs": table("y\tt\tc", "\t", ","),
    "a comma in a name": table("y [mm, from centre];t;c", ";"),
    "commas at the ends": table("y,t,c").replace("\n", ",\n"),
    "remarks": "# camera 2\n" + table("y,t,c", more=["# end"]),
    "lines of Windows": table("y,t,c").replace("\n", "\r\n"),
    "quotes": table('"y","t","c"'),
}


@pytest.mark.parametrize("kind", GOOD)
def test_is_read_without_options(read, kind):
    assert read(GOOD[kind]).value(0.0, 0.1, 0.2) == EXACT.value(0.0, 0.1, 0.2)


def test_a_unit_in_another_encoding(read):
    assert read(table("y [µm];t;c", ";"), "latin-1").noise == EXACT.noise


@pytest.mark.parametrize(("unit", "factor"), [("[%]", 0.01), ("(percent)", 0.01), ("[‰]", 0.001)])
def test_growth_in_per_cent_is_converted(unit, factor, read):
    wave = read(table(f"y [mm],t [s],c {unit}"))
    np.testing.assert_allclose(wave.value(0.0, 0.1, 0.2), factor * EXACT.value(0.0, 0.1, 0.2))


def test_exact_names_come_first(read):
    assert read(table("y,t,c,C").replace("\n", ",0\n").replace("C,0", "C")).noise == EXACT.noise


BAD = {
    "a value too many": (
        table("y,t,c", more=["-20,1,1,1"]),
        "line 122 has 4 values, .* names 3: must be",
    ),
    "decimal commas between commas": (table("y,t,c", mark=","), "line 2 has 6 values.*by semicolons"),
    "a value too few": (table("y,t,c", more=["-20,1"]), "line 122, column 'c' has nothing"),
    "two marks": (table("y;t;c", ";", ",", ["0.5;0;0"]), "line 122, column 'y' has '0.5', but .* ','"),
    "thousands": (table("y;t;c", ";", ".", ["0;0;1,234.5"]), "has '1,234.5', but .* must be the same"),
    "spaces": (table("y t c", " "), "no column 'y', but y t c: columns must be separated by commas"),
    "no names": (table("# y,t,c"), "no column 'y'.* named in the first line, y,t,c"),
    "nothing": ("", "no column 'y', but none"),
    "names only": ("y,t,c\n", "c has 0 samples: must have >= 16"),
    "an open quote": (table("y,t,c", more=['"0,1,2']), "line 122 is no line of a table"),
    "one name twice": (table("Y,y [mm],t,c"), "has several columns 'y': Y, y .mm.; must have one"),
    "too large": (table("y,t,c", more=["0,0,1e300"]), "c reaches 1e.300: must be between"),
}


@pytest.mark.parametrize("kind", BAD)
def test_is_refused_by_line_or_name(read, kind):
    text, message = BAD[kind]
    with pytest.raises(ValueError, match=message):
        read(text)


def test_delimiters_of_more_characters(read):
    with pytest.raises(ValueError, match="delimiter = ';;': must be one character"):
        read(GOOD["commas"], delimiter=";;")
