"""The penalty shoot-out from attempt to attempt: sides alternate until one cannot be caught up with.

The side that would have kicked off begins. A level shoot-out is repeated as often as the rule book says, the other side
beginning, and then said to be undecided.

Section: match, play-offs; penalty shoot-out.
Measures: penalties taken and goals of each side; the clock stands.
Not judged: who wins an undecided match.
"""

from schemas.game import Phase, Stage
from schemas.side import Side
from sim_host.referee import restart
from sim_host.referee.call import CENTRE, Restart
from sim_host.referee.ending import end_match
from sim_host.referee.shoot_out import ShootOut
from sim_host.referee.spots import restart_at
from sim_host.referee.turn import Turn


def begin(turn: Turn) -> None:
    """Signal the first penalty, of the side that would have kicked off."""
    state = turn.state
    out = ShootOut(state.kick_off.opponent)
    turn.state = state._replace(stage=Stage.SHOOT_OUT, shoot_out=out, before=None)
    restart.signal(turn, penalty_for(turn, out.next_side()))


def count(turn: Turn, scored: bool) -> None:
    """An attempt is over."""
    state = turn.state
    if state.shoot_out is not None and state.side is not None:
        turn.state = state._replace(shoot_out=state.shoot_out.counted(state.side, scored))


def next_penalty(turn: Turn, rule: str) -> None:
    """After an attempt: the other side's, another series, or the end."""
    state, periods = turn.state, turn.book.periods
    out = state.shoot_out
    if out is None:
        return
    kicks = periods.shoot_out_kicks
    leader = out.leader(kicks)
    said = f"cyan {out.goals.cyan} : {out.goals.magenta} magenta"
    if leader is not None:
        end_match(turn, rule, f"{leader} wins the penalty shoot-out, {said}")
        return
    if out.is_played(kicks):
        if out.series >= periods.shoot_out_series:
            end_match(turn, rule, f"the penalty shoot-out is undecided after {out.series} series, {said}")
            return
        out = out.repeated()
        turn.state = state._replace(shoot_out=out)
    restart.stop(turn, rule, penalty_for(turn, out.next_side()))


def penalty_for(turn: Turn, side: Side) -> Restart:
    """A penalty of a side, from the mark it attacks."""
    return restart_at(turn.match, turn.state, Phase.PENALTY, side, CENTRE)
