"""Stalled ball: nobody has moved the ball in play for long, so it is dropped.

Section: play, pushing: stand-off; ours where no robot is near.
Measures: how long the ball in play has been slower than the rule book's speed.
Not judged: why nobody plays it.
"""

from schemas.game import EventKind, Phase
from sim_host.referee.decision import Decision
from sim_host.referee.scene import Scene
from sim_host.referee.spots import restart_at
from sim_host.referee.timing import reached
from sim_host.referee.wording import at


def judge(scene: Scene) -> Decision | None:
    """A drop ball where the ball lies, out of a penalty area at the nearest restart spot, or nothing."""
    still = scene.state.still
    if not reached(still, scene.match.book.stall.still_duration):
        return None
    ball = scene.snapshot.ball
    place = (ball.x, ball.y)
    return Decision(
        kind=EventKind.STALL,
        text=f"ball stalled for {still:.1f} s at {at(place)}",
        restart=restart_at(scene.match, scene.state, Phase.DROP_BALL, None, place),
        robot=scene.snapshot.possession,
        place=place,
    )
