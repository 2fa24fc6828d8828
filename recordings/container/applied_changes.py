"""The lasting changes in `host/applied`. They are read for every tick, so only their fields are decoded."""

from typing import Any

import msgspec


class Changes(msgspec.Struct, frozen=True, gc=False):
    """The fields of `schemas.messages.applied.Applied` that stay in force in all later ticks."""

    robots: list[Any] | None = None
    obstacles: list[Any] | None = None
    parameters: dict[str, Any] = {}

    def __bool__(self) -> bool:
        """Whether anything changes."""
        return self.robots is not None or self.obstacles is not None or bool(self.parameters)


_NOTHING = Changes()
_decode = msgspec.json.Decoder(Changes).decode


def changes_in(payload: bytes) -> Changes:
    """The changes of a tick; no changes if the payload is not a valid message."""
    try:
        return _decode(payload)
    except (ValueError, RecursionError):
        return _NOTHING
