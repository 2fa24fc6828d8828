"""From a stream of bytes to messages: JSON objects ended by a zero byte, or single characters. Pure.

The messages do not depend on how the stream is cut into pieces. Anything else is counted and left out, and reading
resumes after the next zero byte.
"""

import json
import re
from collections.abc import Iterator
from typing import Any

from schemas.messages.soccer.league.box_protocol import BoxProtocol
from schemas.messages.soccer.league.signals import BY_CHARACTER

LIMIT = 65_536
"""Bytes of one JSON message, at most; a larger one comes from a sender without zero bytes. World states of teams have
2 to 10 kB."""
MOST_OBJECTS = 100
"""Objects between two zero bytes; software that sends none of these bytes is read all the same."""
DEEPEST = 20
"""Levels of objects and lists in one another; world states have five."""
_END = b"\x00"
_SILENT = b"\x00\r\n "
"""Bytes without meaning between characters."""
_NOT_BLANK = re.compile(r"\S")
_DECODER = json.JSONDecoder(strict=False)


class Framer:
    """Splits one connection's bytes into messages."""

    def __init__(self, protocol: BoxProtocol = BoxProtocol.AUTO, limit: int = LIMIT) -> None:
        self.protocol = protocol
        """The protocol of the sender, as far as it is known."""
        self.garbage = 0
        """Pieces that were not a message: single characters, or whole pieces of JSON that had to be skipped."""
        self._may_change = protocol is BoxProtocol.AUTO
        self._limit = limit
        self._piece = bytearray()
        self._skipping = False

    @property
    def held(self) -> int:
        """Bytes of a message that is not complete."""
        return len(self._piece)

    def feed(self, data: bytes) -> list[dict[str, Any] | str]:
        """The messages that these bytes complete: objects, or single characters."""
        messages: list[dict[str, Any] | str] = []
        at = 0
        while at < len(data):
            if self.protocol is BoxProtocol.JSON or self._skipping:
                at = self._json(data, at, messages)
            else:
                at = self._character(data, at, messages)
        return messages

    def _character(self, data: bytes, at: int, messages: list[dict[str, Any] | str]) -> int:
        """Read one character. A brace begins JSON, unless the protocol was set to characters."""
        byte = data[at : at + 1]
        if byte == b"{":
            if self._may_change:
                self.protocol = BoxProtocol.JSON
            else:
                self.garbage += 1
                self._skipping = True
            return at
        character = byte.decode("latin-1")
        if character in BY_CHARACTER and (self.protocol is BoxProtocol.CHARACTERS or character != " "):
            self.protocol = BoxProtocol.CHARACTERS
            messages.append(character)
        elif byte not in _SILENT:
            self.garbage += 1
        return at + 1

    def _json(self, data: bytes, at: int, messages: list[dict[str, Any] | str]) -> int:
        """Read JSON up to the next zero byte, or to the end of the data."""
        end = data.find(_END, at)
        stop = len(data) if end < 0 else end
        if not self._skipping:
            self._piece += data[at:stop]
            if len(self._piece) > self._limit:
                self._piece.clear()
                self.garbage += 1
                self._skipping = True
        if end < 0:
            return stop
        if not self._skipping:
            messages.extend(self._objects(self._piece.decode("utf-8", errors="replace")))
        self._piece.clear()
        self._skipping = False
        return end + 1

    def _objects(self, text: str) -> Iterator[dict[str, Any]]:
        """The objects of a piece; after a broken one, the rest of the piece is skipped."""
        at = 0
        for _ in range(MOST_OBJECTS):
            begin = _NOT_BLANK.search(text, at)
            if begin is None:
                return
            if begin[0] != "{":
                self.garbage += 1
            brace = text.find("{", begin.start())
            if brace < 0:
                return
            try:
                found, at = _DECODER.raw_decode(text, brace)
            except (ValueError, RecursionError):
                self.garbage += 1
                return
            if is_deeper(found, DEEPEST):
                self.garbage += 1
            else:
                yield found
        self.garbage += _NOT_BLANK.search(text, at) is not None


def is_deeper(value: Any, levels: int) -> bool:
    """Whether objects and lists are nested in more levels than these: a text of few kB can have a thousand."""
    layer = [value]
    for _ in range(levels + 1):
        layer = [
            inner
            for one in layer
            if isinstance(one, dict | list)
            for inner in (one.values() if isinstance(one, dict) else one)
        ]
    return bool(layer)
