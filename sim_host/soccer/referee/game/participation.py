"""Participation of the robots: cards, robots off the field with their remaining time, and silent agents."""

import dataclasses
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from schemas.messages.soccer.game import DisciplinaryRecord
from schemas.side import Side
from schemas.soccer.game import Card, OffField

SUSPENSIONS = frozenset({OffField.SECOND_YELLOW, OffField.RED_CARD})
"""Reasons whose time off counts between START and STOP only, as in the league's referee box."""


class CardCount(NamedTuple):
    """The cards of one robot."""

    yellow: int = 0
    """Yellow cards that count toward the next suspension or red card."""
    red: int = 0


class OwedCard(NamedTuple):
    """A card for a foul after which play went on; it is shown at the next stop."""

    robot: str
    rule: str
    """The rule that called the foul."""
    card: Card


class Absence(NamedTuple):
    """A robot off the field."""

    why: OffField
    left: float | None = None
    """s until it may come back, at the next stoppage; None if its return does not depend on time."""

    @property
    def for_good(self) -> bool:
        """Whether it is sent off for the rest of the match."""
        return self.why is OffField.RED_CARD and self.left is None


@dataclass(frozen=True, slots=True)
class Participation:
    """Cards, absences and silence of the robots; the mappings are replaced, never modified."""

    cards: Mapping[str, CardCount] = field(default_factory=dict)
    """Robots that were shown a card."""
    absences: Mapping[str, Absence] = field(default_factory=dict)
    silent: Mapping[str, float] = field(default_factory=dict)
    """Robot whose agent does not answer → for how many s."""
    substitutions: Mapping[Side, int] = field(default_factory=dict)
    returned: Mapping[Side, int] = field(default_factory=dict)
    """Robots that have come back in this stoppage."""
    offences: Mapping[str, Mapping[str, int]] = field(default_factory=dict)
    """Robot → kind of foul → number of its fouls of that kind, where the rule book punishes repeated ones."""
    owed: tuple[OwedCard, ...] = ()
    """Cards that are shown at the next stop, in the order of the fouls."""

    def after(self, silent: Collection[str], dt: float, running: bool) -> "Participation":
        """The participation `dt` s later, with these robots silent; `running` between START and STOP."""
        if not (self.absences or self.silent or silent):
            return self
        absences = {name: _after(one, dt, running) for name, one in self.absences.items()}
        lost = {name: self.silent.get(name, 0.0) + dt for name in silent}
        return dataclasses.replace(self, absences=absences, silent=lost)

    def with_owed_card(self, robot: str, rule: str, card: Card) -> "Participation":
        """The participation with one more card that is shown at the next stop."""
        return dataclasses.replace(self, owed=(*self.owed, OwedCard(robot, rule, card)))

    @property
    def change_key(self) -> tuple[object, ...]:
        """A value that changes only when a robot is shown a card, leaves or comes back."""
        return (*self.cards.items(), *((name, away.why) for name, away in self.absences.items()))

    def of_robots(self, names: Collection[str]) -> "Participation":
        """The participation of these robots only, without those that a scene has removed."""
        cards = {name: record for name, record in self.cards.items() if name in names}
        absences = {name: one for name, one in self.absences.items() if name in names}
        silent = {name: time for name, time in self.silent.items() if name in names}
        offences = {name: kinds for name, kinds in self.offences.items() if name in names}
        owed = tuple([card for card in self.owed if card.robot in names])
        return dataclasses.replace(self, cards=cards, absences=absences, silent=silent, offences=offences, owed=owed)

    def disciplinary_records(self, names: Collection[str]) -> dict[str, DisciplinaryRecord]:
        """Records of the given robots that are carded or off the field, for publication."""
        if not (self.cards or self.absences):
            return {}
        found = {}
        for name in names:
            record, away = self.cards.get(name), self.absences.get(name)
            if record is None and away is None:
                continue
            yellow, red = record or CardCount()
            left = None if away is None or away.left is None else round(away.left, 3)
            found[name] = DisciplinaryRecord(yellow=yellow, red=red, off_field=away.why if away else None, left=left)
        return found


def _after(away: Absence, dt: float, running: bool) -> Absence:
    if away.left is None or (away.why in SUSPENSIONS and not running):
        return away
    return away._replace(left=max(0.0, away.left - dt))
