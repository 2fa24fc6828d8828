"""Hands on what others sent to the host, byte for byte, so that a recorder loses none of it.

A robot sends its commands once and forgets them. Handed on with the host's own messages they can be fetched again from
its cache, whatever program the robot is, and a recording has exactly what the host took in.
"""

from typing import Any

from schemas.bus.contract import Bus, Received
from schemas.intake import payload_field
from schemas.topics import INTAKE

_MOST = 1000
"""Payloads of one tick that are handed on; a flood is not. What is left out shows as a gap in its sender's numbers."""
_LONGEST = 65_536
"""Bytes of a payload that is handed on: no longer one is a valid message."""
_AT_ONCE = 256 * 1024
"""Bytes after which another message begins."""


class Relay:
    """Collects what came, and sends it once in a tick."""

    def __init__(self, bus: Bus) -> None:
        self._writer = bus.publisher(INTAKE)
        self._entries: list[dict[str, Any]] = []
        self._count = self._size = 0
        self._tick = 0

    def note(self, received: Received) -> None:
        """Something came that is to be recorded."""
        payload = received.payload
        if self._count >= _MOST or len(payload) > _LONGEST:
            return
        if self._size > _AT_ONCE:
            self._put()
        entry = {"key": received.key, **payload_field(payload), "arrived_ns": received.arrived_ns}
        stamp = received.stamp
        if stamp is not None:
            entry["sequence"], entry["sent_ns"], entry["sim_ns"] = stamp
        self._entries.append(entry)
        self._count += 1
        self._size += len(payload)

    def send(self, tick: int) -> None:
        """The tick has ended: send what came, be it nothing, so that a recorder knows how far the host is with this."""
        self._tick = tick
        self._put()
        self._count, self._tick = 0, tick + 1

    def _put(self) -> None:
        self._writer.put_fields({"tick": self._tick, "entries": self._entries})
        self._entries, self._size = [], 0
