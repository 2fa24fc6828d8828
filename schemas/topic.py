"""A topic: its key, its message, who publishes and reads it, and how it is delivered."""

import re
from dataclasses import dataclass
from enum import StrEnum
from functools import cache

from schemas.errors import TouchlineError, did_you_mean
from schemas.wire.message import Message

MAX_CHUNK = 64
"""Most characters of one chunk of a key that is read."""


class Party(StrEnum):
    """The roles of the processes on the bus."""

    HOST = "host"
    ROBOT = "robot"
    """The robot named in the key."""
    COACH = "coach"
    """The coach of the side named in the key; of either side where the key names none."""
    REFEREE = "referee"
    RECORDER = "recorder"
    VIEWER = "viewer"
    OPERATOR = "operator"
    """The person who runs the host."""


class Delivery(StrEnum):
    """How a message is delivered."""

    NEWEST = "newest"
    """Dropped under congestion; a slow subscriber gets only the newest message."""
    EVERY = "every"
    """Dropped under congestion; a subscriber gets all messages that arrive, in order."""
    RECOVERED = "recovered"
    """As `every`, and dropped messages are fetched from the publisher's cache."""
    QUERY = "query"
    """A request with a reply."""
    PRESENCE = "presence"
    """A liveliness token: it exists while its process does."""


@dataclass(frozen=True, slots=True)
class Topic:
    """One row of the table."""

    key: str
    """Key below `touchline/{match}/`, with its variable chunks in braces."""
    message: type[Message] | None
    """The message, or the request of a query; None for a liveliness token."""
    writer: Party
    readers: tuple[Party, ...]
    rate: str
    """How often it is published, in words."""
    delivery: Delivery
    recorded: bool
    description: str
    reply: type[Message] | None = None
    """The reply of a query."""
    cache_size: int = 1500
    """Messages that the publisher of a `recovered` topic keeps for each key: 30 s of ticks in real time."""
    other_writers: tuple[Party, ...] = ()
    """Who writes, apart from `writer`."""

    names_sender: bool = True
    """Whether the key tells the host what it must know of the sender. Hosts with credentials admit no other topic."""

    @property
    def writers(self) -> tuple[Party, ...]:
        """All who publish it, or send the query."""
        return (self.writer, *self.other_writers)

    @property
    def chunks(self) -> tuple[str, ...]:
        """Names of the variable chunks of the key."""
        return tuple(re.findall(r"{(\w+)}", self.key))

    def fill(self, **chunks: str) -> str:
        """The key with its chunks filled in; a missing chunk becomes `*`.

        Raises:
            TouchlineError: the key has no such chunk.
        """
        for name in chunks:
            if name not in self.chunks:
                raise TouchlineError(f"topic {self.key} has no chunk {{{name}}}; {did_you_mean(name, self.chunks)}")
        return self.key.format_map({name: chunks.get(name, "*") for name in self.chunks})

    def has_key(self, key: str) -> bool:
        """Whether this is a key of the topic, without wildcards and with chunks of ordinary length.

        A client may publish on a key with wildcards, which reaches all subscriptions that intersect with it.
        """
        return _usual_pattern(self.key).fullmatch(key) is not None

    def match(self, key: str) -> dict[str, str] | None:
        """The chunks of a filled-in key; None where the key belongs to another topic."""
        found = _pattern(self.key).fullmatch(key)
        return found.groupdict() if found else None


@cache
def _usual_pattern(key: str) -> re.Pattern[str]:
    """The pattern of filled-in keys that are read."""
    return re.compile(re.sub(r"{(\w+)}", rf"[^/*$]{{1,{MAX_CHUNK}}}", key))


@cache
def _pattern(key: str) -> re.Pattern[str]:
    """The pattern of filled-in keys."""
    return re.compile(re.sub(r"{(\w+)}", r"(?P<\1>[^/]+)", key))
