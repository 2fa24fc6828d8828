"""What a topic is: its key, what it carries, who writes and reads it, and how it travels."""

import re
from dataclasses import dataclass
from enum import StrEnum
from functools import cache

from schemas.errors import TouchlineError, did_you_mean
from schemas.message import WireMessage


class Party(StrEnum):
    """Who speaks and listens on the bus."""

    HOST = "host"
    ROBOT = "robot"
    """The robot named in the key."""
    COACH = "coach"
    """The coach of the side named in the key; of either side where the key names none."""
    REFEREE = "referee"
    RECORDER = "recorder"
    VIEWER = "viewer"
    OPERATOR = "operator"
    """Whoever runs the host."""


class Delivery(StrEnum):
    """How a message travels."""

    NEWEST = "newest"
    """Dropped rather than waited for; a reader that is late gets the newest alone."""
    EVERY = "every"
    """Dropped rather than waited for; a reader gets all that arrive, in order."""
    RECOVERED = "recovered"
    """As `every`, and what was dropped is fetched again from the writer's cache."""
    QUERY = "query"
    """Asked for, and answered."""
    PRESENCE = "presence"
    """A liveliness token: it exists while its process does."""


@dataclass(frozen=True, slots=True)
class Topic:
    """One row of the table."""

    key: str
    message: type[WireMessage] | None
    writer: Party
    readers: tuple[Party, ...]
    rate: str
    delivery: Delivery
    recorded: bool
    description: str
    reply: type[WireMessage] | None = None
    cache_size: int = 1500
    """Messages of a `recovered` topic that a writer keeps of a key: 30 s of ticks in real time."""

    @property
    def chunks(self) -> tuple[str, ...]:
        """Names of the variable chunks of the key."""
        return tuple(re.findall(r"{(\w+)}", self.key))

    def fill(self, **chunks: str) -> str:
        """The key with its chunks filled in; a chunk left out becomes `*`.

        Raises:
            TouchlineError: a chunk that the key does not have.
        """
        for name in chunks:
            if name not in self.chunks:
                raise TouchlineError(f"topic {self.key} has no chunk {{{name}}}; {did_you_mean(name, self.chunks)}")
        return self.key.format_map({name: chunks.get(name, "*") for name in self.chunks})

    def match(self, key: str) -> dict[str, str] | None:
        """The chunks of a filled-in key, or nothing when the key belongs to another topic."""
        found = _pattern(self.key).fullmatch(key)
        return found.groupdict() if found else None


@cache
def _pattern(key: str) -> re.Pattern[str]:
    """What a filled-in key looks like."""
    return re.compile(re.sub(r"{(\w+)}", r"(?P<\1>[^/]+)", key))
