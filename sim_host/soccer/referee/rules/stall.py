"""Stalled ball: a ball in play that has not moved for a long time is dropped.

Section: play, pushing: stand-off; ours if no robot is near.
Measures: the time for which the ball in play has been slower than the rule book's speed.
Not judged: why no robot plays it.
"""

from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.timing import reached
from sim_host.soccer.referee.rules.out import dropped
from sim_host.soccer.referee.situation import Situation
from sim_host.soccer.referee.wording import place_text


def judge(situation: Situation) -> Decision | None:
    """A drop ball where the ball is, in a penalty area at the nearest restart spot outside it, or None."""
    still = situation.state.still
    if not reached(still, situation.match.book.stall.still_duration):
        return None
    text = f"ball stalled for {still:.1f} s at {place_text(situation.ball_spot)}"
    return dropped(situation, text, robot=situation.snapshot.possession)
