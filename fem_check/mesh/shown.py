"""Representation of a scikit-fem mesh in words and as plain data."""

from collections.abc import Mapping
from typing import Any

from linear_theory.common.shown import Shown

NAMES = {3: "triangles", 4: "quadrilaterals"}


class MeshShown(Shown):
    """A mesh as vertices (n, 2) and elements (m, 3 or 4), as indices of vertices."""

    def __init__(self, mesh: Any) -> None:
        self.vertices, self.elements = mesh.p.T, mesh.t.T

    def _title(self) -> str:
        count, corners = self.elements.shape
        return f"{count} {NAMES.get(corners, 'elements')}, {len(self.vertices)} vertices"

    def _contents(self) -> Mapping[str, Any]:
        return {"vertices": self.vertices, "elements": self.elements}
