"""The match from before its first half to full time: kick-offs, stoppages, halves, and what a decision leads to.

Each half ends at once when its playing time is up; robots park, and after the break they are carried to their start
poses and play in the other direction, the other side kicking off. A level match whose match file or rule book asks for
a winner goes on with extra time, as much shorter or longer than the rule book says as the halves are, and then with a
penalty shoot-out. A side that cannot field enough robots, because they are sent off for good or their programs are
gone, forfeits; where both sides have as few, the match ends as it stands.

Section: match.
Measures: the clock, which runs from the first START of a half to its end, also through stoppages; beside it the
effective playing time, while the ball is in play. In a shoot-out both stand.
Not judged: added time.
"""

from collections.abc import Callable, Mapping

from schemas.game import RESTARTS, EventKind, Phase, Score, Stage
from schemas.side import Side
from sim_host.referee import discipline, penalties, restart
from sim_host.referee.bench import bench_pose
from sim_host.referee.call import CENTRE, Restart
from sim_host.referee.decision import Decision
from sim_host.referee.ending import end_match, is_given_up, rest
from sim_host.referee.state import RefereeState
from sim_host.referee.timing import reached
from sim_host.referee.turn import Turn

RULE = "flow"
HALF_ON = RESTARTS | {Phase.STOPPED, Phase.PLAY}
"""Phases in which a half is being played."""


def carry_out(turn: Turn, rule: str, decision: Decision) -> None:
    """Let what a rule or action decided happen."""
    if decision.ends_half:
        end_half(turn, rule, decision.text)
        return
    if decision.goal_for is not None:
        turn.state = turn.state._replace(score=turn.state.score.plus(decision.goal_for))
    if decision.shot_scored is not None:
        penalties.count(turn, decision.shot_scored)
    turn.say(
        decision.kind,
        rule,
        decision.text,
        side=decision.side,
        robot=decision.robot,
        robots=decision.robots,
        place=decision.place,
        score=_score_said(turn.state, decision),
        measured=decision.measured,
        limit=decision.limit,
        unit=decision.unit,
        card=decision.card,
    )
    if decision.card is not None and decision.robot is not None:
        discipline.show(turn, rule, decision.robot, decision.card)
    if decision.shot_scored is not None:
        penalties.next_penalty(turn, rule)
    else:
        restart.stop(turn, rule, decision.restart)


def kick_off_after_goal(scorers: Side) -> Restart:
    """The side that conceded kicks off."""
    return Restart(Phase.KICK_OFF, scorers.opponent, CENTRE)


def begin_half(turn: Turn) -> None:
    """Signal the kick-off of the half."""
    if not is_given_up(turn):
        restart.signal(turn, Restart(Phase.KICK_OFF, turn.state.kick_off, CENTRE))


def end_half(turn: Turn, rule: str, text: str) -> None:
    """End the half at once: robots park, then comes a break, or full time when nothing follows."""
    kind = EventKind.HALF_TIME if what_follows(turn) is not None else EventKind.PARKING
    if kind is EventKind.PARKING and not turn.book.periods.parking:
        end_match(turn, rule, text)
        return
    turn.say(kind, rule, text, score=turn.state.score)
    if turn.book.periods.parking:
        rest(turn, Phase.PARKING, turn.book.periods.parking)
    else:
        rest(turn, Phase.HALF_TIME, _break(turn))


def what_follows(turn: Turn) -> Stage | None:
    """The stage of the next half or of the shoot-out, or nothing when the match is over with this one."""
    state, periods = turn.state, turn.book.periods
    if state.stage is Stage.SHOOT_OUT:
        return None
    if state.half < periods.halves:
        return Stage.REGULAR
    if state.half > periods.halves and state.half < periods.halves + periods.extra_halves:
        return Stage.EXTRA_TIME
    if not turn.match.needs_winner or state.score.cyan != state.score.magenta:
        return None
    if state.half == periods.halves and periods.extra_halves:
        return Stage.EXTRA_TIME
    return Stage.SHOOT_OUT if periods.shoot_out_kicks else None


def go_on(turn: Turn) -> None:
    """Begin what follows after a break, or end the match."""
    stage = what_follows(turn)
    if stage is None:
        score = turn.state.score
        end_match(turn, RULE, f"full time, cyan {score.cyan} : {score.magenta} magenta")
    elif stage is Stage.SHOOT_OUT:
        _carry(turn)
        penalties.begin(turn)
    else:
        _change_sides(turn, stage)


def progress(turn: Turn) -> None:
    """What the time that has passed brings about in this phase."""
    step = PROGRESS.get(turn.state.phase)
    if step is not None:
        step(turn)
    restart.release(turn)
    discipline.progress(turn)
    if turn.state.people.away and turn.state.phase in HALF_ON:
        is_given_up(turn)


def _score_said(state: RefereeState, decision: Decision) -> Score | None:
    if decision.shot_scored is not None and state.shoot_out is not None:
        return state.shoot_out.goals
    return state.score if decision.goal_for is not None else None


def _change_sides(turn: Turn, stage: Stage) -> None:
    """Begin the next half: other direction, everybody at the start poses of it, the other side kicks off."""
    state, match = turn.state, turn.match
    duration = match.half_duration if stage is Stage.REGULAR else match.extra_half_duration
    turn.state = state._replace(
        half=state.half + 1,
        stage=stage,
        timing=state.timing._replace(limit=state.clock + duration),
        kick_off=state.kick_off.opponent,
        cyan_attacks=-state.cyan_attacks,
        people=discipline.forgotten(state.people, turn.book.discipline),
        before=None,
    )
    _carry(turn)
    begin_half(turn)


def _carry(turn: Turn) -> None:
    """Carry everybody to the start poses, and who is off the field to the bench of the half."""
    for name in turn.match.roster.names:
        if name in turn.state.people.away:
            turn.place_robot(name, bench_pose(turn.match, turn.state, name))
        else:
            turn.place_robot(name, turn.match.starts[name].team(turn.state.cyan_attacks))


def _before_match(turn: Turn) -> None:
    if turn.match.automatic:
        begin_half(turn)


def _stopped(turn: Turn) -> None:
    pending = turn.state.pending
    if pending is not None and reached(turn.state.timing.timer, turn.book.restarts.stop_to_signal):
        restart.signal(turn, pending)


def _restarting(turn: Turn) -> None:
    signalled = turn.state.restart
    if signalled is not None:
        restart.move_on(turn, signalled)


def _parking(turn: Turn) -> None:
    if not reached(turn.state.timing.timer, turn.book.periods.parking):
        return
    if what_follows(turn) is None:
        go_on(turn)
    else:
        rest(turn, Phase.HALF_TIME, _break(turn))


def _resting(turn: Turn) -> None:
    if reached(turn.state.timing.timer, _break(turn)):
        go_on(turn)


PROGRESS: Mapping[Phase, Callable[[Turn], None]] = {
    Phase.PRE_GAME: _before_match,
    Phase.STOPPED: _stopped,
    Phase.PARKING: _parking,
    Phase.HALF_TIME: _resting,
} | dict.fromkeys(RESTARTS, _restarting)
"""Phase → what time brings about in it; in the others, nothing."""


def _break(turn: Turn) -> float:
    """s of the break before what follows."""
    periods = turn.book.periods
    return periods.shoot_out_break if what_follows(turn) is Stage.SHOOT_OUT else periods.half_time_break
