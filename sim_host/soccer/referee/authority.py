"""Authority: the referee decides alone, or proposes decisions that people may overrule, or leaves them to people.

In `automatic` officiating every decision is carried out in its tick. In `mixed` officiating a decision is first an
event of its own, a proposal. It is carried out when it is confirmed, or when the time that the match file sets is up.
Meanwhile the game goes on, nothing else is judged, and no robot is shown a card for a wrong position. In `manual`
officiating the referee keeps the clocks and places the ball; people decide, and give START. `undo` restores the state
before the last decision, with its score and cards, while the clocks go on; a second `undo` restores the one before
that. A restart that was signalled is signalled again; if play was on, the ball is dropped.

Section: ours.
Measures: nothing of its own.
Not judged: whether people who officiate are right.
"""

from schemas.soccer.game import RESTARTS, EventKind, GameStage, OfficiatingMode, Phase
from sim_host.soccer.referee.evidence import NO_EVIDENCE
from sim_host.soccer.referee.game.decision import Decision, Proposal
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.game.restart import Restart
from sim_host.soccer.referee.game.timing import reached
from sim_host.soccer.referee.placement.bench import bench_pose, entry_pose
from sim_host.soccer.referee.placement.spots import restart_at
from sim_host.soccer.referee.procedures import advantage, offences, penalties, restart
from sim_host.soccer.referee.procedures.decision import carry_out
from sim_host.soccer.referee.rules import Rule
from sim_host.soccer.referee.ruling_draft import RulingDraft

_UNDO_DEPTH = 20
"""Decisions of a half that can be undone, the newest first."""


def judge(draft: RulingDraft, found: tuple[Rule, Decision] | None) -> None:
    """Carry out, propose or note a decision of a rule; carry out a proposal that was not overruled in time."""
    proposal = draft.state.proposal
    if proposal is not None and is_due(proposal):
        decide(draft, proposal.rule, proposal.decision)
        return
    judged = None if found is None else (found[0].name, offences.with_card(draft, found[0].name, found[1]))
    at_once = found is not None and not found[0].while_running
    called = judged
    if draft.state.advantage is not None:
        called = advantage.resolve(draft, judged)
    elif called is not None and proposal is None and advantage.is_played(draft, called[1]):
        advantage.note(draft, *called)
        return
    if called is None:
        return
    if draft.match.mode is not OfficiatingMode.MIXED or (at_once and called is judged):
        decide(draft, *called)
    elif proposal is None:
        propose(draft, *called)


def decide(draft: RulingDraft, rule: str, decision: Decision) -> None:
    """Carry out a decision, and keep the state before it for `undo`."""
    save_for_undo(draft)
    draft.state = draft.state._replace(proposal=None)
    carry_out(draft, rule, decision)


def propose(draft: RulingDraft, rule: str, decision: Decision) -> None:
    """Report a decision that people may overrule; meanwhile the game goes on, and nothing else is judged."""
    proposal = Proposal(rule, decision, draft.match.proposal)
    draft.state = draft.state._replace(proposal=proposal)
    draft.add_decision_event(
        EventKind.PROPOSAL, rule, decision, f"proposed, decided in {proposal.left:g} s: {decision.text}"
    )


def is_due(proposal: Proposal | None) -> bool:
    """Whether the time to overrule a proposal is up."""
    return proposal is not None and reached(0.0, proposal.left)


def save_for_undo(draft: RulingDraft) -> None:
    """Keep the present state for `undo`, in place of the oldest one where there are many."""
    state = draft.state
    kept = (*state.history, state._replace(history=(), proposal=None, advantage=None))
    draft.state = state._replace(history=kept[-_UNDO_DEPTH:])


def why_not_undo(draft: RulingDraft) -> str | None:
    """Why the last decision cannot be undone, or None."""
    if not draft.state.history:
        return "no decision can be undone: there was none in this half, or all were undone already"
    before = draft.state.history[-1]
    if not draft.state.refbox_decides and before.timing.runs and reached(draft.state.clock, before.timing.limit):
        return "the half's time is up"
    return None


def undo(draft: RulingDraft) -> None:
    """Restore the state before the last decision, except the clocks.

    Score, cards, absences and the half are restored. A restart that was signalled is signalled again. If play was on,
    it is halted, and the ball is dropped where it was; in a shoot-out, the penalty is taken again.
    """
    now = draft.state
    if not now.history:
        return
    *earlier, before = now.history
    timing = before.timing._replace(clock=now.clock, effective=now.timing.effective, timer=0.0)
    draft.state = before._replace(
        timing=timing,
        still=0.0,
        ball=now.ball,
        evidence=NO_EVIDENCE,
        set_piece=None,
        history=tuple(earlier),
        refbox_gone=now.refbox_gone,
    )
    _undo_absences(draft, now)
    signalled = before.restart
    if before.running:
        restart.stop(draft, "undo", _restart_after_undo(draft, before))
    elif signalled is not None and before.phase in RESTARTS:
        restart.signal(draft, signalled)


def _restart_after_undo(draft: RulingDraft, before: RefereeState) -> Restart:
    """The restart after a decision is undone that had stopped the running game."""
    if before.stage is GameStage.SHOOT_OUT and before.side is not None:
        return penalties.penalty_for(draft, before.side)
    x, y = before.ball[:2] if before.ball is not None else draft.ball_spot
    return restart_at(draft.match, draft.state, Phase.DROP_BALL, None, (x, y))


def _undo_absences(draft: RulingDraft, now: RefereeState) -> None:
    """Place robots that the decision sent off on the field again, and those that it brought back on the bench."""
    was, is_now = draft.state.participation.absences, now.participation.absences
    for name in draft.match.roster.names:
        if name in was and name not in is_now:
            draft.place_robot(name, bench_pose(draft.match, draft.state, name))
        elif name in is_now and name not in was:
            pose = entry_pose(draft.match, draft.state, draft.snapshot, name)
            draft.place_robot(name, pose or draft.match.starts[name].team(draft.state.cyan_attacks))
