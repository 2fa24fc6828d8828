"""Lost ball: the ball is outside the field or under the ground without having crossed a line.

It is dropped at the nearest legal place.

Section: none; ours, since only a simulation can lose a ball in this way.
Measures: the place of the ball's centre.
Not judged: how it got there.
"""

from schemas.soccer.game import EventKind, Phase
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.situation import Situation
from sim_host.soccer.referee.wording import place_text


def judge(situation: Situation) -> Decision | None:
    """A drop ball at the nearest legal place, or None; the rules on the lines are asked before."""
    match, ball = situation.match, situation.snapshot.ball
    outside = abs(ball.x) > match.out_x or abs(ball.y) > match.out_y
    if not outside and ball.z >= -match.ball.radius:
        return None
    place = (ball.x, ball.y)
    return Decision(
        kind=EventKind.BALL_OUT,
        text=f"ball lost: it is at {place_text(place)}, {ball.z:.2f} m high, without having crossed a line",
        restart=restart_at(match, situation.state, Phase.DROP_BALL, None, place),
        place=place,
    )
