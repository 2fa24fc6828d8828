"""Second yellow card for any robot: it is suspended, whatever it was shown before."""

from schemas.game import Card
from schemas.messages.game import RefereeAction
from sim_host.referee.actions.legality import named_robot, no_match, no_robot, sent_off
from sim_host.referee.procedures import discipline
from sim_host.referee.ruling_draft import RulingDraft


def why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    """Why the action is illegal now, or None."""
    return no_match(draft) or no_robot(draft, action) or sent_off(draft, action)


def apply(draft: RulingDraft, action: RefereeAction) -> None:
    """Show the card."""
    discipline.show_card(draft, action.action, named_robot(action), Card.YELLOW, second=True)
