"""A promised pass: its receiver, from the radio or from the robot itself, for a limited time."""

from typing import NamedTuple

from robot_agent.sdk.world_model import WorldBelief

LASTS = 2.0
"""s for which a receiver expects the promised pass."""


class Promise(NamedTuple):
    """The receiver of the ball, and for how many s more."""

    receiver: str
    left: float = LASTS


def promise_after(before: Promise | None, belief: WorldBelief) -> Promise | None:
    """The last promise after one more sight; a newer one, time, or the ball in this robot's hold ends it."""
    kept = None
    if before is not None and before.left > belief.dt and not belief.holding:
        kept = before._replace(left=before.left - belief.dt)
    for mate in belief.mates.values():
        if mate.pass_to is not None:
            kept = Promise(mate.pass_to)
    return kept
