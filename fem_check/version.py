"""The version, looked up when it is asked for: `import fem_check` loads nothing."""

from linear_theory.common.version import current_version

__version__ = current_version()
