"""Goal: the whole ball over the goal line, between the posts and under the bar; own goals count for the other side.

After a restart a goal of the side that took it counts once a second robot of that side has touched the ball, after a
drop ball once two robots have, in a penalty at once. A ball that goes in before is a goal kick.

Section: play, scoring; restarts.
Measures: the place where the whole ball had passed the line, and how many robots have touched the ball since START; the
other side's having won the ball ends that. A goal is an own goal when a defender held or kicked the ball last, or
nobody else touched it.
Not judged: whether a defender who deflected the ball could help it.
"""

from schemas.game import Card, EventKind, Phase
from schemas.side import Side
from sim_host.referee.decision import Decision
from sim_host.referee.flow import kick_off_after_goal
from sim_host.referee.scene import Crossing, Line, Scene
from sim_host.referee.set_piece import why_no_goal
from sim_host.referee.spots import restart_at
from sim_host.referee.wording import at, touched


def judge(scene: Scene) -> Decision | None:
    """A goal, or nothing."""
    crossing = scene.crossing
    if crossing is None or not is_in_goal(scene, crossing):
        return None
    scorers = next(side for side in Side if scene.state.attack(side) * crossing.x > 0)
    play = scene.state.evidence.play
    shot = play.of(scorers)
    own = play.last is not None and (shot is None or play.control is scorers.opponent)
    robot = shot.robot if shot is not None and not own else scene.state.last_touch
    place = (crossing.x, crossing.y)
    lack = why_no_goal(scene.state.set_piece, scene.match.book, scene.match.roster, scorers)
    if lack is not None:
        touched_by, asked = lack
        return Decision(
            kind=EventKind.NO_GOAL,
            text=f"no goal: {touched_by} robots have touched the ball since the restart, {asked} are asked",
            restart=restart_at(scene.match, scene.state, Phase.GOAL_KICK, scorers.opponent, place),
            side=scorers,
            robot=robot,
            place=place,
            measured=touched_by,
            limit=asked,
            unit="robots",
            card=Card.YELLOW if scene.match.book.fouls.direct_goal == "yellow" else None,
        )
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
