"""What `host/applied` changes for good: read of every tick, so nothing else of the message is taken out of it."""

from typing import Any

import msgspec


class Changes(msgspec.Struct, frozen=True, gc=False):
    """As much of a `schemas.messages.host.Applied`; what there is stays in force in all later ticks."""

    robots: list[Any] | None = None
    obstacles: list[Any] | None = None
    parameters: dict[str, Any] = {}

    def __bool__(self) -> bool:
        """Whether anything changes."""
        return self.robots is not None or self.obstacles is not None or bool(self.parameters)


_NOTHING = Changes()
_decode = msgspec.json.Decoder(Changes).decode


def changes_in(payload: bytes) -> Changes:
    """The changes of a tick; none in a payload that is no such message."""
    try:
        return _decode(payload)
    except (ValueError, RecursionError):
        return _NOTHING
