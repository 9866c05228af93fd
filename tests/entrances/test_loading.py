"""What the command loads before it answers: only what the answer needs."""

import subprocess
import sys

import pytest

SPEED = ("--growth", "12 %", "--length", "40 mm", "--period", "8 s", "--width", "16 mm")


@pytest.mark.parametrize(
    ("arguments", "absent"),
    [
        (("--version",), ("numpy", "pydantic", "pint")),
        (("speed", *SPEED, "--level", "strip"), ("skfem", "shapely", "pydantic", "matplotlib")),
        (("speed", *SPEED, "--level", "first order"), ("skfem", "shapely", "pydantic", "matplotlib")),
        (("speed", *SPEED, "--rtol", "0.2"), ("pydantic", "matplotlib")),
    ],
    ids=["version", "strip", "first order", "cheapest"],
)
def test_what_is_not_needed_is_not_loaded(arguments: tuple[str, ...], absent: tuple[str, ...]) -> None:
    """Finite elements, scene files and pictures take half a second or more each to load."""
    script = (
        "import sys\nfrom fem_check.command import main\n"
        f"sys.argv[1:] = {list(arguments)!r}\n"
        "try:\n    main()\nexcept SystemExit:\n    pass\n"
        f"print(*(name for name in {absent!r} if name in sys.modules), file=sys.stderr)\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout
    assert done.stderr.split() == []
