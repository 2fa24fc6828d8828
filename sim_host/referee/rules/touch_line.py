"""Ball over the touch line: a throw-in for the opponents of the robot that touched it last.

Section: restarts, throw-in.
Measures: the place where the whole ball had passed the line, in the air or on the ground, on the straight way between
two ticks; and the robot that touched it last. A ball that no robot has touched since START is dropped.
Not judged: which of two robots that touched the ball in the same step intended to play it.
"""

from schemas.game import Phase
from sim_host.referee.game.decision import Decision
from sim_host.referee.rules.out import ball_out
from sim_host.referee.situation import Line, Situation


def judge(situation: Situation) -> Decision | None:
    """A throw-in at the crossing point, a drop ball there if no robot has touched the ball, or None."""
    crossing, robot = situation.crossing, situation.state.last_touch
    if crossing is None or crossing.line is not Line.TOUCH:
        return None
    if robot is None:
        return ball_out(situation, crossing, Phase.DROP_BALL, None)
    return ball_out(situation, crossing, Phase.THROW_IN, situation.match.roster.side_of(robot).opponent)
