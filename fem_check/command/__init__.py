"""The command `sheetcrawl`: the one question from the shell.

    sheetcrawl                                    examples, and what else there is
    sheetcrawl speed --growth "12 %"              the paper's sheet and wave, to 1 %
    sheetcrawl --alpha 0.25 --width 0.2 --json    the old spelling, the same as `sheetcrawl speed ...`

Exit status: 0 where the tolerance is met, 1 where it is not or the answer cannot be written, 2 for bad
arguments, 130 after Ctrl-C, 141 where the reader of the answer has gone (`sheetcrawl ... | true`).
Warnings go to stderr, a line each. What takes time to load is loaded when it is needed.
"""

from fem_check.command.program import main
from fem_check.command.status import BAD_ARGUMENTS, CLOSED_PIPE, INTERRUPTED, MET, MISSED

__all__ = ["BAD_ARGUMENTS", "CLOSED_PIPE", "INTERRUPTED", "MET", "MISSED", "main"]
