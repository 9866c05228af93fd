"""Further runs that failed: the part of the error of V that each would have told is infinite."""

import math
from collections.abc import Mapping

FURTHER = {
    "mesh": "on a coarser mesh",
    "snaps": "with other steps",
    "feedback": "with a rougher wave",
    "contact": "with another gap between the layers",
}
"""What differs in the further run that tells a part of the error, by the name in `SpeedErrors`."""


def failed_words(errors: Mapping[str, float]) -> str:
    """Which further runs failed, for parts of the error by name; empty if none did.

    >>> from fem_check.shell.stepping.further.failed import failed_words
    >>> print(failed_words({"step": 0.1, "mesh": float("inf"), "snaps": float("inf")}))
    the runs on a coarser mesh and with other steps failed
    >>> failed_words({"step": 0.1, "mesh": float("nan")})
    ''
    """
    named = [words for name, words in FURTHER.items() if math.isinf(errors.get(name, math.nan))]
    if not named:
        return ""
    *before, last = named
    listed = f"{', '.join(before)} and {last}" if before else last
    return f"the run{'s' * bool(before)} {listed} failed"
