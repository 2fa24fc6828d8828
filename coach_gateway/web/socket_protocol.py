"""WebSocket connections: what a client sends is read in small pieces, none of them before the one before is handled.

A piece of 256 bytes inflates to 250 kB at most. Without pieces, all messages of one read from the network would be
inflated at once: 250 MB of a client that sends 256 kB. A client that sends more frames or inflated bytes than pages do
is closed with a reason; nothing of what it has sent besides is read.
"""

import asyncio
from asyncio.transports import BaseTransport
from typing import TYPE_CHECKING, Any

from uvicorn.protocols.utils import ClientDisconnected
from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.frames import Frame

from coach_gateway.access.client_network import client_network
from coach_gateway.access.rate_limit import TokenBucket

if TYPE_CHECKING:
    from coach_gateway.web.uvicorn_server import PageConfig

PIECE_BYTES = 256
"""Bytes that are read at once."""
MOST_FRAGMENTS = 256
"""Frames of one message."""
_CONTROL_PER_S, _CONTROL_AT_ONCE = 2.0, 20.0
"""Pings and pongs of a client per s of wall time, and at once; browsers send none but the answers to ours."""
FRAMES_PER_S, FRAMES_AT_ONCE = 200.0, 1000.0
"""Frames of messages of a client per s of wall time, and at once."""
BYTES_PER_S, BYTES_AT_ONCE = 100_000.0, 1_000_000.0
"""Inflated bytes of messages of a client per s of wall time, and at once; a page that drives a robot sends 4 kB/s."""
_NOT_UTF_8, _POLICY = 1007, 1008
"""WebSocket close codes."""
_MOST_CLOSING = 8
"""Pieces that are read for the client's part of the closing handshake, among what it had sent before."""
_CLOSING_S = 2.0
"""s of wall time for the client's part of the closing handshake."""


class SocketProtocol(WebSocketsSansIOProtocol):
    """One WebSocket."""

    config: "PageConfig"

    def connection_made(self, transport: BaseTransport) -> None:
        """Take over an HTTP connection."""
        super().connection_made(transport)
        self.close_timeout = _CLOSING_S
        self.network = client_network(self.client[0] if self.client is not None else None)
        now = self.config.connections.clock.now()
        self._control = TokenBucket(_CONTROL_PER_S, _CONTROL_AT_ONCE, now)
        self._frames = TokenBucket(FRAMES_PER_S, FRAMES_AT_ONCE, now)
        self._bytes = TokenBucket(BYTES_PER_S, BYTES_AT_ONCE, now)
        self._unread = bytearray()
        self._pieces_closing = 0
        self._next: asyncio.Handle | None = None
        self.config.connections.enter(self)

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget it."""
        self.config.connections.remove(self)
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Read the first piece now, and the others after everything else that is due."""
        self._unread += data
        if self._next is None:
            self._read_piece()

    async def receive(self) -> Any:
        """The next message; when all are handled, the next piece is read."""
        message = await super().receive()
        if self._next is None:
            self._go_on()
        return message

    async def send(self, message: Any) -> None:
        """Send a message; what a client sends after it was refused for its behaviour is not read."""
        if self.transport.is_closing():
            raise ClientDisconnected
        if message["type"] == "websocket.close" and message.get("code") == _POLICY and self.holds_page:
            self.config.connections.penalize(self)
            self._fail(message.get("reason") or "")
            return
        await super().send(message)

    def handle_text(self, event: Frame) -> None:
        """Read the first frame of a text."""
        if self._is_data_within_limit(event):
            super().handle_text(event)

    def handle_bytes(self, event: Frame) -> None:
        """Read the first frame of a message of bytes."""
        if self._is_data_within_limit(event):
            super().handle_bytes(event)

    def handle_cont(self, event: Frame) -> None:
        """Read a further frame of a message."""
        if not self._is_data_within_limit(event):
            return
        super().handle_cont(event)
        if len(self.frames) > MOST_FRAGMENTS:
            self._refuse("broken", f"a message of more than {MOST_FRAGMENTS} frames")

    def send_receive_event_to_app(self) -> None:
        """Hand on a complete message; the first text that is not UTF-8 ends the connection."""
        if self.curr_msg_data_type == "text":
            try:
                b"".join(self.frames).decode()
            except UnicodeDecodeError:
                self.frames = []
                self.conn.fail(_NOT_UTF_8)
                self.handle_parser_exception()
                return
        super().send_receive_event_to_app()

    def handle_ping(self) -> None:
        """Answer a ping, unless they are too many."""
        if self._is_control_within_limit():
            super().handle_ping()

    def handle_pong(self, event: Frame) -> None:
        """Note a pong, unless they are too many."""
        if self._is_control_within_limit():
            super().handle_pong(event)

    def handle_parser_exception(self) -> None:
        """Close a connection that breaks the protocol."""
        self.config.connections.note_flood(self, "broken")
        super().handle_parser_exception()

    @property
    def holds_page(self) -> bool:
        """Whether the handshake is over, and neither side has closed."""
        return self.handshake_complete and not self.close_sent

    @property
    def is_serving(self) -> bool:
        """Whether a handshake is in progress."""
        return not self.handshake_complete

    def cut(self) -> None:
        """Close it at once."""
        self.transport.abort()

    def _read_piece(self) -> None:
        self._next = None
        if self.transport.is_closing():
            self._unread.clear()
            return
        self._pieces_closing += self.close_sent
        if self._pieces_closing > _MOST_CLOSING:
            self.cut()
            return
        piece = bytes(self._unread[:PIECE_BYTES])
        del self._unread[:PIECE_BYTES]
        super().data_received(piece)
        self._go_on()

    def _go_on(self) -> None:
        """Read the next piece soon, unless messages wait to be handled; without one, read from the network again."""
        if self._unread:
            self.transport.pause_reading()
            if not self.read_paused:
                self._next = self.loop.call_soon(self._read_piece)
        elif not self.read_paused:
            self.transport.resume_reading()

    def _is_control_within_limit(self) -> bool:
        if self.transport.is_closing():
            return False
        if self._control.allow(self.config.connections.clock.now()):
            return True
        self._refuse("control frames", f"more than {_CONTROL_PER_S:g} pings and pongs a second")
        return False

    def _is_data_within_limit(self, event: Frame) -> bool:
        """Whether a frame is read: of a client that is being closed, or is over its limits, none is."""
        if self.transport.is_closing():
            return False
        now = self.config.connections.clock.now()
        if not self._frames.allow(now):
            self._refuse("frames", f"more than {FRAMES_PER_S:g} frames a second")
        elif self._bytes.delay(now, len(event.data)) > 0.0:
            self._refuse("bytes", f"more than {BYTES_PER_S / 1000:g} kB a second")
        return not self.transport.is_closing()

    def _refuse(self, kind: str, reason: str) -> None:
        """Close it with a reason; frames that were read with the one that is refused are not counted again."""
        if not self.transport.is_closing():
            self.config.connections.note_flood(self, kind, reason)
            self._fail(reason)

    def _fail(self, reason: str) -> None:
        """Send why it is closed, and close it without waiting for its client."""
        self.frames = []
        self.conn.fail(_POLICY, reason)
        self.transport.write(b"".join(self.conn.data_to_send()))
        self.close_sent = True
        self._unread.clear()
        self.transport.close()
