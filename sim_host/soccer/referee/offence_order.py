"""Which of several offences of one kind in one tick is decided: the worst one, and never the first of the roster.

Of equally bad offences it is the one nearest to the ball, then that of the side that kicked off this half, which the
other side then does in the next half (ours), then that of the robot that comes first in its own side. The order is the
same for both sides: in a mirrored match it is the mirrored offence.
"""

from collections.abc import Callable, Sequence
from typing import TypeVar

from sim_host.soccer.referee.situation import Situation

Offence = TypeVar("Offence")


def worst_first(
    situation: Situation,
    offences: Sequence[Offence],
    measured: Callable[[Offence], float],
    offender: Callable[[Offence], int],
) -> Sequence[Offence]:
    """The offences in the order in which they are decided.

    Args:
        situation: the tick in which they were found.
        offences: offences of one kind, in the order of the roster.
        measured: the quantity that broke the rule, or may do so; the greater, the worse.
        offender: the robot that commits an offence, by its index in the roster.
    """
    if len(offences) < 2:
        return offences
    robots, ball, sides = situation.snapshot.robots, situation.snapshot.ball, situation.match.roster.sides

    def order(offence: Offence) -> tuple[float, float, bool]:
        index = offender(offence)
        x, y = robots[index].x - ball.x, robots[index].y - ball.y
        return -measured(offence), x * x + y * y, sides[index] is not situation.state.kick_off

    return sorted(offences, key=order)
