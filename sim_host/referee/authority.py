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

from schemas.game import RESTARTS, EventKind, GameStage, OfficiatingMode, Phase
from sim_host.referee.evidence import NO_EVIDENCE
from sim_host.referee.game.decision import Decision, Proposal
from sim_host.referee.game.referee_state import RefereeState
from sim_host.referee.game.restart import Restart
from sim_host.referee.game.timing import reached
from sim_host.referee.placement.bench import bench_pose, entry_pose
from sim_host.referee.placement.spots import restart_at
from sim_host.referee.procedures import penalties, restart
from sim_host.referee.procedures.decision import carry_out
from sim_host.referee.rules import Rule
from sim_host.referee.ruling_draft import RulingDraft


def judge(draft: RulingDraft, found: tuple[Rule, Decision] | None) -> None:
    """Carry out what a rule has found, or propose it; carry out a proposal that nobody overruled in time."""
    proposal = draft.state.proposal
    if proposal is not None and is_due(proposal):
        decide(draft, proposal.rule, proposal.decision)
    elif found is not None:
        rule, decision = found
        if draft.match.mode is not OfficiatingMode.MIXED or not rule.while_running:
            decide(draft, rule.name, decision)
        elif proposal is None:
            propose(draft, rule.name, decision)


def decide(draft: RulingDraft, rule: str, decision: Decision) -> None:
    """Carry a decision out, and remember how it was before."""
    save_for_undo(draft)
    draft.state = draft.state._replace(proposal=None)
    carry_out(draft, rule, decision)


def propose(draft: RulingDraft, rule: str, decision: Decision) -> None:
    """Say what is decided unless people overrule it; the game goes on meanwhile, and nothing else is judged."""
    proposal = Proposal(rule, decision, draft.match.proposal)
    draft.state = draft.state._replace(proposal=proposal)
    draft.add_event(
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


def is_due(proposal: Proposal | None) -> bool:
    """Whether nobody has overruled a proposal in time."""
    return proposal is not None and reached(0.0, proposal.left)


def save_for_undo(draft: RulingDraft) -> None:
    """Keep the state as it is for `undo`; one decision can be undone, not those before it."""
    state = draft.state
    draft.state = state._replace(before=state._replace(before=None, proposal=None))


def why_not_undo(draft: RulingDraft) -> str | None:
    """A reason against undoing the last decision, or nothing."""
    before = draft.state.before
    if before is None:
        return "no decision can be undone: there was none since this half began, or it was undone"
    if before.timing.runs and reached(draft.state.clock, before.timing.limit):
        return "the half's time is up"
    return None


def undo(draft: RulingDraft) -> None:
    """Bring back the state before the last decision; the clocks go on, and what was in play is dropped.

    Score, cards, people and the half are as they were. A restart that was signalled is signalled again; play that was
    on is halted, and the ball is dropped where it was, in a shoot-out the penalty is taken again.
    """
    now, before = draft.state, draft.state.before
    if before is None:
        return
    timing = before.timing._replace(clock=now.clock, effective=now.timing.effective, timer=0.0)
    draft.state = before._replace(
        timing=timing, still=0.0, ball=now.ball, evidence=NO_EVIDENCE, set_piece=None, before=None
    )
    _undo_absences(draft, now)
    signalled = before.restart
    if before.running:
        restart.stop(draft, "undo", _restart_after_undo(draft, before))
    elif signalled is not None and before.phase in RESTARTS:
        restart.signal(draft, signalled)


def _restart_after_undo(draft: RulingDraft, before: RefereeState) -> Restart:
    """How the game goes on that was running."""
    if before.stage is GameStage.SHOOT_OUT and before.side is not None:
        return penalties.penalty_for(draft, before.side)
    x, y = before.ball[:2] if before.ball is not None else draft.ball_spot
    return restart_at(draft.match, draft.state, Phase.DROP_BALL, None, (x, y))


def _undo_absences(draft: RulingDraft, now: RefereeState) -> None:
    """Robots that the decision sent off stand on the field again, those that it brought back are off it."""
    was, is_now = draft.state.participation.absences, now.participation.absences
    for name in draft.match.roster.names:
        if name in was and name not in is_now:
            draft.place_robot(name, bench_pose(draft.match, draft.state, name))
        elif name in is_now and name not in was:
            pose = entry_pose(draft.match, draft.state, draft.snapshot, name)
            draft.place_robot(name, pose or draft.match.starts[name].team(draft.state.cyan_attacks))
