"""The penalty shoot-out: sides alternate until one cannot be caught up with.

The side that would have kicked off begins. A level shoot-out is repeated as often as the rule book allows, begun by the
other side, and is undecided after that.

Section: match, play-offs; penalty shoot-out.
Measures: penalties taken and goals of each side; the clock is stopped.
Not judged: which side wins an undecided match.
"""

import dataclasses

from schemas.side import Side
from schemas.soccer.game import GameStage, Phase
from sim_host.soccer.referee.game.restart import CENTRE, Restart
from sim_host.soccer.referee.game.shoot_out import ShootOut
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.procedures import restart
from sim_host.soccer.referee.procedures.ending import end_match
from sim_host.soccer.referee.ruling_draft import RulingDraft


def begin(draft: RulingDraft) -> None:
    """Signal the first penalty, for the side that would have kicked off."""
    state = draft.state
    out = ShootOut(state.kick_off.opponent)
    draft.state = state._replace(stage=GameStage.SHOOT_OUT, shoot_out=out, history=())
    restart.signal(draft, penalty_for(draft, out.next_side()))


def count(draft: RulingDraft, scored: bool) -> None:
    """Count an attempt that has ended."""
    state = draft.state
    if state.shoot_out is not None and state.side is not None:
        draft.state = state._replace(shoot_out=state.shoot_out.after_attempt(state.side, scored))


def retake(draft: RulingDraft) -> None:
    """Prepare the same penalty once more: the attempt that was stopped leaves nothing."""
    out = draft.state.shoot_out
    if out is not None:
        draft.state = draft.state._replace(shoot_out=dataclasses.replace(out, nearest=None))


def next_penalty(draft: RulingDraft, rule: str) -> None:
    """Stop for the next attempt, begin another series, or end the match."""
    state, periods = draft.state, draft.book.periods
    out = state.shoot_out
    if out is None:
        return
    kicks = periods.shoot_out_kicks
    if state.refbox_decides:
        restart.stop(draft, rule, None)
        return
    leader = out.leader(kicks)
    result = f"cyan {out.goals.cyan} : {out.goals.magenta} magenta"
    if leader is not None:
        end_match(draft, rule, f"{leader} wins the penalty shoot-out, {result}")
        return
    if out.is_played(kicks):
        if out.series >= periods.shoot_out_series:
            end_match(draft, rule, f"the penalty shoot-out is undecided after {out.series} series, {result}")
            return
        out = out.next_series()
        draft.state = state._replace(shoot_out=out)
    restart.stop(draft, rule, penalty_for(draft, out.next_side()))


def penalty_for(draft: RulingDraft, side: Side) -> Restart:
    """A penalty for a side, from the penalty mark that it attacks."""
    return restart_at(draft.match, draft.state, Phase.PENALTY, side, CENTRE)
