"""How wide a flat sheet may be for the levels that `predict` tries."""

from linear_theory.scene.scene import Scene

WIDEST = 20.0
"""Lengths, up to which a flat sheet may be wide for the levels that are not in ANY_WIDTH.

As far as it was measured: a sine at alpha = 0.1 on sheets 5, 10 and 20 lengths wide takes 3.4, 8.7 and
27 s of a processor to 1 % by a cycle of shapes, which answers there, and 3, 19 and 30 s to second
order, which does not reach 1 %; to 0.1 % the cycle takes more than a minute at 20.
"""

ANY_WIDTH = ("strip", "line", "first order")


def check_width(scene: Scene, level: str) -> None:
    """Raise ValueError for a flat sheet wider than any whose cost was measured.

    level: of `predict`.
    """
    sheet = scene.sheet
    if scene.planar and level not in ANY_WIDTH and sheet.width > WIDEST * sheet.length:
        raise ValueError(
            f"width = {sheet.width:g}: must be <= {WIDEST:g} times the length, {sheet.length:g}, for "
            f"level = {level!r}; only 'strip', 'line' and 'first order' answer wider ones"
        )
