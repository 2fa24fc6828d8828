"""Cards for any robot: the rule book says how many yellow ones send it off, and for how long a red one does.

A double yellow card is the second one: the robot is suspended, whatever it was shown before.
"""

from functools import partial

from schemas.messages.soccer.game import RefereeAction
from schemas.soccer.game import Card
from sim_host.soccer.referee.actions.action import Action
from sim_host.soccer.referee.actions.legality import named_robot, no_match, no_robot, sent_off
from sim_host.soccer.referee.procedures import discipline
from sim_host.soccer.referee.ruling_draft import RulingDraft


def card_action(card: Card, *, second: bool = False) -> Action:
    """The action that shows this card."""
    return Action(_why_illegal, partial(_show, card, second))


def _why_illegal(draft: RulingDraft, action: RefereeAction) -> str | None:
    return no_match(draft) or no_robot(draft, action) or sent_off(draft, action)


def _show(card: Card, second: bool, draft: RulingDraft, action: RefereeAction) -> None:
    discipline.show_card(draft, action.action, named_robot(action), card, second=second)
