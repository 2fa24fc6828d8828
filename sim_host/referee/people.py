"""Who takes part: cards, robots off the field with the time that is left to them, programs that are gone."""

import dataclasses
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from schemas.game import OffField, Standing
from schemas.side import Side

PUNISHED = frozenset({OffField.SECOND_YELLOW, OffField.RED_CARD})
"""Whose time off is playing time; a repair or a substitution goes on while the clock stands."""


class Record(NamedTuple):
    """The cards of one robot."""

    yellow: int = 0
    """Those that count toward the next punishment."""
    red: int = 0


class Away(NamedTuple):
    """A robot off the field."""

    why: OffField
    left: float | None = None
    """s until it may come back, at the next stoppage; nothing when no time brings it back."""

    @property
    def for_good(self) -> bool:
        """It is sent off for the rest of the match."""
        return self.why is OffField.RED_CARD and self.left is None


@dataclass(frozen=True, slots=True)
class People:
    """Robots that are not simply there; the mappings are replaced, never changed."""

    records: Mapping[str, Record] = field(default_factory=dict)
    """Robots that were shown a card."""
    away: Mapping[str, Away] = field(default_factory=dict)
    silent: Mapping[str, float] = field(default_factory=dict)
    """Robots whose program is gone, and for how many s."""
    substitutions: Mapping[Side, int] = field(default_factory=dict)
    returned: Mapping[Side, int] = field(default_factory=dict)
    """Robots that have come back in this stoppage."""

    def after(self, silent: Collection[str], dt: float, playing: bool) -> "People":
        """The same `dt` s later, with the robots whose program is gone; `playing` while the game clock runs."""
        if not (self.away or self.silent or silent):
            return self
        away = {name: _after(one, dt, playing) for name, one in self.away.items()}
        lost = {name: self.silent.get(name, 0.0) + dt for name in silent}
        return dataclasses.replace(self, away=away, silent=lost)

    @property
    def news(self) -> tuple[object, ...]:
        """What changes only when somebody is shown a card, leaves or comes back."""
        return (*self.records.items(), *((name, away.why) for name, away in self.away.items()))

    def among(self, names: Collection[str]) -> "People":
        """The same for those of these names: who left the match with its scene is forgotten."""
        records = {name: record for name, record in self.records.items() if name in names}
        away = {name: one for name, one in self.away.items() if name in names}
        silent = {name: time for name, time in self.silent.items() if name in names}
        return dataclasses.replace(self, records=records, away=away, silent=silent)

    def standings(self, names: Collection[str]) -> dict[str, Standing]:
        """Those of these robots that have a card or are off the field, as they are published."""
        if not (self.records or self.away):
            return {}
        found = {}
        for name in names:
            record, away = self.records.get(name), self.away.get(name)
            if record is None and away is None:
                continue
            yellow, red = record or Record()
            left = None if away is None or away.left is None else round(away.left, 3)
            found[name] = Standing(yellow=yellow, red=red, off_field=away.why if away else None, left=left)
        return found


def _after(away: Away, dt: float, playing: bool) -> Away:
    if away.left is None or (away.why in PUNISHED and not playing):
        return away
    return away._replace(left=max(0.0, away.left - dt))
