"""What each account sends, and its limit. Knows neither bus nor clock.

The host does not see which client sent a message. A message counts for the account that alone may send on its key; on
a host without credentials, where anybody may send on any key, for the key itself.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from runtime.access.accounts import Account
from runtime.bus.refusals import Refusal
from schemas.messages.health import AccountHealth
from schemas.side import Side

OVER_LIMIT = "over the limit of messages"
EXTRA_RATE = 1000.0
"""Messages a second of wall time that an account may send beyond the useful ones. A command that answers a new sight is
useful; a repeated or invalid one is not, and of what is sent rarely, as orders, every message counts."""
MOST_EXTRA = 3000
"""Most such messages that count at the same time: what arrives in a burst after a stall is no flood."""
ORDER_WEIGHT = 5
"""An order counts as this many messages: it is sent rarely, and takes long to check."""
_MAX_OTHERS = 20
"""Keys of no robot and of no side that are counted separately: reports on health must not grow with invented keys."""
_OTHERS = "others"
_SIDES = tuple(side.value for side in Side)


@dataclass(slots=True)
class AccountTraffic:
    """What one account has sent."""

    messages: int = 0
    size: int = 0
    """Bytes."""
    extra: float = 0.0
    """Messages that were not useful, less those that time has allowed."""
    dropped: dict[str, int] = field(default_factory=dict)

    def accept(self, size: int, weight: int = 0) -> bool:
        """Count a message of this size, which is not useful by `weight` messages; returns whether it is to be read."""
        self.messages += 1
        self.size += size
        if self.extra + weight > MOST_EXTRA:
            self.drop(OVER_LIMIT)
            return False
        self.extra += weight
        return True

    def drop(self, reason: str, messages: int = 1) -> None:
        """Count dropped messages."""
        self.dropped[reason] = self.dropped.get(reason, 0) + messages


class AccountLimits:
    """All accounts of a match."""

    def __init__(self, sides: Mapping[str, Side], *, has_accounts: bool = False) -> None:
        """`sides` maps each robot to its side; with `has_accounts`, keys are bound to accounts by credentials."""
        self.sides = sides
        self._has_accounts = has_accounts
        self._accounts: dict[str, AccountTraffic] = {}
        self._by_key: dict[str, AccountTraffic] = {}
        self._others = 0
        self._reported: set[str] = set()

    def of_key(self, key: str) -> AccountTraffic:
        """The account that a message on this key counts for."""
        return self._by_key.get(key) or self._learn(key)

    def add_refusals(self, refusals: list[Refusal]) -> None:
        """Count what the bus has refused."""
        for refusal in refusals:
            account = self._account(refusal.key)
            account.messages += refusal.messages
            account.size += refusal.size
            account.drop(refusal.reason, refusal.messages)

    def pass_time(self, seconds: float) -> None:
        """Allow each account the messages of this wall time."""
        for account in self._accounts.values():
            account.extra = max(0.0, account.extra - EXTRA_RATE * seconds)

    def pop_over_limit(self) -> list[str]:
        """Names of the accounts that have gone over their limit for the first time since the last call."""
        over = [
            name for name, one in self._accounts.items() if OVER_LIMIT in one.dropped and name not in self._reported
        ]
        self._reported.update(over)
        return over

    def forfeiting(self) -> list[Side]:
        """The sides whose robots have gone over the limit of their account."""
        if not self._has_accounts:
            return []  # anybody may have sent it
        return [side for side in Side if Account.of_team(side).value in self._reported]

    def health(self) -> dict[str, AccountHealth]:
        """The counts of all accounts that have sent anything."""
        return {
            name: AccountHealth(messages=one.messages, size=one.size, dropped=dict(one.dropped))
            for name, one in self._accounts.items()
        }

    def _learn(self, key: str) -> AccountTraffic:
        name = self._name(key)
        if self._is_known(key):
            account = self._by_key[key] = self._accounts.setdefault(name, AccountTraffic())
            return account
        return self._account(name)

    def _is_known(self, key: str) -> bool:
        """Whether this is the key of a robot or of a side of the match."""
        kind, who = (*key.split("/"), "")[:2]
        return (kind == "robot" and who in self.sides) or (kind == "team" and who in _SIDES)

    def _account(self, name: str) -> AccountTraffic:
        """The account of a key that anybody may have invented."""
        if name not in self._accounts:
            if self._others >= _MAX_OTHERS or name.startswith("robot/"):
                name = _OTHERS
            else:
                self._others += 1
        return self._accounts.setdefault(name, AccountTraffic())

    def _name(self, key: str) -> str:
        if not self._has_accounts:
            return key
        kind, who, what = (*key.split("/"), "", "")[:3]
        if kind == "robot" and what == "command" and who in self.sides:
            return self.sides[who].value
        if kind == "team" and who in _SIDES:
            return f"{who}_coach"
        return {"robot": "operator", "record": "recorder"}.get(kind, key)
