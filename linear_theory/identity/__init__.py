"""What identifies a value, so that it is known again in another process."""

from linear_theory.identity.content import content_key

__all__ = ["content_key"]
