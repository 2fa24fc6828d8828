"""What each account sends, its limit, and its exclusion from the match. Knows neither bus nor clock.

The host does not see which client sent a message. A message counts for the account that alone may send on its key; on
a host without credentials, where anybody may send on any key, for the key itself.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from schemas.bus.refusals import Refusal
from schemas.messages.health import AccountHealth
from schemas.side import Side

OVER_RATE = "over the limit of messages"
CUT_OFF = "cut off"
MOST_EXTRA = 250
"""Most messages beyond the useful ones in a period. A command that answers a new sight is useful; a repeated, late or
invalid one is not, and of what is sent rarely, as orders, every message counts."""
MOST_PERIODS = 12
"""Periods in a row above the limit after which an account is cut off: 3 s at 4 Hz."""
ORDER_WEIGHT = 5
"""An order counts as this many messages: it is sent rarely, and takes long to check."""
_MAX_OTHERS = 20
"""Keys of no robot and of no side that are counted separately: reports on health must not grow with invented keys."""
_OTHERS = "others"
_SIDES = tuple(side.value for side in Side)


@dataclass(slots=True)
class AccountTraffic:
    """What one account has sent."""

    name: str
    may_be_cut_off: bool = True
    messages: int = 0
    size: int = 0
    """Bytes."""
    extra: int = 0
    """Messages of this period that were not useful."""
    read: int = 0
    """Bytes of the messages of this period that were to be read."""
    periods: int = 0
    """Periods in a row above the limit."""
    cut_off: bool = False
    dropped: dict[str, int] = field(default_factory=dict)

    def accept(self, size: int, weight: int = 0) -> bool:
        """Count a message of this size, which is not useful by `weight` messages; returns whether it is to be read."""
        self.messages += 1
        self.size += size
        self.extra += weight
        if self.cut_off:
            self.drop(CUT_OFF)
            return False
        if self.extra > MOST_EXTRA:
            self.extra += not weight
            self.drop(OVER_RATE)
            return False
        self.read += size
        return True

    def drop(self, reason: str, messages: int = 1) -> None:
        """Count dropped messages."""
        self.dropped[reason] = self.dropped.get(reason, 0) + messages

    def end_period(self, forgiving: bool) -> bool:
        """End a period; returns whether the account is cut off from now on."""
        self.periods = self.periods + 1 if self.extra > MOST_EXTRA else 0
        self.extra = self.read = 0
        if forgiving or self.cut_off or not self.may_be_cut_off or self.periods < MOST_PERIODS:
            return False
        self.cut_off = True
        return True

    def admit(self) -> None:
        """Read its messages again."""
        self.cut_off, self.periods, self.extra = False, 0, 0

    def health(self) -> AccountHealth:
        """The counts as they are published."""
        return AccountHealth(messages=self.messages, size=self.size, dropped=dict(self.dropped), cut_off=self.cut_off)


class AccountLimits:
    """All accounts of a match."""

    def __init__(self, sides: Mapping[str, Side], *, has_accounts: bool = False, forgiving: bool = False) -> None:
        """`sides` maps each robot to its side; with `has_accounts`, keys are bound to accounts by credentials."""
        self.sides = sides
        self._has_accounts = has_accounts
        self._forgiving = forgiving
        self._accounts: dict[str, AccountTraffic] = {}
        self._by_key: dict[str, AccountTraffic] = {}
        self._others = 0

    def of_key(self, key: str) -> AccountTraffic:
        """The account that a message on this key counts for."""
        return self._by_key.get(key) or self._learn(key)

    def add_refusals(self, refusals: list[Refusal]) -> None:
        """Count what the bus has refused. Anybody can send on a key of no topic, so this cuts off nobody."""
        for refusal in refusals:
            account = self._account(refusal.key, may_be_cut_off=False)
            account.messages += refusal.messages
            account.size += refusal.size
            account.drop(refusal.reason, refusal.messages)

    @property
    def read(self) -> int:
        """Bytes of the messages of this period that were to be read, of all accounts."""
        return sum(account.read for account in self._accounts.values())

    @property
    def over_limit(self) -> list[str]:
        """Names of the accounts that are above their limit in this period, or cut off."""
        return [name for name, account in self._accounts.items() if account.cut_off or account.extra > MOST_EXTRA]

    def end_period(self) -> list[AccountTraffic]:
        """End a period for all accounts; returns those that are cut off from now on."""
        return [account for account in self._accounts.values() if account.end_period(self._forgiving)]

    def admit(self, name: str) -> bool:
        """Read the messages of an account again that was cut off; returns whether there is one of that name."""
        account = self._accounts.get(name)
        if account is None or not account.cut_off:
            return False
        account.admit()
        return True

    def is_cut_off(self, robot: str) -> bool:
        """Whether the commands of a robot are not read."""
        account = self._by_key.get(f"robot/{robot}/command")
        return account is not None and account.cut_off

    @property
    def cut_off(self) -> list[str]:
        """Names of the accounts that are cut off."""
        return [name for name, account in self._accounts.items() if account.cut_off]

    def health(self) -> dict[str, AccountHealth]:
        """The counts of all accounts that have sent anything."""
        return {name: account.health() for name, account in self._accounts.items()}

    def _learn(self, key: str) -> AccountTraffic:
        name = self._name(key)
        if self._is_known(key):
            account = self._by_key[key] = self._accounts.setdefault(name, AccountTraffic(name))
            return account
        return self._account(name)

    def _is_known(self, key: str) -> bool:
        """Whether this is the key of a robot or of a side of the match."""
        kind, who = (*key.split("/"), "")[:2]
        return (kind == "robot" and who in self.sides) or (kind == "team" and who in _SIDES)

    def _account(self, name: str, *, may_be_cut_off: bool = True) -> AccountTraffic:
        """The account of a key that anybody may have invented."""
        if name not in self._accounts:
            if self._others >= _MAX_OTHERS or name.startswith("robot/"):
                name, may_be_cut_off = _OTHERS, False
            else:
                self._others += 1
        return self._accounts.setdefault(name, AccountTraffic(name, may_be_cut_off))

    def _name(self, key: str) -> str:
        if not self._has_accounts:
            return key
        kind, who, what = (*key.split("/"), "", "")[:3]
        if kind == "robot" and what == "command" and who in self.sides:
            return self.sides[who].value
        if kind == "team" and who in _SIDES:
            return f"{who}_coach"
        return {"robot": "operator", "record": "recorder"}.get(kind, key)
