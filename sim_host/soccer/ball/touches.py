"""Touches of the ball in one physics step: which robots touch it, in which order, and which touch counts as the last.

A later step is a later touch. Within a step the hardest press is the last touch, since it determines the motion of the
ball. Robots that press equally hard have touched the ball at the same time: they are level, and none is the last. The
order of the roster decides nothing.
"""

from collections.abc import Mapping
from typing import NamedTuple


class StepTouches(NamedTuple):
    """The touches of one step; robots by their index in the roster."""

    robots: list[int]
    """In the order of their touches."""
    level: tuple[int, ...] = ()
    """The last robots of them, if several were equally late and pressed equally hard."""


def by_force(forces: Mapping[int, float], holder: int | None, tie: float) -> StepTouches:
    """The touches by force: a robot touches the ball if it presses on it or holds it.

    Args:
        forces: robot → normal force on the ball in N.
        holder: the robot that holds the ball, with or without a contact.
        tie: forces are equal if they differ by less than this share of the larger one.
    """
    pressing = {robot: force for robot, force in forces.items() if force > 0.0 or robot == holder}
    if holder is not None:
        pressing.setdefault(holder, 0.0)
    if len(pressing) < 2:
        return StepTouches(list(pressing))
    order = sorted(pressing, key=pressing.__getitem__)
    hardest = pressing[order[-1]]
    level = tuple([robot for robot in order if hardest - pressing[robot] <= tie * hardest])
    return StepTouches(order, level if len(level) > 1 else ())
