"""Clients of a port that keep to no protocol: bytes, connections and WebSocket frames as an attacker makes them."""

import base64
import socket
import struct
import zlib
from contextlib import suppress

from support.page_gateway import SOON


class RawClient:
    """One TCP connection."""

    def __init__(self, port: int, room: int | None = None) -> None:
        """`room` is the size of its receive buffer, of a client that reads little."""
        self.socket = socket.socket()
        if room is not None:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, room)
        self.socket.settimeout(SOON)
        self.socket.connect(("127.0.0.1", port))

    def send(self, data: bytes) -> bool:
        """Send bytes; returns whether the connection took them."""
        try:
            self.socket.sendall(data)
        except OSError:
            return False
        return True

    def receive(self, most: int = 65_536) -> bytes:
        """What has come; empty once the connection is closed."""
        try:
            return self.socket.recv(most)
        except ConnectionError:
            return b""

    @property
    def is_closed(self) -> bool:
        """Whether the other side has closed; what has come before is passed over."""
        self.socket.setblocking(False)
        try:
            while self.socket.recv(65_536):
                pass
        except BlockingIOError:
            return False
        except OSError:
            return True
        finally:
            with suppress(OSError):
                self.socket.settimeout(SOON)
        return True

    def upgrade(self, origin: str, **headers: str) -> bytes:
        """The response to a WebSocket's handshake."""
        host = origin.partition("//")[2]
        more = "".join(f"{name.replace('_', '-')}: {value}\r\n" for name, value in headers.items())
        self.send(
            f"GET /ws HTTP/1.1\r\nHost: {host}\r\nOrigin: {origin}\r\nUpgrade: websocket\r\n"
            f"Connection: Upgrade\r\nSec-WebSocket-Version: 13\r\n{more}"
            f"Sec-WebSocket-Key: {base64.b64encode(bytes(16)).decode()}\r\n\r\n".encode()
        )
        response = b""
        while b"\r\n\r\n" not in response and (part := self.receive()):
            response += part
        return response

    def close(self) -> None:
        self.socket.close()


def frame(payload: bytes, opcode: int = 1, *, fin: bool = True, compressed: bool = False) -> bytes:
    """A frame of a WebSocket client, masked with zeros."""
    first = (0x80 if fin else 0) | (0x40 if compressed else 0) | opcode
    if len(payload) < 126:
        head = struct.pack("!BB", first, 0x80 | len(payload))
    elif len(payload) < 65_536:
        head = struct.pack("!BBH", first, 0x80 | 126, len(payload))
    else:
        head = struct.pack("!BBQ", first, 0x80 | 127, len(payload))
    return head + bytes(4) + payload


def deflated(content: bytes) -> bytes:
    """A message as permessage-deflate compresses it."""
    packer = zlib.compressobj(9, zlib.DEFLATED, -12)
    return (packer.compress(content) + packer.flush(zlib.Z_SYNC_FLUSH)).removesuffix(b"\x00\x00\xff\xff")
