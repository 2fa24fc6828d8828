"""A referee box of the league that base stations come to, written from the protocol's tables."""

import asyncio
import json
import socket
from typing import Any

CYAN_AT, MAGENTA_AT = "224.16.32.44", "224.16.32.55"
"""What the first and the second base station are called."""


class Box:
    """A referee box: welcomes each base station with its address, and sends everything to all of them."""

    def __init__(self, greets: bool = True, reads: bool = True) -> None:
        self.greets = greets
        self.reads = reads
        self.links: list[asyncio.StreamWriter] = []
        self.came = 0
        self.states: list[Any] = []
        """World states that came."""

    async def open(self, port: int = 0) -> int:
        door = socket.socket()
        door.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        kept = 2**20
        if not self.reads:  # else the stream and the kernel on both ends, by its large segments, swallow megabytes
            kept = 1024
            door.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, kept)
            door.setsockopt(socket.IPPROTO_TCP, socket.TCP_MAXSEG, 536)
        door.bind(("127.0.0.1", port))
        self._server = await asyncio.start_server(self._meet, sock=door, limit=kept)
        return int(self._server.sockets[0].getsockname()[1])

    async def close(self) -> None:
        self._server.close()
        self.hang_up()
        await asyncio.sleep(0)

    def hang_up(self) -> None:
        for link in self.links:
            link.transport.abort()
        self.links.clear()

    def send(self, data: bytes) -> None:
        for link in self.links:
            link.write(data)

    def say(self, command: str, target: str = "", **more: Any) -> None:
        self.send(json.dumps({"command": command, "targetTeam": target, **more}).encode() + b"\x00")

    async def _meet(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        if self.greets:
            target = (CYAN_AT, MAGENTA_AT)[self.came % 2]
            writer.write(json.dumps({"command": "WELCOME", "targetTeam": target}).encode() + b"\x00")
        self.links.append(writer)
        self.came += 1
        try:
            while self.reads:
                self.states.append(json.loads((await reader.readuntil(b"\x00"))[:-1]))
            await asyncio.Event().wait()
        except (OSError, asyncio.IncompleteReadError):
            writer.transport.abort()
