"""Carries out a decision of a rule or of people: score, event, card and restart."""

from schemas.soccer.game import EventKind, Score
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.referee_state import RefereeState
from sim_host.soccer.referee.procedures import discipline, offences, penalties, periods, restart
from sim_host.soccer.referee.ruling_draft import RulingDraft


def carry_out(draft: RulingDraft, rule: str, decision: Decision) -> None:
    """Carry out a decision; `rule` is the rule or action that made it."""
    if decision.ends_half:
        periods.end_half(draft, rule, decision.text)
        return
    if decision.goal_for is not None:
        draft.state = draft.state._replace(score=draft.state.score.plus(decision.goal_for))
    if decision.shot_scored is not None:
        penalties.count(draft, decision.shot_scored)
    draft.add_decision_event(decision.kind, rule, decision, decision.text, _published_score(draft.state, decision))
    if decision.kind is EventKind.FOUL and decision.robot is not None:
        draft.state = draft.state._replace(offender=decision.robot)
        offences.count(draft, rule, decision.robot)
    if decision.card is not None and decision.robot is not None:
        discipline.show_card(draft, rule, decision.robot, decision.card)
    if decision.shot_scored is not None:
        penalties.next_penalty(draft, rule)
        return
    if draft.state.shoot_out is not None:
        penalties.retake(draft)
    restart.stop(draft, rule, decision.restart)


def _published_score(state: RefereeState, decision: Decision) -> Score | None:
    if decision.shot_scored is not None and state.shoot_out is not None:
        return state.shoot_out.goals
    return state.score if decision.goal_for is not None else None
