"""Cancel goal: takes one goal from a side's score by decision of a person, whenever it was scored; the game goes on.

Where the side has goals in a penalty shoot-out, it loses one of these.

To cancel a goal at once, before anything else is decided, `undo` is better: it also takes back the restart.
"""

import dataclasses

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import EventKind
from sim_host.soccer.referee.actions.legality import no_match, no_side
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_match(draft) or no_side(action) or _no_goal(draft, action)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Take away a goal."""
    side = action.side
    if side is None:
        return
    out = draft.state.shoot_out
    if out is not None and out.goals.of(side):
        goals = out.goals.plus(side, -1)
        draft.state = draft.state._replace(shoot_out=dataclasses.replace(out, goals=goals))
        text = f"a goal of {side} in the shoot-out is cancelled by {action.source}"
        draft.add_event(EventKind.NO_GOAL, action.action, text, side=side, score=goals)
        return
    score = draft.state.score.plus(side, -1)
    draft.state = draft.state._replace(score=score)
    text = f"a goal of {side} is cancelled by {action.source}"
    draft.add_event(EventKind.NO_GOAL, action.action, text, side=side, score=score)


def _no_goal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """The side must have scored."""
    out = draft.state.shoot_out
    if action.side is None or draft.state.score.of(action.side) or (out is not None and out.goals.of(action.side)):
        return None
    return f"{action.side} has no goal"
