"""WebSocket connections: what a client sends is read in small pieces, none of them before the one before is handled.

A piece of 1 kB inflates to 1 MB at most. Without pieces, all messages of one read from the network would be inflated at
once: 250 MB of a client that sends 256 kB.
"""

import asyncio
from asyncio.transports import BaseTransport
from typing import TYPE_CHECKING, Any

from uvicorn.protocols.websockets.websockets_sansio_impl import WebSocketsSansIOProtocol
from websockets.frames import Frame

from coach_gateway.access.client_network import client_network
from coach_gateway.access.rate_limit import TokenBucket

if TYPE_CHECKING:
    from coach_gateway.web.uvicorn_server import PageConfig

PIECE_BYTES = 1024
"""Bytes that are read at once."""
MOST_FRAGMENTS = 256
"""Frames of one message."""
_CONTROL_PER_S, _CONTROL_AT_ONCE = 2.0, 20.0
"""Pings and pongs of a client per s of wall time, and at once; browsers send none but the answers to ours."""
_NOT_UTF_8 = 1007
"""WebSocket close code."""
_MOST_CLOSING = 16
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
        self._control = TokenBucket(_CONTROL_PER_S, _CONTROL_AT_ONCE, self.config.connections.clock.now())
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

    def handle_cont(self, event: Frame) -> None:
        """Read a further frame of a message."""
        super().handle_cont(event)
        if len(self.frames) > MOST_FRAGMENTS:
            self._refuse("broken")

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
        self.config.connections.refusals.note("broken", self.network, self.config.connections.clock.now())
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
        if self._control.allow(self.config.connections.clock.now()):
            return True
        self._refuse("control frames")
        return False

    def _refuse(self, kind: str) -> None:
        """Close it at once; frames that were read with the one that is refused are not counted again."""
        if not self.transport.is_closing():
            self.config.connections.refuse(self, kind)
