"""Goal: the whole ball over the goal line, between the posts and under the bar; own goals count for the other side.

After a restart, a goal of the side that took it counts only if a second robot of that side has touched the ball; after
a drop ball, if two robots have touched it. A penalty may be scored directly. If a goal does not count for this reason,
the other side has a goal kick.

Section: play, scoring; restarts.
Measures: the place where the whole ball had passed the line, and the number of robots that have touched the ball since
START, until the other side has won the ball. A goal is an own goal if a defender was the last robot to hold or kick the
ball, or no attacker has touched it.
Not judged: whether a defender who deflected the ball could avoid it.
"""

from schemas.side import Side
from schemas.soccer.game import Card, EventKind, Phase
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.restart import kick_off_after_goal
from sim_host.soccer.referee.game.set_piece import why_no_goal
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.situation import Crossing, Line, Situation
from sim_host.soccer.referee.wording import last_touch_text, place_text


def judge(situation: Situation) -> Decision | None:
    """A goal, or one that does not count, or None."""
    crossing = situation.crossing
    if crossing is None or not is_in_goal(situation, crossing):
        return None
    scorers = next(side for side in Side if situation.state.attack(side) * crossing.x > 0)
    play = situation.state.evidence.play
    shot = play.of(scorers)
    own = play.last is not None and (shot is None or play.control is scorers.opponent)
    robot = shot.robot if shot is not None and not own else situation.state.last_touch
    place = (crossing.x, crossing.y)
    lack = why_no_goal(situation.state.set_piece, situation.match.book, situation.match.roster, scorers)
    if lack is not None:
        touched_by, required = lack
        return Decision(
            kind=EventKind.NO_GOAL,
            text=f"no goal: {touched_by} robots have touched the ball since the restart, {required} required",
            restart=restart_at(situation.match, situation.state, Phase.GOAL_KICK, scorers.opponent, place),
            side=scorers,
            robot=robot,
            place=place,
            measured=touched_by,
            limit=required,
            unit="robots",
            card=Card.YELLOW if situation.match.book.fouls.direct_goal == "yellow" else None,
        )
    what = "own goal" if own else "goal"
    return Decision(
        kind=EventKind.GOAL,
        text=f"{what}, counts for {scorers}: ball over the goal line at {place_text(place)}, "
        f"{crossing.z:.2f} m high, {last_touch_text(robot)}",
        restart=kick_off_after_goal(scorers),
        goal_for=scorers,
        side=scorers,
        robot=robot,
        place=place,
    )


def is_in_goal(situation: Situation, crossing: Crossing) -> bool:
    """Whether the ball crossed the goal line between the posts and under the bar."""
    pitch = situation.match.pitch
    return crossing.line is Line.GOAL and abs(crossing.y) < pitch.goal_width / 2 and crossing.z < pitch.goal_height
