"""What others than the host said in a replayed match, handed on as its host did: recorders take it from there."""

from typing import Any

from recordings.reader import Recorded
from schemas.bus.contract import Bus
from schemas.intake import payload_field
from schemas.topics import INTAKE


class Relay:
    """Collects what robots and coaches said in one moment, and sends it once."""

    def __init__(self, bus: Bus) -> None:
        self._writer = bus.publisher(INTAKE)
        self._entries: list[dict[str, Any]] = []
        self._sequences: dict[str, int] = {}

    def note(self, recorded: Recorded) -> None:
        """One of them says this; numbers count what is said in the replay."""
        number = self._sequences[recorded.key] = self._sequences.get(recorded.key, -1) + 1
        told = {"sequence": number, "sent_ns": recorded.sent_ns, "sim_ns": recorded.log_ns}
        self._entries.append({"key": recorded.key, **payload_field(recorded.payload), **told})

    def send(self, tick: int, *, empty: bool) -> None:
        """Send what was noted; with `empty` also nothing, so that a recorder knows how far the replay is."""
        if self._entries or empty:
            self._writer.put_fields({"tick": tick, "entries": self._entries})
            self._entries = []
