"""From a stream of bytes to messages: JSON objects ended by a zero byte, or single characters. Pure.

However the stream is cut into pieces, the messages are the same. What is no message is counted and left out, and the
next zero byte begins anew.
"""

import json
from collections.abc import Iterator
from enum import StrEnum
from typing import Any

from schemas.league.signals import BY_CHARACTER

LIMIT = 65_536
"""Bytes of one JSON message; more is a sender that forgets its zero bytes. Teams' world states have 2 to 10 kB."""
_END = b"\x00"
_SILENT = b"\x00\r\n"
"""Between characters they mean nothing."""
_DECODER = json.JSONDecoder(strict=False)


class BoxProtocol(StrEnum):
    """How a referee box speaks."""

    AUTO = "auto"
    """As its first bytes show: JSON begins with a brace."""
    JSON = "json"
    CHARACTERS = "characters"


class Framer:
    """Takes one connection's bytes."""

    def __init__(self, protocol: BoxProtocol = BoxProtocol.AUTO, limit: int = LIMIT) -> None:
        self.protocol = protocol
        """How the sender speaks, as far as that is known."""
        self.garbage = 0
        """Pieces that were no message; of characters each, of JSON each that had to be passed over."""
        self._may_change = protocol is BoxProtocol.AUTO
        self._limit = limit
        self._piece = bytearray()
        self._passing_over = False

    def feed(self, data: bytes) -> list[dict[str, Any] | str]:
        """The messages that these bytes complete: objects, or single characters."""
        messages: list[dict[str, Any] | str] = []
        at = 0
        while at < len(data):
            if self.protocol is BoxProtocol.JSON or self._passing_over:
                at = self._json(data, at, messages)
            else:
                at = self._character(data, at, messages)
        return messages

    def _character(self, data: bytes, at: int, messages: list[dict[str, Any] | str]) -> int:
        """One character; a brace is none: with it JSON begins, where nobody said that there is none."""
        byte = data[at : at + 1]
        if byte == b"{":
            if self._may_change:
                self.protocol = BoxProtocol.JSON
            else:
                self.garbage += 1
                self._passing_over = True
            return at
        character = byte.decode("latin-1")
        if character in BY_CHARACTER and (self.protocol is BoxProtocol.CHARACTERS or character != " "):
            self.protocol = BoxProtocol.CHARACTERS
            messages.append(character)
        elif byte not in (_SILENT[:1], _SILENT[1:2], _SILENT[2:], b" "):
            self.garbage += 1
        return at + 1

    def _json(self, data: bytes, at: int, messages: list[dict[str, Any] | str]) -> int:
        """Up to the next zero byte, or to the end of the data."""
        end = data.find(_END, at)
        stop = len(data) if end < 0 else end
        if not self._passing_over:
            self._piece += data[at:stop]
            if len(self._piece) > self._limit:
                self._piece.clear()
                self.garbage += 1
                self._passing_over = True
        if end < 0:
            return stop
        if not self._passing_over:
            messages.extend(self._objects(self._piece.decode("utf-8", errors="replace")))
        self._piece.clear()
        self._passing_over = False
        return end + 1

    def _objects(self, text: str) -> Iterator[dict[str, Any]]:
        """The objects of a piece; behind one that is broken, the rest of the piece is passed over."""
        at = 0
        while text[at:].strip():
            begin = text.find("{", at)
            if begin < 0 or text[at:begin].strip():
                self.garbage += 1
            if begin < 0:
                return
            try:
                found, at = _DECODER.raw_decode(text, begin)
            except (ValueError, RecursionError):
                self.garbage += 1
                return
            yield found
