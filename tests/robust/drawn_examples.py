"""Settings of property tests: the same examples in every run, however busy the machine."""

from collections.abc import Callable

from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers


def without_local_constants() -> None:
    """Keep hypothesis from drawing numbers that it reads in the modules of the project.

    Those are the modules that happen to be loaded: a test would see other examples alone than with all
    others, where a failure could not be found again.
    """
    if hasattr(providers, "_get_local_constants"):
        providers._get_local_constants = lambda: providers._local_constants


without_local_constants()


def examples(count: int) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Settings for that many examples."""
    return settings(
        max_examples=count,
        deadline=None,
        derandomize=True,
        database=None,
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
    )
