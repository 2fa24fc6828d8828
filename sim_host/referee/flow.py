"""The match from before its first half to full time: kick-offs, stoppages, halves, and what a decision leads to."""

import dataclasses
from collections.abc import Callable, Mapping

from schemas.game import RESTARTS, EventKind, Phase, Score
from schemas.side import Side
from sim_host.referee import restart
from sim_host.referee.decision import Decision
from sim_host.referee.state import Restart, Spot
from sim_host.referee.turn import Turn

RULE = "flow"
CENTRE: Spot = (0.0, 0.0)
HALF_ON = RESTARTS | {Phase.STOPPED, Phase.PLAY}
"""Phases in which a half is being played."""


def carry_out(turn: Turn, rule: str, decision: Decision) -> None:
    """Let what a rule or action decided happen."""
    if decision.ends_half:
        end_half(turn, rule, decision.text)
        return
    if decision.goal_for is not None:
        turn.state = dataclasses.replace(turn.state, score=_one_more(turn.state.score, decision.goal_for))
    turn.say(
        decision.kind,
        rule,
        decision.text,
        side=decision.side,
        robot=decision.robot,
        place=decision.place,
        score=turn.state.score if decision.goal_for is not None else None,
    )
    restart.stop(turn, rule, decision.restart)


def kick_off_after_goal(scorers: Side) -> Restart:
    """The side that conceded kicks off."""
    return Restart(Phase.KICK_OFF, scorers.opponent, CENTRE)


def begin_half(turn: Turn) -> None:
    """Signal the kick-off of the half."""
    restart.signal(turn, Restart(Phase.KICK_OFF, turn.state.kick_off, CENTRE))


def end_half(turn: Turn, rule: str, text: str) -> None:
    """End the half at once: a break, or full time after the last half."""
    if turn.state.half >= turn.match.book.periods.halves:
        end_match(turn, rule, text)
        return
    _rest(turn, Phase.HALF_TIME)
    turn.say(EventKind.HALF_TIME, rule, text, score=turn.state.score)


def end_match(turn: Turn, rule: str, text: str) -> None:
    """Full time."""
    _rest(turn, Phase.FULL_TIME)
    turn.say(EventKind.FULL_TIME, rule, text, score=turn.state.score)


def change_sides(turn: Turn) -> None:
    """Begin the next half: other direction, everybody at the start poses of it, the other side kicks off."""
    state = turn.state
    turn.state = dataclasses.replace(
        state,
        half=state.half + 1,
        half_limit=state.clock + turn.match.half_duration,
        kick_off=state.kick_off.opponent,
        cyan_attacks=-state.cyan_attacks,
    )
    for name in turn.match.roster.names:
        turn.place_robot(name, turn.match.starts[name].team(turn.state.cyan_attacks))
    begin_half(turn)


def progress(turn: Turn) -> None:
    """What the time that has passed brings about in this phase."""
    step = PROGRESS.get(turn.state.phase)
    if step is not None:
        step(turn)


def _before_match(turn: Turn) -> None:
    if turn.match.automatic:
        begin_half(turn)


def _stopped(turn: Turn) -> None:
    pending = turn.state.pending
    if pending is not None and restart.reached(turn.state.timer, turn.match.book.restarts.stop_to_signal):
        restart.signal(turn, pending)


def _restarting(turn: Turn) -> None:
    signalled = turn.state.restart
    if signalled is not None:
        restart.move_on(turn, signalled)


def _resting(turn: Turn) -> None:
    if restart.reached(turn.state.timer, turn.match.book.periods.half_time_break):
        change_sides(turn)


PROGRESS: Mapping[Phase, Callable[[Turn], None]] = {
    Phase.PRE_GAME: _before_match,
    Phase.STOPPED: _stopped,
    Phase.HALF_TIME: _resting,
} | dict.fromkeys(RESTARTS, _restarting)
"""Phase → what time brings about in it; in the others, nothing."""


def _rest(turn: Turn, phase: Phase) -> None:
    turn.state = dataclasses.replace(
        turn.state,
        phase=phase,
        side=None,
        spot=None,
        running=False,
        clock_runs=False,
        pending=None,
        timer=0.0,
    )


def _one_more(score: Score, side: Side) -> Score:
    return Score(cyan=score.cyan + (side is Side.CYAN), magenta=score.magenta + (side is Side.MAGENTA))
