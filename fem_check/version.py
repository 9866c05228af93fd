"""The version, determined on first use: `import fem_check` loads nothing."""

from linear_theory.common.version import current_version

__version__ = current_version()
