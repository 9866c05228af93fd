"""The share of a body that slips one way under dry friction with a direction."""

from linear_theory.friction.law import FrictionLaw


def share_slower(law: FrictionLaw, unit: float) -> float:
    """Share of the weight with g below its level, for slip unit (g - level).

    Forward slip meets forward friction, backward slip backward friction, and the two balance: for unit
    > 0 what is below slips backward, forward/(forward + backward) of the weight.
    """
    backward, forward = law.limits
    against = forward if unit > 0 else backward
    return against / (forward + backward)
