"""Our referee as a referee box beside a host, and base stations that connect to it, which may send anything."""

import asyncio
import json
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import Any

from coach_gateway.ports import bound_socket
from coach_gateway.soccer.refbox.server import RefBoxServer, ServerAddress
from schemas.side import Side
from schemas.soccer.game import Phase
from support.gateway_bench import Bench, opened, until

NAMES = {"teams.cyan.name": "Sapphire", "teams.magenta.name": "Ruby"}


class BaseStation:
    """A base station at an address of loopback: reads commands, and may send objects and bytes."""

    def __init__(self) -> None:
        self.heard: list[dict[str, Any]] = []
        self.gone = False

    async def connect(self, port: int, source: str) -> "BaseStation":
        self._reader, self.writer = await asyncio.open_connection("127.0.0.1", port, local_addr=(source, 0))
        self._task = asyncio.create_task(self._hear())
        return self

    @property
    def commands(self) -> list[str]:
        """`KICKOFF SAPPHIRE`, `REPAIR RUBY 3`."""
        return [" ".join(str(word) for word in one.values() if word != "") for one in self.heard]

    def say(self, **said: Any) -> None:
        self.send(said)

    def send(self, *pieces: Any) -> None:
        for one in pieces:
            self.writer.write(one if isinstance(one, bytes) else json.dumps(one).encode() + b"\x00")

    async def leave(self) -> None:
        self.writer.transport.abort()
        await self._task

    async def _hear(self) -> None:
        try:
            while True:
                self.heard.append(json.loads((await self._reader.readuntil(b"\x00"))[:-1]))
        except (OSError, asyncio.IncompleteReadError):
            self.gone = True
            self.writer.transport.abort()


class Boxed:
    """Our box, its bench, and its base stations."""

    def __init__(self, bench: Bench, box: RefBoxServer) -> None:
        self.bench, self.box = bench, box
        self.stations: list[BaseStation] = []

    async def come(self, port: int = 0, source: str = "127.0.0.1", **hello: Any) -> BaseStation:
        """Have a base station come to the port of this number; with `hello` it says that, and is answered."""
        station = await BaseStation().connect(self.box.ports[port], source)
        self.stations.append(station)
        if hello:
            station.say(type="hello", **hello)
            await until(lambda: station.heard or station.gone)
        return station

    async def plays_on(self, *stations: BaseStation) -> None:
        """The commands of a game come to these base stations."""
        self.bench.stage.say(phase=Phase.STOPPED, side=None)
        self.bench.stage.say(phase=Phase.CORNER, side=Side.CYAN)
        await until(lambda: all("CORNER Sapphire" in one.commands for one in stations), "the game's commands")


@asynccontextmanager
async def boxed(
    *server_addresses: ServerAddress, names: dict[str, str] | None = None, **settings: Any
) -> AsyncIterator[Boxed]:
    """A box that listens at these addresses; `settings` are its own."""
    async with opened(**NAMES | (names or {})) as bench:
        addresses = server_addresses or (ServerAddress(0),)
        bound = [bound_socket("--refbox-server", one.host, one.port, socket.SOCK_STREAM) for one in addresses]
        box = RefBoxServer(bench.live, addresses, bound, bench.logged.append, **settings)
        bench.start(box)
        await until(lambda: len(box.ports) == max(1, len(server_addresses)))
        scene = Boxed(bench, box)
        try:
            yield scene
        finally:
            for station in scene.stations:
                await station.leave()
            await bench.end()
