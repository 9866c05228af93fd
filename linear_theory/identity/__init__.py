"""Content keys, by which a value is recognised in another process."""

from linear_theory.identity.content import content_key

__all__ = ["content_key"]
