"""Scene files: read, checked and written, with their units and settings."""

# Read by lazy_loader as it runs, and by type checkers.

from .mistakes import SceneFileError
from .parts.scene_file import RunSettings, SceneFile
from .reading import read
from .writing import write

__all__ = ["RunSettings", "SceneFile", "SceneFileError", "read", "write"]
