"""Failures of a run that has its answer."""

from linear_theory.common.errors import SheetcrawlError


class NotWrittenError(SheetcrawlError, OSError):
    """A file of a run could not be written, as on a full disk; `block` is the answer, in words."""

    def __init__(self, message: str, block: str = "") -> None:
        super().__init__(message)
        self.block = block
