"""What each account may do, by the rows of the topic table and the table of tokens. Pure."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from runtime.access.accounts import ACCOUNTS, Account
from schemas.side import Side
from schemas.tokens import TOKENS
from schemas.topic import Delivery, Party, Topic
from schemas.topics import ALIVE, TOPICS

Robots = Mapping[Side, Sequence[str]]
"""Side → its robots."""


@dataclass(frozen=True)
class Rights:
    """The rights of one account in a match; keys are below the match, with wildcards."""

    account: Account
    robots: Robots

    @cached_property
    def publishes(self) -> list[str]:
        """Keys on which it publishes."""
        return self._written(is_query=False)

    @cached_property
    def subscribes(self) -> list[str]:
        """Keys to which it subscribes."""
        return [key for topic in self._read(is_query=False) for key in self._keys(topic, is_own=False)]

    @cached_property
    def recovers(self) -> list[str]:
        """Keys among these whose missed and earlier messages it fetches from the publisher."""
        recovered = (topic for topic in self._read(is_query=False) if topic.delivery is Delivery.RECOVERED)
        return [key for topic in recovered for key in self._keys(topic, is_own=False)]

    @cached_property
    def queries(self) -> list[str]:
        """Keys that it queries."""
        return self._written(is_query=True)

    @cached_property
    def serves(self) -> list[str]:
        """Keys whose queries it answers."""
        return [key for topic in self._read(is_query=True) for key in self._keys(topic, is_own=True)]

    @cached_property
    def written_patterns(self) -> list[str]:
        """All keys of the topics on which it publishes, of every robot and side."""
        return [topic.fill() for topic in TOPICS.values() if self._is_written(topic, is_query=False)]

    @cached_property
    def declares(self) -> list[str]:
        """Liveliness tokens that it declares."""
        own = ((kind, row.name) for kind, row in TOKENS.items() if not self._parties.isdisjoint(row.writers))
        return [ALIVE.fill(kind=kind, name=name) for kind, form in own for name in self._names(form)]

    @cached_property
    def sees(self) -> list[str]:
        """Liveliness tokens that it sees."""
        return [ALIVE.fill(kind=kind) for kind, row in TOKENS.items() if not self._parties.isdisjoint(row.readers)]

    @property
    def _parties(self) -> frozenset[Party]:
        return frozenset(ACCOUNTS[self.account].parties)

    @property
    def _sides(self) -> tuple[Side, ...]:
        side = self.account.side
        return tuple(Side) if side is None else (side,)

    def _is_written(self, topic: Topic, *, is_query: bool) -> bool:
        kind = topic.delivery is Delivery.QUERY
        is_token = topic.delivery is Delivery.PRESENCE
        is_open = topic.names_sender and not is_token
        return is_open and kind == is_query and not self._parties.isdisjoint(topic.writers)

    def _written(self, *, is_query: bool) -> list[str]:
        written = (topic for topic in TOPICS.values() if self._is_written(topic, is_query=is_query))
        return [key for topic in written for key in self._keys(topic, is_own=True)]

    def _read(self, *, is_query: bool) -> Iterator[Topic]:
        for topic in TOPICS.values():
            is_token = topic.delivery is Delivery.PRESENCE
            kind = topic.delivery is Delivery.QUERY
            if not is_token and kind == is_query and not self._parties.isdisjoint(topic.readers):
                yield topic

    def _keys(self, topic: Topic, *, is_own: bool) -> list[str]:
        """The keys of a topic for this account.

        A team's robots have their own keys only, a coach its side's. A coach reads the keys of every robot where
        the key names no side, and writes the keys of its own robots.
        """
        if self.account.side is None:
            return [topic.fill()]
        sides = {"side": self.account.side.value} if "side" in topic.chunks else {}
        is_bound = "robot" in topic.chunks and not sides and (is_own or Party.ROBOT in self._parties)
        if not is_bound:
            return [topic.fill(**sides)]
        return [topic.fill(robot=robot) for robot in self.robots[self.account.side]]

    def _names(self, form: str) -> list[str]:
        """The names of tokens of this form."""
        if "{robot}" in form:
            return [form.format(robot=robot) for side in self._sides for robot in self.robots[side]]
        pattern = form if form == "*" else form.replace("*", "$*")  # Zenoh's wildcard for a part of a chunk
        return [pattern.format(side=side.value) for side in self._sides] if "{side}" in form else [pattern]


def writers_of(topic: Topic) -> list[Account]:
    """The accounts that publish a topic, or send its query."""
    parties = set(topic.writers) if topic.names_sender else set()
    return [account for account, row in ACCOUNTS.items() if not parties.isdisjoint(row.parties)]
