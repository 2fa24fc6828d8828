"""Goal: a goal for a side by decision of a person; the other side kicks off.

In a shoot-out, the attempt of the side that takes the penalty ends with a goal. A referee box counts it after its STOP.
"""

import dataclasses

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import EventKind, GameStage
from sim_host.soccer.referee.actions.legality import no_half, no_side, no_such_robot
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.game.restart import kick_off_after_goal
from sim_host.soccer.referee.procedures.decision import carry_out
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_half(draft) or no_side(action) or no_such_robot(draft, action) or _not_its_penalty(draft, action)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Count the goal."""
    side = action.side
    if side is None:
        return
    out = draft.state.shoot_out
    if out is not None and not draft.state.running:
        draft.state = draft.state._replace(shoot_out=dataclasses.replace(out, goals=out.goals.plus(side)))
        text = f"the last penalty of {side} scored, decided by {action.source}"
        draft.add_event(EventKind.SHOT, action.action, text, side=side, score=out.goals.plus(side))
        return
    if draft.state.stage is GameStage.SHOOT_OUT:
        text = f"penalty of {side} scored, decided by {action.source}"
        shot = Decision(EventKind.SHOT, text, shot_scored=True, side=side, robot=action.robot)
        carry_out(draft, action.action, shot)
        return
    decision = Decision(
        kind=EventKind.GOAL,
        text=f"goal for {side}, decided by {action.source}",
        restart=kick_off_after_goal(side),
        goal_for=side,
        side=side,
        robot=action.robot,
    )
    carry_out(draft, action.action, decision)


def _not_its_penalty(draft: RulingDraft, action: RefereeAction) -> str | None:
    """In a shoot-out, only the side that takes the penalty can score, after START; a box counts it after its STOP."""
    state, out, side = draft.state, draft.state.shoot_out, action.side
    if state.refbox_decides and out is not None and side is not None and not state.running:
        missed = out.goals.of(side) < out.taken.of(side)
        return None if missed else f"{side} has scored all of its {out.taken.of(side)} penalties"
    if state.stage is not GameStage.SHOOT_OUT or (state.running and state.side is action.side):
        return None
    return f"{action.side} is not taking a penalty of the shoot-out now"
