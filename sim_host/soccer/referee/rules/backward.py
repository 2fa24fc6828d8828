"""Backward dribble: a robot may drive backward with the ball for a short distance, and a long one only once.

A movement longer than `backward_once` may not be repeated until the ball was visibly released, or a new struggle with
an opponent has lasted long enough. The other side gets a free kick.

Section: play, backward dribble.
Measures: the distance against the kick axis, integrated from the robot's velocity while it has the ball; half a second
without backward motion ends a movement.
Not judged: driving sideways, and turning with the ball.
"""

from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules.foul import exceeds, foul, is_called
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side where the ball is, or None."""
    dribble = situation.state.evidence.dribble
    if dribble is None or not dribble.backward:
        return None
    handling, way = situation.match.book.handling, dribble.backward
    limit = handling.backward_again if dribble.spent else handling.backward_distance
    if not exceeds(way, limit) or not is_called(situation, "backward"):
        return None
    again = " again without having released the ball" if dribble.spent else ""
    text = f"{dribble.robot} dribbled {way:.2f} m backward{again}, limit {limit:.2f}"
    return foul(situation, "backward", (dribble.robot,), text, (way, limit, "m"))
