"""Lost ball: it lies outside the field or under the ground, and no line that it crossed explains it.

It is dropped at the nearest legal place.

Section: none; ours, against what only a simulation can do to a ball.
Measures: the place of the ball's centre.
Not judged: how it came there.
"""

from schemas.game import EventKind, Phase
from sim_host.referee.decision import Decision
from sim_host.referee.scene import Scene
from sim_host.referee.spots import restart_at
from sim_host.referee.wording import at


def judge(scene: Scene) -> Decision | None:
    """A drop ball at the nearest legal place, or nothing; the rules on the lines have judged before."""
    match, ball = scene.match, scene.snapshot.ball
    outside = abs(ball.x) > match.out_x or abs(ball.y) > match.out_y
    if not outside and ball.z >= -match.ball.radius:
        return None
    place = (ball.x, ball.y)
    return Decision(
        kind=EventKind.BALL_OUT,
        text=f"ball lost: it is at {at(place)}, {ball.z:.2f} m high, without having crossed a line",
        restart=restart_at(match, scene.state, Phase.DROP_BALL, None, place),
        place=place,
    )
