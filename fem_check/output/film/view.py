"""From where a film looks at the sheet."""

from enum import StrEnum

from linear_theory.common import validation


class View(StrEnum):
    """TOP, from above; SPACE, in space from the side and above, with a side view to scale. Raises
    ValueError for another name.

    >>> from fem_check.output import View
    >>> print(View("space"), View.named(None, components=2))
    space top
    """

    TOP = "top"
    SPACE = "space"

    @classmethod
    def named(cls, value: object, components: int) -> "View":
        """A view or its name; None is SPACE for a sheet that leaves the plane, else TOP."""
        if value is None:
            return cls.SPACE if components == 3 else cls.TOP
        return cls(validation.choice("view", value, tuple(cls)))
