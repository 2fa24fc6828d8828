"""Carries one connection to a host and keeps the beginning of what both send, to see why the host refuses it.

Zenoh reports every refusal as "unable to connect". On the wire the host closes with a reason.
"""

import select
import socket
import ssl
import threading
from types import TracebackType
from typing import Self

_KEPT = 4096
"""Bytes of each direction that are kept; a handshake has a few hundred."""
_POLL_S = 0.02
_INIT, _OPEN, _CLOSE = 1, 2, 3
"""Kinds of Zenoh's messages of a handshake: the lowest five bits of their first byte."""


class HandshakeTap:
    """A listener on loopback, which carries the first connection to the host; `link` is the connection to it."""

    def __init__(self, link: socket.socket) -> None:
        link.setblocking(False)  # TLS has records without content: a read of one would wait for the next
        self._link = link
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.endpoint = f"tcp/127.0.0.1:{self._listener.getsockname()[1]}"
        self.from_client, self.from_host = bytearray(), bytearray()
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name="handshake tap", daemon=True)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stopping.set()
        self._thread.join()
        self._listener.close()
        self._link.close()

    def _run(self) -> None:
        while not self._stopping.is_set():
            if select.select([self._listener], [], [], _POLL_S)[0]:
                client, _ = self._listener.accept()
                with client:
                    self._carry(client)
                return

    def _carry(self, client: socket.socket) -> None:
        ways = {client: (self._link, self.from_client), self._link: (client, self.from_host)}
        while not self._stopping.is_set():
            has_more = isinstance(self._link, ssl.SSLSocket) and self._link.pending() > 0
            ready = [self._link] if has_more else select.select(list(ways), [], [], _POLL_S)[0]
            for source in ready:
                target, kept = ways[source]
                try:
                    content = source.recv(_KEPT)
                    if content:
                        target.sendall(content)
                except ssl.SSLWantReadError:
                    continue
                except OSError:
                    content = b""
                if not content:
                    return
                kept += content[: _KEPT - len(kept)]


def message_kinds(sent: bytes) -> list[int]:
    """The kinds of the Zenoh messages in the beginning of a connection; empty where it is no Zenoh."""
    return [message[0] & 0x1F for message in _messages(sent)]


def close_reason(sent: bytes) -> int | None:
    """The reason with which this end has closed the connection during the handshake; None if it has not."""
    last = _messages(sent)[-1:]
    return last[0][1] if last and last[0][0] & 0x1F == _CLOSE and len(last[0]) > 1 else None


def is_zenoh(sent: bytes) -> bool:
    """Whether the bytes are those of a Zenoh handshake."""
    kinds = message_kinds(sent)
    return bool(kinds) and kinds[0] in (_INIT, _CLOSE)


def has_opened(sent: bytes) -> bool:
    """Whether this end has sent the second message of the handshake, in which a client proves its password."""
    return _OPEN in message_kinds(sent)


def _messages(sent: bytes) -> list[bytes]:
    """The messages: each has its length before it, in two bytes. The first byte that fits in none ends the list."""
    found = []
    while len(sent) > 2:
        length = int.from_bytes(sent[:2], "little")
        message = sent[2 : 2 + length]
        if not length or len(message) < length or message[0] & 0x1F not in (_INIT, _OPEN, _CLOSE):
            break
        found.append(bytes(message))
        sent = sent[2 + length :]
    return found
