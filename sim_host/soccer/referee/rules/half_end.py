"""End of a half: its playing time is up. While a league's referee box officiates, it alone ends the half.

Section: match.
Measures: the game clock, which runs from the first START of a half, also in stoppages.
Not judged: lost time, which is not added.
"""

from schemas.soccer.game import EventKind
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.timing import reached
from sim_host.soccer.referee.situation import Situation


def judge(situation: Situation) -> Decision | None:
    """The immediate end of the half, or None."""
    state = situation.state
    if state.refbox_decides or not state.timing.runs or not reached(state.clock, state.timing.limit):
        return None
    return Decision(
        kind=EventKind.HALF_TIME,
        text=f"half {state.half} ends after {state.clock:.1f} s of play, "
        f"cyan {state.score.cyan} : {state.score.magenta} magenta",
        ends_half=True,
    )
