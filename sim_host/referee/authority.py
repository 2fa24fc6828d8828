"""Authority: the referee decides, or proposes and people may overrule it, or people decide alone; and what is undone.

In `automatic` officiating every decision is carried out in its tick. In `mixed` it is an event of its own, and carried
out when it is confirmed or the match file's time is up; meanwhile the game goes on, nothing else is judged, and nobody
is shown a card for standing wrong. In `manual` the referee keeps the clocks and places the ball; people decide, and
give START. `undo` brings back the state before the last decision, score and cards with it, while the clocks go on: a
restart that was signalled is signalled again, and where play was on the ball is dropped.

Section: ours.
Measures: nothing of its own.
Not judged: whether people who officiate are right.
"""

from schemas.game import RESTARTS, EventKind, Mode, Phase, Stage
from sim_host.referee import flow, penalties, restart
from sim_host.referee.bench import bench_pose, entry_pose
from sim_host.referee.call import Restart
from sim_host.referee.decision import Decision, Proposal
from sim_host.referee.evidence import NOTHING
from sim_host.referee.rules import Rule
from sim_host.referee.spots import restart_at
from sim_host.referee.state import RefereeState
from sim_host.referee.timing import reached
from sim_host.referee.turn import Turn


def judge(turn: Turn, found: tuple[Rule, Decision] | None) -> None:
    """Carry out what a rule has found, or propose it; carry out a proposal that nobody overruled in time."""
    proposal = turn.state.proposal
    if proposal is not None and time_is_up(proposal):
        decide(turn, proposal.rule, proposal.decision)
    elif found is not None:
        rule, decision = found
        if turn.match.mode is not Mode.MIXED or not rule.while_running:
            decide(turn, rule.name, decision)
        elif proposal is None:
            propose(turn, rule.name, decision)


def decide(turn: Turn, rule: str, decision: Decision) -> None:
    """Carry a decision out, and remember how it was before."""
    remember(turn)
    turn.state = turn.state._replace(proposal=None)
    flow.carry_out(turn, rule, decision)


def propose(turn: Turn, rule: str, decision: Decision) -> None:
    """Say what is decided unless people overrule it; the game goes on meanwhile, and nothing else is judged."""
    proposal = Proposal(rule, decision, turn.match.proposal)
    turn.state = turn.state._replace(proposal=proposal)
    turn.say(
        EventKind.PROPOSAL,
        rule,
        f"proposed, in {proposal.left:g} s it is decided: {decision.text}",
        side=decision.side,
        robot=decision.robot,
        robots=decision.robots,
        place=decision.place,
        measured=decision.measured,
        limit=decision.limit,
        unit=decision.unit,
        card=decision.card,
    )


def time_is_up(proposal: Proposal | None) -> bool:
    """Whether nobody has overruled a proposal in time."""
    return proposal is not None and reached(0.0, proposal.left)


def remember(turn: Turn) -> None:
    """Keep the state as it is for `undo`; one decision can be undone, not those before it."""
    state = turn.state
    turn.state = state._replace(before=state._replace(before=None, proposal=None))


def why_not_undo(turn: Turn) -> str | None:
    """A reason against undoing the last decision, or nothing."""
    before = turn.state.before
    if before is None:
        return "no decision can be undone: there was none since this half began, or it was undone"
    if before.timing.runs and reached(turn.state.clock, before.timing.limit):
        return "the half's time is up"
    return None


def undo(turn: Turn) -> None:
    """Bring back the state before the last decision; the clocks go on, and what was in play is dropped.

    Score, cards, people and the half are as they were. A restart that was signalled is signalled again; play that was
    on is halted, and the ball is dropped where it was, in a shoot-out the penalty is taken again.
    """
    now, before = turn.state, turn.state.before
    if before is None:
        return
    timing = before.timing._replace(clock=now.clock, effective=now.timing.effective, timer=0.0)
    turn.state = before._replace(timing=timing, still=0.0, ball=now.ball, evidence=NOTHING, set_piece=None, before=None)
    _undo_leaving(turn, now)
    signalled = before.restart
    if before.running:
        restart.stop(turn, "undo", _again(turn, before))
    elif signalled is not None and before.phase in RESTARTS:
        restart.signal(turn, signalled)


def _again(turn: Turn, before: RefereeState) -> Restart:
    """How the game goes on that was running."""
    if before.stage is Stage.SHOOT_OUT and before.side is not None:
        return penalties.penalty_for(turn, before.side)
    x, y = before.ball[:2] if before.ball is not None else turn.ball_spot
    return restart_at(turn.match, turn.state, Phase.DROP_BALL, None, (x, y))


def _undo_leaving(turn: Turn, now: RefereeState) -> None:
    """Robots that the decision sent off stand on the field again, those that it brought back are off it."""
    was, is_now = turn.state.people.away, now.people.away
    for name in turn.match.roster.names:
        if name in was and name not in is_now:
            turn.place_robot(name, bench_pose(turn.match, turn.state, name))
        elif name in is_now and name not in was:
            pose = entry_pose(turn.match, turn.state, turn.snapshot, name)
            turn.place_robot(name, pose or turn.match.starts[name].team(turn.state.cyan_attacks))
