"""The liveliness tokens: kind → who declares such a token and who sees it. Access rules are derived from this table."""

from dataclasses import dataclass
from enum import StrEnum

from schemas.topic import Party


class PresenceKind(StrEnum):
    """The kind of a process in its liveliness token `alive/{kind}/{name}`."""

    HOST = "host"
    REPLAY = "replay"
    """In addition to `host`: this host replays a recording."""
    AGENT = "agent"
    """It has the name of its robot."""
    SESSION = "session"
    """An agent that claims a robot; its name is no other agent's."""
    RECORDER = "recorder"
    COACH = "coach"
    """A page or a terminal that shows the match."""
    REFBOX = "refbox"
    """A base station that is connected to a league's referee box; it has the name of its side."""
    REFEREE = "referee"
    """A gateway through which people officiate; its name is that in their requests."""


@dataclass(frozen=True, slots=True)
class Token:
    """One kind of token."""

    writers: tuple[Party, ...]
    readers: tuple[Party, ...]
    name: str = "*"
    """Form of its name: `{robot}` and `{side}` stand for the writer's, `*` for any name."""


_WATCHERS = (Party.COACH, Party.REFEREE, Party.RECORDER, Party.VIEWER, Party.OPERATOR)
_ALL = (Party.ROBOT, *_WATCHERS)
SESSION_SEPARATOR = "_"
"""Stands between the side and the rest of a session's name in a match with credentials: `cyan_3f0c…`."""

TOKENS: dict[PresenceKind, Token] = {
    PresenceKind.HOST: Token((Party.HOST,), _ALL),
    PresenceKind.REPLAY: Token((Party.HOST,), _ALL),
    PresenceKind.AGENT: Token((Party.ROBOT,), (Party.HOST, *_WATCHERS), "{robot}"),
    PresenceKind.SESSION: Token((Party.ROBOT,), (Party.HOST,), f"{{side}}{SESSION_SEPARATOR}*"),
    PresenceKind.RECORDER: Token((Party.RECORDER,), (Party.HOST, *_WATCHERS)),
    PresenceKind.COACH: Token((Party.COACH, Party.REFEREE, Party.VIEWER, Party.OPERATOR), (Party.HOST, *_WATCHERS)),
    PresenceKind.REFBOX: Token((Party.REFEREE,), (Party.HOST, *_WATCHERS)),
    PresenceKind.REFEREE: Token((Party.REFEREE,), (Party.HOST,)),
}
"""Kind → its row. Names of sessions and of referees are secrets between their process and the host."""
