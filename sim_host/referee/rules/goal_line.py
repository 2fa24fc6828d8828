"""Ball over the goal line outside the goal: a corner if a defender touched it last, a goal kick if an attacker did.

A ball that the attackers kicked from their own half and that grazes a defender on its way out is a goal kick, too.

Section: restarts, corner and goal kick; play, scoring.
Measures: the place where the whole ball had passed the line, who touched it last, and where the ball was at the last
touch of the side that held or kicked it last.
Not judged: whether a defender meant to touch it; a defender who held or kicked it has.
"""

from schemas.game import Phase
from schemas.side import Side
from sim_host.referee.decision import Decision
from sim_host.referee.rules.foul import is_called, is_own_half
from sim_host.referee.rules.goal import is_in_goal
from sim_host.referee.rules.out import ball_out
from sim_host.referee.scene import Line, Scene


def judge(scene: Scene) -> Decision | None:
    """A corner, a goal kick, a drop ball when nobody touched the ball, or nothing."""
    crossing, robot = scene.crossing, scene.state.last_touch
    if crossing is None or crossing.line is not Line.GOAL or is_in_goal(scene, crossing):
        return None
    if robot is None:
        return ball_out(scene, crossing, Phase.DROP_BALL, None)
    side = scene.match.roster.side_of(robot)
    if scene.state.attack(side) * crossing.x > 0:
        return ball_out(scene, crossing, Phase.GOAL_KICK, side.opponent)
    if _kicked_from_afar(scene, side.opponent):
        return ball_out(scene, crossing, Phase.GOAL_KICK, side)
    return ball_out(scene, crossing, Phase.CORNER, side.opponent)


def _kicked_from_afar(scene: Scene, attackers: Side) -> bool:
    """Whether the attackers played the ball last but for a touch in passing, and from their own half."""
    play = scene.state.evidence.play
    touch = play.of(attackers)
    return (
        is_called(scene, "own_half_goal")
        and play.control is attackers
        and touch is not None
        and is_own_half(scene, attackers, touch.place[0])
    )
