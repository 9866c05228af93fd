"""The command `sheetcrawl`: the speed of a sheet from the shell.

    sheetcrawl                                    examples and a list of commands
    sheetcrawl speed --growth "12 %"              the paper's sheet and wave, to 1 %
    sheetcrawl explore                            a page with sliders
    sheetcrawl --alpha 0.25 --width 0.2 --json    the old spelling, the same as `sheetcrawl speed ...`

Exit status: 0 if the tolerance is met, 1 if it is not or the answer cannot be written, 2 for bad
arguments, 130 after Ctrl-C, 143 after SIGTERM (which ends it in the same way), 141 if the reader of the
answer has closed it (`sheetcrawl ... | true`).
Warnings go to stderr, one line each. Slow imports are deferred until they are needed.
"""

from fem_check.command.program import main
from fem_check.command.status import BAD_ARGUMENTS, CLOSED_PIPE, INTERRUPTED, MET, MISSED, TERMINATED

__all__ = ["BAD_ARGUMENTS", "CLOSED_PIPE", "INTERRUPTED", "MET", "MISSED", "TERMINATED", "main"]
