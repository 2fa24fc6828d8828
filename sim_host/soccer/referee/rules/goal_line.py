"""Ball over the goal line outside the goal: a corner if a defender touched it last, a goal kick if an attacker did.

A ball that the attackers kicked from their own half and that grazes a defender on its way out is also a goal kick.

Section: restarts, corner and goal kick; play, scoring.
Measures: the place where the whole ball had passed the line, the robot that touched it last, by time and force, and the
place of the ball at the last touch of the side that held or kicked it last. A ball that both sides touched at the same
time and equally hard (ours), or no robot since START, is dropped.
Not judged: whether a defender intended to touch the ball; one that held or kicked it did.
"""

from schemas.side import Side
from schemas.soccer.game import Phase
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules.foul import is_called, is_own_half
from sim_host.soccer.referee.rules.goal import is_in_goal
from sim_host.soccer.referee.rules.out import ball_out
from sim_host.soccer.referee.situation import Line, Situation


def judge(situation: Situation) -> Decision | None:
    """A corner, a goal kick, a drop ball if neither side touched the ball last, or None."""
    crossing, robot = situation.crossing, situation.state.last_touch
    if crossing is None or crossing.line is not Line.GOAL or is_in_goal(situation, crossing):
        return None
    if robot is None or situation.state.level_touches:
        return ball_out(situation, crossing, Phase.DROP_BALL, None)
    side = situation.match.roster.side_of(robot)
    if situation.state.attack(side) * crossing.x > 0:
        return ball_out(situation, crossing, Phase.GOAL_KICK, side.opponent)
    if _kicked_from_afar(situation, side.opponent):
        return ball_out(situation, crossing, Phase.GOAL_KICK, side)
    return ball_out(situation, crossing, Phase.CORNER, side.opponent)


def _kicked_from_afar(situation: Situation, attackers: Side) -> bool:
    """Whether the attackers, apart from a mere touch by a defender, played the ball last, and from their own half."""
    play = situation.state.evidence.play
    touch = play.of(attackers)
    return (
        is_called(situation, "own_half_goal")
        and play.control is attackers
        and touch is not None
        and is_own_half(situation, attackers, touch.place[0])
    )
