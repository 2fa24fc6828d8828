"""Dribbling circle: a robot that has caught the ball may dribble it within a circle around the place of the catch.

To dribble farther, it must visibly release the ball and catch it again, which moves the circle. Otherwise the other
side gets a free kick.

Section: play, dribbling.
Measures: the straight distance between the places of the ball at the catch and now, while the robot holds it. The ball
is released when there is enough air between it and the hull, or when another robot touches it.
Not judged: whether a release was intended.
"""

import math

from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules.foul import foul, is_called
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """A free kick for the other side where the ball is, or None."""
    dribble = situation.state.evidence.dribble
    if dribble is None or situation.snapshot.possession != dribble.robot:
        return None
    way, limit = math.dist(dribble.caught, situation.ball_spot), situation.match.book.handling.circle
    if way <= limit or not is_called(situation, "dribble_circle"):
        return None
    text = f"{dribble.robot} dribbled {way:.2f} m from where it caught the ball, limit {limit:.2f}"
    return foul(situation, "dribble_circle", (dribble.robot,), text, (way, limit, "m"))
