"""Goal: the whole ball over the goal line, between the posts and under the bar; own goals count for the other side."""

from schemas.game import EventKind
from schemas.side import Side
from sim_host.referee.decision import Decision
from sim_host.referee.flow import kick_off_after_goal
from sim_host.referee.scene import Crossing, Line, Scene
from sim_host.referee.wording import at, touched


def judge(scene: Scene) -> Decision | None:
    """A goal, or nothing."""
    crossing = scene.crossing
    if crossing is None or not is_in_goal(scene, crossing):
        return None
    scorers = next(side for side in Side if scene.state.attack(side) * crossing.x > 0)
    robot = scene.state.last_touch
    own = robot is not None and scene.match.roster.side_of(robot) is not scorers
    place = (crossing.x, crossing.y)
    what = "own goal" if own else "goal"
    return Decision(
        kind=EventKind.GOAL,
        text=f"{what}, counts for {scorers}: ball over the goal line at {at(place)}, "
        f"{crossing.z:.2f} m high, {touched(robot)}",
        restart=kick_off_after_goal(scorers),
        goal_for=scorers,
        side=scorers,
        robot=robot,
        place=place,
    )


def is_in_goal(scene: Scene, crossing: Crossing) -> bool:
    """Whether the ball passed the goal line through the mouth of the goal."""
    pitch = scene.match.pitch
    return crossing.line is Line.GOAL and abs(crossing.y) < pitch.goal_width / 2 and crossing.z < pitch.goal_height
