"""Scrum: a ball that both sides are at, and that makes no progress, is dropped where it is.

The drop is fair: the ball is where both sides had it, or at the nearest restart spot outside a penalty area; neither
side has it, and all robots keep the same distance.

Section: play, pushing: stand-off; ours if no two robots touch each other.
Measures: the time for which robots of both sides have been within `reach` of the ball, hull to hull, with gaps shorter
than 0.5 s, since the ball last moved by `progress`.
Not judged: which robot holds the ball in this time.
"""

from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules.out import dropped
from sim_host.soccer.referee.situation import Situation
from sim_host.soccer.referee.wording import place_text


def judge(situation: Situation) -> Decision | None:
    """A drop ball, or None."""
    contest = situation.state.evidence.contest
    numbers = situation.match.book.scrum
    if contest is None or contest.stuck < numbers.duration:
        return None
    names = situation.match.roster.names
    text = (
        f"scrum: both sides at the ball at {place_text(situation.ball_spot)} for {contest.stuck:.1f} s without "
        f"{numbers.progress:.2f} m of progress, limit {numbers.duration:.1f}"
    )
    robots = tuple([names[index] for index in contest.robots])
    return dropped(situation, text, (contest.stuck, numbers.duration, "s"), robots=robots)
