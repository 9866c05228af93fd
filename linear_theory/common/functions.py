"""Functions that a user gives: that they can be called as they will be."""

import inspect
from collections.abc import Callable
from typing import Any

import numpy as np

from linear_theory.common.validation import shown


def callable_with(
    name: str, function: Any, signature: str, count: int, hint: str = ""
) -> Callable[..., Any]:
    """`function`, which must take `count` arguments by their order.

    signature: these arguments in words, for the message; hint: what they are. Functions whose signature
    Python does not know, compiled ones, are accepted, and fail where they are called.
    Raises ValueError, naming the argument and what it is, for anything else.

    >>> from linear_theory.common.functions import callable_with
    >>> callable_with("height", lambda x, y: x * y, "(x, y)", 2)(2, 3)
    6
    >>> callable_with("height", lambda x: x, "(x, y)", 2)
    Traceback (most recent call last):
    ...
    ValueError: height has the signature (x): must be (x, y)
    """
    more = f", {hint}" if hint else ""
    if not callable(function):
        raise ValueError(f"{name} = {shown(function)}: must be a function, {signature}{more}")
    if isinstance(function, np.ufunc):  # its further arguments by order would be results
        own, fits = f"of {function.nin} arguments", function.nin == count
    else:
        own, fits = _signature(function, count)
    if not fits:
        raise ValueError(f"{name} has the signature {own}: must be {signature}{more}")
    return function


def _signature(function: Callable[..., Any], count: int) -> tuple[str, bool]:
    """In words, and whether it can be called with `count` arguments; as far as Python knows it."""
    try:
        own = inspect.signature(function)
    except (ValueError, TypeError):
        return "", True
    try:
        own.bind(*range(count))
    except TypeError:
        return str(own), False
    return str(own), True
