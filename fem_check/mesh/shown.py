"""A mesh of scikit-fem as its owner shows it: in words, and as plain data."""

from collections.abc import Mapping
from typing import Any

from linear_theory.common.shown import Shown

NAMES = {3: "triangles", 4: "quadrilaterals"}


class MeshShown(Shown):
    """Vertices (n, 2) and elements (m, 3 or 4), the numbers of their vertices."""

    def __init__(self, mesh: Any) -> None:
        self.vertices, self.elements = mesh.p.T, mesh.t.T

    def _title(self) -> str:
        count, corners = self.elements.shape
        return f"{count} {NAMES.get(corners, 'elements')}, {len(self.vertices)} vertices"

    def _contents(self) -> Mapping[str, Any]:
        return {"vertices": self.vertices, "elements": self.elements}
