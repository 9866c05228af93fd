"""What `fem_check.files` offers: read by `lazy_loader` as it runs, and by type checkers."""

from .build import RunSettings, SceneFile
from .mistakes import SceneFileError
from .reading import read
from .writing import write

__all__ = ["RunSettings", "SceneFile", "SceneFileError", "read", "write"]
