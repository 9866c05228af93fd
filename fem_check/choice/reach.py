"""How wide a flat sheet may be for the levels that `predict` tries."""

from linear_theory.scene.scene import Scene

WIDEST = 20.0
"""Lengths, up to which a flat sheet may be wide for the levels that are not in ANY_WIDTH."""

ANY_WIDTH = ("strip", "first order")


def check_width(scene: Scene, method: str) -> None:
    """Raise ValueError for a flat sheet so wide that its edge layers would take minutes.

    method: of `predict`.
    """
    sheet = scene.sheet
    if scene.planar and method not in ANY_WIDTH and sheet.width > WIDEST * sheet.length:
        raise ValueError(
            f"width = {sheet.width:g}: must be <= {WIDEST:g} times the length, {sheet.length:g}, for "
            f"method = {method!r}; only 'first order' answers wider sheets, as far as that theory holds"
        )
