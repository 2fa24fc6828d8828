"""The periods of a match, from before the first half to full time: kick-offs, halves, breaks, extra time, shoot-out.

Each half ends at once when its playing time is up. Robots park; after the break they are placed at their start poses,
play in the other direction, and the other side kicks off. A level match whose match file or rule book requires a winner
goes on with extra time, and then with a penalty shoot-out. If a match file shortens or lengthens the halves, extra time
changes by the same factor. A side forfeits if it cannot field enough robots, because they are sent off for good or
their agents do not answer; if both sides are left with equally few, the match ends with the present score.

Section: match.
Measures: the game clock, which runs from the first START of a half to its end, also in stoppages; and the effective
playing time, while the ball is in play. Both are stopped in a shoot-out.
Not judged: added time.
"""

from collections.abc import Callable, Mapping

from schemas.soccer.game import RESTARTS, EventKind, GameStage, Phase
from sim_host.soccer.referee.game.restart import CENTRE, Restart
from sim_host.soccer.referee.game.timing import reached
from sim_host.soccer.referee.placement.bench import bench_pose
from sim_host.soccer.referee.procedures import discipline, penalties, restart
from sim_host.soccer.referee.procedures.ending import end_if_forfeited, end_match, suspend_play
from sim_host.soccer.referee.ruling_draft import RulingDraft

RULE = "periods"
HALF_PHASES = RESTARTS | {Phase.STOPPED, Phase.PLAY}
"""Phases that are part of a half."""


def begin_half(draft: RulingDraft) -> None:
    """Signal the kick-off of the half, unless a side forfeits."""
    if draft.state.refbox_decides or not end_if_forfeited(draft):
        restart.signal(draft, Restart(Phase.KICK_OFF, draft.state.kick_off, CENTRE))


def end_half(draft: RulingDraft, rule: str, text: str) -> None:
    """End the half at once: robots park, then a break follows, or full time after the last period."""
    kind = EventKind.HALF_TIME if what_follows(draft) is not None else EventKind.PARKING
    if kind is EventKind.PARKING and not draft.book.periods.parking:
        end_match(draft, rule, text)
        return
    draft.add_event(kind, rule, text, score=draft.state.score)
    if draft.book.periods.parking:
        suspend_play(draft, Phase.PARKING, draft.book.periods.parking)
    else:
        suspend_play(draft, Phase.HALF_TIME, break_limit(draft))


def what_follows(draft: RulingDraft) -> GameStage | None:
    """The stage of the next half or of the shoot-out; None after the last period that the match requires."""
    state = draft.state
    is_open = draft.match.needs_winner and state.score.cyan == state.score.magenta
    return _next_stage(draft, beyond_regular=is_open)


def break_limit(draft: RulingDraft) -> float | None:
    """Duration in s of the break before the next period; None while a referee box decides when it ends."""
    return None if draft.state.refbox_decides else _break_duration(draft)


def _next_stage(draft: RulingDraft, *, beyond_regular: bool) -> GameStage | None:
    """The stage that follows; extra time and shoot-out only if `beyond_regular`."""
    state, periods = draft.state, draft.book.periods
    if state.stage is GameStage.SHOOT_OUT:
        return None
    if state.half < periods.halves:
        return GameStage.REGULAR
    if state.half > periods.halves and state.half < periods.halves + periods.extra_halves:
        return GameStage.EXTRA_TIME
    if not beyond_regular:
        return None
    if state.half == periods.halves and periods.extra_halves:
        return GameStage.EXTRA_TIME
    return GameStage.SHOOT_OUT if periods.shoot_out_kicks else None


def begin_next_period(draft: RulingDraft) -> None:
    """Begin the next period after a break, or end the match; a referee box may go on where the rules would not."""
    stage = _next_stage(draft, beyond_regular=True) if draft.state.refbox_decides else what_follows(draft)
    if stage is None:
        _end_at_full_time(draft)
    elif stage is GameStage.SHOOT_OUT:
        _place_at_start_poses(draft)
        penalties.begin(draft)
    else:
        _change_sides(draft, stage)


def advance(draft: RulingDraft) -> None:
    """Apply the effects of time in this phase."""
    step = ADVANCE_BY_PHASE.get(draft.state.phase)
    if step is not None:
        step(draft)
    restart.drop_settled_set_piece(draft)
    discipline.advance(draft)
    state = draft.state
    if state.participation.absences and state.phase in HALF_PHASES and not state.refbox_decides:
        end_if_forfeited(draft)


def _end_at_full_time(draft: RulingDraft) -> None:
    score = draft.state.score
    end_match(draft, RULE, f"full time, cyan {score.cyan} : {score.magenta} magenta")


def _change_sides(draft: RulingDraft, stage: GameStage) -> None:
    """Begin the next half: the direction changes, robots are at their start poses, the other side kicks off."""
    state, match = draft.state, draft.match
    duration = match.half_duration if stage is GameStage.REGULAR else match.extra_half_duration
    draft.state = state._replace(
        half=state.half + 1,
        stage=stage,
        timing=state.timing._replace(limit=state.clock + duration),
        kick_off=state.kick_off.opponent,
        cyan_attacks=-state.cyan_attacks,
        participation=discipline.for_next_half(state.participation, draft.book.discipline),
        history=(),
    )
    _place_at_start_poses(draft)
    begin_half(draft)


def _place_at_start_poses(draft: RulingDraft) -> None:
    """Place all robots at their start poses, and those off the field on the bench of this half."""
    for name in draft.match.roster.names:
        if name in draft.state.participation.absences:
            draft.place_robot(name, bench_pose(draft.match, draft.state, name))
        else:
            draft.place_robot(name, draft.match.starts[name].team(draft.state.cyan_attacks))


def _before_match(draft: RulingDraft) -> None:
    if draft.match.automatic and not draft.state.refbox_decides:
        begin_half(draft)


def _while_stopped(draft: RulingDraft) -> None:
    pending = draft.state.pending
    if pending is not None and reached(draft.state.timing.timer, draft.book.restarts.stop_to_signal):
        restart.signal(draft, pending)


def _while_restarting(draft: RulingDraft) -> None:
    signalled = draft.state.restart
    if signalled is not None:
        restart.advance(draft, signalled)


def _while_parking(draft: RulingDraft) -> None:
    if not reached(draft.state.timing.timer, draft.book.periods.parking):
        return
    if what_follows(draft) is None:
        _end_at_full_time(draft)
    else:
        suspend_play(draft, Phase.HALF_TIME, break_limit(draft))


def _during_break(draft: RulingDraft) -> None:
    if not draft.state.refbox_decides and reached(draft.state.timing.timer, _break_duration(draft)):
        begin_next_period(draft)


ADVANCE_BY_PHASE: Mapping[Phase, Callable[[RulingDraft], None]] = {
    Phase.PRE_GAME: _before_match,
    Phase.STOPPED: _while_stopped,
    Phase.PARKING: _while_parking,
    Phase.HALF_TIME: _during_break,
} | dict.fromkeys(RESTARTS, _while_restarting)
"""Phase → the effects of time in it; the other phases have none."""


def _break_duration(draft: RulingDraft) -> float:
    """Duration in s of the break before the next period."""
    periods = draft.book.periods
    return periods.shoot_out_break if what_follows(draft) is GameStage.SHOOT_OUT else periods.half_time_break
