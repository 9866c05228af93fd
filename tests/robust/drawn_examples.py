"""Settings of property tests: the same examples in every run, however busy the machine."""

from collections.abc import Callable

from hypothesis import HealthCheck, settings


def examples(count: int) -> Callable[[Callable[..., None]], Callable[..., None]]:
    """Settings for that many examples."""
    return settings(
        max_examples=count,
        deadline=None,
        derandomize=True,
        database=None,
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture],
    )
