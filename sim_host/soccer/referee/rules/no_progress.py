"""No progress: a ball in play that stays within a circle for a long time is dropped, with or without an opponent.

A robot that turns on its spot with the ball, dribbles to and fro within its circle, or releases the ball and catches it
again at the same place makes no progress; neither do teammates that pass the ball among themselves within the circle.

Section: play, pushing: stand-off, for its 10 s; ours without an opponent, and for the distance.
Measures: the time for which the centre of the ball has been within the circle around the place where it was caught, or
where it was when it left the last circle.
Not judged: which robot could have played it.
"""

from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.rules.foul import exceeds
from sim_host.soccer.referee.rules.out import dropped
from sim_host.soccer.referee.situation import Situation
from sim_host.soccer.referee.wording import place_text


def is_due(situation: Situation) -> bool:
    """Whether the ball has been within its circle for longer than allowed."""
    progress = situation.state.evidence.progress
    limit = situation.match.book.stall.progress_duration
    return progress is not None and exceeds(situation.snapshot.time - progress.since, limit)


def judge(situation: Situation) -> Decision | None:
    """A drop ball where the ball is, in a penalty area at the nearest restart spot outside it, or None."""
    progress, numbers = situation.state.evidence.progress, situation.match.book.stall
    if progress is None or not is_due(situation):
        return None
    lasted, holder = situation.snapshot.time - progress.since, situation.snapshot.possession
    text = (
        f"no progress: the ball has been within {numbers.progress_distance:.2f} m of "
        f"{place_text(progress.place)} for {lasted:.1f} s, limit {numbers.progress_duration:.1f}"
        f"{f'; {holder} has it' if holder is not None else ''}"
    )
    return dropped(situation, text, (lasted, numbers.progress_duration, "s"), robot=holder)
