"""Scrum: a ball that both sides are at and nobody gets away with is dropped where it is.

The drop is fair: it lies where both had it, or outside a penalty area at the nearest restart spot, belongs to nobody,
and everybody keeps the same distance.

Section: play, pushing: stand-off; ours where no two robots touch each other.
Measures: how long robots of both sides have been within `reach` of the ball, hull to hull, with gaps shorter than
0.5 s, since the ball last came as far as `progress`.
Not judged: who of them holds the ball meanwhile.
"""

from schemas.game import EventKind, Phase
from sim_host.referee.game.decision import Decision
from sim_host.referee.placement.spots import restart_at
from sim_host.referee.situation import Situation
from sim_host.referee.wording import place_text


def judge(situation: Situation) -> Decision | None:
    """A drop ball, or nothing."""
    contest = situation.state.evidence.contest
    numbers = situation.match.book.scrum
    if contest is None or contest.stuck < numbers.duration:
        return None
    ball, names = situation.snapshot.ball, situation.match.roster.names
    place = (ball.x, ball.y)
    return Decision(
        kind=EventKind.STALL,
        text=f"scrum: both sides at the ball at {place_text(place)} for {contest.stuck:.1f} s without "
        f"{numbers.progress:.2f} m of progress, limit {numbers.duration:.1f}",
        restart=restart_at(situation.match, situation.state, Phase.DROP_BALL, None, place),
        robots=tuple([names[index] for index in contest.robots]),
        place=place,
        measured=contest.stuck,
        limit=numbers.duration,
        unit="s",
    )
