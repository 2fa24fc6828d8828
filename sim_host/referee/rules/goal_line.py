"""Ball over the goal line outside the goal: a corner if a defender touched it last, a goal kick if an attacker did."""

from schemas.game import Phase
from sim_host.referee.decision import Decision
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
    attacker = scene.state.attack(side) * crossing.x > 0
    return ball_out(scene, crossing, Phase.GOAL_KICK if attacker else Phase.CORNER, side.opponent)
