"""Repeated fouls: a robot that commits fouls of one kind again and again is shown a yellow card.

From the number that the rule book sets, each further foul of the kind is a yellow card, if the foul is none by itself.
Standing too near at START and encroaching after it are one kind. A foul counts also if an advantage was played, and
does not if people overrule or undo it.

Section: misconduct; ours: the numbers.
Measures: the fouls of each robot, by the rule that called them.
Not judged: fouls of several robots of a side in turn; intent.
"""

import dataclasses

from schemas.soccer.game import Card, EventKind
from sim_host.soccer.referee.game.decision import Decision
from sim_host.soccer.referee.ruling_draft import RulingDraft

ENCROACHMENT = "encroachment"
_KINDS = {"positions": ENCROACHMENT}
"""Rule → the kind of its fouls, where it is not the rule's own name."""


def count(draft: RulingDraft, rule: str, robot: str | None) -> None:
    """Count a foul of a robot, if the rule book punishes repeated ones."""
    if robot is None or not _limit(draft, rule):
        return
    participation = draft.state.participation
    mine = participation.offences.get(robot, {})
    offences = {**participation.offences, robot: {**mine, _kind(rule): _number(draft, rule, robot) + 1}}
    draft.state = draft.state._replace(participation=dataclasses.replace(participation, offences=offences))


def is_next_a_card(draft: RulingDraft, rule: str, robot: str) -> bool:
    """Whether the next foul of a robot by this rule is a yellow card because it is repeated."""
    limit = _limit(draft, rule)
    return limit > 0 and _number(draft, rule, robot) + 1 >= limit


def with_card(draft: RulingDraft, rule: str, decision: Decision) -> Decision:
    """The decision on a foul, with a yellow card if the robot repeats it and it is no card by itself."""
    robot = decision.robot
    if decision.kind is not EventKind.FOUL or robot is None or decision.card is not None:
        return decision
    if not is_next_a_card(draft, rule, robot):
        return decision
    text = f"{decision.text}; foul {_number(draft, rule, robot) + 1} of this kind by {robot}"
    return dataclasses.replace(decision, text=text, card=Card.YELLOW)


def _kind(rule: str) -> str:
    return _KINDS.get(rule, rule)


def _limit(draft: RulingDraft, rule: str) -> int:
    numbers = draft.book.discipline
    return numbers.repeated_encroachment if _kind(rule) == ENCROACHMENT else numbers.repeated_fouls


def _number(draft: RulingDraft, rule: str, robot: str) -> int:
    """Number of fouls of this kind that the robot has committed."""
    return draft.state.participation.offences.get(robot, {}).get(_kind(rule), 0)
