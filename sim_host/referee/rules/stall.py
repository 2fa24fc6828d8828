"""Stalled ball: a ball in play that has not moved for a long time is dropped.

Section: play, pushing: stand-off; ours if no robot is near.
Measures: the time for which the ball in play has been slower than the rule book's speed.
Not judged: why no robot plays it.
"""

from schemas.game import EventKind, Phase
from sim_host.referee.game.decision import Decision
from sim_host.referee.game.timing import reached
from sim_host.referee.placement.spots import restart_at
from sim_host.referee.situation import Situation
from sim_host.referee.wording import place_text


def judge(situation: Situation) -> Decision | None:
    """A drop ball where the ball is, in a penalty area at the nearest restart spot outside it, or None."""
    still = situation.state.still
    if not reached(still, situation.match.book.stall.still_duration):
        return None
    ball = situation.snapshot.ball
    place = (ball.x, ball.y)
    return Decision(
        kind=EventKind.STALL,
        text=f"ball stalled for {still:.1f} s at {place_text(place)}",
        restart=restart_at(situation.match, situation.state, Phase.DROP_BALL, None, place),
        robot=situation.snapshot.possession,
        place=place,
    )
