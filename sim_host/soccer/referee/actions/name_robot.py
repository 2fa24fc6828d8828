"""Name robot: the answer to the question which robot of a side an action concerns; the action is carried out for it."""

from schemas.messages.soccer.game import RefereeAction
from sim_host.soccer.referee.actions import naming
from sim_host.soccer.referee.actions.legality import named_robot, no_match, no_robot
from sim_host.soccer.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_match(draft) or no_robot(draft, action) or naming.why_no_answer(draft, named_robot(action))


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Carry out the action that the question is about."""
    naming.answer(draft, named_robot(action))
