"""The accounts: the users of the bus of one match, and the parties of the topic table that each stands for."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from schemas.side import Side
from schemas.topic import Party


class Account(StrEnum):
    """A user of the bus."""

    CYAN = "cyan"
    MAGENTA = "magenta"
    CYAN_COACH = "cyan_coach"
    MAGENTA_COACH = "magenta_coach"
    REFEREE = "referee"
    OPERATOR = "operator"
    RECORDER = "recorder"
    VIEWER = "viewer"

    @classmethod
    def of_team(cls, side: Side) -> "Account":
        """The account of a side's robots."""
        return cls(side.value)

    @classmethod
    def of_coach(cls, side: Side) -> "Account":
        """The account of a side's coach."""
        return cls(f"{side.value}_coach")

    @property
    def side(self) -> Side | None:
        """The side that the account belongs to; None for one of both sides or of none."""
        return ACCOUNTS[self].side


@dataclass(frozen=True, slots=True)
class AccountRow:
    """One account."""

    parties: tuple[Party, ...]
    """The parties of the topic table that it stands for."""
    description: str
    side: Side | None = None
    """The side whose robots or whose coach it stands for; None for both sides."""


ACCOUNTS: Mapping[Account, AccountRow] = {
    Account.CYAN: AccountRow((Party.ROBOT,), "the robots of cyan", Side.CYAN),
    Account.MAGENTA: AccountRow((Party.ROBOT,), "the robots of magenta", Side.MAGENTA),
    Account.CYAN_COACH: AccountRow((Party.COACH,), "the coach of cyan", Side.CYAN),
    Account.MAGENTA_COACH: AccountRow((Party.COACH,), "the coach of magenta", Side.MAGENTA),
    Account.REFEREE: AccountRow((Party.REFEREE,), "people and boxes that officiate"),
    Account.OPERATOR: AccountRow(
        (Party.OPERATOR, Party.REFEREE, Party.COACH, Party.VIEWER),
        "the person who runs the host, and the gateway, which officiates and gives the orders of both coaches",
    ),
    Account.RECORDER: AccountRow((Party.RECORDER,), "recorders"),
    Account.VIEWER: AccountRow((Party.VIEWER,), "everyone who only watches"),
}
"""Account → its row."""
