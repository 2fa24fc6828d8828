"""Ball over the touch line: a throw-in for the opponents of the robot that touched it last.

Section: restarts, throw-in.
Measures: the place where the whole ball had passed the line, in the air or on the ground, on the straight line between
two ticks; and the robot that touched it last, by time and force: in the same physics step the one that pressed harder.
A ball that both sides touched at the same time and equally hard (ours), or no robot since START, is dropped.
Not judged: which of two robots intended to play the ball.
"""

from schemas.soccer.game import Phase
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules.out import ball_out
from sim_host.soccer.referee.situation import Line, Situation


def judge(situation: Situation) -> Decision | None:
    """A throw-in at the crossing point, a drop ball there if neither side touched the ball last, or None."""
    crossing, robot = situation.crossing, situation.state.last_touch
    if crossing is None or crossing.line is not Line.TOUCH:
        return None
    if robot is None or situation.state.level_touches:
        return ball_out(situation, crossing, Phase.DROP_BALL, None)
    return ball_out(situation, crossing, Phase.THROW_IN, situation.match.roster.side_of(robot).opponent)
